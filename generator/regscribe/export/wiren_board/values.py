"""What a channel of a template says of a value: its form, scale, limits, codes and the one error value."""

from fractions import Fraction

from regscribe.dialects.wiren_board import ORDERS, STRING8, TYPES
from regscribe.emit.words import one_line, sentinel_words, span_words
from regscribe.export.device import Device, Point
from regscribe.export.device.numbers import is_exact, json_number
from regscribe.losses import Grade
from regscribe.model import BitField, Enum, Kind, Member, Order, WireType, show

Channel = dict[str, object]
"""The keys of a channel."""

SHOWN = 10**15
"""Up to there the service shows all digits of a number that it scales."""

DIGITS = {WireType.FLOAT32: 7, WireType.FLOAT64: 15}
"""Significant digits that it shows of floats."""

UNSIGNED = {
    WireType.INT16: WireType.UINT16,
    WireType.INT24: WireType.UINT24,
    WireType.INT32: WireType.UINT32,
    WireType.INT64: WireType.UINT64,
}
"""The types as which bits are taken without a sign."""


def value(device: Device, point: Point) -> Channel:
    """What the whole register means."""
    kind, wire = point.register.kind, point.wire
    if wire.space.is_bits:
        return {"type": "value", **_codes(point.members)} if point.members else {"type": "switch"}
    if wire.type is WireType.STRING:
        form = TYPES[wire.type] if point.register.text.per_register else STRING8
        return {"type": "text", "format": form, **_one_per_register(point), "string_data_size": point.words}
    if kind is Kind.BOOLEAN:
        lose_faults(device, point, "fault words are shown as they are", None)
        return {"type": "switch", "format": TYPES[wire.type], "on_value": "1", "off_value": "0"}
    device.lose_version(point)
    _lose_digits(device, point)
    return {
        "type": "value",
        "format": TYPES[wire.type],
        **_scale(point.slope, point.offset),
        **({"units": point.unit} if point.unit else {}),
        **_limits(device, point),
        **_codes(point.members),
        **_error(device, point),
    }


def _one_per_register(point: Point) -> Channel:
    """The service takes the low byte of each word: where the high one counts, its bytes are swapped."""
    low = point.register.text.per_register != "high"
    return {} if low else {"byte_order": ORDERS[Order.LITTLE if point.wire.bytes is Order.BIG else Order.BIG]}


def _lose_digits(device: Device, point: Point) -> None:
    if digits := DIGITS.get(point.wire.type):
        device.lose(point.register, "decimals-cut", Grade.LOST, f"shown with {digits} significant digits")
    elif point.is_scaled and max(map(abs, point.wire.type.ends)) > SHOWN:
        device.lose(
            point.register, "precision-float64", Grade.WRONG, "shown with 15 significant digits, as it is scaled"
        )
    if not (is_exact(point.slope) and is_exact(point.offset)):
        device.lose(point.register, "scale-rounded", Grade.COSMETIC, "its scale is rounded to a float of 64 bits")


def _scale(slope: Fraction, offset: Fraction) -> Channel:
    scale = {"scale": json_number(slope)} if slope != 1 else {}
    return {**scale, **({"offset": json_number(offset)} if offset else {})}


def _limits(device: Device, point: Point) -> Channel:
    """The lowest and the highest value that may be written, as far as they are known."""
    register = point.register
    if not register.access.writable or not register.range:
        return {}
    if point.limits is None:
        device.lose(register, "range", Grade.LOST, "its limits are not known as the device is stated")
        return {}
    low, high = point.limits
    return {"min": json_number(low), "max": json_number(high)}


def _codes(members: tuple[Member, ...]) -> Channel:
    if not members:
        return {}
    return {"enum": [str(one.code) for one in members], "enum_titles": [one_line(one.label) for one in members]}


def _error(device: Device, point: Point) -> Channel:
    """The one fault word that becomes an error, as the pattern of its bits."""
    chosen = next((one for one in point.faults if one.low is not None and one.low == one.high), None)
    lose_faults(device, point, "error_value is one number", chosen and chosen.low)
    if chosen is None or chosen.low is None:
        return {}
    number = chosen.low if point.wire.type.is_float else int(chosen.low)
    words = point.wire.type.pack(float(number) if point.wire.type.is_float else int(number))
    pattern = 0
    for word in words:
        pattern = pattern << 16 | word
    bits = point.wire.type.bits or 16 * len(words)
    device.lose(point.register, "sentinel-label", Grade.LOST, f"an error without its label: {one_line(chosen.label)}")
    return {"error_value": f"0x{pattern & ((1 << bits) - 1):X}"}


def lose_faults(device: Device, point: Point, why: str, taken: object) -> None:
    """Tell the fault words that are shown as values; what is no number is shown as such."""
    for fault in point.faults:
        if fault.low is None or fault.high is None or (fault.low == fault.high == taken):
            continue
        code = "sentinel" if taken is None else "several-sentinels"
        number = span_words(show(fault.low), show(fault.high))
        device.lose(point.register, code, Grade.WRONG, f"shown as a value: {number} = {one_line(fault.label)} ({why})")


def part_of(device: Device, point: Point, part: BitField) -> Channel:
    """Some bits of a word."""
    form = TYPES[UNSIGNED.get(point.wire.type, point.wire.type)]
    place: Channel = {"address": f"{point.address}:{part.low}:{part.width}", "format": form}
    if point.write is not None and point.write != point.address:
        place["write_address"] = f"{point.write}:{part.low}:{part.width}"
    if part.is_flag:
        return {"type": "switch", **place}
    error: Channel = {}
    for place_of, fault in enumerate(part.sentinels):
        if fault.ends is None or fault.ends[0] != fault.ends[1] or place_of:
            done = f"shown as a value of {part.id}: {one_line(sentinel_words(fault))}"
            device.lose(point.register, "fields", Grade.WRONG, done)
        else:
            done = f"{part.id} is an error without its label: {one_line(fault.label)}"
            device.lose(point.register, "sentinel-label", Grade.LOST, done)
            error = {"error_value": f"0x{int(fault.ends[0]):X}"}
    limits = {"min": json_number(part.range[0]), "max": json_number(part.range[1])} if part.range else {}
    return {
        "type": "value",
        **place,
        **_scale(part.multiply, part.add),
        **({"units": part.unit} if part.unit else {}),
        **(limits if point.register.access.writable else {}),
        **_codes(_members(part.enum)),
        **error,
    }


def _members(enum: Enum | None) -> tuple[Member, ...]:
    return enum.members if enum else ()
