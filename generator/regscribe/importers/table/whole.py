"""What only the table as a whole tells: the base of addresses, spaces, dialects, whether scales divide."""

import itertools
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction

from regscribe.importers.table.cells import Unclear
from regscribe.importers.table.cells.addresses import Address, AddressColumn, parse_addresses
from regscribe.importers.table.cells.addresses import Column as Texts
from regscribe.importers.table.cells.bits import BitColumn, parse_bits
from regscribe.importers.table.cells.dialect_choice import choose_dialect
from regscribe.importers.table.cells.dialects import Dialect
from regscribe.importers.table.cells.numbers import decimal_comma
from regscribe.importers.table.cells.ranges import Limits, parse_limits, parse_number, parse_range, stated_limits
from regscribe.importers.table.cells.scales import Hint, ScaleColumn, Way, parse_scales
from regscribe.importers.table.cells.spaces import SpaceCell, parse_spaces
from regscribe.importers.table.cells.types import TypeCell, parse_type
from regscribe.importers.table.choices import Choices
from regscribe.importers.table.columns import Column
from regscribe.importers.table.contents import DIALECT as ANY_DIALECT
from regscribe.importers.table.headings import AT
from regscribe.importers.table.layout import Item
from regscribe.importers.table.titles import space_of_title
from regscribe.model import Space, WireType
from regscribe.model.identifiers import snake

NUMBERS = ("scale", "offset", "range", "min", "max", "default")
"""Columns of numbers, which write fractions alike."""

Parsed = Address | Unclear | None


@dataclass(frozen=True, slots=True)
class Whole:
    """What the table says as a whole, row by row where it does.

    `functions` are those that a row names; `limits` are ranges as printed; `comma`: whether commas are decimal points
    (None: nothing shows it); `exponents` are the ids of registers that may hold powers of ten, by name; `bits` are
    those of a column of their own; `base` is what the option of that name would say.
    """

    addresses: tuple[Parsed, ...]
    spaces: tuple[Space | Unclear, ...]
    functions: tuple[tuple[int, ...], ...]
    types: tuple[TypeCell | Unclear | None, ...]
    dialect: Dialect
    scales: ScaleColumn
    decimals: ScaleColumn
    limits: tuple[Limits | Unclear | None, ...]
    comma: bool | None
    exponents: dict[str, str]
    bits: BitColumn
    headings: dict[str, str]
    stated: tuple[str, ...]
    base: str


def whole_of(items: Sequence[Item], columns: Sequence[Column], choices: Choices, page: str = "") -> Whole:
    """Read what is decided once for the table; `page` is the name of its sheet, which may tell the space."""
    headings: dict[str, str] = {}
    for column in columns:
        headings.setdefault(column.role, column.heading)
    said = parse_spaces(_texts(items, "space"), headings.get("space", ""), digits=choices.digits)
    hints = [_hint(cell, item, page) for cell, item in zip(said.cells, items, strict=True)]
    found = _addresses(items, columns, hints, choices)
    spaces = tuple(_space(hint, address, choices) for hint, address in zip(hints, found.cells, strict=True))
    gaps = gaps_of(found.cells, spaces)
    sizes = [_size(item, cell) for item, cell in zip(items, found.cells, strict=True)]
    choice = choose_dialect(_texts(items, "type"), sizes, gaps, said=choices.dialect)
    comma = decimal_comma(text for role in NUMBERS for text in _texts(items, role))
    limits, why_limits = _limits(items, comma)
    types = tuple(
        _type(item, cell, choice.dialect, gap) for item, cell, gap in zip(items, found.cells, gaps, strict=True)
    )
    hints_of_scale = [
        _hint_of_scale(item, one, _wire(wire, choices), comma)
        for item, one, wire in zip(items, limits, types, strict=True)
    ]
    heading = headings.get("scale", "")
    scales = parse_scales(_texts(items, "scale"), heading, way=choices.scale, hints=hints_of_scale)
    decimals = parse_scales(_texts(items, "decimals"), way=Way.DECIMALS)
    stated = (
        found.evidence,
        said.evidence if "space" in headings else "",
        *_titled(items, said.cells, page),
        _assumed_space(hints, found.cells, choices),
        *choice.stated,
        scales.evidence if "scale" in headings else _no_scale(items, headings),
        why_limits,
    )
    bits = parse_bits(_texts(items, "bit"))
    plain = tuple(filter(None, (*stated, bits.evidence)))
    functions = tuple(cell.functions if isinstance(cell, SpaceCell) else () for cell in said.cells)
    known = (found.cells, spaces, functions, types, choice.dialect)
    exponents = _exponents(items, types)
    return Whole(*known, scales, decimals, limits, comma, exponents, bits, headings, plain, found.words)


def _exponents(items: Sequence[Item], types: Sequence[TypeCell | Unclear | None]) -> dict[str, str]:
    """The ids of the registers of 16 bits with a sign whose name no other has, by name in small letters."""
    names = Counter(item["name"].casefold() for item in items)
    return {
        item["name"].casefold(): snake(item["name"])
        for item, wire in zip(items, types, strict=True)
        if isinstance(wire, TypeCell) and wire.type is WireType.INT16 and names[item["name"].casefold()] == 1
    }


