"""Items of ha-solarman's definitions, by their rule."""

from dataclasses import dataclass, replace
from typing import Any

from regscribe.dialects import ABCD
from regscribe.draft import Remark
from regscribe.draft.labels import labelled
from regscribe.importers.shared.bits import bits_of
from regscribe.importers.shared.exact import whole
from regscribe.importers.shared.points import Point
from regscribe.importers.shared.reading import Keys, refuse
from regscribe.importers.shared.tree import Node
from regscribe.model import Order, Space, Span, WireType

SHOWN = frozenset({"name", "class", "state_class", "device_class", "icon", "uom", "rule", "digits", "category"}) | {
    *("platform", "hide", "hidden", "attributes", "mod", "alt", "friendly_name", "suggested_display_precision"),
    *("description", "l", "pack", "mppt", "realtime", "translation_key", "isstr", "disabled", "persistent", "step"),
}
"""Keys that only matter to what Home Assistant shows, or when ha-solarman asks."""

NUMBERS = {1: False, 3: False, 2: True, 4: True}
"""Rules of numbers, and whether they have a sign."""
ASCII, BITS, VERSION, DATE, TIME, RAW = 5, 6, 7, 8, 9, 10
TEXTS = {ASCII: WireType.STRING, VERSION: WireType.BYTES, RAW: WireType.BYTES}
BYTE = 0x100
UNSIGNED = {1: WireType.UINT16, 2: WireType.UINT32, 3: WireType.UINT48, 4: WireType.UINT64, 8: WireType.UINT128}
SIGNED = {1: WireType.INT16, 2: WireType.INT32, 3: WireType.INT48, 4: WireType.INT64}
MAGNITUDES = {1: WireType.SIGNMAG16, 2: WireType.SIGNMAG32}
LAYOUTS = {3: "yM Dh ms", 6: "y M D h m s"}
WRITTEN = frozenset({"number", "select", "switch", "time", "datetime", "button"})
FUNCTIONS = {3: Space.HOLDING, 4: Space.INPUT, 1: Space.COIL, 2: Space.DISCRETE}
USUAL_DIVISOR = 100


@dataclass(frozen=True, slots=True)
class Usual:
    """Where registers stand whose item does not say it, and which variant of the device is meant."""

    space: Space
    stretches: tuple[tuple[int, int, Space], ...]
    mod: int = 0

    def at(self, register: int) -> Space:
        """The space of a register."""
        return next((space for first, last, space in self.stretches if first <= register <= last), self.space)


def item(name: str, place: Span, usual: Usual, keys: Keys) -> Point:
    """Return the register of an item. Raises LeftOutError."""
    if keys.has("sensors") or not keys.has("registers"):
        refuse("registers", "it has no registers of its own: it is computed, or only shown")
    keys = _of_variant(keys, usual.mod)
    registers = _registers(keys)
    point = Point(
        name=name, place=place, at=registers[0], space=_space(keys, usual, registers[0]), unit=keys.text("uom")
    )
    interval = keys.whole("update_interval")
    point = replace(point, access=_access(keys, point.space), more={"poll": interval} if interval else {})
    rule = keys.whole("rule") or 0
    if rule in NUMBERS:
        return _number(point, registers, keys, signed=NUMBERS[rule])
    point = replace(point, unit="")
    if rule == BITS:
        return _bits(point, registers, keys)
    if registers != list(range(registers[0], registers[0] + len(registers))):
        refuse("registers", f"the registers {registers} of rule {rule} do not follow each other")
    return _other(point, len(registers), rule, keys)


def _of_variant(keys: Keys, mod: int) -> Keys:
    """The keys with those values of lists that are of a variant of the device; the last where a list is shorter."""
    members = dict(keys.node.members or {})
    for key in VARIED & members.keys():
        listed = members[key].elements
        nested = listed is not None and any(one.elements is not None for one in listed)
        if listed and (key != "registers" or nested):
            members[key] = listed[min(mod, len(listed) - 1)]
    keys.node = replace(keys.node, members=members)
    registers = members.get("registers")
    if registers is not None and registers.elements == ():
        refuse("registers", f"variant {mod} of the device does not have it (--mod)")
    return keys


