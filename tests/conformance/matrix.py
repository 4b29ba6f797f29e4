"""Every key of a register, tried on every kind, type, space, access and place: honoured, or refused by a rule."""

import json
import os
from collections import Counter
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from functools import cache
from itertools import chain, islice
from operator import itemgetter
from pathlib import Path
from typing import Any, NamedTuple

from regscribe.model import RegisterMap

from . import matrix_maps as maps
from . import matrix_watch as watch
from .matrix_maps import Seed
from .suite import Json, diagnose, errors_of

ROOT = Path(__file__).parents[2]
SCHEMA = json.loads((ROOT / "schema" / "map.language.json").read_text("utf-8"))

DOCS_ONLY = frozenset(
    "symbol printed description source inferred name endurance persistence poll good_for static mandatory".split()  # noqa: SIM905
)
"""Keys that are for readers: they are honoured in the docs (`persistence` for what is neither RAM nor EEPROM)."""
DOCS_WHERE: dict[str, Callable[[Seed], bool]] = {
    "range": lambda seed: seed.access == "r",
    "range_decimals": lambda seed: seed.access == "r",
    "unit": lambda seed: seed.access == "w",
    "type": lambda seed: seed.kind in {"flags", "fields", "version", "boolean", *["enum"] * (seed.access == "w")},
    "functions": lambda seed: seed.access == "r" or seed.type not in {"uint16", "int16", "bit"},
    "write": lambda seed: seed.type not in {"uint16", "int16", "bit"},
    "kind": lambda seed: seed.kind in {"raw", "integer", "number"},
}
"""Keys that tell readers something where there is nothing to do: limits of what is never written, and their like."""

Trial = tuple[Any, Json]
"""A value of a key, and what must stand beside it to mean something."""

