"""What a change is: its rule, its place, before and after, and how much it matters on the wire and for programs."""

from collections.abc import Hashable, Iterable
from dataclasses import dataclass
from enum import IntEnum, StrEnum
from typing import NamedTuple

from regscribe.model import Rule, Span


class Effect(IntEnum):
    """How much a change matters to those who rely on what was."""

    NONE = 0
    COMPATIBLE = 1
    BEHAVIOURAL = 2
    BREAKING = 3


class Level(StrEnum):
    """Whose view counts: any client on the wire; programs that use drivers too; readers of the docs too."""

    WIRE = "wire"
    API = "api"
    DOCS = "docs"


class Verdict(IntEnum):
    """The part of a semantic version that must be raised."""

    NONE = 0
    PATCH = 1
    MINOR = 2
    MAJOR = 3

    @property
    def word(self) -> str:
        """The verdict as people write it: `major`."""
        return self.name.lower()


class Effects(NamedTuple):
    """The effect on the wire, and that on programs that use the driver; neither: only texts differ."""

    wire: Effect = Effect.NONE
    api: Effect = Effect.NONE

    def at(self, level: Level) -> Effect:
        """The effect that counts at a level."""
        return self.wire if level is Level.WIRE else max(self)

    def counts(self, level: Level) -> bool:
        """Whether those of a level notice the change."""
        return level is Level.DOCS or self.at(level) > Effect.NONE

    def verdict(self, level: Level = Level.DOCS) -> Verdict:
        """What the change asks of the version, for those of a level."""
        if not self.counts(level):
            return Verdict.NONE
        effect = self.at(level)
        return {Effect.NONE: Verdict.PATCH, Effect.BREAKING: Verdict.MAJOR}.get(effect, Verdict.MINOR)


TEXT_ONLY = Effects()


class Difference(NamedTuple):
    """One fact that differs between two versions of a thing: its rule, what it is, and the fact in words."""

    rule: Rule
    what: str
    effects: Effects
    before: str = ""
    after: str = ""


class Site(NamedTuple):
    """Where something differs: map, model and subject (a path or an id), the definition now and the one before.

    `paths` are the registers that it concerns. `other` is what the subject was called before, if otherwise.
    """

    map: str
    model: str
    subject: str
    span: Span
    was: Span | None = None
    group: str = ""
    paths: tuple[str, ...] = ()
    other: str = ""


class Found(NamedTuple):
    """A difference at a site. Those of one `cause` become one change.

    `moved` is the first address before and after, and the words there, of a register that stands elsewhere now.
    """

    site: Site
    difference: Difference
    cause: Hashable = None
    moved: tuple[int, int, int] | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Change:
    """One change with one cause, at the definition of what changed, and all registers and models that it affects.

    `was` is where it stood before, `subjects` are the registers (else the ids) that it is about, `advice` says more.
    """

    rule: Rule
    place: Span
    subjects: tuple[str, ...]
    what: str
    before: str
    after: str
    effects: Effects
    map: str
    registers: tuple[str, ...] = ()
    models: tuple[str, ...] = ()
    was: Span | None = None
    advice: str = ""


def verdict_of(changes: Iterable[Change], level: Level = Level.DOCS) -> Verdict:
    """What all changes together ask of the version, for those of a level."""
    return max((change.effects.verdict(level) for change in changes), default=Verdict.NONE)
