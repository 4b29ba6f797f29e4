"""Conditions with names, each of whose changes is one change wherever it is used."""

from collections.abc import Iterator
from typing import Any

from regscribe.breaking.change import Difference, Effects, Found, Site
from regscribe.breaking.facts import H
from regscribe.breaking.field_roles import UNCOMPARED
from regscribe.breaking.plain import field_names, plain
from regscribe.breaking.rules import EXISTENCE
from regscribe.emit.words import condition_words
from regscribe.model import Condition, Register, RegisterMap


def conditions_in(value: Any) -> Iterator[Condition]:  # noqa: ANN401 (any value of the model)
    """The conditions with names in a value of the model, those within others too."""
    if isinstance(value, Condition) and value.name:
        yield value
    for name in field_names(value):
        if name not in UNCOMPARED:
            yield from conditions_in(getattr(value, name))
    if type(value) is tuple:
        for each in value:
            yield from conditions_in(each)


def _conditions(one: RegisterMap | Register) -> dict[str, set[Condition]]:
    """The conditions with names, each in all the forms that it has (in arrays the paths differ)."""
    found: dict[str, set[Condition]] = {}
    things = (one,) if isinstance(one, Register) else one.models
    for condition in conditions_in(tuple(things)):
        found.setdefault(condition.name, set()).add(condition)
    return found


def changed_conditions(old: RegisterMap, new: RegisterMap) -> frozenset[str]:
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


def condition_changes(name: str, old: RegisterMap, new: RegisterMap) -> Iterator[Found]:
    """One change for a condition, wherever it is used."""
    words = (" or else ".join(sorted(map(condition_words, _conditions(one)[name]))) for one in (old, new))
    difference = Difference(EXISTENCE, f"condition `{name}`", Effects(H, H), *words)
    models = {
        model.name: tuple(one.path for one in model.registers if name in _conditions(one)) for model in new.models
    }
    using = {model: paths for model, paths in models.items() if paths} or {"": ()}  # else commands use it, say
    for model, paths in using.items():
        yield Found(Site(new.id, model, name, new.span, old.span, paths=paths), difference, (new.id, name))
