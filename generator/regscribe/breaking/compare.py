"""Two versions of maps to their changes: maps and models paired, everything in them compared, waivers honoured."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

from regscribe.breaking.change import Change, Difference, Effects, Found, Site
from regscribe.breaking.conditions import changed_conditions, condition_changes
from regscribe.breaking.facts import B, C, N, compared
from regscribe.breaking.fold import folded
from regscribe.breaking.map_facts import MAP_FACTS, PROTOCOL_FACTS, SERIAL_FACTS
from regscribe.breaking.models import ModelComparison
from regscribe.breaking.names import name_differences
from regscribe.breaking.pairs import Pairs, paired
from regscribe.breaking.plain import plain
from regscribe.breaking.register_pairs import Two
from regscribe.breaking.renames import INDEX, Renames
from regscribe.breaking.rules import MAP_ADDED, MAP_REMOVED, MAP_RENAMED, MODEL_ADDED, MODEL_REMOVED, RULES
from regscribe.breaking.things import found_at, new_ids, thing_differences, thing_pairs
from regscribe.model import RegisterMap, Waiver
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
    given_names = new_ids(givens)
    names = Renames(givens=given_names, conditions=changed_conditions(old, new))
    names = names.with_paths({f"{GIVEN}.{mine}": f"{GIVEN}.{theirs}" for mine, theirs in given_names.items()})
    blocks = thing_pairs("block", old.blocks, new.blocks, names)
    names = replace(names, blocks=new_ids(blocks))
    models = paired(old.models, new.models, lambda one: one.name, [lambda one: plain(one.registers)])
    paths: dict[str, str] = dict(names.paths)
    commands: dict[str, str] = {}
    for mine, theirs in models.both:
        model = ModelComparison.of(new.id, Two(mine, theirs), names)
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
        yield from condition_changes(name, old, new)
    differences = [
        *compared(MAP_FACTS, *_identified(old, new), renames),
        *compared(PROTOCOL_FACTS, old.protocol, new.protocol),
        *compared(SERIAL_FACTS, old.protocol.serial, new.protocol.serial),
        *name_differences(old, new),
    ]
    yield from (Found(site, each) for each in differences)
    for apart in (*thing_differences("given", givens, renames), *thing_differences("block", blocks, renames)):
        yield found_at(apart, site)


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
