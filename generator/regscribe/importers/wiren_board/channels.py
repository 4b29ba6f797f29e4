"""Channels, parameters and setup of Wiren Board's templates."""

import math
import struct
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Any

from regscribe.dialects import Orders, read_back
from regscribe.dialects.wiren_board import ORDERS, OTHER_TYPES, SINGLE_WRITES, SPACES, STRING8, TYPES
from regscribe.draft import Remark
from regscribe.draft.labels import described, labelled
from regscribe.draft.numbers import plain
from regscribe.files import OneLine
from regscribe.importers.shared.exact import whole
from regscribe.importers.shared.points import Point
from regscribe.importers.shared.reading import Keys, refuse
from regscribe.importers.shared.tree import Node
from regscribe.importers.wiren_board.conditions import ConditionError, Reference, condition_of
from regscribe.model import Order, Space, Span, WireType, show

INPUTS = {**read_back(SPACES), **dict.fromkeys(SINGLE_WRITES, Space.HOLDING)}
BY_TYPE = read_back(TYPES)
BY_ORDER = read_back(ORDERS)
USUAL = "u16"

SHOWN = frozenset(
    {"name", "title", "type", "group", "order", "enabled", "sporadic", "semi-sporadic", "original_name"}
) | {
    *("id", "round_to", "description", "default", "vrf", "precision", "required", "min", "max", "units", "unit"),
    *("max_fail_cycles", "poll_interval"),
}
"""Keys that only matter to what Wiren Board shows, or when it asks."""

UNITS = {
    "temperature": "°C",
    "rel_humidity": "%",
    "atmospheric_pressure": "mbar",
    "power": "W",
    "power_consumption": "kWh",
    "voltage": "V",
    "water_flow": "m³/h",
    "water_consumption": "m³",
    "resistance": "Ω",
    "concentration": "ppm",
    "wind_speed": "m/s",
}
"""Units that a type of channel has by Wiren Board's conventions."""

WRITE_ONLY = frozenset({"wo-switch"})
PUSHED = "pushbutton"
PARTS = 3
FLOATS = {WireType.FLOAT32: (">f", 4), WireType.FLOAT64: (">d", 8)}


@dataclass(slots=True)
class Context:
    """What counts for all channels: names of groups, texts in English, parameters, and those that conditions ask."""

    groups: Mapping[str, str]
    said: Mapping[str, str]
    references: Mapping[str, Reference]
    asked: set[str] = field(default_factory=set)

    def group(self, one: Node, usual: str) -> str:
        """The name of the group of a channel."""
        return self.groups.get(one.word("group"), "") or one.word("group") or usual


def channel(name: str, place: Span, context: Context, own: str, keys: Keys) -> Point:
    """Return the register of a channel, or of the parameter `own`. Raises LeftOutError."""
    for key in ("oneOf", "device_type", "consists_of"):
        if keys.has(key):
            refuse(key, f"it is made of others ({key}), which is not taken over")
    space = keys.choice("reg_type", INPUTS, "holding")
    at, bits = _address(keys)
    point = Point(name=name, place=place, at=at, space=space, access=_access(keys, space))
    more: dict[str, Any] = {"id": context.references[own].id} if own in context.references else {}
    more |= _when(keys, context) | _further(keys, context, point)
    point = replace(point, bits=bits, unit=_unit(keys), more=more)
    if space.is_bits:
        keys.taken |= {"format", "word_order", "byte_order", "scale", "offset", "on_value", "off_value"}
        return replace(point, type=WireType.BIT, unit="", bits=None, more=more | _codes(keys, context, point))
    return _of_words(point, keys, context)


def _address(keys: Keys) -> tuple[int, tuple[int, int] | None]:
    """The wire address, and the bits of a word (`reg:shift:width`)."""
    found = keys.take("address")
    parts = [whole(one) for one in (found.text if found and found.is_scalar else "").split(":")]
    known = [one for one in parts if one is not None]
    if len(known) != len(parts) or len(known) not in {1, PARTS}:
        refuse("address", f"address {found.shown if found else 'is not given and'} is none of Modbus")
    if len(known) == 1:
        return known[0], None
    at, shift, width = known
    if width < 1:
        refuse("address", f"a part of {width} bits")
    return at, (shift, shift + width - 1)


def _access(keys: Keys, space: Space) -> str:
    if keys.truth("readonly") or space in {Space.INPUT, Space.DISCRETE}:
        return "r"
    return "w" if keys.node.word("type") in WRITE_ONLY else "rw"


def _unit(keys: Keys) -> str:
    return keys.text("units") or keys.text("unit") or UNITS.get(keys.node.word("type"), "")


def _when(keys: Keys, context: Context) -> dict[str, Any]:
    """The condition under which it exists. Raises LeftOutError for one that is not understood."""
    text = keys.text("condition")
    if not text:
        return {}
    try:
        when, asked = condition_of(text, context.references)
    except ConditionError as why:
        refuse("condition", f"condition `{text}`: {why}")
    context.asked |= asked
    return {"when": when}


