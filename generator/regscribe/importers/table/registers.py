"""One row to one register, or to the reasons why it is left out."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from regscribe.draft import Entry, Remark
from regscribe.importers.table.cells import Unclear
from regscribe.importers.table.cells.addresses import Address
from regscribe.importers.table.cells.detect import Row as Detected
from regscribe.importers.table.cells.scales import PLAIN
from regscribe.importers.table.cells.types import TypeCell, parse_type
from regscribe.importers.table.choices import Choices
from regscribe.importers.table.grid import Grid
from regscribe.importers.table.layout import Item
from regscribe.importers.table.making import LeftOutError, Making
from regscribe.importers.table.meanings import LONGEST_NAME, add_access, add_codes, add_texts, clean, codes_of, name_of
from regscribe.importers.table.numbers import add_default, add_limits, add_scale, add_type, add_unit
from regscribe.importers.table.whole import Whole
from regscribe.model import Space
from regscribe_runtime.values.octets import KINDS

if TYPE_CHECKING:
    from fractions import Fraction

    from regscribe.importers.table.cells.ranges import Limits

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


def made_of(item: Item, index: int, whole: Whole, choices: Choices, grid: Grid) -> Made:
    """Make a register of a row."""
    entry = Entry(
        name=clean(item["name"] or item["symbol"])[:LONGEST_NAME] or item.row.where,
        place=grid.span(item.row),
        group=clean(item["group"] or item.section)[:LONGEST_NAME] or GROUP,
        where=item.row.where,
    )
    try:
        making, address = _begun(item, index, whole)
    except LeftOutError as error:
        return Made(_with(entry, None, (error.remark,)))
    try:
        return _finished(making, address, index, whole, choices, entry)
    except LeftOutError as error:
        return Made(_with(entry, None, (*making.remarks, error.remark)), at=making.at, space=making.space)


def _with(entry: Entry, keys: Mapping[str, Any] | None, remarks: tuple[Remark, ...], name: str = "") -> Entry:
    return Entry(
        name=name or entry.name, place=entry.place, keys=keys, remarks=remarks, group=entry.group, where=entry.where
    )


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


def _finished(making: Making, address: Address, index: int, whole: Whole, choices: Choices, entry: Entry) -> Made:
    item = making.item
    bits = address.bits or _bit(item)
    name = name_of(making)
    making.set({"at": making.at, "name": name[:LONGEST_NAME]})
    if len(name) > LONGEST_NAME:
        making.tell("name-cut", f"its name has {len(name)} characters; {LONGEST_NAME} are kept")
    making.set({} if making.space is Space.HOLDING else {"space": str(making.space)})
    add_access(making, whole, choices)
    kind = parse_type(item["type"], whole.dialect)
    making.type = kind if isinstance(kind, TypeCell) else TypeCell()
    codes = codes_of(making)
    add_type(making, whole, index, choices, coded=codes is not None or bits is not None)
    _check_count(making, address)
    limits: Limits | None = None
    default: Fraction | None = None
    if codes is not None:
        add_codes(making, codes)
        _number_of_codes(making, whole, index)
    elif making.wire not in KINDS and not making.space.is_bits:
        add_unit_and_scale(making, whole, index)
        limits = add_limits(making, whole)
    default = add_default(making)
    add_texts(making)
    detected = Detected(
        name=name,
        place=entry.place,
        where=entry.where,
        space=making.space,
        at=making.at,
        words=making.words,
        wire=making.wire,
        bits=bits,
        limits=limits,
        default=default,
        scale=making.scale or PLAIN,
    )
    done = _with(entry, making.keys, tuple(making.remarks), name)
    return Made(done, detected, bits, making.declared, making.at, making.space)


def add_unit_and_scale(making: Making, whole: Whole, index: int) -> None:
    """Set scale and unit, in this order: a scale may say the unit (`1 = 0.1 A`)."""
    add_scale(making, whole, index)
    add_unit(making)


def _bit(item: Item) -> tuple[int, int] | None:
    """The bit that a column of its own says."""
    text = item["bit"]
    if not text:
        return None
    if not (text.isascii() and text.isdecimal() and len(text) < 3):  # noqa: PLR2004 - bits of a word or two
        code, message = "bit-unclear", f"bit `{text[:40]}` is no number of a bit"
        raise LeftOutError(code, message)
    return int(text), int(text)


def _check_count(making: Making, address: Address) -> None:
    """Raise LeftOutError where the address says another number of registers than the type takes."""
    if address.count and address.count != making.words and not making.space.is_bits:
        code = "length-unclear"
        message = f"its address says {address.count} registers and its type takes {making.words}"
        raise LeftOutError(code, message)


def _number_of_codes(making: Making, whole: Whole, index: int) -> None:
    """Say what a register of codes has of a number, which is not kept."""
    item = making.item
    for cells, role in ((whole.scales, "scale"), (whole.decimals, "decimals")):
        cell = cells.cells[index]
        if cell is not None and cell != PLAIN:
            making.lose("scale-of-codes", f"{role} `{item[role][:30]}` does not go with codes")
    if item["unit"] and item["unit"] not in {"-", "--", "/"}:
        making.lose("unit-of-codes", f"unit `{item['unit'][:30]}` does not go with codes")
