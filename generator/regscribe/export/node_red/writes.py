"""Which registers a flow may write, and the table from which it does."""

from regscribe.export.device import Device, Point
from regscribe.export.device.places import places_of, step_of
from regscribe.export.device.writes import obstacle, write_function
from regscribe.export.node_red.table import Entry, entry_of, intervals
from regscribe.losses import Grade
from regscribe.model import Kind

WRITTEN = frozenset({Kind.NUMBER, Kind.INTEGER, Kind.RAW, Kind.ENUM, Kind.BOOLEAN})
"""Kinds that are written whole, with no bits of others in the same word and no characters to be checked."""


def write_entries(device: Device) -> list[Entry]:
    """Return how to write each register that can be written, and tell the loss of those that are only read."""
    found = []
    for point in device.points:
        if point.write is None:
            continue
        if why := _why_not(device, point):
            device.lose(point.register, "write", Grade.LOST, f"read only: {why}")
        else:
            found.append(_entry(device, point, point.write))
    return found


def _why_not(device: Device, point: Point) -> str:
    register, view = point.register, point.register.write_view
    most = device.register_map.protocol.most_written(view.space)
    reasons = {
        f"the flow does not write a value of the kind {register.kind}": register.kind not in WRITTEN,
        (why := obstacle(point, device.register_map.protocol)): bool(why),
        "its range is not known as the device is stated": point.ranges is None or point.valid is None,
        "its smallest step is not known as the device is stated": step_of(point, device.request.known) == 0,
        "its words do not stand side by side": point.wire.apart,
        "its writes must be aligned": (point.write or 0) % view.align or point.words % view.align,
        f"a request may write {most} of its {point.words} words": most < point.words,
    }
    return next((why for why, holds in reasons.items() if holds), "")


def _entry(device: Device, point: Point, address: int) -> Entry:
    said = {key: value for key, value in entry_of(point, point.address).items() if key not in {"bit", "raw", "unit"}}
    said |= {"fc": write_function(point, device.register_map.protocol), "address": address, "quantity": point.words}
    if point.wire.space.is_bits:
        ends = {"lowest": "0", "highest": "1", "bits": 1, "bytes": [0]}
        return said | {"coil": True} | ends | ({"ranges": intervals(point.ranges)} if point.ranges else {})
    return said | _number(device, point)


def _number(device: Device, point: Point) -> Entry:
    every, wire_type = places_of(point), point.wire.type
    used = wire_type.bits // 8 if wire_type.spelling and wire_type.bits else len(every)
    said: Entry = {"bytes": every, "read": list(range(len(every) - used, len(every)))}
    if point.ranges:
        said["ranges"] = intervals(point.ranges)
    if wire_type.is_integer:
        clips = point.view.saturates
        said["lowest"], said["highest"] = str(wire_type.minimum + clips), str(wire_type.maximum - clips)
        # the byte beside a number of one byte is written as 0, other words that a number does not fill with its sign
        said["bits"] = wire_type.bits if used == 1 else 8 * len(every)
    if step := step_of(point, device.request.known):
        said["step"] = str(step)
    return said