SEL = {"sel": 1}
TRIALS: dict[str, tuple[Trial, ...]] = {
    "at": ((12, {}), ([11, 10], {}), ([10, 12], {})),
    "name": (("Y", {}),),
    "when": ((SEL, {}), ({"any": [SEL, {"low": {"to": -1}}]}, {})),
    "id": (("z", {}),),
    "symbol": (("S.1", {}),),
    "printed": (("5.1", {"symbol": "S.1"}), ("5.1", {})),
    "description": (("what it is", {}),),
    "source": (("7.7", {}),),
    "space": (
        ("input", {}),
        ("holding", {}),
        ("coil", {}),
        ("discrete", {}),
        ("status", {}),
        ("file", {}),
        ("enron", {}),
    ),
    "file": ((4, {"space": "file"}), (4, {})),
    "queue": ((9, {"space": "queue"}), (9, {})),
    "access": (("r", {}), ("rw", {}), ("w", {})),
    "views": (("one", {}),),
    "type": (("int16", {}), ("uint32", {}), ("float32", {}), ("bit", {}), ("uint8", {})),
    "length": ((3, {}),),
    "text": (("latin-1", {}), ({"one_per_register": "low"}, {})),
    "layout": (("hm", {}),),
    "word_order": (
        ("little", {}),
        ({"register": "ord", "codes": {0: "big", 1: "little"}}, {}),
        ([{"when": SEL, "is": "little"}, {"is": "big"}], {}),
        ([2, 1], {}),
        ([3, 4, 1, 2], {}),
    ),
    "byte_order": (("little", {}), ([{"when": SEL, "is": "little"}, {"is": "big"}], {})),
    "byte": (("high", {}),),
    "functions": (([3], {}), ([3, 16], {}), ([6], {}), ([1], {}), ([4], {}), ([7], {}), ([2], {})),
    "write_at": ((40, {}), (40, {"functions": [3, 16]})),
    "write": (
        ({"at": 40}, {}),
        ({"space": "coil"}, {}),
        ({"functions": [16]}, {"write_at": 40}),
        ({"at": 40, "type": "int32"}, {}),
    ),
    "kind": tuple((kind, {}) for kind in maps.KINDS),
    "scale": (("0..100", {}), ("cases", {}), ({"from": "low", "to": 100, "raw": "0..50"}, {})),
    "decimals": ((1, {}), (-2, {}), ("digits", {}), ("not_stated", {})),
    "multiply": ((0.5, {}), (2, {}), ("dig", {}), ("1/3", {}), ({"product": [2, "dig"]}, {})),
    "divide": ((4, {}), ("dig", {})),
    "exponent": ((-1, {}), ("dig", {})),
    "add": ((3, {}), ("low", {}), ([{"when": SEL, "is": 1}, {"is": {"sum": ["low", 1]}}], {})),
    "step": ((5, {}), (0.5, {"multiply": 0.1})),
    "range": (
        ("1..5", {}),
        ({"from": "low", "to": "high"}, {}),
        ({"from": {"open": "the lowest"}, "to": 4}, {}),
        (["0..1", "3..4"], {}),
        ({"from": "low", "to": {"sum": ["high", -1]}}, {}),
        ([{"when": SEL, "is": "1..5"}, {"is": "2..3"}], {}),
    ),
    "range_decimals": (("digits", {"range": "10..500"}), ("digits", {})),
    "valid": (("1..5", {}), ({"from": "low", "to": "high"}, {}), ([{"when": SEL, "is": "1..5"}], {})),
    "special": (
        ({3: "three"}, {}),
        ({3: {"label": "three", "means": 30}}, {}),
        ({3: {"label": "three", "id": "TRE"}}, {}),
    ),
    "default": ((3, {}), ("AB", {}), ("one", {}), ([{"when": SEL, "is": 3}, {"is": 4}], {})),
    "delivered": ((3, {}), ("AB", {}), ("one", {}), ([{"when": SEL, "is": 3}, {"is": 4}], {})),
    "unit": (("°C", {}), ("temperature", {}), ([{"when": SEL, "is": "°C"}, {"is": "K"}], {})),
    "enum": (({0: "off", 3: "on"}, {}), ("choice", {}), ({0: "off", 3: {"label": "on", "invalid": "not now"}}, {})),
    "flags": (({1: "middle"}, {}),),
    "fields": (({"wide": {"bits": "0..3"}}, {}),),
    "version": (("nn.nn", {}),),
    "sentinels": (
        ({7: "broken"}, {}),
        ({0: "broken"}, {}),
        ({"nan": "broken"}, {}),
        ({"5..9": "broken"}, {}),
        ([{"when": SEL, "is": {7: "broken"}}], {}),
    ),
    "aliases": (([50], {}),),
    "persistence": (("ram", {}), ("eeprom", {}), ("both", {}), ("in a drawer", {})),
    "endurance": ((1000, {}), (1000, {"persistence": "eeprom"})),
    "rescales": (("temperature", {}),),
    "writable": (({"when": SEL, "reason": "only then"}, {}),),
    "unlock": (("unlock_it", {}),),
    "apply": (("apply_it", {}),),
    "danger": (("burns", {}),),
    "stays": (("calibration", {}), ("operation", {}), ("momentary", {})),
    "governs": (
        ("address", {"stays": "address"}),
        ({"setting": "baud", "codes": {0: "9600", 1: "19200"}}, {"stays": "line"}),
        ({"setting": "baud", "codes": {0: "9600", 1: "19200"}, "from": "at_once"}, {"stays": "line"}),
    ),
    "settle": ((20, {}),),
    "reading": (("clears", {}),),
    "poll": (("slow", {}), (60, {})),
    "good_for": ((30, {}),),
    "static": ((True, {}),),
    "mandatory": ((True, {}), (False, {})),
    "shadows": (("low", {}), ("words", {})),
    "rereads": (("low", {}), ("low", {"access": "r"})),
    "follows": (("low", {}), ([{"when": SEL, "is": "low"}], {}), ("words", {})),
    "difference": ((True, {"unit": "temperature"}), (True, {})),
    "inferred": (([{"what": "something", "why": "because"}], {}),),
    "models": ((["B"], {}),),
    "except": ((["A"], {}),),
    "variants": (),
}
"""What is tried of each key of a register. `variants` is a place of its own."""


class Verdict(NamedTuple):
    """What became of one combination: how it was honoured, or which rules refused it, or `ignored`."""

    seed: Seed
    key: str
    value: Any
    beside: Json
    fate: str
    rules: tuple[str, ...] = ()

    def line(self) -> str:
        """The combination on one line."""
        beside = f" beside {self.beside}" if self.beside else ""
        return f"{'/'.join(self.seed)}: {self.key}: {self.value!r}{beside}"


def register_keys() -> list[str]:
    """The keys of a register, as the schema has them."""
    return list(SCHEMA["$defs"]["register"]["properties"])


def compiled(document: Json) -> tuple[RegisterMap | None, tuple[str, ...]]:
    """A map, or the rules that refuse it."""
    register_map, found = diagnose(maps.text(document))
    rules = tuple(sorted({one.rule for one in errors_of(found)}))
    return (None if rules else register_map), rules


class Seen(NamedTuple):
    """A compiled map and what was seen of it so far."""

    map: RegisterMap
    driver: tuple[object, ...]
    simulator: tuple[object, ...]


