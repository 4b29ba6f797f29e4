"""What the page knows of maps: the facts of the JSON export, each register once, with what differs by model.

The shape, before `sharing` takes values out that occur several times:

    {"format": 1, "encodings": {..},
     "maps": [{"id", "title", .., "models": [..], "registers": [..], "groups": [..], "commands": [..]}]}

A register (group, command, computed value) has the facts in which all models agree, `models` where not all have it,
and `variants` where models differ: objects with `models` and the facts that are theirs. One of an array is that of the
first element, with `elements` (see `folding`). Facts that say nothing (an empty text, false, the usual factor) are left
out; numbers are exact (see `exact`). `anchor` and `said` come from the reference in Markdown,
`python` from the driver (see `python_names`).
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

from regscribe.emit.common_values import merged_order
from regscribe.emit.header import FORMAT
from regscribe.emit.markdown.context import context
from regscribe.emit.outline import pattern
from regscribe.emit.python.enum_classes import NamedClasses
from regscribe.export.json import plain
from regscribe.model import Model, RegisterMap
from regscribe.register_browser.encodings import encodings
from regscribe.register_browser.exact import exact
from regscribe.register_browser.folding import fold
from regscribe.register_browser.python_names import named_classes, python_names
from regscribe.register_browser.said import about, said
from regscribe.register_browser.sharing import shared
from regscribe.register_browser.spoken_conditions import with_words

Json = Any
"""Nested lists and dicts of texts, whole numbers, booleans and None."""

NOT_SHOWN = frozenset({"waivers", "class_prefix", "source", "models"})
OF_MODELS = ("name", "description", "class_name")


def document(maps: Sequence[RegisterMap]) -> Json:
    """Return what the page knows of `maps`."""
    return shared({"format": FORMAT, "encodings": encodings(maps), "maps": [_map(one) for one in maps]})


def _map(register_map: RegisterMap) -> Json:
    facts = exact(plain(replace(register_map, models=())))
    found = context(register_map)
    spoken = said(found)
    named = named_classes(register_map)
    registers = _merged(register_map, lambda one: _registers(one, named))
    commands = _merged(register_map, lambda one: _keyed(one, "commands"))
    for kind, key, each in (("register", "path", registers), ("command", "id", commands)):
        for one in each:
            anchor = found.anchor(kind, pattern(one[key]))
            one |= {"anchor": anchor, "said": spoken.get(anchor, {})}
    return {name: value for name, value in facts.items() if name not in NOT_SHOWN} | {
        "about": about(found),
        "models": [{name: getattr(one, name) for name in OF_MODELS} for one in register_map.models],
        "registers": registers,
        "groups": _merged(register_map, lambda one: _keyed(one, "groups")),
        "commands": commands,
        "computed": _merged(register_map, lambda one: _keyed(one, "computed")),
    }


def _registers(model: Model, named: NamedClasses) -> dict[str, Json]:
    """The registers of a model by their path in the first element, arrays folded."""
    every = [with_words(exact(plain(one)), one, model) | python_names(one, named) for one in model.registers]
    return {one["path"]: one for one in fold(every)}


def _keyed(model: Model, name: str) -> dict[str, Json]:
    return {one.id: with_words(exact(plain(one)), one, model) for one in getattr(model, name)}


def _merged(register_map: RegisterMap, parts: Callable[[Model], Mapping[str, Json]]) -> list[Json]:
    """The parts of all models, each once, in the order of the models."""
    found = {model.name: parts(model) for model in register_map.models}
    names = merged_order(each.keys() for each in found.values())
    every = len(found)
    return [_once({model: each[name] for model, each in found.items() if name in each}, every) for name in names]


def _once(versions: Mapping[str, Json], every: int) -> Json:
    """One part: what all its models agree in, and what is theirs alone."""
    first, *others = versions.values()
    common = {key: value for key, value in first.items() if all(key in one and one[key] == value for one in others)}
    variants: list[Json] = []
    for model, version in versions.items():
        own = {key: value for key, value in version.items() if key not in common}
        like = next((one for one in variants if {k: v for k, v in one.items() if k != "models"} == own), None)
        if like is None:
            variants.append({"models": [model], **own})
        else:
            like["models"].append(model)
    lacking = {} if len(versions) == every else {"models": list(versions)}
    return common | lacking | ({"variants": variants} if len(variants) > 1 else {})
