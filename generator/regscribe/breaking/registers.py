"""The registers of one model in two versions: which is which, and all that differs between them."""

from collections.abc import Hashable, Iterator, Mapping
from dataclasses import dataclass

from regscribe.breaking import codes, parts, places
from regscribe.breaking.arrays import Shaped, arrays_of, home, shapes
from regscribe.breaking.change import Difference, Effects, Found, Site
from regscribe.breaking.facts import B, C, H, N, compared
from regscribe.breaking.pairs import Pairs
from regscribe.breaking.places import Seat, spelled
from regscribe.breaking.register_facts import FACTS
from regscribe.breaking.register_pairs import Two
from regscribe.breaking.renames import INDEX, Renames
from regscribe.breaking.rules import ADDED, MOVED_GROUP, RELATION, REMOVED, RENAMED, SCALE, UNCERTAIN, UNIT
from regscribe.model import Register, Span

CAUSES = {SCALE: "scale", UNIT: "unit"}
"""Rules of changes whose cause may be a rule of the map, and what uses it."""


@dataclass(frozen=True, slots=True)
class RegisterComparison:
    """Compares the registers of one model; `groups` are those that one version alone has, by id."""

    map_id: str
    two: Two
    pairs: Pairs[Register]
    renames: Renames
    groups: Mapping[str, str]

    def found(self) -> Iterator[Found]:
        """All differences of registers and arrays."""
        old, new = arrays_of(self.two.old), arrays_of(self.two.new)
        shaped = list(shapes(old, new, self.renames))
        for one in shaped:
            yield self._shaped(one)
        for mine, theirs in self.pairs.both:
            yield from self._pair(
                Seat(mine, home(mine, old), self.two.old), Seat(theirs, home(theirs, new), self.two.new)
            )
        yield from self._apart(shaped)

    def _site(self, old: Register | None, new: Register | None) -> Site:
        one = new or old
        assert one is not None  # noqa: S101 (a caller has one of both)
        other = old.path if old and old.path != one.path else ""
        span, was = (new.span if new else self._around(one)), (old.span if old else None)
        return Site(self.map_id, self.two.new.name, one.path, span, was, one.group, (one.path,), other)

    def _around(self, gone: Register) -> Span:
        """The group in which a register stood, or else the model."""
        group = self.renames.groups.get(gone.group, gone.group)
        spans = [one.span for one in self.two.new.groups if one.id == group]
        return spans[0] if spans else self.two.new.span

    def _shaped(self, shaped: Shaped) -> Found:
        name = shaped.id
        inside = [one.path for one in self.two.new.registers if f"{one.array}.".startswith(f"{name}.")]
        site = Site(self.map_id, self.two.new.name, f"{name}[]", shaped.new.span, shaped.old.span, paths=tuple(inside))
        return Found(site, shaped.difference, ("array", name, shaped.new.span))

    def _pair(self, old: Seat, new: Seat) -> Iterator[Found]:
        mine, theirs = old.register, new.register
        site = self._site(mine, theirs)
        if mine.path != theirs.path:
            yield self._renamed(site, mine, theirs)
        for difference in compared(FACTS, mine, theirs, self.renames):
            if difference.what == "name" and mine.id != theirs.id:
                continue  # the path says it
            yield Found(site, difference, self._cause(difference, mine, theirs))
        for difference, cause, moved in places.differences(old, new, self.renames):
            yield Found(
                site, difference, (self.map_id, cause) if cause is not None else self._views_cause(mine, theirs), moved
            )
        for coded in codes.enum_differences(
            mine.enum, theirs.enum, theirs.access, self.renames, same_kind=mine.kind is theirs.kind
        ):
            enums = site._replace(span=theirs.enum.span, was=mine.enum.span) if theirs.enum and mine.enum else site
            yield Found(enums if coded.cause is not None else site, coded.difference, coded.cause)
        for difference in (
            *codes.special_differences(mine, theirs),
            *codes.sentinel_differences(mine.sentinels, theirs.sentinels, self.renames),
            *parts.part_differences(mine, theirs, self.renames),
            *self._group(mine, theirs),
            *self._rescales(mine, theirs),
        ):
            yield Found(site, difference)

    def _renamed(self, site: Site, mine: Register, theirs: Register) -> Found:
        """A rename; of all registers of an array that was renamed one change."""
        before, after = mine.path, theirs.path
        cause: Hashable = None
        if mine.index == theirs.index:  # so is it for the other elements
            before, after = INDEX.sub("[]", before), INDEX.sub("[]", after)
            if mine.array != theirs.array and mine.id == theirs.id:
                before, after = f"{mine.array}[]", f"{theirs.array}[]"
                cause = (self.map_id, RENAMED.id, before, after)
        return Found(site, Difference(RENAMED, "path", Effects(N, B), before, after), cause)

    def _cause(self, difference: Difference, mine: Register, theirs: Register) -> Hashable:
        """The rule of the map that both versions use; None where the register says it itself."""
        use = CAUSES.get(difference.rule, "")
        rules = [dict(one.rules).get(use, "") or (one.unit_id if use == "unit" else "") for one in (mine, theirs)]
        return (self.map_id, use, rules[1]) if use and rules[0] and rules[0] == rules[1] else None

    def _views_cause(self, mine: Register, theirs: Register) -> Hashable:
        sets = [dict(one.rules).get("views", "") for one in (mine, theirs)]
        return (self.map_id, "views", sets[1]) if sets[0] and sets[0] == sets[1] else None

    def _group(self, mine: Register, theirs: Register) -> Iterator[Difference]:
        before = self.renames.groups.get(mine.group, mine.group)
        if before != theirs.group:
            yield Difference(MOVED_GROUP, "group", Effects(N, H), mine.group, theirs.group)

    def _rescales(self, mine: Register, theirs: Register) -> Iterator[Difference]:
        """The registers that the device converts when this one is written, as far as both versions have them."""
        if not mine.rescales and not theirs.rescales:
            return
        now = {new.path: old for old, new in self.pairs.both}
        before = {path for path, old in now.items() if mine.rescales and old.unit_id == mine.rescales}
        after = {one.path for one in self.two.new.registers if theirs.rescales and one.unit_id == theirs.rescales}
        after &= now.keys()
        if before != after:
            words = (", ".join(sorted(paths)) or "none" for paths in (before, after))
            yield Difference(RELATION, "registers that it converts", Effects(H, H), *words)

    def _apart(self, shaped: list[Shaped]) -> Iterator[Found]:
        """Registers of one version alone, unless the shape of an array or a whole group says it."""
        told = tuple(f"{one.id}." for one in shaped if one.difference.what in {"first index", "number of elements"})
        both = [{INDEX.sub("[]", one.path) for one in model.registers} for model in self.two]

        def is_told(register: Register, others: set[str]) -> bool:
            return f"{register.array}.".startswith(told) and INDEX.sub("[]", register.path) in others

        for register in self.pairs.removed:
            if not is_told(register, both[1]):
                gone = Difference(REMOVED, "register", Effects(B, B), _words(register), "none")
                yield self._with_group(Found(self._site(register, None), gone), register)
        for register in self.pairs.added:
            if not is_told(register, both[0]):
                come = Difference(ADDED, "register", Effects(C, C), "none", _words(register))
                yield self._with_group(Found(self._site(None, register), come), register)
        for old, new in self.pairs.uncertain:
            words = [f"{one.path} at {spelled(one.base.space, one.address)}" for one in (old, new)]
            yield Found(self._site(old, new), Difference(UNCERTAIN, "register", Effects(C, C), *words))

    def _with_group(self, found: Found, register: Register) -> Found:
        """The registers of a group that one version alone has are one change."""
        sort = self.groups.get(register.group)
        if sort is None:
            return found
        gone = found.difference.rule is REMOVED
        words = f"group `{register.group}`"
        difference = found.difference._replace(
            what="registers of a group", before=words if gone else "none", after="none" if gone else words
        )
        return found._replace(difference=difference, cause=(self.map_id, sort, register.group))


def _words(register: Register) -> str:
    """Where a register stands: at an address, or in an array."""
    return f"in {register.array}[]" if register.array else f"at {spelled(register.base.space, register.address)}"