def _limits(items: Sequence[Item], comma: bool | None) -> tuple[tuple[Limits | Unclear | None, ...], str]:  # noqa: FBT001 - three states
    """The ranges as printed, of one column or of two; equal ends may state nothing."""
    pairs = [(item["min"], item["max"]) for item in items if item["min"] or item["max"]]
    stated, why = stated_limits(pairs) if pairs else (True, "")
    found: list[Limits | Unclear | None] = []
    for item in items:
        one = parse_range(item["range"], comma=comma)
        if one is None and (item["min"] or item["max"]):
            one = parse_limits(item["min"], item["max"], comma=comma)
            if isinstance(one, Limits) and not stated and one.low == one.high:
                one = None
        found.append(one)
    return tuple(found), why


def _type(item: Item, address: Parsed, dialect: Dialect, gap: int) -> TypeCell | Unclear | None:
    """The type of a row."""
    return parse_type(item["type"], dialect, size=_size(item, address), gap=gap)


def _size(item: Item, address: Parsed) -> str:
    """The size of a row: the registers of its range where no cell says one."""
    count = address.count if isinstance(address, Address) and item["type"] else 0
    return item["length"] or (f"{count} registers" if count else "")


def _wire(found: TypeCell | Unclear | None, choices: Choices) -> WireType | None:
    return (found.type if isinstance(found, TypeCell) else None) or choices.type


def _hint_of_scale(
    item: Item,
    limits: Limits | Unclear | None,
    wire: WireType | None,
    comma: bool | None,  # noqa: FBT001 - three states
) -> Hint | None:
    """What the range and the default of a row may say of its scale."""
    numbers = limits.numbers if isinstance(limits, Limits) else ()
    default = parse_number(item["default"], comma=comma)
    numbers += (default,) if isinstance(default, Fraction) else ()
    return Hint(numbers, wire) if numbers and wire is not None else None


def _texts(items: Sequence[Item], role: str) -> list[str]:
    return [item[role] for item in items]


def _addresses(
    items: Sequence[Item], columns: Sequence[Column], hints: Sequence[Space | Unclear | None], choices: Choices
) -> AddressColumn:
    texts = [
        Texts(column.heading, tuple(item.row.cell(column.index) for item in items))
        for column in columns
        if column.role == AT
    ]
    spaces = [hint if isinstance(hint, Space) else choices.space for hint in hints]
    words = [_takes_words(item["type"]) for item in items]
    return parse_addresses(texts, spaces=spaces, words=words, base=choices.base)


def _takes_words(text: str) -> bool:
    """Whether a cell is a type of whole words, whatever its width is in the dialect of the table."""
    found = parse_type(text, ANY_DIALECT)
    return isinstance(found, TypeCell) and found.type is not None and found.type is not WireType.BIT


def _hint(cell: SpaceCell | Unclear | None, item: Item, page: str) -> Space | Unclear | None:
    """The space that a row says in a column of its own, else the title of its section, else the name of the sheet."""
    if isinstance(cell, Unclear):
        return cell
    if cell is not None:
        return cell.space
    return space_of_title(item.section) or space_of_title(page)


def _titled(items: Sequence[Item], cells: Sequence[object], page: str) -> Iterator[str]:
    """What titles say of the spaces of the rows below them."""
    said: Counter[tuple[str, Space]] = Counter()
    for item, cell in zip(items, cells, strict=True):
        title = item.section if space_of_title(item.section) else page
        if cell is None and (space := space_of_title(title)):
            said[title, space] += 1
    for (title, space), count in said.items():
        yield f"the title `{title}` says that {count} rows are in the space {space}"


def _space(hint: Space | Unclear | None, address: Parsed, choices: Choices) -> Space | Unclear:
    own = address.space if isinstance(address, Address) else None
    if isinstance(hint, Unclear):
        return hint
    if hint is not None and own is not None and hint is not own:
        return Unclear(f"the address says {own} and the row says {hint}")
    return hint or own or choices.space or Space.HOLDING


def _assumed_space(hints: Sequence[object], addresses: Sequence[Parsed], choices: Choices) -> str:
    if choices.space is not None:
        return ""
    count = sum(
        hint is None and isinstance(address, Address) and address.space is None
        for hint, address in zip(hints, addresses, strict=True)
    )
    if not count:
        return ""
    return (
        f"nothing says in which space {count} of {len(hints)} rows are: they are taken as holding registers (--space)"
    )


def _no_scale(items: Sequence[Item], headings: dict[str, str]) -> str:
    if "decimals" in headings or not any(item["unit"] for item in items):
        return ""
    return "no column says a scale: numbers are taken as they are sent, unless their unit has a factor"


def gaps_of(addresses: Sequence[Parsed], spaces: Sequence[Space | Unclear]) -> tuple[int, ...]:
    """The registers of each row: of its range, else the distance to the next of its space; 0 where neither is known."""
    known = sorted(
        {(str(space), cell.at) for cell, space in zip(addresses, spaces, strict=True) if isinstance(cell, Address)}
    )
    after = {one: later[1] - one[1] for one, later in itertools.pairwise(known) if later[0] == one[0]}
    return tuple(
        (cell.count or after.get((str(space), cell.at), 0)) if isinstance(cell, Address) else 0
        for cell, space in zip(addresses, spaces, strict=True)
    )