VARIED = frozenset({"scale", "registers"})
"""Keys that may list a value for each variant of a device."""


def _registers(keys: Keys) -> list[int]:
    listed = keys.take("registers")
    numbers = [whole(one.text) for one in (listed.each if listed else ())]
    found = [one for one in numbers if one is not None]
    if not found or len(found) != len(numbers):
        refuse("registers", f"registers {listed.shown if listed else ''} are no list of addresses")
    return found


def _space(keys: Keys, usual: Usual, register: int) -> Space:
    code = keys.take("code")
    text = code.word("read") if code and code.members else (code.text if code else "")
    space = FUNCTIONS.get(whole(text) or 0) if text else usual.at(register)
    if space is None or space.is_bits:
        refuse("code", f"code {text} is none that reads registers")
    return space


def _access(keys: Keys, space: Space) -> str:
    written = keys.text("platform") in WRITTEN or keys.has("configurable")
    keys.taken |= {"configurable"}
    return "rw" if written and space is Space.HOLDING else "r"


def _placed(point: Point, registers: list[int], wire: WireType) -> Point:
    """The point with its words: side by side in one direction, or each at an address of its own."""
    first, count = registers[0], len(registers)
    if registers == list(range(first, first + count)):
        orders = ABCD if count == 1 else (Order.LITTLE, Order.BIG)
        return replace(point, type=wire, orders=orders)
    if registers == list(range(first, first - count, -1)):
        return replace(point, at=registers[-1], type=wire)
    if point.access != "r":
        point = replace(point, access="r", remarks=(Remark("write-dropped", "words apart cannot be written"),))
    apart = list(reversed(registers))
    return replace(point, at=min(registers), type=wire, more={**point.more, "at": apart})


def _number(point: Point, registers: list[int], keys: Keys, *, signed: bool) -> Point:
    magnitude = keys.truth("magnitude")
    table = MAGNITUDES if signed and magnitude else SIGNED if signed else UNSIGNED
    wire = table.get(len(registers))
    if wire is None:
        refuse("registers", f"a number of {len(registers)} registers")
    point = _placed(point, registers, wire)
    lookup = keys.take("lookup")
    part = _part(keys)
    for key, why in TOLD.items():
        keys.drop(key, why)
    shift = part[0] if part is not None and keys.has("mask") else 0
    point = replace(point, bits=part)
    if lookup is not None:
        return replace(_labelled(point, lookup, keys, shift), unit="")
    if keys.text("platform") == "switch":
        return _switch(point, keys)
    point = _scaled(point, keys, inverted=signed and keys.truth("inverted"))
    return replace(point, multiply=point.multiply * (1 << shift)) if shift and point.multiply else point


TOLD = {
    "range": "a stored number outside is not shown",
    "validation": "a value outside is not shown",
    "value": "what is written for on and off",
    "multiply": "it is multiplied by other registers",
    "options": "what can be chosen",
}
"""Keys of numbers that a map does not have so, and what ha-solarman does with them."""


def _scaled(point: Point, keys: Keys, *, inverted: bool) -> Point:
    """The point with value = (number - offset) x scale / divide."""
    scale, divide, offset = keys.scale("scale"), keys.scale("divide"), keys.scale("offset", 0)
    if scale is None or not divide or offset is None:
        return replace(point, multiply=None)
    factor = (-scale if inverted else scale) / divide
    if not factor:
        refuse("scale", "a scale of 0")
    return replace(point, multiply=factor, add=-offset * factor)


def _part(keys: Keys) -> tuple[int, int] | None:
    """The bits of a word that an item means."""
    bit, mask, wide = (keys.whole(key) for key in ("bit", "mask", "bitmask"))
    if bit is not None:
        return bit, bit
    if wide:
        found = bits_of(wide)
        if found is None or found[0] != found[1]:
            refuse("bitmask", f"bitmask 0x{wide:X} is not one bit")
        return found
    if not mask:
        return None
    return bits_of(mask) or refuse("mask", f"the bits of mask 0x{mask:X} do not stand together")


