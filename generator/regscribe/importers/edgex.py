"""The importer of EdgeX device profiles for Modbus: each device resource is a register.

EdgeX reads in the order mask, shift, base, scale, offset. A scale with a fraction on a whole-number type is read by its
whole part there: what the author meant is not sure, so such a number is raw.
"""

from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from functools import partial
from typing import Any

from regscribe.dialects import ABCD, Orders, read_back
from regscribe.dialects.edgex import ACCESS, BOOL, RAW_TYPES, SWAPS, TABLES, TYPES
from regscribe.draft import Draft
from regscribe.draft.labels import described
from regscribe.importers.shared.bits import bits_of
from regscribe.importers.shared.document import Collecting, has, reads, text_of
from regscribe.importers.shared.points import Point
from regscribe.importers.shared.read_yaml import read_yaml
from regscribe.importers.shared.reading import Keys, refuse, unclear_scale
from regscribe.importers.shared.tree import TreeError
from regscribe.model import Access, Space, Span, WireType, show
from regscribe.plugins import Likeness, Option

name = "edgex"
summary = "an EdgeX device profile for Modbus"
options: tuple[Option, ...] = ()

SPACES = read_back(TABLES)
BY_TYPE = read_back(TYPES)
BY_RAW = {word.upper(): wire for wire, word in RAW_TYPES.items()}
BY_ACCESS = {**read_back(ACCESS), "WR": Access.READ_WRITE}
BY_SWAP: dict[tuple[bool, bool], Orders] = {swaps: orders for orders, swaps in SWAPS.items()}
SHOWN = frozenset({"name", "isHidden", "tag", "mediaType"})
MOST_WORDS_OF_SWAP = 2
"""Words of a number that the device service swaps; of one it does not, of four it cannot."""


def likeness(data: bytes, name: str) -> Likeness:  # noqa: ARG001 - the contract of importers
    """Surely, by resources with a primaryTable."""
    resources, table = r"""^["{\s]*deviceResources["]?\s*:""", r"""primaryTable["']?\s*:"""
    return Likeness.SURE if has(data, resources, table) else Likeness.NO


@reads
def read(data: bytes, name: str, options: Mapping[str, str]) -> Draft:  # noqa: ARG001 - as above
    """Return the registers of a profile."""
    root, doubled = read_yaml(text_of(data))
    listed = root.get("deviceResources")
    if listed is None:
        raise TreeError(root.line, "there are no deviceResources", "is this a device profile?")
    found = Collecting(name, SHOWN)
    found.doubled(doubled)
    for resource in listed.each:
        called = resource.word("name") or "unnamed"
        found.add(called, resource, partial(_resource, called, found.place(resource)), group="Resources")
    commands = root.get("deviceCommands")
    if commands:
        named = ", ".join(one.word("name") for one in commands.each)
        found.stated.append(f"deviceCommands are ways to ask EdgeX, no facts of a map: {named}")
    return found.draft(title=root.word("model") or root.word("name"), maker=root.word("manufacturer"))


def _resource(name: str, place: Span, keys: Keys) -> Point:
    attributes, properties = keys.take("attributes"), keys.take("properties")
    if attributes is None or properties is None:
        refuse("attributes", "it has no attributes or no properties")
    of, value = Keys(attributes, keys.remarks), Keys(properties, keys.remarks)
    space = _table(of)
    at, bit = _address(of)
    access = BY_ACCESS.get(value.text("readWrite", "R").upper())
    if access is None:
        refuse("readWrite", f"readWrite `{value.text('readWrite')}` is none of R, W, RW")
    more: dict[str, Any] = {**described(name, keys.text("description"))}
    point = Point(name=name, place=place, at=at, space=space, access=access.value, unit=value.text("units"), more=more)
    point = _form(point, bit, of, value)
    value.taken.add("valueType")
    keys.remarks += [*of.rest(frozenset()), *value.rest(SHOWN)]
    return point


def _table(of: Keys) -> Space:
    """The table, in any case of letters as the device service takes it."""
    word = of.text("primaryTable").upper()
    if word not in SPACES:
        refuse("primaryTable", f"primaryTable `{word}` is none of {', '.join(SPACES)}")
    return SPACES[word]


