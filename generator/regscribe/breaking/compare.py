"""Two versions of maps to their changes: maps and models paired, everything in them compared, waivers honoured."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

from regscribe.breaking.change import Change, Difference, Effects, Found, Site
from regscribe.breaking.facts import B, C, H, N, compared
from regscribe.breaking.fold import folded
from regscribe.breaking.map_facts import MAP_FACTS, MODEL_FACTS, PROTOCOL_FACTS, SERIAL_FACTS
from regscribe.breaking.names import name_differences
from regscribe.breaking.pairs import Pairs, paired
from regscribe.breaking.plain import INDEX, Renames, conditions_in, plain
from regscribe.breaking.registers import RegisterComparison, Two, pairs_of, renamed_paths
from regscribe.breaking.rules import (
    EXISTENCE,
    MAP_ADDED,
    MAP_REMOVED,
    MAP_RENAMED,
    MODEL_ADDED,
    MODEL_REMOVED,
    MODEL_RENAMED,
    RULES,
)
from regscribe.breaking.things import NOTES_FACTS, Apart, T, thing_differences, thing_pairs
from regscribe.emit.words import condition_words
from regscribe.model import Condition, Register, RegisterMap, Waiver
from regscribe_runtime.values.conditions import GIVEN

MAP = "map"
"""The subject of what is about a map as a whole."""

IDS = frozenset(rule.id for rule in RULES)


@dataclass(frozen=True, slots=True)
class Comparison:
    """The changes between two versions, and waivers of the new one that excuse nothing."""

    changes: tuple[Change, ...]
    idle: tuple[Waiver, ...] = ()


def compare(olds: Sequence[RegisterMap], news: Sequence[RegisterMap], *, alone: bool = False) -> Comparison:
    """All changes from the old maps to the new ones; `alone`: the one of each is a pair whatever their ids are."""
    pairs = paired(olds, news, lambda one: one.id, [lambda one: tuple(plain(model) for model in one.models)])
    if alone and len(olds) == len(news) == 1:
        pairs = Pairs(((olds[0], news[0]),), (), ())
    found: list[Found] = []
    used: set[Waiver] = set()
    for old, new in pairs.both:
        if old.content_hash != new.content_hash or old.id != new.id:
            found += [one for one in _map(old, new) if not _waived(one, new.waivers, used)]
    found += [_whole(old, Difference(MAP_REMOVED, "map", Effects(B, B), old.id, "none")) for old in pairs.removed]
    found += [_whole(new, Difference(MAP_ADDED, "map", Effects(C, C), "none", new.id)) for new in pairs.added]
    mine = [waiver for one in news for waiver in one.waivers if waiver.rule in IDS]
    return Comparison(folded(found), tuple(waiver for waiver in mine if waiver not in used))


def _waived(one: Found, waivers: Iterable[Waiver], used: set[Waiver]) -> bool:
    """Whether a waiver excuses a difference; what it names may lack its indexes, or be the name before."""
    names = {name for name in (one.site.subject, one.site.other) if name}
    names |= {INDEX.sub(mark, name) for name in names for mark in ("", "[]")}
    matching = [waiver for waiver in waivers if waiver.rule == one.difference.rule.id and waiver.at in names]
    used.update(matching)
    return bool(matching)


def _whole(one: RegisterMap, difference: Difference) -> Found:
    return Found(Site(one.id, "", MAP, one.span), difference)


def _map(old: RegisterMap, new: RegisterMap) -> Iterator[Found]:
    """What differs between two versions of a map."""
    site = Site(new.id, "", MAP, new.span, old.span)
    if old.id != new.id:
        yield Found(site, Difference(MAP_RENAMED, "id of the map", Effects(N, B), old.id, new.id))
    givens = thing_pairs("given", old.givens, new.givens, Renames())
    given_names = _ids(givens)
    names = Renames(givens=given_names, conditions=_changed_conditions(old, new))
    names = names.with_paths({f"{GIVEN}.{mine}": f"{GIVEN}.{theirs}" for mine, theirs in given_names.items()})
    blocks = thing_pairs("block", old.blocks, new.blocks, names)
    names = replace(names, blocks=_ids(blocks))
    models = paired(old.models, new.models, lambda one: one.name, [lambda one: plain(one.registers)])
    paths: dict[str, str] = dict(names.paths)
    commands: dict[str, str] = {}
    for mine, theirs in models.both:
        model = _ModelComparison.of(new.id, Two(mine, theirs), names)
        paths |= model.renames.paths
        commands |= model.renames.commands
        yield from model.found()
    for mine in models.removed:
        gone = Difference(MODEL_REMOVED, "model", Effects(B, B), mine.name, "none")
        yield Found(Site(new.id, "", mine.name, new.span, mine.span), gone)
    for theirs in models.added:
        come = Difference(MODEL_ADDED, "model", Effects(C, C), "none", theirs.name)
        yield Found(Site(new.id, theirs.name, theirs.name, theirs.span), come)
    renames = replace(names, commands=commands).with_paths(paths)
    for name in sorted(names.conditions):
        yield from _condition(name, old, new)
    differences = [
        *compared(MAP_FACTS, *_identified(old, new), renames),
        *compared(PROTOCOL_FACTS, old.protocol, new.protocol),
        *compared(SERIAL_FACTS, old.protocol.serial, new.protocol.serial),
        *name_differences(old, new),
    ]
    yield from (Found(site, each) for each in differences)
    for apart in (*thing_differences("given", givens, renames), *thing_differences("block", blocks, renames)):
        yield _found(apart, site)


def _identified(old: RegisterMap, new: RegisterMap) -> tuple[RegisterMap, RegisterMap]:
    """Both maps with what identifies the models that both have: that others came or went is told already."""
    names = {model.name for model in old.models} & {model.name for model in new.models}
    one, other = (
        tuple(
            replace(rule, models=models)
            for rule in register_map.identity
            if (models := tuple(name for name in rule.models if name in names))
        )
        for register_map in (old, new)
    )
    return replace(old, identity=one), replace(new, identity=other)


def _found(apart: Apart, site: Site) -> Found:
    """A difference of a thing with an id, as one of the map or of a model."""
    here = site._replace(subject=apart.id, span=apart.span or site.span, was=apart.was or site.was, other=apart.other)
    return Found(here, apart.difference)


def _conditions(one: RegisterMap | Register) -> dict[str, set[Condition]]:
    """The conditions with names, each in all the forms that it has (in arrays the paths differ)."""
    found: dict[str, set[Condition]] = {}
    things = (one,) if isinstance(one, Register) else one.models
    for condition in conditions_in(tuple(things)):
        found.setdefault(condition.name, set()).add(condition)
    return found


def _changed_conditions(old: RegisterMap, new: RegisterMap) -> frozenset[str]:
    """The names of conditions that both versions have, with other tests on registers that both call the same."""
    before, after = _conditions(old), _conditions(new)
    paths = [{register.path for model in one.models for register in model.registers} for one in (old, new)]
    both = paths[0] & paths[1]
    return frozenset(
        name
        for name in before.keys() & after.keys()
        if {plain(each) for each in before[name]} != {plain(each) for each in after[name]}
        and all(path in both for each in before[name] | after[name] for path in each.registers)
    )


def _condition(name: str, old: RegisterMap, new: RegisterMap) -> Iterator[Found]:
    """One change for a condition, wherever it is used."""
    words = (" or else ".join(sorted(map(condition_words, _conditions(one)[name]))) for one in (old, new))
    difference = Difference(EXISTENCE, f"condition `{name}`", Effects(H, H), *words)
    for model in new.models:
        users = tuple(one.path for one in model.registers if name in _conditions(one))
        yield Found(Site(new.id, model.name, name, new.span, old.span, paths=users), difference, (new.id, name))


@dataclass(frozen=True, slots=True)
class _ModelComparison:
    """Compares a model in two versions; `things` are the pairs of what has an id in it, by sort."""

    map_id: str
    two: Two
    registers: Pairs[Register]
    things: dict[str, Pairs[Any]]
    renames: Renames

    @classmethod
    def of(cls, map_id: str, two: Two, names: Renames) -> "_ModelComparison":
        """Pair all that the model has."""
        registers = pairs_of(two)
        renames = names.with_paths({**names.paths, **renamed_paths(registers)})
        commands = thing_pairs("command", two.old.commands, two.new.commands, renames)
        renames = replace(renames, commands=_ids(commands))
        groups = thing_pairs("group", two.old.groups, two.new.groups, renames)
        renames = replace(renames, groups=_ids(groups))
        things: dict[str, Pairs[Any]] = {
            "group": groups,
            "command": commands,
            "computed value": thing_pairs("computed value", two.old.computed, two.new.computed, renames),
            "program": thing_pairs("program", two.old.programs, two.new.programs, renames),
        }
        return cls(map_id, two, registers, things, renames)

    def found(self) -> Iterator[Found]:
        """All that differs."""
        old, new = self.two
        site = Site(self.map_id, new.name, new.name, new.span, old.span, other=old.name)
        if old.name != new.name:
            yield Found(site, Difference(MODEL_RENAMED, "name of the model", Effects(N, B), old.name, new.name))
        for each in compared(MODEL_FACTS, old, new, self.renames):
            yield Found(site, each, (self.map_id, "models"))
        groups = self.things["group"]
        apart = {one.id: "group" for one in (*groups.removed, *groups.added)}
        yield from RegisterComparison(self.map_id, self.two, self.registers, self.renames, apart).found()
        for sort, pairs in self.things.items():
            yield from (_found(each, site) for each in thing_differences(sort, pairs, self.renames))
        yield from self._notes(site)

    def _notes(self, site: Site) -> Iterator[Found]:
        """What is noted of the programs that both versions have."""
        before, after = (
            {program.id: notes for program, notes in zip(model.programs, model.program_notes, strict=True)}
            for model in self.two
        )
        for old, new in self.things["program"].both:
            here = site._replace(subject=new.id, span=after[new.id].span, was=before[old.id].span)
            yield from (Found(here, each) for each in compared(NOTES_FACTS, before[old.id], after[new.id]))


def _ids(pairs: Pairs[T]) -> dict[str, str]:
    """What was renamed."""
    return {old.id: new.id for old, new in pairs.both if old.id != new.id}
