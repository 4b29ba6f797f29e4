"""A new version of a list into a map that a person edited meanwhile: what the list changed, where nobody else did.

Three states are compared: what the last import said, what the list says now, and what the map says. The text of the
map is changed in the places that the list changed; all else in it stays byte for byte.
"""

from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any

from regscribe.draft.additions import Additions, Waiting
from regscribe.draft.differences import Change, Index, Merged, Note
from regscribe.draft.map_edits import EditError, Edits, drop_key, set_keys
from regscribe.draft.map_registers import MapGroup, MapRegister, groups_of
from regscribe.model import Span
from regscribe.source import Document

ABSENT = "not stated"

MOST_SHOWN = 60
"""Characters of a value that a message shows."""


def merge(base: Sequence[MapRegister], new: Document, ours: Document) -> Merged:
    """Merge what changed from the last import (`base`) to the present one (`new`) into a person's map (`ours`)."""
    run = _Run(Edits(ours), Edits(new), groups_of(ours), groups_of(new))
    before = Index(base)
    mine = Index([register for group in run.mine for register in group.registers])
    seen: set[int] = set()
    for register in (register for group in run.latest for register in group.registers):
        old = before.find(register)
        if old is None:
            run.add(register, mine.find(register))
        else:
            seen.add(id(old))
            run.update(old, register, mine.find(old))
    run.insert()
    for old in base:
        if id(old) not in seen and (own := mine.find(old)) is not None:
            run.note(Change.GONE, own, "the list has it no longer; it stays in the map until you take it out")
    return Merged(run.edits.done(), tuple(run.notes))


@dataclass(slots=True)
class _Run:
    """One merge; `last` is the register of the map that the list came to last, by group."""

    edits: Edits
    new: Edits
    mine: tuple[MapGroup, ...]
    latest: tuple[MapGroup, ...]
    notes: list[Note] = field(default_factory=list)
    waiting: list[Waiting] = field(default_factory=list)
    last: dict[str, MapRegister] = field(default_factory=dict)

    def note(self, change: Change, register: MapRegister, message: str) -> None:
        """Keep a difference, at the place of a register of the map."""
        self._note(self.edits, change, register, message)

    def note_new(self, change: Change, register: MapRegister, message: str) -> None:
        """Keep a difference, at the place of a row of the list."""
        self._note(self.new, change, register, message)

    def _note(self, edits: Edits, change: Change, register: MapRegister, message: str) -> None:
        name = edits.document.name
        place = register.node.place.span(name) if register.node else Span(name)
        self.notes.append(Note(change, str(register), message, place))

    def add(self, register: MapRegister, own: MapRegister | None) -> None:
        """A row that the last import did not have."""
        if own is None:
            self.waiting.append((register, self.last.get(register.group)))
            return
        self.last[register.group] = own
        if differing := [key for key in register.keys if register.keys[key] != own.value(key)]:
            message = f"new in the list, but you have it already, with another {' and '.join(differing)}"
            self.note(Change.KEPT, own, message)

    def update(self, old: MapRegister, register: MapRegister, own: MapRegister | None) -> None:
        """A row that both have: each key that the list changed and nobody else did is changed."""
        keys = [key for key in {**old.keys, **register.keys} if old.keys.get(key) != register.keys.get(key)]
        if own is not None:
            self.last[register.group] = own
            for key in keys:
                self._key(key, old, register, own)
        elif keys:
            message = f"{', '.join(keys)} changed in the list, but you took the register out of the map"
            self.note_new(Change.KEPT, register, message)

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
        """Put in what is new: rows and the units that they need."""
        additions = Additions(self.edits, self.new, self.note_new)
        with suppress(EditError):  # then `check` tells which unit is not declared
            additions.declare_units()
        additions.insert(self.waiting, self.latest, self.mine)


def _shown(value: object) -> str:
    if value is None:
        return ABSENT
    text = str(value)
    return f"`{text if len(text) <= MOST_SHOWN else f'{text[: MOST_SHOWN - 3]}...'}`"


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
