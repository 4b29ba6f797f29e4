"""Address spaces cut into sections (a view's region each) and rows of cells; stretches without registers are folded."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import groupby, pairwise

from regscribe.model import RegisterMap, Space
from regscribe.pictures.address_use import AddressUse

Hole = tuple[str, int, int]
"""Addresses without a register: `unused`, `reserved` or nothing, the first and the last."""

Content = tuple[int, tuple[AddressUse, ...], str]
"""Equal for neighbours that are drawn as one cell: -1 (with many addresses in a cell, its number), uses, kind."""

MOST_SECTIONS = 24
"""With more regions than this a space is drawn as one section."""


@dataclass(frozen=True, slots=True)
class Grid:
    """How many cells stand in a row, how many addresses a cell has, and how many rows and cells are at most drawn."""

    columns: int
    scale: int
    rows: int
    cells: int

    @property
    def step(self) -> int:
        """Return the addresses of a row."""
        return self.columns * self.scale


GRIDS = (
    Grid(columns=20, scale=1, rows=60, cells=1200),
    Grid(columns=50, scale=1, rows=80, cells=1500),
    Grid(columns=50, scale=10, rows=80, cells=1500),
    Grid(columns=50, scale=100, rows=80, cells=1500),
    Grid(columns=50, scale=1000, rows=1 << 16, cells=1 << 16),
)
"""From fine to coarse; the last one always fits."""


@dataclass(frozen=True, slots=True)
class AddressSection:
    """A stretch of one space under a heading: uses of one view, and stretches that are `unused` or `reserved`."""

    space: Space
    region: tuple[int, int] | None
    uses: tuple[AddressUse, ...]
    holes: tuple[Hole, ...] = ()

    @property
    def view(self) -> str:
        """Return the names of the views."""
        return ", ".join(dict.fromkeys(use.view for use in self.uses))

    @property
    def first(self) -> int:
        """Return the lowest address."""
        starts = [*(use.first for use in self.uses), *(low for _, low, _ in self.holes)]
        return self.region[0] if self.region else min(starts)

    @property
    def last(self) -> int:
        """Return the highest address; a region may end beyond its last register."""
        ends = [*(use.last for use in self.uses), *(high for _, _, high in self.holes)]
        return max([*ends, self.region[1]] if self.region else ends)


@dataclass(frozen=True, slots=True)
class Cell:
    """Neighbouring columns with the same content: uses, or a hole of a `kind` (empty: an address of nothing)."""

    column: int
    span: int
    first: int
    last: int
    uses: tuple[AddressUse, ...] = ()
    kind: str = ""


@dataclass(frozen=True, slots=True)
class AddressRow:
    """Addresses from `first` on, one step of the grid."""

    first: int
    cells: tuple[Cell, ...]


Fold = tuple[Hole, ...]
"""Rows without a register, drawn as one line: holes in order, without gaps between them."""


def sections(register_map: RegisterMap, uses: Sequence[AddressUse]) -> tuple[AddressSection, ...]:
    """Return the sections of all spaces, by space and address."""
    unused = dict.fromkeys(stretch for model in register_map.models for stretch in model.unused)
    stretches = [("unused", *stretch) for stretch in unused] + [("reserved", *one) for one in register_map.reserved]
    stretches = [one for one in stretches if not one[1].part_bits]
    found: list[AddressSection] = []
    for space in Space:
        own = [use for use in uses if use.space is space]
        holes = [(kind, low, high) for kind, of, low, high in stretches if of is space]
        found += sorted(_of_space(space, own, holes), key=lambda section: (section.first, section.last))
    return tuple(found)


def _regions(found: list[AddressUse]) -> list[tuple[int, int]]:
    regions = list(filter(None, dict.fromkeys(use.region for use in found)))
    return regions if len(regions) <= MOST_SECTIONS else []


def _of_space(space: Space, found: list[AddressUse], holes: list[Hole]) -> Iterator[AddressSection]:
    regions = _regions(found)
    for region in regions:
        inside = tuple(use for use in found if use.region == region)
        yield AddressSection(space, region, inside, _clipped(holes, *region))
    rest = tuple(use for use in found if use.region not in regions)
    outside = tuple((kind, *gap) for kind, low, high in holes for gap in gaps(regions, low, high))
    if rest or outside:
        yield from _by_view(AddressSection(space, None, rest, outside))


def _by_view(section: AddressSection) -> tuple[AddressSection, ...]:
    """Return a section for each view without a region, if their addresses do not mix; holes go with the first."""
    views: dict[str, list[AddressUse]] = {}
    for use in section.uses:
        views.setdefault(use.view, []).append(use)
    parts = [
        replace(section, uses=tuple(uses), holes=() if number else section.holes)
        for number, uses in enumerate(views.values())
    ]
    ordered = sorted(parts, key=lambda part: part.first)
    apart = all(one.last < two.first for one, two in pairwise(ordered))
    return tuple(parts) if parts and apart and len(parts) <= MOST_SECTIONS else (section,)


def _clipped(holes: Iterable[Hole], low: int, high: int) -> tuple[Hole, ...]:
    """Return the parts of holes that lie between two addresses."""
    return tuple(
        (kind, max(first, low), min(last, high)) for kind, first, last in holes if first <= high and low <= last
    )


def gaps(spans: Iterable[tuple[int, int]], low: int, high: int) -> Iterator[tuple[int, int]]:
    """Yield the stretches from `low` to `high` that no span holds."""
    for first, last in sorted(spans):
        if first > high:
            break
        if low < first:
            yield low, first - 1
        low = max(low, last + 1)
    if low <= high:
        yield low, high


def choose(found: Sequence[AddressSection]) -> Grid:
    """Return the finest grid whose rows and cells are not too many."""
    for grid in GRIDS:
        rows = sum(len(_numbers(section, grid.step)) for section in found)
        cells = sum(len(_numbers(section, grid.scale)) for section in found)
        if rows <= grid.rows and cells <= grid.cells:
            return grid
    return GRIDS[-1]


def _numbers(section: AddressSection, step: int) -> set[int]:
    """Return which rows (or cells) of `step` addresses hold a register."""
    return {number for use in section.uses for number in range(use.first // step, use.last // step + 1)}


def layout(section: AddressSection, grid: Grid) -> tuple[AddressRow | Fold, ...]:
    """Return the rows of a section; rows without registers that follow each other are one fold."""
    kinds: dict[int, str] = {}
    uses: dict[int, list[AddressUse]] = {}
    for kind, low, high in section.holes:
        kinds.update(dict.fromkeys(range(low // grid.scale, high // grid.scale + 1), kind))
    for use in section.uses:
        for cell in range(use.first // grid.scale, use.last // grid.scale + 1):
            uses.setdefault(cell, []).append(use)

    def content(cell: int) -> Content:
        found = tuple(uses.get(cell, ()))
        return cell if found and grid.scale > 1 else -1, found, kinds.get(cell, "")

    full = _numbers(section, grid.step)
    rows: list[AddressRow | Fold] = []
    for has, run in groupby(range(section.first // grid.step, section.last // grid.step + 1), key=full.__contains__):
        numbers = list(run)
        rows += (
            (_row(section, grid, content, number) for number in numbers) if has else (_fold(section, grid, numbers),)
        )
    return tuple(rows)


def _fold(section: AddressSection, grid: Grid, numbers: Sequence[int]) -> Fold:
    first = max(numbers[0] * grid.step, section.first)
    last = min((numbers[-1] + 1) * grid.step - 1, section.last)
    stretches: list[Hole] = []
    for kind, low, high in sorted(_clipped(section.holes, first, last), key=lambda hole: hole[1:]):
        if first < low:
            stretches.append(("", first, low - 1))
        if first <= high:
            stretches.append((kind, max(first, low), high))
        first = max(first, high + 1)
    return (*stretches, ("", first, last)) if first <= last else tuple(stretches)


def _row(section: AddressSection, grid: Grid, content: Callable[[int], Content], number: int) -> AddressRow:
    start = number * grid.columns
    first = max(start, section.first // grid.scale)
    last = min(start + grid.columns - 1, section.last // grid.scale)
    cells: list[Cell] = []
    for (_, uses, kind), run in groupby(range(first, last + 1), key=content):
        numbers = list(run)
        end = (numbers[-1] + 1) * grid.scale - 1
        cells.append(Cell(numbers[0] - start, len(numbers), numbers[0] * grid.scale, end, uses, "" if uses else kind))
    return AddressRow(start * grid.scale, tuple(cells))
