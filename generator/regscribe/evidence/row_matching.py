"""Pairs the rows of a table with those of a map: by id and address, by address, by id; aliases last."""

from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from regscribe.evidence.rows import ComparedRow, Spot
from regscribe.evidence.table import TableError


@dataclass(slots=True)
class Matching:
    """Pairs (ours, theirs) in the order of theirs, and what has no counterpart.

    `by_alias` are pairs whose second row stands at an alias of the first: it adds to the pair at the base address.
    """

    pairs: list[tuple[ComparedRow, ComparedRow]] = field(default_factory=list)
    by_alias: list[tuple[ComparedRow, ComparedRow]] = field(default_factory=list)
    only_ours: list[ComparedRow] = field(default_factory=list)
    only_theirs: list[ComparedRow] = field(default_factory=list)


class _RowIndex:
    """Our entries by place and by id; `free` are those without a counterpart yet."""

    def __init__(self, entries: Sequence[ComparedRow]) -> None:
        self.free = dict.fromkeys(range(len(entries)))
        self.entries = entries
        self.at: dict[tuple[str, Spot], list[int]] = defaultdict(list)
        self.aliases: dict[tuple[str, Spot], list[int]] = defaultdict(list)
        self.by_id: dict[tuple[str, str], list[int]] = defaultdict(list)
        for place, entry in enumerate(entries):
            self.by_id[entry.model, entry.id].append(place)
            for spots, found in ((entry.spots, self.at), (entry.aliases, self.aliases)):
                for space, address in spots:
                    found[entry.model, (space, address)].append(place)
                    found[entry.model, ("", address)].append(place)

    def exact(self, row: ComparedRow) -> list[int]:
        """Return free entries of the row's id at the row's place (if it has one)."""
        return [place for place in self.named(row) if not row.spots or place in self._standing(row)]

    def at_place(self, row: ComparedRow) -> list[int]:
        """Return free entries at the row's place; a command only for a row without id, where no register stands."""
        if row.is_command and row.id:
            return []  # several commands may begin at one address
        standing = self._standing(row)
        found = self._free(standing, row)
        registers = [place for place in found if not self.entries[place].is_command]
        taken = not row.is_command and any(not self.entries[place].is_command for place in standing)
        return registers or ([] if taken else found)

    def named(self, row: ComparedRow) -> list[int]:
        """Return free entries of the row's id, wherever they stand."""
        return self._free(self.by_id.get((row.model, row.id), ()), row) if row.id else []

    def at_alias(self, row: ComparedRow) -> list[int]:
        """Return the entries that have an alias at the row's place, free or not."""
        return [place for spot in row.spots for place in self.aliases.get((row.model, spot), ())]

    def _standing(self, row: ComparedRow) -> list[int]:
        return [place for spot in row.spots for place in self.at.get((row.model, spot), ())]

    def _free(self, places: Iterable[int], row: ComparedRow) -> list[int]:
        """The entries at `places` that are free; a row that states its kind finds a command only if it is one."""
        free = [place for place in places if place in self.free]
        if not row.cells.get("kind", "").strip():
            return free
        return [place for place in free if self.entries[place].is_command == row.is_command]


def match(ours: Sequence[ComparedRow], theirs: Sequence[ComparedRow], *, name: str) -> Matching:
    """Pair the entries of two sides. Raises TableError for doubled rows and those that fit several of our entries."""
    _refuse_doubles(theirs, name)
    index = _RowIndex(ours)
    found: dict[int, int] = {}
    for candidates in (index.exact, index.at_place, index.named):
        for number, row in enumerate(theirs):
            if number not in found and (fitting := candidates(row)):
                found[number] = _single(fitting, row, ours, name)
                index.free.pop(found[number])
    matching = Matching([(ours[found[number]], theirs[number]) for number in sorted(found)])
    for number, row in enumerate(theirs):
        if number not in found:
            if aliased := index.at_alias(row):
                matching.by_alias.append((ours[_single(aliased, row, ours, name)], row))
            else:
                matching.only_theirs.append(row)
    matching.only_ours = [ours[place] for place in index.free]
    return matching


def _single(places: list[int], row: ComparedRow, ours: Sequence[ComparedRow], name: str) -> int:
    """Return the one entry that fits, by its name where several do."""
    if len(places) > 1:
        title = row.cells.get("name", "")
        places = [place for place in places if ours[place].cells["name"] == title] or places
    if len(places) > 1:
        fitting = [ours[one].place for one in places]
        spots = ", ".join(f"{place.space} {place.address} (`{place.id}`)" for place in fitting)
        message = (
            f"{name}:{row.line}: this row may be any of {spots} of {row.model}: add a column `space` or `id` that tells"
        )
        raise TableError(message)
    return places[0]


def _refuse_doubles(rows: Sequence[ComparedRow], name: str) -> None:
    seen: dict[tuple[str, tuple[Spot, ...], str, bool], int] = {}
    for row in rows:
        key = (row.model, row.spots, row.id, row.is_command)
        line = seen.setdefault(key, row.line)
        if line != row.line:
            place = row.place
            where = f"{place.space} {place.address}".strip() or f"`{row.id}`"
            message = f"{name}: lines {line} and {row.line} both describe {where} of {row.model}: remove one of them"
            raise TableError(message)
