"""Which register of one version is which of the other: by path, then by what can be proven."""

from collections.abc import Hashable
from dataclasses import fields
from typing import NamedTuple

from regscribe.breaking import parts
from regscribe.breaking.pairs import Pairs, paired
from regscribe.breaking.places import bare
from regscribe.breaking.plain import plain_field
from regscribe.breaking.renames import Renames
from regscribe.model import Model, Register, Space

NAMING = frozenset({"id", "path", "name", "symbol", "printed", "description", "section", "inferred", "span", "rules"})
"""What a register is called and what is said of it."""

PLACING = frozenset({"at", "aliases", "page", "block", "group", "array", "index", "unit_id", "rescales"})
"""Where it stands, and what names other things of the map."""


class Two(NamedTuple):
    """A model in two versions."""

    old: Model
    new: Model


def pairs_of(two: Two) -> Pairs[Register]:
    """Registers by path; then by address and content (renamed); then by content and name (moved and renamed).

    What is left of a group that moved as a whole is looked for where it would have moved to.
    """
    known = {register.path for register in two.new.registers}
    before = {register.path for register in two.old.registers}
    unknown = Renames().with_paths(dict.fromkeys(known ^ before, "?"))

    def same(register: Register) -> Hashable:
        return _address(register), _content(register, unknown)

    def moved(register: Register) -> Hashable:
        return " ".join(register.name.split()), register.symbol, _content(register, unknown)

    found = paired(two.old.registers, two.new.registers, lambda one: one.path, [same, moved], _address)
    shifts = _shifts(found) if found.removed and found.added else {}
    if not shifts:
        return found
    gone = {id(register) for register in found.removed}

    def shifted(register: Register) -> Hashable:
        distance = shifts.get((register.group, register.base.space), 0) if id(register) in gone else 0
        return _address(register, distance), _content(register, unknown)

    more = paired(found.removed, found.added, lambda one: one.path, [shifted], _address)
    return Pairs((*found.both, *more.both), more.removed, more.added, more.uncertain)


def _shifts(pairs: Pairs[Register]) -> dict[tuple[str, Space], int]:
    """The distance by which all registers of a group moved, by their group and space before."""
    found: dict[tuple[str, Space], set[int]] = {}
    for old, new in pairs.both:
        if old.base.space is new.base.space:
            found.setdefault((old.group, old.base.space), set()).add(new.address - old.address)
    return {key: min(distances) for key, distances in found.items() if len(distances) == 1 and distances != {0}}


def _address(register: Register, distance: int = 0) -> Hashable:
    return register.block, register.base.space, bare(register.base.space, register.address + distance)


def _content(register: Register, renames: Renames) -> Hashable:
    """All that a register is besides what it is called and where it stands."""
    names = [one.name for one in fields(register) if one.name not in NAMING | PLACING]
    return tuple(plain_field(register, name, renames) for name in names)


def renamed_paths(pairs: Pairs[Register]) -> dict[str, str]:
    """What registers, and parts of words, are called now, by what they were called."""
    found = {old.path: new.path for old, new in pairs.both if old.path != new.path}
    for old, new in pairs.both:
        for mine, theirs in parts.part_pairs(old, new).both if old.fields and new.fields else ():
            if (old.path, mine.id) != (new.path, theirs.id):
                found[f"{old.path}.{mine.id}"] = f"{new.path}.{theirs.id}"
    return found
