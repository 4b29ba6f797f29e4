"""No document of the right shape makes lowering raise, however little sense it makes."""

import random
from copy import deepcopy
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

import regscribe.lower
from regscribe.lower import lower
from regscribe.schema import validate
from regscribe.source import Document, load

EXAMPLES = sorted((Path(regscribe.lower.__file__).parent / "examples").glob("*.yaml"))
SEEDS = range(15)


def places(value: Any, path: tuple[str | int, ...] = ()) -> list[tuple[str | int, ...]]:
    steps = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    return [path, *(found for step, child in steps for found in places(child, (*path, step)))]


def at(value: Any, path: tuple[str | int, ...]) -> Any:
    for step in path:
        value = value[step]
    return value


def mutated(data: Any, chance: random.Random) -> Any:
    changed = deepcopy(data)
    *way, last = chance.choice(places(changed)[1:])
    holder = at(changed, tuple(way))
    kind = chance.randrange(4)
    if kind == 0:
        del holder[last]
    elif kind == 1:
        holder[last] = deepcopy(at(changed, chance.choice(places(changed))))
    elif kind == 2:
        holder[last] = chance.choice([0, -1, 65535, 10**30, "a", "1..2", "9..1", "x.y", [], {}, None, True])
    elif isinstance(holder, dict):
        holder[chance.choice(["range", "enum", "when", "1", "not", "scale", "fields"])] = holder.pop(last)
    return changed


def variants_of(document: Document, seeds: range) -> list[Document]:
    return [replace(document, data=mutated(document.data, random.Random(seed))) for seed in seeds]  # noqa: S311 - reproducible, no secret


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.name)
def test_no_mutated_map_makes_lowering_raise(path: Path) -> None:
    document, _ = load(path)
    assert document is not None
    for variant in variants_of(document, SEEDS):
        found, mistakes = lower(variant)
        assert (found is None) == bool(mistakes)


def test_some_mutated_maps_are_of_the_right_shape_and_still_wrong() -> None:
    document, _ = load(EXAMPLES[0])
    assert document is not None
    right = [variant for variant in variants_of(document, range(200)) if not validate(variant)]
    assert any(lower(variant)[1] for variant in right)
