"""What the user says of columns: `--columns at=Register,type="Data type",unit=-`."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from difflib import get_close_matches

from regscribe.importers.table.grid import TableError, number_of
from regscribe.importers.table.headings import IGNORE, ROLES, SEVERAL, fold

PAIR = re.compile(r"\s*([a-z_]+|-)\s*=\s*(.*?)\s*", re.DOTALL)
NEXT = re.compile(r",(?=\s*(?:[a-z_]+|-)\s*=)|\n")
"""What separates two of them: a comma in a heading is none."""


@dataclass(frozen=True, slots=True)
class Asked:
    """The roles of columns by index, and the roles that no column has."""

    at: dict[int, str]
    none: frozenset[str] = frozenset()

    @property
    def fixed(self) -> frozenset[str]:
        """The roles that are given to columns."""
        return frozenset(self.at.values())


def pairs_of(text: str) -> list[tuple[str, str]]:
    """The roles and headings that a text says, in its order. Raises TableError for what is no such pair."""
    pairs = []
    for part in filter(str.strip, NEXT.split(text)):
        found = PAIR.fullmatch(part)
        if not found or (found[1] not in ROLES and found[1] != IGNORE):
            near = get_close_matches(part.partition("=")[0].strip(), ROLES, n=1)
            meant = f"did you mean {near[0]}?" if near else f"there are {', '.join(ROLES)}"
            message = f"--columns {part.strip()}: write what a column says and its heading, at=Register; {meant}"
            raise TableError(message)
        pairs.append((found[1], found[2].strip("\"'")))
    return pairs


def asked(text: str, headings: Sequence[str], *, first: int = 0) -> Asked:
    """Find the columns that `--columns` names, by heading, letter or number. Raises TableError with the nearest."""
    at: dict[int, str] = {}
    none = set()
    for role, heading in pairs_of(text):
        if heading == IGNORE:
            none.add(role)
            continue
        index = _index(role, heading, headings, first)
        if index in at and at[index] != role:
            message = f"--columns: `{heading}` cannot be both {at[index]} and {role}"
            raise TableError(message)
        if role in at.values() and role not in SEVERAL | {IGNORE} and at.get(index) != role:
            message = f"--columns: two columns are said to be {role}: name one"
            raise TableError(message)
        at[index] = role
    return Asked(at, frozenset(none))


def _index(role: str, heading: str, headings: Sequence[str], first: int) -> int:
    folded = [fold(each) for each in headings]
    same = [index for index, each in enumerate(headings) if each.strip() == heading]
    same = same or [index for index, each in enumerate(folded) if each and each == fold(heading)]
    if len(same) == 1:
        return same[0]
    if len(same) > 1:
        message = f"--columns {role}={heading}: {len(same)} columns have this heading: name one by its letter or number"
        raise TableError(message)
    letter = number_of(heading)
    index = int(heading) - 1 if heading.isdecimal() and len(heading) < 4 else -1 if letter is None else letter - first  # noqa: PLR2004
    if 0 <= index < len(headings):
        return index
    near = get_close_matches(fold(heading), [each for each in folded if each], n=1, cutoff=0.4)
    known = f"did you mean `{headings[folded.index(near[0])]}`?" if near else f"it has {_all(headings)}"
    message = f"--columns {role}={heading}: the table has no such column; {known}"
    raise TableError(message)


def _all(headings: Sequence[str]) -> str:
    return ", ".join(f"`{heading}`" for heading in headings if heading) or "no headings: name columns by number"
