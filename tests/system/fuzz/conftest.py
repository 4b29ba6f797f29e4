"""Sound maps, and ways to break them: as text, and as a tree of values that stays near the right shape."""

import json
import random
import re
from collections.abc import Callable, Iterator
from copy import deepcopy
from decimal import Decimal
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from regscribe import source
from regscribe.checks.catalogue import MAIN, Example, all_rules, examples
from regscribe.schema import schema_json

ROOT = Path(__file__).parents[3]
TEXTS = json.loads((Path(__file__).parent / "texts.json").read_text("utf-8"), parse_float=Decimal)
HOSTILE: tuple[str, ...] = (*TEXTS["hostile"], "x" * 3000, "\N{CJK UNIFIED IDEOGRAPH-6F22} " * 60)
"""Texts that could break out of a string, a template, a cell; what they execute would set REGSCRIBE_FUZZ."""
EXTREMES: tuple[Any, ...] = tuple(TEXTS["extremes"])
"""Values that are seldom the right ones."""
SNIPPETS: tuple[str, ...] = (*TEXTS["snippets"], "[" * 3000, "{a: " * 2000, "- " * 2000, "9" * 5000)
"""What YAML treats in a special way."""
FREE_TEXT = frozenset(TEXTS["free_text_keys"])


def cut(map_id: str, *, groups: set[str], dropped: list[str], without: set[str]) -> Example:
    """A real map with some of its groups only, and without some of its models and sections."""
    names = "|".join(dropped)
    text = (ROOT / "maps" / f"{map_id}.yaml").read_text(encoding="utf-8")
    text = re.sub(rf"(?<=[\[,])\s*(?:{names})(?=[\],])", "", text)  # in lists of models
    text = re.sub(r"\[,\s*", "[", re.sub(r",+(?=[,\]])", "", text))
    text = re.sub(rf"^(?:  (?:{names}): .*|.*models: \[\].*)\n", "", text, flags=re.MULTILINE)
    sections = [one for one in re.split(r"^(?=[\w-]+:)", text, flags=re.MULTILINE) if one.split(":")[0] not in without]
    parts = [part for one in sections for part in re.split(r"^(?=  - id: )", one, flags=re.MULTILINE)]
    kept = [one for one in parts if not (group := re.match(r"  - id: (\w+)", one)) or group[1] in groups]
    return ((f"{map_id}.yaml", "".join(kept)),)


def small(*, several: bool) -> list[Example]:
    """The examples of the rules: those of several files, or the others."""
    found = [example for rule in all_rules() for example in examples(rule.id) if example]
    return [((MAIN, example[0][1]), *example[1:]) for example in found if (len(example) > 1) is several]


BASES: dict[str, Callable[[], list[Example]]] = {
    "oven": lambda: [
        (("test/oven.yaml", (ROOT / "tests" / "runtime" / "driver" / "oven.yaml").read_text(encoding="utf-8")),),
    ],
    "fdc": lambda: [
        cut(
            "fdc/series-100",
            groups={"input", "output_1", "output_2", "process", "command"},
            dropped=["BTC-8100", "BTC-4100", "BTC-7100", "C91"],
            without={"examples"},
        )
    ],
    "athena": lambda: [
        cut(
            "athena/series-c",
            groups={"communication", "unit_of_measure", "input", "display", "ramp_soak"},
            dropped=["16C", "25C"],
            without={"examples", "commands", "waivers", "identify", "uses", "programs"},
        )
    ],
    "rules": lambda: small(several=False),
    "families": lambda: small(several=True),
}
"""Maps by kind; of each the files, the map first."""


@cache
def bases(kind: str) -> list[Example]:
    return BASES[kind]()


@cache
def tree(text: str) -> Any:
    """The values of a text; None where it cannot be read."""
    document, _ = source.parse(text, name="map.yaml")
    return document.data if document else None


class Step(NamedTuple):
    """A place in a tree: what holds it, and the key or index there."""

    holder: Any
    key: Any

    @property
    def value(self) -> Any:
        return self.holder[self.key]


def steps(value: Any) -> Iterator[Step]:
    """Every place below `value`."""
    for key in value if isinstance(value, dict) else range(len(value)) if isinstance(value, list) else ():
        yield Step(value, key)
        yield from steps(value[key])


@cache
def pool() -> dict[str, list[Any]]:
    """What stands under each key, in all maps and in the schema's examples: the right shape, seldom the right sense."""
    found: dict[str, list[Any]] = {}
    for text in (text for kind in BASES for base in bases(kind) for _, text in base):
        for step in steps(tree(text)):
            if isinstance(step.key, str):
                found.setdefault(step.key, []).append(step.value)
    for definition in [schema_json(), *schema_json()["$defs"].values()]:
        for key, details in definition.get("properties", {}).items():
            found.setdefault(key, []).extend(details.get("x-examples", []))
    return found


def _lines(text: str, chance: random.Random) -> str:
    lines = text.splitlines(keepends=True) or [""]
    one, other = (chance.randrange(len(lines)) for _ in range(2))
    match chance.randrange(4):
        case 0:
            del lines[one : one + chance.choice([1, 1, 2, 10])]
        case 1:
            lines.insert(one, lines[other])
        case 2:
            lines[one], lines[other] = lines[other], lines[one]
        case _:
            line = lines[one]
            lines[one] = chance.choice([f" {line}", line[1:], f"  {line}", line.lstrip(), line.rstrip()])
    return "".join(lines)


def _characters(text: str, chance: random.Random) -> str:
    at = chance.randrange(len(text) + 1)
    snippet = chance.choice([*SNIPPETS, *HOSTILE])
    return chance.choice([text[:at], text[:at] + text[at + 1 :], *[text[:at] + snippet + text[at:]] * 3])


