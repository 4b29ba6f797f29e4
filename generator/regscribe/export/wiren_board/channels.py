"""What a register becomes in a template: one channel, or one for each of its bits and parts."""

from collections.abc import Iterator
from math import ceil

from regscribe.dialects.wiren_board import ORDERS, SPACES
from regscribe.export.device import Device, Point
from regscribe.export.device.writes import obstacle, write_function
from regscribe.export.wiren_board.values import Channel, lose_faults, part_of, value
from regscribe.losses import Grade
from regscribe.model import Kind, Order, Space, WireType

SEVERAL, COIL = 16, 5
"""The functions that write several registers, and one coil."""


def channels(device: Device, point: Point) -> Iterator[tuple[str, str, Channel]]:
    """The channels of a register, each with the id and the label that it has, and the losses told."""
    register = point.register
    if register.kind in {Kind.FLAGS, Kind.FIELDS} and point.fields and not point.wire.space.is_bits:
        place = _place(device, point)
        lose_faults(device, point, "fault words are shown as bits", None)
        for part in point.fields:
            label = f"{register.name} {part.label}"
            if part.signed:
                device.lose(register, "fields", Grade.LOST, f"left out: {part.id}, a signed number of some bits")
            else:
                yield part.id, label, place | part_of(device, point, part)
        return
    yield "", register.name, _place(device, point) | value(device, point)


def _place(device: Device, point: Point) -> Channel:
    """Where it stands, how it is written, and how often it is read."""
    wire, register = point.wire, point.register
    why = _why_read_only(device, point)
    if register.access.writable and why:
        device.lose(register, "write", Grade.LOST, f"read only: {why}")
    orders = {
        **({"word_order": ORDERS[wire.words]} if isinstance(wire.words, Order) and wire.words is not Order.BIG else {}),
        **({"byte_order": ORDERS[wire.bytes]} if isinstance(wire.bytes, Order) and wire.bytes is not Order.BIG else {}),
    }
    written = register.access.writable and not why
    function = write_function(point, device.register_map.protocol) if written else 0
    several = written and point.words == 1 and function == SEVERAL
    return {
        "reg_type": "holding_multi" if several else SPACES[wire.space],
        "address": point.address,
        **({"write_address": point.write} if written and point.write != point.address else {}),
        **({} if wire.space.is_bits else orders),
        **({} if written or wire.space in {Space.INPUT, Space.DISCRETE} else {"readonly": True}),
        **_poll(device, point),
    }


def _why_read_only(device: Device, point: Point) -> str:
    if point.wire.type is WireType.STRING and not point.wire.space.is_bits:
        return "the service writes a shorter text over the beginning of a longer one"
    if point.register.kind is Kind.VERSION:
        return "a version is not written as a number"
    why = obstacle(point, device.register_map.protocol)
    if not why and point.wire.space is Space.COIL and write_function(point, device.register_map.protocol) != COIL:
        return "the service writes a coil by function 5 alone"
    return why


def _poll(device: Device, point: Point) -> Channel:
    _, wanted, kept = point.register.reading
    if isinstance(wanted, str) or kept or point.register.static:
        done = "read as all others: the map says how long a value holds, or how often in a word"
        device.lose(point.register, "poll", Grade.COSMETIC, done)
    return {} if isinstance(wanted, str) or not wanted else {"read_rate_limit_ms": ceil(1000 * wanted)}
