"""Sensors of Home Assistant: numbers and texts, and bits of words."""

import re
from dataclasses import replace
from fractions import Fraction
from functools import partial
from typing import Any, NamedTuple

from regscribe.dialects import ABCD, DCBA, Orders, read_back
from regscribe.dialects.home_assistant import SPACES, STRUCT_CODES, SWAPS, TYPES
from regscribe.draft import Remark
from regscribe.files import OneLine
from regscribe.importers.shared.document import Collecting
from regscribe.importers.shared.points import Point
from regscribe.importers.shared.reading import Keys, refuse
from regscribe.importers.shared.tree import Node
from regscribe.model import Space, Span, WireType

INPUTS = read_back(SPACES)
BY_TYPE = read_back(TYPES)
BY_SWAP = {**read_back(SWAPS), "none": ABCD}
STRUCT = re.compile(r"([<>!]?)((?:\d{0,3}[A-Za-z])+)")
CODE = re.compile(r"(\d{0,3})([A-Za-z])")
BYTES = {
    "xB": (WireType.UINT8, "low"),
    "xb": (WireType.INT8, "low"),
    "Bx": (WireType.UINT8, "high"),
    "bx": (WireType.INT8, "high"),
}
"""Structures of one byte of a word."""
MOST_BITS = 16
USUAL = "int16"

SHOWN = frozenset({"name", "unique_id", "device_class", "state_class", "icon", "precision", "entity_category"}) | {
    *("suggested_display_precision", "lazy_error_count", "enabled_by_default", "slave", "device_address"),
}
"""Keys that only matter to what Home Assistant shows, and the unit id, by which entities are chosen."""


class Form(NamedTuple):
    """How the number of an entity stands in its words; `count` of it are one behind the other."""

    type: WireType
    orders: Orders
    words: int = 0
    repeated: int = 1
    byte: str = ""


def form_of(keys: Keys) -> Form:
    """Return the form of an entity. Raises LeftOutError."""
    orders = keys.choice("swap", BY_SWAP, "none")
    told = keys.text("data_type", USUAL)
    if told == "custom":
        return _custom(keys, orders)
    wire = keys.choice("data_type", BY_TYPE, USUAL)
    words = keys.whole("count")
    if not wire.is_octets:
        if words not in {None, wire.words}:
            refuse("count", f"count {words} is not that of {wire}, which has {wire.words}")
        return Form(wire, orders)
    if not words:
        refuse("count", "a string has no count of words")
    return Form(wire, _of_text(orders), words)


def _of_text(orders: Orders) -> Orders:
    if orders not in {ABCD, BY_SWAP["byte"]}:
        refuse("swap", "the words of a text are in an order that the map cannot say")
    return orders