def _further(keys: Keys, context: Context, point: Point) -> dict[str, Any]:
    """Facts beside the number: where it is written, how often it is read, by which function."""
    more: dict[str, Any] = {}
    written = keys.whole("write_address")
    if written is not None and point.access != "r":
        more["write_at"] = written
    period = keys.whole("read_period_ms") or keys.whole("read_rate_limit_ms")
    if period:
        more["poll"] = plain(Fraction(period, 1000))
    function = SINGLE_WRITES.get(keys.node.word("reg_type"))
    if function:
        more["functions"] = [3, *function]
    if keys.node.word("type") == PUSHED and point.access != "r":
        more["stays"] = "momentary"
    keys.drop("fw", "the firmware since which it exists")
    return more | described(point.name, context.said.get(keys.node.word("description"), ""))


def _of_words(point: Point, keys: Keys, context: Context) -> Point:
    """The point with the form of its words, its scale and its codes. Raises LeftOutError."""
    told = keys.text("format", USUAL)
    orders: Orders = (
        keys.choice("word_order", BY_ORDER, "big_endian"),
        keys.choice("byte_order", BY_ORDER, "big_endian"),
    )
    if told in {"string", STRING8}:
        words = keys.whole("string_data_size") or 0
        if not words or point.bits:
            refuse("string_data_size", "a text has no string_data_size")
        if told == STRING8:
            return replace(point, type=WireType.STRING, words=words, orders=orders, unit="")
        text = OneLine(one_per_register="low" if orders[1] is Order.BIG else "high")
        orders = (orders[0], Order.BIG)
        return replace(
            point, type=WireType.STRING, words=words, orders=orders, unit="", more={**point.more, "text": text}
        )
    if told not in BY_TYPE:
        refuse("format", f"format `{told}` is none that is understood {OTHER_TYPES.get(told, '')}".strip())
    wire = BY_TYPE[told]
    point = replace(
        point, type=wire, orders=orders, multiply=keys.scale("scale"), add=keys.number("offset") or Fraction(0)
    )
    if point.multiply == 0:
        refuse("scale", "a scale of 0")
    more = {**point.more, **_faults(keys, wire), **_codes(keys, context, point)}
    if "enum" not in more and point.access != "r":
        more |= _limits(keys)
    return replace(point, unit="" if "enum" in more else point.unit, more=more)


def _limits(keys: Keys) -> dict[str, Any]:
    low, high = keys.number("min"), keys.number("max")
    return {} if low is None or high is None else {"range": f"{show(low)}..{show(high)}"}


def _faults(keys: Keys, wire: WireType) -> dict[str, Any]:
    """Words that are no values: they are patterns, so of a signed number the highest bit is its sign."""
    found: dict[Any, str] = {}
    for key, label in (("error_value", "error"), ("unsupported_value", "not supported")):
        pattern = keys.whole(key)
        if pattern is None:
            continue
        number = _meant(pattern, wire)
        if number is None:
            keys.remarks.append(Remark("error-value-dropped", f"{key} {pattern} is no word of {wire}", todo=True))
        else:
            found[number] = label
    return {"sentinels": OneLine(found)} if found else {}


def _meant(pattern: int, wire: WireType) -> Any:  # noqa: ANN401 - a number as YAML has it, or nan
    if wire in FLOATS:
        code, size = FLOATS[wire]
        if not 0 <= pattern < 1 << 8 * size:
            return None
        (value,) = struct.unpack(code, pattern.to_bytes(size, "big"))
        return "nan" if math.isnan(value) else None if math.isinf(value) else plain(Fraction(value))
    if not wire.is_integer or pattern >= 1 << wire.bits:
        return None
    signed = wire.minimum < 0 and pattern >= 1 << (wire.bits - 1)
    number = pattern - (1 << wire.bits) if signed else pattern
    return number if wire.minimum <= number <= wire.maximum else None


def _codes(keys: Keys, context: Context, point: Point) -> dict[str, Any]:
    """The codes of an enum, or those of a switch."""
    listed, titles = keys.take("enum"), keys.take("enum_titles")
    on, off = keys.whole("on_value"), keys.whole("off_value")
    if listed is None and on is None and off is None:
        return {}
    if listed is None:
        codes = {0 if off is None else off: "off", 1 if on is None else on: "on"}
    else:
        texts = [context.said.get(one.text, one.text) for one in (titles.each if titles else listed.each)]
        numbers = [whole(one.text) for one in listed.each]
        codes = {code: text for code, text in zip(numbers, texts, strict=False) if code is not None}
        if len(codes) != len(numbers) or len(texts) != len(numbers):
            message = f"{len(numbers)} codes and {len(texts)} titles, of which {len(codes)} are a pair"
            keys.remarks.append(Remark("enum-unclear", message, todo=True))
    if point.multiply != 1 or point.add:
        keys.remarks.append(Remark("enum-dropped", "codes of a scaled number are not taken over", todo=True))
        return {}
    return {"enum": labelled(dict(sorted(codes.items())))}


def setup(name: str, place: Span, context: Context, keys: Keys) -> Point:
    """Return the register that is written when the device is found. Raises LeftOutError."""
    value = keys.take("value")
    point = channel(name, place, context, "", keys)
    shown = value.shown if value else "nothing"
    keys.remarks.append(Remark("setup-value", f"Wiren Board writes {shown} when it finds the device", lossy=False))
    return point