def _address(of: Keys) -> tuple[int, int | None]:
    """The wire address and the bit behind a point."""
    first, dot, bit = of.text("startingAddress").partition(".")
    if not first.isdecimal() or (dot and not bit.isdecimal()):
        refuse("startingAddress", f"startingAddress `{first}{dot}{bit}` is none")
    return int(first), int(bit) if dot else None


def _form(point: Point, bit: int | None, of: Keys, value: Keys) -> Point:
    told = value.text("valueType")
    value.drop("defaultValue", "what EdgeX writes where nothing is given, not what the device begins with")
    if told.lower() == BOOL.lower():
        value.taken |= {"scale", "offset", "minimum", "maximum"}  # EdgeX leaves truth values alone
        if point.space.is_bits:
            return replace(point, type=WireType.BIT)
        return replace(point, bits=(bit or 0, bit or 0))
    wire = next((one for word, one in BY_TYPE.items() if word.lower() == told.lower()), None)
    if wire is None or point.space.is_bits:
        refuse("valueType", f"valueType `{told}` of {point.space} registers is none that is understood")
    if wire is WireType.STRING:
        words = of.whole("stringRegisterSize")
        if not words:
            refuse("stringRegisterSize", "a String has no stringRegisterSize")
        return replace(point, type=wire, words=words)
    raw = of.text("rawType").upper()
    if raw:
        if raw not in BY_RAW or not wire.is_float:
            refuse("rawType", f"rawType `{raw}` of valueType {told} is none that EdgeX has")
        value_type, wire = wire, BY_RAW[raw]
    else:
        value_type = wire
    orders = _orders(of, wire)
    return _scaled(replace(point, type=wire, orders=orders), value, whole_only=not value_type.is_float)


def _orders(of: Keys, wire: WireType) -> Orders:
    swaps = of.truth("isByteSwap"), of.truth("isWordSwap")
    if swaps == (False, False) or wire.words == 1:
        return ABCD
    if wire.words > MOST_WORDS_OF_SWAP:
        refuse("isWordSwap", "EdgeX swaps numbers of 32 bits only")
    return BY_SWAP[swaps]


def _scaled(point: Point, value: Keys, *, whole_only: bool) -> Point:
    """The point with its part of the word, scale, offset and limits."""
    part, factor = _part(value, point)
    multiply, add = value.scale("scale"), value.number("offset") or Fraction(0)
    base = value.number("base")
    if base not in {None, 0, 1}:
        value.remarks.append(unclear_scale(f"base {base}: EdgeX raises the number to that power"))
        multiply = None
    if multiply is not None and whole_only and (multiply.denominator != 1 or add.denominator != 1):
        why = f"scale {show(multiply)} and offset {show(add)} on {point.type}: EdgeX takes their whole part only"
        value.remarks.append(unclear_scale(why))
        multiply = None
    multiply = Fraction(1) if multiply == 0 else multiply
    multiply = None if multiply is None else multiply * factor
    low, high = value.number("minimum"), value.number("maximum")
    limits = {} if low is None or high is None else {"range": f"{show(low)}..{show(high)}"}
    if (low is None) != (high is None):
        value.drop("minimum", "there is no maximum beside it")
        value.drop("maximum", "there is no minimum beside it")
    return replace(point, bits=part, multiply=multiply, add=add, more={**point.more, **limits})


def _part(value: Keys, point: Point) -> tuple[tuple[int, int] | None, int]:
    """The bits that mask and shift leave, and the factor of what is not shifted down to its lowest bit.

    A positive shift goes to the right, as in EdgeX 2 and later; the first versions turned the sign around.
    """
    mask, shift = value.whole("mask") or 0, value.whole("shift") or 0
    if not mask and not shift:
        return None, 1
    found = bits_of(mask) if mask else (shift, point.type.bits - 1)
    if found is None or shift not in {0, found[0]} or point.type.minimum < 0 or point.type.is_float:
        refuse("mask", f"mask {mask} and shift {shift} of {point.type} are not a part moved down to its lowest bit")
    return found, 1 if shift else 1 << found[0]
