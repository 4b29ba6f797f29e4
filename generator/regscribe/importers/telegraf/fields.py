"""Fields of Telegraf's modbus input, of the styles metric and request, and of the style register."""

from dataclasses import replace
from fractions import Fraction
from typing import Any

from regscribe.dialects import ABCD, DCBA, Orders, read_back
from regscribe.dialects.telegraf import BIT, BYTES, FIXED, OLD_TYPES, ORDERS, SPACES, TABLES, TYPES
from regscribe.draft import Remark
from regscribe.files import OneLine
from regscribe.importers.shared.exact import whole
from regscribe.importers.shared.points import Point
from regscribe.importers.shared.reading import Keys, refuse
from regscribe.importers.shared.tree import Node
from regscribe.model import Space, Span, WireType

INPUTS = read_back(SPACES)
BY_TYPE = read_back(TYPES)
BY_LETTERS: dict[str, Orders] = {
    **read_back(ORDERS),
    "": ABCD,
    "AB": ABCD,
    "BA": DCBA,
    "ABCDEFGH": ABCD,
    "HGFEDCBA": DCBA,
    "BADCFEHG": read_back(ORDERS)["BADC"],
    "GHEFCDAB": read_back(ORDERS)["CDAB"],
}
"""Orders by the letters of a number of one, two or four words."""

SIGNED = {1: WireType.INT16, 2: WireType.INT32, 4: WireType.INT64}
UNSIGNED = {1: WireType.UINT16, 2: WireType.UINT32, 4: WireType.UINT64}
PLACES = {"lower": "low", "upper": "high"}
UNIT = "unit"

SHOWN = frozenset({"name", "output", "measurement"})
"""Keys that only matter to what Telegraf calls a value."""


def _order(wire: WireType, text: str) -> Orders:
    if text.upper() not in BY_LETTERS:
        refuse("byte_order", f"byte_order `{text}` is none")
    word, byte = BY_LETTERS[text.upper()]
    return (ABCD[0], byte) if wire.words == 1 and not wire.is_octets else (word, byte)


def _scale(keys: Keys) -> Fraction | None:
    """The scale; 0 is none."""
    factor = keys.scale("scale")
    return Fraction(1) if factor == 0 else factor


def _unit(block: Node) -> str:
    """The tag `unit` of a block, as the exporter writes it."""
    tags = block.get("tags")
    return tags.word(UNIT) if tags else ""


def _tags(keys: Keys, block: Node) -> None:
    """Tell the other tags of a block."""
    tags = block.get("tags")
    for key, value in ((tags and tags.members) or {}).items():
        if key != UNIT:
            keys.remarks.append(Remark("tag-dropped", f"the tag {key} {value.shown} is not taken over", lossy=False))


def field_of(name: str, place: Span, block: Node, _: str, location: str, keys: Keys) -> Point:
    """Return the register of a field of the styles metric and request. Raises LeftOutError."""
    told = keys.take("register") or block.get("register")
    space = INPUTS.get(told.text.strip() if told else "holding")
    at = keys.whole("address")
    if space is None or at is None:
        refuse("address", f"register {told.shown if told else ''} with address {at} is none")
    _tags(keys, block)
    keys.taken |= {"omit"}
    point = Point(name=name, place=place, at=at, space=space, unit=_unit(block))
    if space.is_bits:
        keys.taken |= {"type"}
        return replace(point, type=WireType.BIT)
    return _of_words(point, keys, keys.text("type").upper(), block.word("byte_order"), location)


def _of_words(point: Point, keys: Keys, told: str, order: str, location: str) -> Point:
    """The point with the form of its words. Raises LeftOutError."""
    if told == BIT:
        bit = keys.whole("bit") or 0
        return replace(point, bits=(bit, bit))
    if told in BYTES:
        wire, byte = BYTES[told]
        more: dict[str, Any] = {"byte": byte} if byte == "high" else {}
        return replace(point, type=wire, multiply=_scale(keys), more=more)
    if told not in BY_TYPE:
        refuse("type", f"type `{told}` is none of {', '.join(BY_TYPE)}, {BIT}, {', '.join(BYTES)}")
    wire = BY_TYPE[told]
    orders = _order(wire, order)
    if not wire.is_octets:
        return replace(point, type=wire, orders=orders, multiply=_scale(keys))
    return _text(point, keys.whole("length") or 0, orders, location)


def _text(point: Point, words: int, orders: Orders, location: str) -> Point:
    if not words:
        refuse("length", "a STRING has no length")
    if orders[0] is not ABCD[0]:
        refuse("byte_order", "the words of a text are in an order that the map cannot say")
    form: dict[str, Any] = {}
    if location in PLACES:
        form["text"] = OneLine(one_per_register=PLACES[location])
    return replace(point, type=WireType.STRING, orders=orders, words=words, more=form)


def field_of_list(name: str, place: Span, _: Node, table: str, location: str, keys: Keys) -> Point:
    """Return the register of a field of the style register. Raises LeftOutError."""
    space = TABLES[table]
    listed = keys.take("address")
    addresses = [whole(one.text) for one in (listed.each if listed else ())]
    known = [one for one in addresses if one is not None]
    if not known or len(known) != len(addresses):
        refuse("address", f"address {listed.shown if listed else 'is not given and'} is no list of addresses")
    point = Point(name=name, place=place, at=known[0], space=space)
    if known != list(range(known[0], known[0] + len(known))):
        refuse("address", f"the addresses {known} do not follow each other")
    if space in {Space.COIL, Space.DISCRETE}:
        return replace(point, type=WireType.BIT)
    told, order = keys.text("data_type").upper(), keys.text("byte_order")
    words = len(known)
    if told in FIXED:
        wire = (SIGNED if FIXED[told] else UNSIGNED).get(words)
        if wire is None:
            refuse("data_type", f"{told} of {words} words")
        return replace(point, type=wire, orders=_order(wire, order), multiply=_scale(keys))
    if told in {BIT, *BYTES}:
        return _of_words(point, keys, told, order, location)
    known_type = OLD_TYPES.get(told)
    if known_type is None:
        refuse("data_type", f"data_type `{told}` is none of {', '.join([*OLD_TYPES, *FIXED])}")
    if known_type.is_octets:
        return _text(point, words, _order(known_type, order), location)
    if known_type.words != words:
        refuse("address", f"{told} has {known_type.words} words, and {words} addresses are given")
    return replace(point, type=known_type, orders=_order(known_type, order), multiply=_scale(keys))
