"""Every key of every object of the schema, taken away from a map or changed: something must come out otherwise."""

import re
from collections.abc import Callable, Iterator
from copy import deepcopy
from dataclasses import dataclass
from decimal import Decimal
from functools import cache, partial, reduce
from itertools import islice
from operator import getitem
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

from regscribe import source
from regscribe.files import dump
from regscribe.model import RegisterMap, Severity
from regscribe.pipeline import compile_map

from . import behaviour
from .schema_keys import SAME, Found, keys_in, keys_of_schema
from .suite import Json, plain, whole_map
from .test_recipes import recipes

CHILD = "test/child.yaml"
"""The map that has something of others."""
SPECIMENS = Path(__file__).parent / "specimens" / "maps"
TRIED, MOST_VALUES, MOST_PLACES, MOST_SHOWN = 15, 2, 3, 60
"""How many other values of a key are tried, how many of them that no rule refuses, in how many small and large maps."""


SETTLED = frozenset(
    (
        "map",
        "library",
        "drop",
        "dropped",
        "override",
        "manual",
        "model",
        "notation",
        "limits",
        "limits_of_space",
        "exception",
        "latency",
        "block",
        "matcher",
        "given_test",
        "default_case",
        "own_unit_case",
        "unit_case",
        "unit_symbol",
        "enum",
        "order_case",
        "set",
        "array",
        "range_case",
        "interval",
        "open_limit",
        "special_details",
        "sentinel_details",
        "write",
        "writable",
        "inferred",
        "protocol",
        "faults",
        "serial",
        "chain",
        "given",
        "condition",
        "enum_case",
        "member_details",
        "byte_order_case",
        "order_from_register",
        "term",
        "term_case",
        "group",
        "sentinel_case",
        "flags",
        "flag_details",
        "field",
        "computed",
        "command",
        "step",
        "step_argument",
        "argument",
        "repeat",
        "decimals_case",
        "governing",
        "text_details",
        "unused",
        "erratum",
    )
)
"""Objects of which each key was tried, and is what is said here; of the others each key has a specimen."""
FOR_READERS = frozenset(
    (
        "map.maker",
        "library.title",
        "drop.programs",
        "drop.errata",
        "drop.notes",
        "dropped.reason",
        "override.reason",
        "manual.title",
        "manual.date",
        "manual.publisher",
        "model.description",
        "notation.name",
        "notation.base",
        "latency.note",
        "enum.columns",
        "array.name",
        "array.description",
        "array.source",
        "open_limit.open",
        "sentinel_details.label",
        "writable.reason",
        "inferred.what",
        "inferred.why",
        "protocol.source",
        "serial.description",
        "given.reason",
        "member_details.cells",
        "member_details.description",
        "group.description",
        "flags.none",
        "flag_details.description",
        "field.unit",
        "unit_symbol.description",
        "field.description",
        "computed.name",
        "computed.description",
        "computed.source",
        "command.name",
        "command.description",
        "command.source",
        "argument.description",
        "erratum.where",
        "erratum.printed",
        "erratum.read",
        "erratum.why",
    )
)
"""Keys by which nobody does anything else: they are said in the docs."""
UNTOLD = frozenset(("map.maker", "library.title", "drop.waivers", "special_details.id", "sentinel_details.id"))
"""Keys that pages of docs do not show."""
DOING = frozenset(("driver", "simulator", "vectors", "plan", "findings"))


def ignored(key: str) -> str:
    """What was tried of a key that changed nothing; empty where it counts, or where each change of it is refused."""
    verdict = judge(key, places()[key], partial(_counts, key))
    return verdict.line() if verdict.tried and not _counts(key, verdict.sides) else ""


def _counts(key: str, sides: frozenset[str]) -> bool:
    return (key in FOR_READERS or bool(sides & DOING)) and (key in UNTOLD or "docs" in sides)


@dataclass(frozen=True, eq=False)
class Specimen:
    """A map, or a library beside one: its file below the folder of maps, and what stands in it."""

    file: str
    document: Json
    shown_by: str

    def __repr__(self) -> str:
        return self.file


class Outcome(NamedTuple):
    """What a map does and says, by who does or says it: worked out when it is asked for."""

    sides: dict[str, Callable[[], list[object]]]
    findings: list[str]


@cache
def specimens() -> tuple[Specimen, ...]:
    """The maps that have every key: those of the folder, and those of the recipes."""
    found = [_specimen(path) for path in sorted(SPECIMENS.rglob("*.yaml"))]
    for number, (_, text, _) in enumerate(recipes()):
        file = f"test/recipe-{number}.yaml"
        parts = whole_map(_data(text)).replace("test/case", f"test/recipe-{number}")
        found.append(Specimen(file, _data(parts), file))
    return tuple(found)


def _specimen(path: Path) -> Specimen:
    file = str(path.relative_to(SPECIMENS))
    beside = CHILD if file in {"test/base.yaml", "test/common.library.yaml"} else file
    return Specimen(file, _data(path.read_text(encoding="utf-8")), beside)


def _data(text: str) -> Any:
    document, found = source.parse(text, name="specimen.yaml")
    assert document is not None, found
    return document.data


class Verdict(NamedTuple):
    """Who does or says something else without a key, or with another value of it; `tried` are the changes."""

    key: str
    sides: frozenset[str]
    tried: tuple[str, ...]

    def line(self) -> str:
        """The verdict on one line."""
        return f"{self.key}: {', '.join(sorted(self.sides)) or 'nobody'} of {len(self.tried)}: {' | '.join(self.tried)}"


def tried_here() -> list[str]:
    """The keys of all objects but registers and views."""
    return [key for key in keys_of_schema() if key.partition(".")[0] not in SAME]


