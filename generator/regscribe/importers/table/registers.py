"""One row to one register, or to the reasons why it is left out."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Any

from regscribe.draft import Entry
from regscribe.importers.table.cells import Unclear
from regscribe.importers.table.cells.addresses import Address
from regscribe.importers.table.cells.detect import Row as Detected
from regscribe.importers.table.cells.doubts import below_in, below_type
from regscribe.importers.table.cells.ranges import Limits, Ranged, Settled, settle_ranges
from regscribe.importers.table.cells.scales import PLAIN
from regscribe.importers.table.cells.types import TypeCell
from regscribe.importers.table.cells.units import parse_unit
from regscribe.importers.table.choices import Choices
from regscribe.importers.table.grid import Grid
from regscribe.importers.table.layout import Item
from regscribe.importers.table.making import LeftOutError, Making
from regscribe.importers.table.meanings import LONGEST_NAME, add_access, add_codes, add_texts, clean, codes_of, name_of
from regscribe.importers.table.numbers import (
    UNCLEAR_TYPE,
    add_default,
    add_limits,
    add_scale,
    add_type,
    add_unit,
    printed_default,
)
from regscribe.importers.table.specials import add_special, is_number
from regscribe.importers.table.whole import Whole
from regscribe.model import Space
from regscribe_runtime.values.octets import KINDS

GROUP = "Registers"


@dataclass(frozen=True, slots=True)
class Made:
    """What became of a row: its entry, what is known of it for checks of the table, and the bits that it is about."""

    entry: Entry
    detected: Detected | None = None
    bits: tuple[int, int] | None = None
    declared: Mapping[str, Any] = field(default_factory=dict)
    at: int = 0
    space: Space = Space.HOLDING
    order_assumed: bool = False


@dataclass(frozen=True, slots=True)
class Half:
    """A register before its ranges are settled, which takes the whole column; without `making` it is left out."""

    entry: Entry
    making: Making | None = None
    bits: tuple[int, int] | None = None
    limits: Limits | Unclear | None = None
    default: Fraction | Unclear | None = None


def made_of(items: Sequence[Item], whole: Whole, choices: Choices, grid: Grid) -> tuple[list[Made], str]:
    """Make registers of rows; the sentence says what ranges count, if that had to be found out."""
    halves = [_half(item, index, whole, choices, grid) for index, item in enumerate(items)]
    ranged = [_ranged(half, half.limits) for half in halves] + [_ranged(half, half.default) for half in halves]
    column = settle_ranges(ranged, counts=choices.ranges)
    ranges, defaults = column.cells[: len(halves)], column.cells[len(halves) :]
    made = [_made(*parts) for parts in zip(halves, ranges, defaults, strict=True)]
    return made, column.evidence


def _ranged(half: Half, found: Limits | Fraction | Unclear | None) -> Ranged | None:
    """The limits, or the default as such, with what tells whether they count what is stored."""
    making = half.making
    if making is None or making.scale is None or found is None or isinstance(found, Unclear):
        return None
    limits = Limits(found, found) if isinstance(found, Fraction) else found
    return Ranged(limits, making.wire, making.scale)


def _half(item: Item, index: int, whole: Whole, choices: Choices, grid: Grid) -> Half:
    entry = Entry(
        name=clean(item["name"] or item["symbol"])[:LONGEST_NAME] or item.row.where,
        place=grid.span(item.row),
        group=clean(item["group"] or item.section)[:LONGEST_NAME] or GROUP,
        where=item.row.where,
    )
    try:
        making, address = _begun(item, index, whole)
        return _grown(making, address, index, whole, choices, entry)
    except LeftOutError as error:
        return Half(replace(entry, remarks=(error.remark,)))


def _begun(item: Item, index: int, whole: Whole) -> tuple[Making, Address]:
    """A register with address and space. Raises LeftOutError where one of them is not known."""
    address, space = whole.addresses[index], whole.spaces[index]
    if address is None:
        code, message = "address-missing", "no cell says its address"
        raise LeftOutError(code, message)
    if isinstance(address, Unclear):
        code = "address-unclear"
        raise LeftOutError(code, address.message)
    if isinstance(space, Unclear):
        code = "space-unclear"
        raise LeftOutError(code, space.message)
    making = Making(item, address.at, space)
    for text in item.lost:
        making.lose("continued", text)
    return making, address


def _grown(making: Making, address: Address, index: int, whole: Whole, choices: Choices, entry: Entry) -> Half:
    """A register with all but range and default. Raises LeftOutError where its number is not understood."""
    item, kind = making.item, whole.types[index]
    making.type = kind if isinstance(kind, TypeCell) else TypeCell()
    bits = _bits(making, address.bits or _own_bits(whole, index))
    name = name_of(making)
    making.set({"at": making.at, "name": name[:LONGEST_NAME]})
    if len(name) > LONGEST_NAME:
        making.tell("name-cut", f"its name has {len(name)} characters; {LONGEST_NAME} are kept")
    making.set({} if making.space is Space.HOLDING else {"space": str(making.space)})
    add_access(making, whole, index, choices)
    codes = codes_of(making, whole, index)
    special = codes if codes is not None and is_number(making, whole, index, codes) else None
    codes = None if special else codes
    add_type(making, whole, index, choices, coded=codes is not None or bits is not None)
    _check_count(making, address)
    limits: Limits | Unclear | None = None
    if codes is not None:
        add_codes(making, codes)
        _number_lost(making, whole, index, "codes")
    elif making.wire not in KINDS and not making.space.is_bits:
        add_scale(making, whole, index)  # before the unit, which a scale may say (`1 = 0.1 A`)
        add_unit(making)
        limits = whole.limits[index] if item["range"] or item["min"] or item["max"] else None
        for below in (limits, below_in(item["description"]) if making.scale else None):
            if isinstance(below, Limits) and (doubt := below_type(below, making.wire, making.scale or PLAIN)):
                raise LeftOutError(UNCLEAR_TYPE, doubt.message)
        if special:
            add_special(making, special)
        if making.type.kind == "flags":
            making.tell("bits-unnamed", f"type `{item['type'][:30]}`: no cell says what its bits mean")
        if making.type.kind == "boolean":
            making.set({"kind": "boolean"})
    else:
        _number_lost(making, whole, index, "a bit" if making.space.is_bits else f"a {making.wire}")
    default = printed_default(making, whole, index)
    return Half(replace(entry, name=name), making, bits, limits, default)


def _made(half: Half, ranged: Settled | Unclear | None, defaulted: Settled | Unclear | None) -> Made:
    making = half.making
    if making is None:
        return Made(half.entry)
    if making.scale is None:
        _lose_scaled(making, half)
    elif isinstance(half.limits, Unclear):
        ranged = half.limits
    limits, default = add_limits(making, ranged), add_default(making, defaulted)
    add_texts(making)
    codes = making.keys.get("enum") or making.keys.get("special")
    detected = Detected(
        name=half.entry.name,
        place=half.entry.place,
        where=half.entry.where,
        space=making.space,
        at=making.at,
        words=making.words,
        wire=making.wire,
        bits=half.bits,
        limits=limits,
        default=default,
        scale=making.scale or PLAIN,
        codes=frozenset(map(Fraction, codes)) if isinstance(codes, dict) else frozenset(),
    )
    entry = replace(half.entry, keys=making.keys, remarks=tuple(making.remarks))
    return Made(entry, detected, half.bits, making.declared, making.at, making.space, making.order_assumed)


def _lose_scaled(making: Making, half: Half) -> None:
    """Say which numbers are not taken because they count in the unit of an unclear scale."""
    for role, found in (("range", half.limits), ("default", half.default)):
        if found is not None:
            making.lose(f"{role}-unscaled", f"the {role} is left out, as it counts in the unit of an unclear scale")


def _own_bits(whole: Whole, index: int) -> tuple[int, int] | None:
    """The bits that a column of its own says."""
    found = whole.bits.cells[index]
    if isinstance(found, Unclear):
        code = "bit-unclear"
        raise LeftOutError(code, found.message)
    return found


def _check_count(making: Making, address: Address) -> None:
    """Raise LeftOutError where the address says another number of registers than the type takes."""
    if address.count and address.count != making.words and not making.space.is_bits:
        code = "length-unclear"
        message = f"its address says {address.count} registers and its type takes {making.words}"
        raise LeftOutError(code, message)


def _bits(making: Making, bits: tuple[int, int] | None) -> tuple[int, int] | None:
    """The bits of a part of a word: from the place that the address says, as many as the type says."""
    count = making.type.bits
    if not count:
        return bits
    if bits is None or (bits[0] != bits[1] and bits[1] - bits[0] + 1 != count) or bits[0] + count > BITS:
        code, message = "bit-unclear", f"type `{making.item['type'][:30]}`: which {count} bits of the word is not said"
        raise LeftOutError(code, message)
    return bits[0], bits[0] + count - 1


BITS = 16
"""Those of a word."""


def _number_lost(making: Making, whole: Whole, index: int, what: str) -> None:
    """Say what a register of codes, of a text or of a bit has of a number, which is not kept."""
    item = making.item
    for cells, role in ((whole.scales, "scale"), (whole.decimals, "decimals")):
        cell = cells.cells[index]
        if cell is not None and cell != PLAIN:
            making.lose(f"{role}-lost", f"{role} `{item[role][:30]}` does not go with {what}")
    if item["unit"] and parse_unit(item["unit"]) is not None:
        making.lose("unit-lost", f"unit `{item['unit'][:30]}` does not go with {what}")
    limits = whole.limits[index]
    printed = item["range"] or "..".join(filter(None, (item["min"], item["max"])))
    if printed and limits is not None and not _are_codes(making, limits):
        making.lose("range-lost", f"range `{printed[:30]}` does not go with {what}")


def _are_codes(making: Making, limits: Limits | Unclear) -> bool:
    """Whether a range says no more than that the codes are the codes, or that a bit is 0 or 1."""
    codes = making.keys.get("enum", {0: "", 1: ""} if making.space.is_bits else {})
    return isinstance(limits, Limits) and bool(codes) and limits.low == min(codes) and limits.high == max(codes)
