"""A new version of a list into a map that a person edited meanwhile: what the list changed, where nobody else did.

Three states are compared: what the last import said, what the list says now, and what the map says. The text of the
map is changed in the places that the list changed; all else in it stays byte for byte.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from textwrap import dedent
from typing import Any

from regscribe.draft.map_edits import EditError, Edits, add_elements, drop_key, set_keys
from regscribe.draft.map_registers import MapGroup, MapRegister, groups_of
from regscribe.model import Span
from regscribe.source import Document

ABSENT = "not stated"


class Change(StrEnum):
    """What became of a difference between two versions of a list."""

    CHANGED = "changed"
    ADDED = "added"
    KEPT = "kept as you have it"
    GONE = "gone from the list"


@dataclass(frozen=True, slots=True)
class Note:
    """One difference: what became of it, of which register, where that stands in the map, and what was what."""

    change: Change
    name: str
    message: str
    place: Span


@dataclass(frozen=True, slots=True)
class Merged:
    """The text of the map with what the list changed, and every difference."""

    text: str
    notes: tuple[Note, ...]


def merge(base: Sequence[MapRegister], new: Document, ours: Document) -> Merged:
    """Merge what changed from the last import (`base`) to the present one (`new`) into a person's map (`ours`)."""
    run = _Run(Edits(ours), Edits(new), groups_of(ours), groups_of(new))
    before = _Index(base)
    mine = _Index([register for group in run.mine for register in group.registers])
    latest = [register for group in run.latest for register in group.registers]
    seen: set[int] = set()
    for register in latest:
        old = before.find(register)
        if old is None:
            run.add(register, mine.find(register))
            continue
        seen.add(id(old))
        run.update(old, register, mine.find(old))
    run.units(new, ours)
    run.insert()
    for old in base:
        if id(old) not in seen and (own := mine.find(old)) is not None:
            run.note(Change.GONE, own, "the list has it no longer; it stays in the map until you take it out")
    return Merged(run.edits.done(), tuple(run.notes))


class _Index:
    """Finds registers by where they are on the wire, else by their id."""

    def __init__(self, registers: Sequence[MapRegister]) -> None:
        self._places: dict[Any, list[MapRegister]] = {}
        self._ids: dict[str, list[MapRegister]] = {}
        for register in registers:
            self._places.setdefault(register.place, []).append(register)
            self._ids.setdefault(register.id, []).append(register)

    def find(self, wanted: MapRegister) -> MapRegister | None:
        """The same register; by its place the one of that id, if several stand there."""
        there = self._places.get(wanted.place, [])
        named = [register for register in there if register.id == wanted.id]
        if named or len(there) == 1:
            return (named or there)[0]
        alike = self._ids.get(wanted.id, [])
        return alike[0] if len(alike) == 1 and not there else None


