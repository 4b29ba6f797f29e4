"""Truth values in Home Assistant: a binary sensor, or a switch where the device takes a write as it stands."""

from collections.abc import Mapping
from math import ceil

from regscribe.dialects.home_assistant import SPACES
from regscribe.emit.words import one_line, span_words
from regscribe.export.device import Device, Point
from regscribe.export.device.writes import obstacle, writes_several
from regscribe.losses import Grade
from regscribe.model import Order, Space, WireType, show

Entity = dict[str, object]
"""The keys of an entity."""

WORDS = frozenset({WireType.UINT16, WireType.INT16})
"""Types of words of which a binary sensor reads the lowest bit."""

WRITES: Mapping[tuple[Space, bool], str] = {
    (Space.HOLDING, False): "holding",
    (Space.HOLDING, True): "holdings",
    (Space.COIL, False): "coil",
    (Space.COIL, True): "coils",
}
"""Values of `write_type` by the space, and whether the function is that for several."""


def placed(device: Device, point: Point) -> Entity:
    """Where an entity stands, and how often it is read: as all others, or as seldom as the map says."""
    register, every = point.register, device.request.every
    _, wanted, kept = register.reading
    if isinstance(wanted, str) or kept or register.static:
        done = f"read every {every} s, as all others: the map says how long a value holds, or how often in a word"
        device.lose(register, "poll", Grade.COSMETIC, done)
    seconds = every if isinstance(wanted, str) else max(every, ceil(wanted))
    return {"slave": device.request.unit, "address": point.address, "scan_interval": seconds}


def lose_faults(device: Device, point: Point, code: str, why: str, taken: int | None = None) -> None:
    """Tell that fault words are shown as values; not what is no number, nor `taken` and its negative."""
    for fault in point.faults:
        if fault.low is not None and fault.high is not None and (taken is None or {*fault[:2]} - {taken, -taken}):
            number = span_words(show(fault.low), show(fault.high))
            done = f"shown as a value: {number} = {one_line(fault.label)} ({why})"
            device.lose(point.register, code, Grade.WRONG, done)


def binary_sensor(device: Device, point: Point) -> Entity:
    """A truth value that is read."""
    if point.register.access.writable:
        device.lose(point.register, "write", Grade.LOST, f"read only: {obstacle(point, device.register_map.protocol)}")
    lose_faults(device, point, "sentinel", "only the lowest bit counts")
    if point.wire.space.is_words:
        done = "Home Assistant looks at the lowest bit alone: a word that is neither 0 nor 1 reads as on or off"
        device.lose(point.register, "truth-of-words", Grade.WRONG, done)
    return placed(device, point) | {"input_type": SPACES[point.wire.space]}


def is_truth(point: Point) -> bool:
    """Whether a register is a bit, or a word whose lowest bit says it."""
    one_word = point.words == 1 and point.wire.bytes is Order.BIG and point.wire.type in WORDS
    return point.is_truth and (point.wire.space.is_bits or one_word)


def switches(device: Device, point: Point) -> bool:
    """Whether a register is a switch: a truth value that is written where it is read, with nothing before or after."""
    return is_truth(point) and point.register.access.writable and not obstacle(point, device.register_map.protocol)


def switch(device: Device, point: Point) -> Entity:
    """A truth value that is written, and read back."""
    several = writes_several(point, device.register_map.protocol)
    lose_faults(device, point, "sentinel", "a switch keeps its state then")
    verify: Entity = {"input_type": SPACES[point.wire.space]}
    if point.write != point.address:
        verify["address"] = point.address
    if settle := ceil(point.register.settle / 1000):
        verify["delay"] = settle
    write_type = WRITES[point.wire.space, several]
    return placed(device, point) | {"address": point.write, "write_type": write_type, "verify": verify}