def _tokens(text: str, chance: random.Random) -> str:
    found = [match.span() for match in re.finditer(r"[\w.+-]+", text)] or [(0, 0)]
    (start, end), (first, last) = chance.choice(found), chance.choice(found)
    new = chance.choice([*SNIPPETS, *map(str, EXTREMES)])
    return text[:start] + chance.choice([new, text[first:last]]) + text[end:]


def _any(value: Any, chance: random.Random, wanted: Callable[[Step], bool] = lambda _: True) -> Step:
    return chance.choice([step for step in steps(value) if wanted(step)] or [Step({"x": {}}, "x")])


def _text(step: Step) -> bool:
    return step.key in FREE_TEXT and isinstance(step.value, str)


def _name(step: Step) -> bool:
    return isinstance(step.value, str) and step.value.isidentifier()


def _number(step: Step) -> bool:
    return isinstance(step.value, int | Decimal) and not isinstance(step.value, bool)


def _element(step: Step) -> bool:
    return isinstance(step.holder, list)


def drop(value: Any, chance: random.Random) -> None:
    step = _any(value, chance)
    del step.holder[step.key]


def rename(value: Any, chance: random.Random) -> None:
    step = _any(value, chance, lambda one: isinstance(one.holder, dict))
    new = chance.choice([*pool(), str(chance.choice(EXTREMES)), chance.choice(HOSTILE)])
    step.holder[new] = step.holder.pop(step.key)


def spoil(value: Any, chance: random.Random) -> None:
    step = _any(value, chance)
    step.holder[step.key] = deepcopy(chance.choice(EXTREMES))


def attack(value: Any, chance: random.Random) -> None:
    step = _any(value, chance, _text)
    hostile = chance.choice(HOSTILE)
    step.holder[step.key] = chance.choice([hostile, f"{step.value}{hostile}{step.value}"])


def borrow(value: Any, chance: random.Random) -> None:
    """Another map's value of the same key."""
    step = _any(value, chance, lambda one: one.key in pool())
    step.holder[step.key] = deepcopy(chance.choice(pool().get(step.key, [0])))


def add(value: Any, chance: random.Random) -> None:
    """A key that such a mapping can have, as its siblings show, with a value from anywhere."""
    step = _any(value, chance, lambda one: _element(one) and isinstance(one.value, dict))
    siblings = [key for one in step.holder if isinstance(one, dict) for key in one] if _element(step) else []
    key = chance.choice([*siblings, chance.choice(list(pool()))])
    step.value[key] = deepcopy(chance.choice(pool().get(key) or [0]))


def retarget(value: Any, chance: random.Random) -> None:
    """A name where another name stood: another register, enum or command."""
    step = _any(value, chance, _name)
    step.holder[step.key] = _any(value, chance, _name).value


def nudge(value: Any, chance: random.Random) -> None:
    step = _any(value, chance, _number)
    if _number(step):
        step.holder[step.key] = chance.choice([step.value + 1, step.value - 1, -step.value, step.value * 10])


def double(value: Any, chance: random.Random) -> None:
    step = _any(value, chance, _element)
    if _element(step):
        step.holder.insert(chance.randrange(len(step.holder) + 1), deepcopy(step.value))


def swap(value: Any, chance: random.Random) -> None:
    one = _any(value, chance)
    other = _any(value, chance, lambda step: step.key == one.key)
    one.holder[one.key], other.holder[other.key] = deepcopy(other.value), deepcopy(one.value)


BREAK_TEXT = (_lines, _characters, _tokens)
BREAK_TREE = (drop, rename, spoil, double, swap, add, add, attack, attack, borrow, borrow, retarget, nudge)


def written(value: Any) -> str:
    """Plain values as YAML in flow style, a line for each."""
    match value:
        case dict():
            return "{" + ",\n".join(f"{written(key)}: {written(one)}" for key, one in value.items()) + "}"
        case list():
            return "[" + ",\n".join(map(written, value)) + "]"
        case Decimal():
            return str(value)
    return json.dumps(value, ensure_ascii=False)


def _broken(text: str, way: str, chance: random.Random) -> str:
    value = deepcopy(tree(text))
    times = chance.choice([1, 1, 1, 2, 3])
    if way == "text" or value is None:
        for _ in range(times):
            text = chance.choice(BREAK_TEXT)(text, chance)
        return text
    for _ in range(times):
        chance.choice(BREAK_TREE)(value, chance)
    return written(value)


@pytest.fixture(scope="session")
def broken() -> Callable[[str, str, int], Example]:
    """Make the files of variant `seed` of a kind of map, broken as `text` or as `tree` in one of its files."""

    def make(kind: str, way: str, seed: int) -> Example:
        chance = random.Random(f"{kind} {way} {seed}")  # noqa: S311 - reproducible, no secret
        files = list(chance.choice(bases(kind)))
        at = chance.randrange(len(files))
        files[at] = (files[at][0], _broken(files[at][1], way, chance))
        return tuple(files)

    return make


@pytest.fixture(scope="session")
def sound() -> Callable[[str], list[Example]]:
    """The maps of a kind, unbroken, and written anew from their values."""
    return lambda kind: [
        *bases(kind),
        *(tuple((name, written(tree(text))) for name, text in one) for one in bases(kind)),
    ]


@pytest.fixture(scope="session")
def hostile() -> tuple[str, ...]:
    """Texts that could break out of a string, a template, a comment, a cell; what they would execute sets CANARY."""
    return HOSTILE


@pytest.fixture(scope="session")
def as_yaml() -> Callable[[Any], str]:
    """Write plain values as YAML."""
    return written
