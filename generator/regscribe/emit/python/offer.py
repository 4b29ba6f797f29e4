"""What generated modules have to offer to others, by content: a module that needs the same imports it.

Content is told by keys: texts in which sections stand between marks, since the manual of a sibling counts its chapters
otherwise. Two things with the same key would be the same lines in a module.
"""

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import NamedTuple

from regscribe.model import renumbered

MARK = "\0"
"""Stands around a section in a key; no text of a map has it."""
_SECTION = re.compile(f"{MARK}([^{MARK}]*){MARK}")


class Origin(NamedTuple):
    """A name and the module that declares it."""

    module: str
    name: str


class Declared(NamedTuple):
    """What a declaration is by its key, by its type as a type checker sees it, and by what its map tells of it.

    `section` and `persistence` are told of a whole group or set more often than of one register, so they stand apart.
    """

    key: str
    type: str
    section: str = ""
    persistence: str = ""

    @property
    def whole(self) -> str:
        """A key of all of it."""
        return f"{self.key} {marked(self.section)} {self.persistence}"


class Telling(NamedTuple):
    """What a map tells of all registers of a set where it uses it, in one of its groups; None for what it leaves."""

    group: str
    section: str | None
    persistence: str | None


@dataclass(frozen=True, slots=True)
class Part:
    """A class that declares registers, arrays or commands, by id; `telling` if it is a set as a map uses it."""

    origin: Origin
    items: Mapping[str, Declared]
    telling: Telling | None = None

    @property
    def id(self) -> str:
        """What tells it from other parts."""
        return ".".join(self.origin)


@dataclass(frozen=True, slots=True)
class Groups:
    """The class of a map's groups, and each group by id: its title and members."""

    origin: Origin
    groups: Mapping[str, tuple[str, tuple[str, ...], int | None]]


@dataclass(frozen=True, slots=True, kw_only=True)
class Offer:
    """Named classes, classes of array elements and commands by key; parts by what they are parts of; constants by text.

    `sets` are the parts of libraries, which may be parts of anything and tell no section.
    `parts` of the models stand under "", those of an array's element under its path, those of commands under
    "commands". `sections` are the chapters that have another number here, by the module of an inherited part.
    """

    named: Mapping[str, Origin] = field(default_factory=dict)
    parts: Mapping[str, tuple[Part, ...]] = field(default_factory=dict)
    sets: tuple[Part, ...] = ()
    elements: Mapping[str, Origin] = field(default_factory=dict)
    commands: Mapping[tuple[Origin, ...], Origin] = field(default_factory=dict)
    constants: Mapping[str, Origin] = field(default_factory=dict)
    devices: Mapping[str, Origin] = field(default_factory=dict)
    groups: Groups | None = None
    sections: Mapping[str, Mapping[str, str]] = field(default_factory=dict)

    def names(self) -> frozenset[str]:
        """Every private name and every name made from the map's own in what is offered."""
        parts = [part.origin for same in (*self.parts.values(), self.sets) for part in same]
        others = [*self.commands.values(), *self.devices.values(), *([self.groups.origin] if self.groups else [])]
        return frozenset(origin.name for origin in (*parts, *others))

    def renumbered(self, chapters: Mapping[str, str]) -> "Offer":
        """The same as a map sees it whose manual numbers chapters otherwise."""
        parts = {owner: tuple(_part(part, chapters) for part in same) for owner, same in self.parts.items()}
        elements = {key_renumbered(key, chapters): origin for key, origin in self.elements.items()}
        sections = {module: _composed(self.sections.get(module, {}), chapters) for module in self.modules()}
        return replace(self, parts=parts, elements=elements, sections=sections)

    def modules(self) -> frozenset[str]:
        """The modules of all parts."""
        return frozenset(part.origin.module for same in self.parts.values() for part in same)


def marked(section: str) -> str:
    """A section as it stands in a key."""
    return f"{MARK}{section}{MARK}"


def key_renumbered(key: str, chapters: Mapping[str, str]) -> str:
    """The key of the same thing in a manual that numbers chapters otherwise."""
    return _SECTION.sub(lambda found: marked(renumbered(found[1], chapters)), key)


def _part(part: Part, chapters: Mapping[str, str]) -> Part:
    def here(one: Declared) -> Declared:
        key, kind = key_renumbered(one.key, chapters), key_renumbered(one.type, chapters)
        return one._replace(key=key, type=kind, section=renumbered(one.section, chapters))

    return Part(part.origin, {name: here(one) for name, one in part.items.items()})


def _composed(first: Mapping[str, str], then: Mapping[str, str]) -> Mapping[str, str]:
    """One renumbering after the other, without what stays as it is."""
    both = {old: then.get(first.get(old, old), first.get(old, old)) for old in (*first, *then)}
    return {old: new for old, new in both.items() if old != new}


def chosen(parts: Iterable[Part], own: Mapping[str, Declared]) -> list[Part]:
    """The parts that a class with the items `own` may inherit: of those it has everything, the best first.

    At least half of a part must be the same; what is not is to be overridden. No item comes from two parts.
    """
    rated = []
    for place, part in enumerate(parts):
        same = sum(own[name] == one for name, one in part.items.items()) if part.items.keys() <= own.keys() else 0
        if same and same * 2 >= len(part.items):
            rated.append((-same, place, part))
    found: dict[int, Part] = {}
    covered: set[str] = set()
    for _, place, part in sorted(rated, key=lambda one: one[:2]):
        if covered.isdisjoint(part.items):
            covered.update(part.items)
            found[place] = part
    return [found[place] for place in sorted(found)]
