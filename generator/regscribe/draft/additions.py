"""New rows of a list in the text of a map: behind the row that they follow in the list, or in groups of their own."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from textwrap import dedent

from regscribe.draft.differences import Change
from regscribe.draft.map_edits import EditError, Edits, add_elements, set_keys
from regscribe.draft.map_registers import MapGroup, MapRegister

Tell = Callable[[Change, MapRegister, str], None]
"""Keeps what became of a new row."""

Waiting = tuple[MapRegister, MapRegister | None]
"""A new row, and the register of the map that it follows."""


@dataclass(frozen=True, slots=True)
class Additions:
    """Puts rows of the text `new` into the text of `edits`."""

    edits: Edits
    new: Edits
    tell: Tell

    def insert(self, waiting: Sequence[Waiting], latest: Sequence[MapGroup], mine: Sequence[MapGroup]) -> None:
        """Put new rows behind the rows that they follow, else at the end of their group, which may be a new one."""
        for group in latest:
            rows = [(register, after) for register, after in waiting if register.group == group.name]
            own = next((one for one in mine if one.name == group.name or one.id == group.id), None)
            if rows and (own is None or own.list is None):
                self._new_group(group, [register for register, _ in rows])
            elif own is not None:
                self._by_anchor(own, rows)

    def _by_anchor(self, own: MapGroup, rows: Sequence[Waiting]) -> None:
        anchors: dict[int, list[MapRegister]] = {}
        for register, after in rows:
            inside = after is not None and any(after is one for one in own.registers)
            anchors.setdefault(after.index if inside and after is not None else -1, []).append(register)
        for anchor, registers in anchors.items():
            self._rows(own, anchor, registers)

    def _rows(self, own: MapGroup, anchor: int, registers: Sequence[MapRegister]) -> None:
        assert own.list is not None  # noqa: S101 - looked at before
        after = (own.list.elements or [])[anchor] if anchor >= 0 else None
        try:
            add_elements(self.edits, own.list, after, [self._text(register) for register in registers])
        except EditError as error:
            self._tell(Change.KEPT, registers, f"new in the list: add it by hand to {own.name} ({error})")
        else:
            self._tell(Change.ADDED, registers, f"to the group {own.name}")

    def _new_group(self, group: MapGroup, registers: Sequence[MapRegister]) -> None:
        groups = self.edits.document.root.child("groups")
        members = (group.node.members or {}).items()
        head = [f"{key}: {self.new.slice(node.place)}" for key, node in members if key != "registers"]
        rows = [f"  {line}" for register in registers for line in _listed(self._text(register))]
        try:
            if groups is None:
                message = "the map has no groups"
                raise EditError(message)  # noqa: TRY301 - told as all others
            add_elements(self.edits, groups, None, ["\n".join([*head, "registers:", *rows])])
        except EditError as error:
            self._tell(Change.KEPT, registers, f"new in the list: add it by hand, in a group {group.name} ({error})")
        else:
            self._tell(Change.ADDED, registers, f"in the new group {group.name}")

    def _tell(self, change: Change, registers: Sequence[MapRegister], message: str) -> None:
        for register in registers:
            self.tell(change, register, message)

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

    def declare_units(self) -> None:
        """Declare the units that new rows need and the map does not declare. Raises EditError."""
        declared = self.new.document.root.child("units")
        own = self.edits.document.root.child("units")
        known = own.members if own is not None and own.members else {}
        missing = (
            {
                self.new.slice((declared.keys or {})[unit]): self.new.slice(node.place)
                for unit, node in (declared.members or {}).items()
                if unit not in known
            }
            if declared is not None
            else {}
        )
        groups = (self.edits.document.root.keys or {}).get("groups")
        if missing and own is not None and known:
            set_keys(self.edits, own, {name: f"{{{_flat(text)}}}" for name, text in missing.items()})
        elif missing and groups is not None:
            start = self.edits.start(groups)
            flat = ", ".join(f"{name}: {{{_flat(text)}}}" for name, text in missing.items())
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