def _custom(keys: Keys, orders: Orders) -> Form:
    """The form that `structure` says, where it is that of one number, or of several alike."""
    told = keys.text("structure").replace(" ", "")
    found = STRUCT.fullmatch(told)
    if not found or not found[1]:
        refuse("structure", f"structure `{told}` is none that begins with >, or no structure at all")
    if found[1] != "<" and found[2] in BYTES and orders == ABCD:
        half, byte = BYTES[found[2]]
        return Form(half, orders, byte=byte)
    orders = orders if found[1] != "<" else _reversed(orders)
    words = keys.whole("count")
    codes = [(int(number or 1), letter) for number, letter in CODE.findall(found[2])]
    if len(codes) == 1 and codes[0][1] == "s" and codes[0][0] % 2 == 0:
        return Form(WireType.STRING, _of_text(orders), codes[0][0] // 2)
    letters = {letter for _, letter in codes}
    wire = STRUCT_CODES.get(letters.pop()) if len(letters) == 1 else None
    if wire is None:
        refuse("structure", f"structure `{told}` is not that of one number, or of several alike")
    count = sum(number for number, _ in codes)
    if words not in {None, count * wire.words}:
        refuse("count", f"count {words} is not that of structure `{told}`, {count * wire.words}")
    if count > 1 and orders != ABCD:
        refuse("swap", "a swap of several numbers at once has no meaning here")
    return Form(wire, orders, 0, count)


def _reversed(orders: Orders) -> Orders:
    if orders != ABCD:
        refuse("structure", "a structure that begins with < and a swap together are not understood")
    return DCBA


def sensor(keys: Keys, name: str, place: Span, group: str) -> Point:
    """Return the register of a sensor. Raises LeftOutError."""
    form = form_of(keys)
    further = keys.whole("virtual_count") or keys.whole("slave_count") or 0
    at = address_of(keys)
    point = Point(
        name=name,
        place=place,
        at=at,
        space=keys.choice("input_type", INPUTS, "holding"),
        type=form.type,
        orders=form.orders,
        words=form.words,
        multiply=keys.scale("scale"),
        add=keys.number("offset") or Fraction(0),
        unit=keys.text("unit_of_measurement"),
        group=group,
        count=form.repeated * (1 + further),
    )
    if form.repeated > 1 and further:
        refuse("virtual_count", "a structure of several numbers with a virtual_count is not understood")
    if point.multiply == 0:
        refuse("scale", "a scale of 0")
    keys.drop("min_value", "Home Assistant shows it in place of lower readings; no reading is wrong by it")
    keys.drop("max_value", "Home Assistant shows it in place of higher readings; no reading is wrong by it")
    keys.drop("zero_suppress", "Home Assistant shows 0 in place of readings near it")
    byte = {"byte": form.byte} if form.byte == "high" else {}
    return replace(point, more={**byte, **sentinel(keys, point.type), **poll(keys)})


def address_of(keys: Keys) -> int:
    """Return the wire address. Raises LeftOutError."""
    at = keys.whole("address")
    if at is None:
        refuse("address", "it has no address")
    return at


def sentinel(keys: Keys, wire: WireType) -> dict[str, Any]:
    """Return the fault word that `nan_value` is: of a signed number it may be written without its sign."""
    value = keys.whole("nan_value")
    if value is None:
        return {}
    fitting = [one for one in (value, -value) if wire.is_integer and wire.minimum <= one <= wire.maximum]
    if not fitting:
        keys.remarks.append(Remark("nan-value-dropped", f"nan_value {value} is no number of {wire}", todo=True))
        return {}
    faults: dict[Any, str] = {fitting[0]: "not available"}
    return {"sentinels": OneLine(faults)}


def poll(keys: Keys) -> dict[str, Any]:
    """Return how often it is worth a request."""
    seconds = keys.whole("scan_interval") if keys.text("scan_interval").isdecimal() else None
    if seconds is None:
        keys.drop("scan_interval", "no whole number of seconds")
        return {}
    return {"poll": seconds or "never"}


def binary_sensor(found: Collecting, entity: Node, name: str, group: str) -> None:
    """Add the bits of a binary sensor: of a word the lowest, and as many further ones as `virtual_count` says."""
    further = Keys(entity).whole("virtual_count") if entity.word("virtual_count").isdecimal() else 0
    bits = 1 + (further or 0)

    def make(number: int, keys: Keys) -> Point:
        keys.taken |= {"virtual_count", "slave_count"}
        space = keys.choice("input_type", INPUTS, "coil")
        at, shown = address_of(keys), name if bits == 1 else f"{name} {number}"
        point = Point(name=shown, place=found.place(entity), at=at, space=space, group=group, more=poll(keys))
        if space.is_bits:
            return replace(point, at=at + number, type=WireType.BIT)
        if bits > MOST_BITS:
            refuse("virtual_count", f"{bits} bits are more than a word has")
        point = replace(point, bits=(number, number))
        return point if space is Space.HOLDING else replace(point, access="r")

    for number in range(bits if bits <= MOST_COILS else 1):
        found.add(name, entity, partial(make, number))


MOST_COILS = 2000
"""Bits that one request reads."""
