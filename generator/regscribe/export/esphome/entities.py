"""What a register becomes in ESPHome: one entity, or one for each of its bits and parts."""

from collections.abc import Iterator

from regscribe.dialects.esphome import SPACES
from regscribe.export.device import Device, Point
from regscribe.export.device.names import distinct
from regscribe.export.device.writes import obstacle, writes_several
from regscribe.export.esphome.items import Item, Keys
from regscribe.export.esphome.numbers import number
from regscribe.export.esphome.sensors import part_of, place, sensor
from regscribe.losses import Grade
from regscribe.model import BitField, Kind, Order, Space, WireType

WORD_BITS = 16
MASKED_WORDS = 2
"""The most words of which the component takes bits by a mask."""


def items(device: Device, point: Point) -> Iterator[Item]:
    """The entities of a register, with their losses told."""
    kind = point.register.kind
    if point.wire.space.is_bits or (
        kind is Kind.BOOLEAN and point.words == 1 and point.wire.type is not WireType.UINT8
    ):
        yield _truth(device, point)
    elif point.wire.type is WireType.STRING:
        yield _text(device, point)
    elif kind in {Kind.FLAGS, Kind.FIELDS} and point.fields:
        yield from _parts(device, point)
    else:
        yield _number(device, point)


def _number(device: Device, point: Point) -> Item:
    kind, writable = point.register.kind, point.register.access.writable
    found = None
    if kind is Kind.ENUM:
        found = _select(device, point) if writable else None
        if found is None:
            device.lose(point.register, "enum", Grade.LOST, "its codes are shown as numbers, without their labels")
    elif kind is Kind.BOOLEAN:
        device.lose(point.register, "boolean", Grade.LOST, "shown as the number 0 or 1")
        _lose_write(device, point, "the component writes truth values to one register")
    elif writable:
        found = number(device, point)
    return found or sensor(device, point)


def _lose_write(device: Device, point: Point, why: str) -> None:
    if point.register.access.writable:
        device.lose(point.register, "write", Grade.LOST, f"read only: {why}")


def _truth(device: Device, point: Point) -> Item:
    bits, protocol = point.wire.space.is_bits, device.register_map.protocol
    why = obstacle(point, protocol) or ("" if point.write == point.address else "it is written at another address")
    written = point.register.access.writable and not why
    if not written:
        _lose_write(device, point, why)
    keys: Keys = {"register_type": SPACES[point.wire.space], "address": point.address}
    if not bits:
        keys["bitmask"] = 1 << (0 if point.wire.bytes is Order.BIG else WORD_BITS // 2)
        done = "the lowest bit alone counts: a word that is neither 0 nor 1 reads as on or off"
        device.lose(point.register, "truth-of-words", Grade.WRONG, done)
    if point.faults:
        device.lose(point.register, "sentinel", Grade.WRONG, "fault words are shown as on or off")
    if point.register.kind is Kind.ENUM:
        device.lose(point.register, "enum", Grade.LOST, "shown as on and off")
    if written:
        done = "after a write the state that was asked for is shown, refused or not, until the next poll"
        device.lose(point.register, "write-echo", Grade.LOST, done)
        keys |= {"use_write_multiple": True} if writes_several(point, protocol) else {}
    platform = "switch" if written else "binary_sensor"
    return Item(platform=platform, point=point, label=point.register.name, address=point.address, keys=keys)


def _text(device: Device, point: Point) -> Item:
    _lose_write(device, point, "the component writes no texts")
    return Item(
        platform="text_sensor",
        point=point,
        label=point.register.name,
        address=point.address,
        count=point.words,
        keys={
            "register_type": SPACES[point.wire.space],
            "address": point.address,
            "register_count": point.words,
            "response_size": 2 * point.words,
            "raw_encode": "ANSI",
        },
    )


def _parts(device: Device, point: Point) -> Iterator[Item]:
    _lose_write(device, point, "the component would write the other bits of the word too")
    if point.faults:
        device.lose(point.register, "sentinel", Grade.WRONG, "fault words are shown as bits")
    wide = [part for part in point.fields if not part.is_flag]
    masked = point.words <= MASKED_WORDS and not any(part.signed for part in wide)
    if wide and not masked:
        device.lose(point.register, "fields", Grade.LOST, "exported as the number of the word: no mask takes its parts")
        yield sensor(device, point)
    elif wide:
        yield from (part_of(device, point, part) for part in wide)
    yield from (_flag(point, part) for part in point.fields if part.is_flag)


def _flag(point: Point, flag: BitField) -> Item:
    """One bit, in the word that has it."""
    word, bit = divmod(flag.low, WORD_BITS)
    behind = point.words - 1 - word if point.wire.words is Order.BIG else word
    mask = 1 << (bit if point.wire.bytes is Order.BIG else bit ^ 8)
    address = point.address + behind
    keys: Keys = {"register_type": SPACES[point.wire.space], "address": address, "bitmask": mask}
    label = f"{point.register.name} {flag.label}"
    return Item(platform="binary_sensor", point=point, label=label, address=address, part=flag.id, keys=keys)


def _select(device: Device, point: Point) -> Item | None:
    """A choice that is written; None, with the reason told, where it is only read."""
    protocol, members = device.register_map.protocol, point.members
    why = "" if point.wire.space is Space.HOLDING else "the component writes holding registers alone"
    why = why or obstacle(point, protocol)
    why = why or ("" if point.write == point.address else "it is written at another address than it is read at")
    if why or not members or not point.wire.type.is_integer or point.wire.type is WireType.UINT8:
        _lose_write(device, point, why or "a select writes numbered codes of whole words")
        return None
    labels = list(distinct((one.label, str(one.code)) for one in members))
    if [one.label for one in members] != labels:
        device.lose(point.register, "enum", Grade.COSMETIC, "labels that are the same have their codes behind them")
    device.lose(point.register, "enum", Grade.LOST, "a code without a label leaves the choice before it on display")
    keys = {key: value for key, value in place(point).items() if key != "register_type"}
    keys["optionsmap"] = dict(zip(labels, (one.code for one in members), strict=True))
    keys |= {"use_write_multiple": True} if point.words == 1 and writes_several(point, protocol) else {}
    return Item(
        platform="select",
        point=point,
        label=point.register.name,
        address=point.address,
        count=point.words,
        keys=keys,
    )