def seen(register_map: RegisterMap, path: str) -> Seen:
    """Watch driver and simulator of a map."""
    driver = tuple(watch.by_driver(watch.driver_of(register_map), path))
    return Seen(register_map, driver, tuple(watch.by_simulator(register_map, path)))


@cache
def _plain(seed: Seed, beside: str) -> Seen | tuple[str, ...]:
    register_map, rules = compiled(maps.whole(seed, json.loads(beside), {}))
    return rules if register_map is None else seen(register_map, seed.path)


def judge(seed: Seed, key: str, value: Any, beside: Json) -> Verdict | None:
    """What becomes of a key beside others in a map; None where the map says so without it, or is wrong without it."""
    if restates(seed, key, value, beside) or not _is_sound(seed):
        return None
    plain = _plain(seed, json.dumps(beside))
    document = maps.whole(seed, beside, {key: value})
    register_map, rules = compiled(document)
    told = (seed, key, value, beside)
    if register_map is None:
        return Verdict(*told, "refused", rules)
    if not isinstance(plain, Seen):
        return Verdict(*told, "needed")
    return Verdict(*told, _fate(seed, key, plain, seen(register_map, seed.path)))


def _fate(seed: Seed, key: str, plain: Seen, now: Seen) -> str:
    if now.driver != plain.driver:
        return "driver"
    if now.simulator != plain.simulator:
        return "simulator"
    in_docs = key in DOCS_ONLY or (key in DOCS_WHERE and DOCS_WHERE[key](seed))
    return "docs" if in_docs and watch.by_docs(now.map) != watch.by_docs(plain.map) else "ignored"


@cache
def _is_sound(seed: Seed) -> bool:
    return compiled(maps.whole(seed, {}, {}))[0] is not None


RIVALS = ({"views", "type"}, {"scale", "decimals", "multiply", "divide", "exponent", "add"})
"""Keys that say the same in other words: one of the register takes the place of the other among defaults."""


def restates(seed: Seed, key: str, value: Any, beside: Json) -> bool:
    """Whether the map says the same without the key: it is the default, or the register itself has something else."""
    own = maps.register_of(seed, beside)
    in_place = set(own).union(*(rivals for rivals in RIVALS if rivals & own.keys()))
    if seed.place == "each" and key in in_place:
        return True
    if seed.place in {"each", "variant"} and key not in SCHEMA["$defs"]["variant"]["properties"].keys() - {"models"}:
        return True
    same = {"space": seed.space, "type": seed.type, "access": seed.access, "kind": seed.kind} | own
    return key in same and same[key] == value


def combinations(*, every: int) -> Iterator[tuple[Seed, str, Any, Json]]:
    """All keys and values on all seeds; of `every` so many the first."""
    trials = ((key, value, beside) for key in register_keys() for value, beside in TRIALS[key])
    everything = ((seed, *trial) for trial in trials for seed in maps.seeds())
    return islice(everything, 0, None, every)


def judged(*, every: int) -> list[Verdict]:
    """What becomes of each combination whose map is sound without the key and does not say the same."""
    return [verdict for _, verdict in _share(every, 0, 1)]


def judged_by_all_cores(*, every: int) -> list[Verdict]:
    """The same, sooner."""
    cores = os.cpu_count() or 1
    with ProcessPoolExecutor(cores) as pool:
        shares = pool.map(_share, *zip(*((every, each, cores) for each in range(cores)), strict=True))
        return [verdict for _, verdict in sorted(chain.from_iterable(shares), key=itemgetter(0))]


def _share(every: int, share: int, shares: int) -> list[tuple[int, Verdict]]:
    """Verdicts and their places in the order of all: a share of the seeds, so that each is watched once."""
    owner = {seed: number % shares for number, seed in enumerate(maps.seeds())}
    found = ((place, judge(*one)) for place, one in enumerate(combinations(every=every)) if owner[one[0]] == share)
    return [(place, verdict) for place, verdict in found if verdict is not None]


def table(verdicts: list[Verdict]) -> str:
    """Combinations by key: how many were tried, and what became of them."""
    fates = ("driver", "simulator", "docs", "needed", "refused", "ignored")
    lines = [f"{'key':16}{'tried':>8}" + "".join(f"{fate:>11}" for fate in fates) + "  refused by"]
    for key in [*dict.fromkeys(one.key for one in verdicts), ""]:
        of_key = [one for one in verdicts if key in {one.key, ""}]
        counts = Counter(one.fate for one in of_key)
        rules = ", ".join(sorted({rule for one in of_key for rule in one.rules})) if key else ""
        cells = "".join(f"{counts[fate]:>11}" for fate in fates)
        lines.append(f"{key or 'all':16}{len(of_key):>8}{cells}  {rules}")
    return "\n".join(lines)
