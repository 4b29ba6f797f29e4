"""A map that is being made of another form: what became of each row of the source, and what a person must decide.

Importers return a `Draft`; `text_of` writes it as YAML, `settle` takes out what `check` refuses, so that what comes out
passes, and the report (`regscribe.draft.report`) tells of each entry what was taken, lost or left out.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from enum import StrEnum
from typing import Any

from regscribe.model import Diagnostic, Severity, Span


class Outcome(StrEnum):
    """What became of a row of the source."""

    WHOLE = "whole"
    WITH_LOSS = "with loss"
    LEFT_OUT = "left out"


class Part(StrEnum):
    """The list of a map that an entry belongs to."""

    REGISTERS = "registers"
    COMMANDS = "commands"
    COMPUTED = "computed"


@dataclass(frozen=True, slots=True)
class Remark:
    """What is to be said of an entry, under a stable `code` in lower case (`scale-unclear`).

    The message quotes the source and says what was done. `lossy`: a fact of the source is not in the map. `todo`: a
    person must decide, so the message stands in the map too, as a comment.
    """

    code: str
    message: str
    lossy: bool = True
    todo: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Entry:
    """One row, point or parameter of the source, and what became of it.

    `keys` are those of a register, an array, a command or a computed value in the language, without the `registers` of
    an array, which are its `members`; None: it is left out, and the remarks say why. `place` is the line of the source,
    `where` the place in people's words if a line says little (`sheet Registers, row 7`). `parts` are rows which stand
    together in the keys of this entry (the bits of a word): it is then no row itself, and their own keys are an empty
    mapping.
    """

    name: str
    place: Span
    keys: Mapping[str, Any] | None = None
    remarks: tuple[Remark, ...] = ()
    group: str = "Registers"
    members: tuple["Entry", ...] = ()
    parts: tuple["Entry", ...] = ()
    where: str = ""
    part: Part = Part.REGISTERS

    @property
    def outcome(self) -> Outcome:
        """What became of it; of an array without its members."""
        if self.keys is None:
            return Outcome.LEFT_OUT
        return Outcome.WITH_LOSS if any(remark.lossy for remark in self.remarks) else Outcome.WHOLE

    @property
    def each(self) -> tuple["Entry", ...]:
        """The rows in it: itself (an array only if there is something to say of it) or its parts, and all members."""
        own = () if self.members and self.keys is not None and not self.remarks else (self,)
        return (*(self.parts or own), *(inner for member in self.members for inner in member.each))

    def told(self, remark: Remark, *, keys: Mapping[str, Any] | None) -> "Entry":
        """Return it with other keys, or left out, and a remark; the remark is for its parts if it has such."""
        if not self.parts:
            return replace(self, keys=keys, remarks=(*self.remarks, remark))
        parts = tuple(
            replace(one, keys=None if keys is None else one.keys, remarks=(*one.remarks, remark)) for one in self.parts
        )
        return replace(self, keys=keys, parts=parts)


@dataclass(frozen=True, slots=True)
class Recognised:
    """A column of a table: what people call it, its heading, what it was understood as, and why."""

    column: str
    heading: str
    meaning: str
    evidence: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Draft:
    """A map in the making.

    `head` has the keys of the map above its groups (`models`, `protocol`, `enums`, `manual`, ..), but for `format` and
    `map`; `groups` further keys of a group by its name. `title` and `maker` are what the source calls the device and
    who made it. `stated` are conclusions about the source as a whole, with their evidence. `findings` are faults of the
    source itself (doubles, overlaps, impossible ranges); with an error among them nothing is imported.
    `recognised` are the columns of a table. `settings` are options of the importer by which a later version of the
    source is read in the same way; of an option with several values each stands in a line.
    """

    entries: tuple[Entry, ...] = ()
    head: Mapping[str, Any] = field(default_factory=dict)
    groups: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    title: str = ""
    maker: str = ""
    stated: tuple[str, ...] = ()
    findings: tuple[Diagnostic, ...] = ()
    recognised: tuple[Recognised, ...] = ()
    settings: Mapping[str, str] = field(default_factory=dict)

    @property
    def failed(self) -> bool:
        """Whether nothing can be imported."""
        return any(one.severity is Severity.ERROR for one in self.findings)

    @property
    def each(self) -> tuple[Entry, ...]:
        """All entries, those inside arrays too, in the order of the source."""
        return tuple(inner for entry in self.entries for inner in entry.each)

    @property
    def each_kept(self) -> tuple[Entry, ...]:
        """All entries that become a part of the map, words in place of their parts."""
        waiting = list(reversed(self.entries))
        found: list[Entry] = []
        while waiting:
            entry = waiting.pop()
            found += [] if entry.keys is None else [entry]
            waiting += reversed(entry.members)
        return tuple(found)


def refused(name: str, message: str, *, line: int = 1, help_text: str = "", rule: str = "import") -> Draft:
    """A draft that says why nothing can be made of the source `name`."""
    return Draft(findings=(Diagnostic(rule, message, Span(name, line, 1, line, 1), help=help_text),))