@cache
def places() -> dict[str, list[tuple[Found, Specimen]]]:
    """Where each key stands, by its name, in small maps first; keys that a register has are tried elsewhere."""
    found: dict[str, list[tuple[Found, Specimen]]] = {key: [] for key in tried_here()}
    for specimen in sorted(specimens(), key=lambda one: len(str(one.document))):
        for one in keys_in(specimen.document):
            if one.name in found:
                found[one.name].append((one, specimen))
    return found


def judge(key: str, where: list[tuple[Found, Specimen]], wanted: Callable[[frozenset[str]], bool]) -> Verdict:
    """What a key changes, in as many places and ways as it takes until that is what is wanted."""
    sides, tried = frozenset[str](), []
    for found, specimen in (*where[:MOST_PLACES], *where[MOST_PLACES:][-MOST_PLACES:]):
        before = _outcome(specimen, dump(plain(specimen.document)))
        assert before is not None, specimen
        for value, now in islice(_accepted(found, specimen), MOST_VALUES):
            sides |= _differing(before, now)
            tried.append(f"{specimen} {'.'.join(map(str, found.place))} {value[:MOST_SHOWN]}")
            if wanted(sides):
                return Verdict(key, sides, tuple(tried))
    return Verdict(key, sides, tuple(tried))


def _accepted(found: Found, specimen: Specimen) -> Iterator[tuple[str, Outcome]]:
    """Maps without a key, or with another value, that no rule refuses."""
    for value, document in islice(_others(found, specimen.document), TRIED):
        now = _outcome(specimen, dump(plain(document)))
        if now is not None:
            yield value, now


def _others(found: Found, document: Any) -> Iterator[tuple[str, Any]]:
    *above, key = found.place
    without = deepcopy(document)
    del reduce(getitem, above, without)[key]
    yield "without", without
    for value in _values(reduce(getitem, found.place, document), found.schema, document):
        changed = deepcopy(document)
        reduce(getitem, above, changed)[key] = value
        yield repr(value), changed


def _values(value: Any, node: Json, document: Any) -> Iterator[Any]:
    """Other values of a key: others that the schema lists, and values near it."""
    yield from (one for one in node.get("enum", ()) if one != value)
    if isinstance(value, bool):
        yield not value
    elif isinstance(value, int | Decimal):
        yield from (value + 1, value - 1, 1, 0)
    elif isinstance(value, str):
        yield from _texts(value, document)
    elif isinstance(value, list):
        others = (value[:-1], value[1:], value[::-1], [_next(one) for one in value])
        yield from (other for other in others if other != value)
    elif isinstance(value, dict):
        yield from ({key: each for key, each in value.items() if key != gone} for gone in value)


def _next(value: Any) -> Any:
    return value + 1 if isinstance(value, int) else value


def _texts(value: str, document: Any) -> Iterator[str]:
    """Other texts: names of the map that are like it, numbers that are near, words."""
    if re.fullmatch(r"-?\d+ *\.\. *-?\d+", value):
        first, last = value.split("..")
        yield from (f"{first}..{int(last) - 1}", f"{int(first) + 1}..{last}")
    names = sorted(_names(document), key=lambda name: (name[:2] != value[:2], name))
    yield from dict.fromkeys(name for name in names if name != value)
    yield from (f"{value}x", f"{value} x")


def _names(node: Any) -> Iterator[str]:
    """Every word that stands in a map."""
    if isinstance(node, dict):
        yield from (key for key in node if isinstance(key, str))
        if "at" in node and "name" in node:
            yield re.sub(r"\W+", "_", node["name"].lower())
        for each in node.values():
            yield from _names(each)
    elif isinstance(node, list):
        for each in node:
            yield from _names(each)
    elif isinstance(node, str):
        yield node


@cache
def _outcome(specimen: Specimen, text: str) -> Outcome | None:
    """What a map does and says whose file has this text; None where a rule refuses it."""
    folder = Path(TEMPORARY.name) / "maps"
    for one in specimens() if specimen.shown_by == CHILD else ():
        _write(folder / one.file, dump(plain(one.document)))
    _write(folder / specimen.file, text)
    path = folder / specimen.shown_by
    compiled = compile_map(path)
    own = () if path == folder / specimen.file else compile_map(folder / specimen.file).diagnostics
    if compiled.map is None or any(one.severity is Severity.ERROR for one in own):
        return None
    sides = {name: cache(lambda side=side: [*side(compiled.map)]) for name, side in SIDES.items()}
    sides["plan"] = cache(partial(_plans, path, text if path == folder / specimen.file else "", compiled.map))
    findings = [f"{one.rule} {one.message}" for one in (*compiled.diagnostics, *own)]
    return Outcome(sides, findings)


def _plans(path: Path, text: str, register_map: RegisterMap) -> list[object]:
    """What `plan` prints for all registers of each model; of the text that a file had then."""
    if text:
        _write(path, text)
    return [*behaviour.of_plans(path, register_map)]


SIDES: dict[str, Callable[[Any], Iterator[object]]] = {
    "driver": behaviour.of_drivers,
    "simulator": behaviour.of_simulators,
    "vectors": behaviour.of_vectors,
    "code": behaviour.of_code,
    "docs": behaviour.of_docs,
    "export": behaviour.of_exports,
}
TELLING = ("code", "docs", "export")
ACTING = ("driver", "simulator", "vectors", "plan")
TEMPORARY = TemporaryDirectory()


def _write(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def _differing(before: Outcome, now: Outcome) -> frozenset[str]:
    """Who says something else; of those who do something the first."""
    told = {name for name in TELLING if before.sides[name]() != now.sides[name]()}
    acting = (name for name in ACTING if before.sides[name]() != now.sides[name]())
    return frozenset(told | {next(acting, "")} | ({"findings"} if before.findings != now.findings else set())) - {""}