def _switch(point: Point, keys: Keys) -> Point:
    """A switch: codes for on and off, or one bit."""
    value = keys.node.get("value")
    bit = whole(value.word("bit")) if value else None
    keys.remarks = [one for one in keys.remarks if one.code != "value-dropped"]
    if bit is not None:
        return replace(point, bits=(bit, bit), unit="")
    on, off = ((whole(value.word(key)) if value else None) for key in ("on", "off"))
    labels = {0 if off is None else off: "off", 1 if on is None else on: "on"}
    return replace(point, unit="", more={**point.more, "enum": labelled(dict(sorted(labels.items())))})


def _labelled(point: Point, lookup: Node, keys: Keys, shift: int = 0) -> Point:
    """The codes of a lookup; of one with bits or modes the flags. Codes of a mask are not shifted by ha-solarman."""
    codes: dict[int, str] = {}
    flags: dict[int, str] = {}
    for one in lookup.each:
        label, bit = one.word("value"), one.get("bit")
        listed = one.get("key") or bit
        if one.word("mode") == "|":
            flags |= _flag(bit, listed, label)
            continue
        for code in listed.each if listed else ():
            stored = whole(code.text)
            stored = 1 << stored if bit is listed and stored is not None and 0 <= stored < MOST_BITS else stored
            number = None if stored is None or stored % (1 << shift) else stored >> shift
            if number is None:
                every = code.text == "default"
                other = "every other code" if every else f"a code that is none, {code.shown},"
                keys.remarks.append(Remark("lookup-dropped", f"{other} is `{label}`", lossy=not every))
            elif number in codes and codes[number] != label:
                keys.remarks.append(Remark("lookup-doubled", f"{number} is `{codes[number]}` and `{label}`"))
            else:
                codes[number] = label
    if flags and point.bits is None:
        if codes.keys() - {0}:
            keys.remarks.append(Remark("lookup-dropped", f"codes beside bits: {codes}"))
        none: dict[Any, Any] = {"none": codes[0]} if 0 in codes else {}
        return replace(point, more={**point.more, "flags": labelled(flags, "bit") | none})
    return replace(point, more={**point.more, **({"enum": labelled(codes)} if codes else {})})


MOST_BITS = 64


def _flag(bit: Node | None, listed: Node | None, label: str) -> dict[int, str]:
    """The bit that an entry of a lookup means, by its number or by its weight."""
    number = whole(bit.text) if bit and bit.is_scalar else None
    if number is None and bit is None and listed is not None:
        found = bits_of(whole(listed.each[0].text) or 0) if listed.each else None
        number = found[0] if found and found[0] == found[1] else None
    return {} if number is None else {number: label}


def _bits(point: Point, registers: list[int], keys: Keys) -> Point:
    """Words of bits without names: raw numbers."""
    wire = UNSIGNED.get(len(registers))
    if wire is None:
        refuse("registers", f"the bits of {len(registers)} registers")
    lookup = keys.take("lookup")
    placed = _placed(point, list(reversed(registers)), wire)
    return _labelled(placed, lookup, keys) if lookup else replace(placed, more={**placed.more, "kind": "raw"})


def _other(point: Point, words: int, rule: int, keys: Keys) -> Point:
    """Texts, versions, dates, times and bytes. Raises LeftOutError for other rules."""
    if rule == VERSION:
        message = "a version of four digits a register is read as bytes here"
        keys.remarks.append(Remark("version-raw", message, todo=True))
        keys.taken |= {"hex", "delimiter", "remove"}
    if rule in TEXTS:
        return replace(point, type=TEXTS[rule], words=words)
    layout = LAYOUTS.get(words, "") if rule == DATE else _time(keys) if rule == TIME and words == 1 else ""
    wire = WireType.DATETIME if rule == DATE else WireType.TIME
    if not layout:
        refuse("rule", f"rule {rule} of {words} registers is not understood")
    return replace(point, type=wire, more={**point.more, "layout": layout})


def _time(keys: Keys) -> str:
    """The layout of a time of day in one register: decimal digits, or two bytes."""
    if keys.has("hex"):
        return "bcd hm" if keys.whole("hex") == BYTE else ""
    return {100: "hhmm", BYTE: "hm"}.get(keys.whole("dec") or USUAL_DIVISOR, "")