@dataclass(slots=True)
class _Run:
    edits: Edits
    new: Edits
    mine: tuple[MapGroup, ...]
    latest: tuple[MapGroup, ...]
    notes: list[Note] = field(default_factory=list)
    waiting: list[tuple[MapRegister, MapRegister | None]] = field(default_factory=list)
    last: dict[str, MapRegister] = field(default_factory=dict)
    known: set[int] = field(default_factory=set)

    def note(self, change: Change, register: MapRegister, message: str) -> None:
        """Keep a difference, at the place of the register in the map, else in the list."""
        edits = self.edits if register.node is not None and id(register) not in self.known else self.new
        place = register.node.place.span(edits.document.name) if register.node else Span(edits.document.name)
        self.notes.append(Note(change, str(register), message, place))

    def add(self, register: MapRegister, own: MapRegister | None) -> None:
        """A row that the last import did not have."""
        if own is not None:
            self.last[register.group] = own
            if differing := [key for key in register.keys if register.keys[key] != own.value(key)]:
                message = f"new in the list, but you have it already, with another {' and '.join(differing)}"
                self.note(Change.KEPT, own, message)
            return
        self.waiting.append((register, self.last.get(register.group)))

    def update(self, old: MapRegister, register: MapRegister, own: MapRegister | None) -> None:
        """A row that both have: each key that the list changed and nobody else did is changed."""
        keys = [key for key in {**old.keys, **register.keys} if old.keys.get(key) != register.keys.get(key)]
        if own is None:
            if keys:
                self.known.add(id(register))
                message = f"{', '.join(keys)} changed in the list, but you took the register out of the map"
                self.note(Change.KEPT, register, message)
            return
        self.last[register.group] = own
        for key in keys:
            self._key(key, old, register, own)

    def _key(self, key: str, old: MapRegister, register: MapRegister, own: MapRegister) -> None:
        was, now, mine = old.keys.get(key), register.keys.get(key), own.value(key)
        if mine == now:
            return
        told = f"{key}: {_shown(was)} -> {_shown(now)} in the list"
        if mine != was:
            self.note(Change.KEPT, own, f"{told}, and {_shown(mine)} here")
            return
        try:
            self._write(key, register, own, now)
        except EditError as error:
            self.note(Change.KEPT, own, f"{told}: change it by hand ({error})")
        else:
            self.note(Change.CHANGED, own, told)

    def _write(self, key: str, register: MapRegister, own: MapRegister, now: object) -> None:
        node = own.node
        if node is None or register.node is None or (key not in own.keys and key in own.each and now is None):
            message = "it stands in the group's `each`"
            raise EditError(message)
        if now is None:
            drop_key(self.edits, node, key)
            return
        text = self.new.slice((register.node.members or {})[key].place)
        if "\n" in text:
            message = "its value has several lines"
            raise EditError(message)
        set_keys(self.edits, node, {key: text})

    def insert(self) -> None:
        """Put new rows behind the row that they follow in the list, or at the end of their group."""
        for group in self.latest:
            rows = [(register, after) for register, after in self.waiting if register.group == group.name]
            if not rows:
                continue
            own = next((one for one in self.mine if one.name == group.name or one.id == group.id), None)
            if own is None or own.list is None:
                self._new_group(group, [register for register, _ in rows])
                continue
            by_anchor: dict[int, list[MapRegister]] = {}
            for register, after in rows:
                inside = after is not None and any(after is one for one in own.registers)
                by_anchor.setdefault(after.index if inside and after is not None else -1, []).append(register)
            for anchor, registers in by_anchor.items():
                self._insert(own, anchor, registers)

    def _insert(self, own: MapGroup, anchor: int, registers: Sequence[MapRegister]) -> None:
        assert own.list is not None  # noqa: S101 - looked at before
        after = (own.list.elements or [])[anchor] if anchor >= 0 else None
        try:
            add_elements(self.edits, own.list, after, [self._text(register) for register in registers])
        except EditError as error:
            for register in registers:
                self._new(Change.KEPT, register, f"new in the list: add it by hand to {own.name} ({error})")
        else:
            for register in registers:
                self._new(Change.ADDED, register, f"to the group {own.name}")

    def _new_group(self, group: MapGroup, registers: Sequence[MapRegister]) -> None:
        groups = self.edits.document.root.child("groups")
        head = [
            f"{key}: {self.new.slice(node.place)}"
            for key, node in (group.node.members or {}).items()
            if key != "registers"
        ]
        rows = [f"  {line}" for register in registers for line in _listed(self._text(register))]
        try:
            if groups is None:
                message = "the map has no groups"
                raise EditError(message)  # noqa: TRY301 - told as all others
            add_elements(self.edits, groups, None, ["\n".join([*head, "registers:", *rows])])
        except EditError as error:
            for register in registers:
                self._new(Change.KEPT, register, f"new in the list: add it by hand, in a group {group.name} ({error})")
        else:
            for register in registers:
                self._new(Change.ADDED, register, f"in the new group {group.name}")

    def _new(self, change: Change, register: MapRegister, message: str) -> None:
        self.known.add(id(register))
        self.note(change, register, message)

    def _text(self, register: MapRegister) -> str:
        """The text of a new row, with the comments above it."""
        assert register.node is not None  # noqa: S101 - it stands in the text of the import
        place = register.node.place
        lines = self.new.text.split("\n")
        first = place.line
        while first > 0 and lines[first - 1].lstrip().startswith("#"):
            first -= 1
        comments = [line.strip() for line in lines[first : place.line]]
        body = dedent(" " * place.column + self.new.slice(place))
        return "\n".join([*comments, body])

    def units(self, new: Document, ours: Document) -> None:
        """Declare the units that new rows need and the map does not declare."""
        declared = new.root.child("units")
        own = ours.root.child("units")
        missing = {
            unit: self.new.slice(node.place)
            for unit, node in ((declared.members if declared else None) or {}).items()
            if own is None or unit not in (own.members or {})
        }
        if not missing:
            return
        assert declared is not None  # noqa: S101 - it has members
        names = {unit: self.new.slice((declared.keys or {})[unit]) for unit in missing}
        if own is not None and own.members:
            set_keys(self.edits, own, {names[unit]: " ".join(text.split("\n")) for unit, text in missing.items()})
            return
        groups = (ours.root.keys or {}).get("groups")
        if groups is not None:
            start = self.edits.start(groups)
            flat = ", ".join(f"{names[unit]}: {{{_flat(text)}}}" for unit, text in missing.items())
            self.edits.change(start, start, f"units: {{{flat}}}\n")


def _flat(text: str) -> str:
    """A mapping in braces or on lines, without its braces, on one line."""
    bare = text.removeprefix("{").removesuffix("}")
    return ", ".join(line.strip() for line in bare.split("\n") if line.strip())


def _listed(text: str) -> Iterator[str]:
    """A row as lines of a list."""
    lines = text.split("\n")
    comments = [line for line in lines if line.startswith("#")]
    yield from comments
    first, *rest = lines[len(comments) :]
    yield f"- {first}"
    yield from (f"  {line}" for line in rest)


def _shown(value: object) -> str:
    if value is None:
        return ABSENT
    text = str(value)
    return f"`{text if len(text) <= 60 else f'{text[:57]}...'}`"  # noqa: PLR2004 - a part of a line


def stored(document: Document) -> tuple[Mapping[str, Any], ...]:
    """What the next merge must know of an import: each register with its group and unit id."""
    return tuple(
        {
            "group": register.group,
            **({"unit_id": int(register.unit)} if register.unit else {}),
            "register": register.keys,
        }
        for group in groups_of(document)
        for register in group.registers
    )


def restored(items: Sequence[Mapping[str, Any]]) -> tuple[MapRegister, ...]:
    """The registers of `stored`."""
    return tuple(MapRegister(str(item["group"]), item["register"], {}, str(item.get("unit_id", ""))) for item in items)
