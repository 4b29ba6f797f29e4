"""What each column of a table says: by its heading, by what stands below it, and as the user says."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from regscribe.importers.table.column_words import Asked
from regscribe.importers.table.contents import CONTENTS, judge
from regscribe.importers.table.grid import Grid, letters
from regscribe.importers.table.header import Header
from regscribe.importers.table.headings import AT, IGNORE, INSIDE, SEVERAL, meaning

ENOUGH = 0.8
"""Share of the cells of a column without a known heading that must be, say, types."""

FEWEST = 3

FEW_NAMES = 4
"""A column that names less than one in so many of the rows that another column names, names none."""

BY_USER = "as you said"


@dataclass(frozen=True, slots=True)
class Column:
    """One column: its index, what it is called, its role (empty: not understood; `-`: not to be read), and why."""

    index: int
    called: str
    heading: str
    role: str
    evidence: str

    @property
    def shown(self) -> tuple[str, str, str, str]:
        """What the proposal shows of it."""
        understood = {"": "not understood", IGNORE: "not read"}.get(self.role, self.role)
        return self.called, self.heading, understood, self.evidence


def recognise(grid: Grid, header: Header, asked: Asked) -> tuple[Column, ...]:
    """Return the columns of a grid; of several that claim a role the plainest has it. What is asked for stands."""
    texts = texts_below(grid, header)
    roles: dict[int, tuple[str, str]] = {}
    for index, role in asked.at.items():
        roles[index] = role, BY_USER
    taken = {role for role, _ in roles.values()} | asked.none
    claims = sorted(
        (unsure, index, role)
        for index, heading in enumerate(header.headings)
        if index not in roles and (role := meaning(heading)[0])
        for unsure in (meaning(heading)[1],)
    )
    poor = _poor_names([index for _, index, role in claims if role == "name"], texts)
    for unsure, index, claimed in claims:
        role, evidence = poor.get(index) or judge(claimed, texts[index], known=unsure < INSIDE)
        if role in asked.none or (role in taken and (role not in SEVERAL or role in asked.fixed)):
            continue
        if role == AT and AT in taken and unsure >= INSIDE:
            continue
        roles[index] = role, evidence
        taken.add(role)
    _by_contents(roles, taken, texts)
    _name(roles, taken | asked.none)
    return tuple(_column(grid, header, index, roles) for index in range(len(texts)) if _has(header, texts, index))


def _poor_names(claiming: Sequence[int], texts: Sequence[Sequence[str]]) -> dict[int, tuple[str, str]]:
    """What the columns for names are that name few rows where another names far more: they say more of those rows."""
    filled = {index: sum(map(bool, texts[index])) for index in claiming}
    most = max(filled.values(), default=0)
    why = "a heading for name, but only {} cells are filled, and another such column has {}"
    return {
        index: ("description", why.format(count, most)) for index, count in filled.items() if count * FEW_NAMES < most
    }


def _name(roles: dict[int, tuple[str, str]], taken: set[str]) -> None:
    """Let the first description name the registers where no column does."""
    described = [index for index, (role, why) in sorted(roles.items()) if role == "description" and why != BY_USER]
    if "name" not in taken and "symbol" not in taken and described:
        roles[described[0]] = "name", f"{roles[described[0]][1]}, and no column has names"


def _has(header: Header, texts: Sequence[Sequence[str]], index: int) -> bool:
    return bool(header.headings[index]) or any(texts[index])


def _column(grid: Grid, header: Header, index: int, roles: Mapping[int, tuple[str, str]]) -> Column:
    by_letters = bool(grid.rows) and grid.rows[0].letters
    first = grid.rows[0].first if grid.rows else 0
    called = letters(first + index) if by_letters else str(index + 1)
    role, evidence = roles.get(index, ("", ""))
    return Column(index, called, header.headings[index], role, evidence)


def texts_below(grid: Grid, header: Header) -> list[list[str]]:
    """The cells of each column below the header, without those that a merged cell repeats, and without titles."""
    below = [row for row in grid.rows[header.last + 1 :] if len(header.headings) == 1 or len(set(row.cells) - {""}) > 1]
    return [[row.cell(at) for row in below if at not in row.repeated] for at in range(len(header.headings))]


def _by_contents(roles: dict[int, tuple[str, str]], taken: set[str], texts: Sequence[Sequence[str]]) -> None:
    """Give the roles that no heading told to columns whose cells tell them."""
    for role, understood in CONTENTS.items():
        if role in taken:
            continue
        for index, cells in enumerate(texts):
            filled = [cell for cell in cells if cell]
            good = sum(map(understood, filled))
            if index not in roles and good >= max(FEWEST, ENOUGH * len(filled)):
                roles[index] = role, f"{good} of {len(filled)} cells are such"
                taken.add(role)
                break
