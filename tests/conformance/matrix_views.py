"""Every key of a view, tried in both views of a set, on every kind, type, space and access: honoured, or refused."""

from collections.abc import Iterator
from functools import cache, partial
from itertools import islice
from typing import Any, NamedTuple

from . import matrix
from . import matrix_maps as maps
from . import matrix_watch as watch
from .matrix_maps import Seed

FRACTIONS = (1.26, 2.5, -2.5, 0.04, 120.05)
"""Values that a device would round."""

TRIALS: dict[str, tuple[Any, ...]] = {
    "offset": (1100,),
    "stride": (2,),
    "type": ("int16", "uint32", "float32", "float64", "int64", "bit", "string"),
    "factor": (10, 0.5, 0.1, {"power": "dig"}),
    "rounding": ("half_up", "half_away", "half_even", "down"),
    "saturates": (True,),
    "word_order": ("little", {"register": "ord", "codes": {0: "big", 1: "little"}}, [2, 1]),
    "byte_order": ("little", [{"when": {"sel": 1}, "is": "little"}, {"is": "big"}]),
    "byte": ("high",),
    "functions": ([3], [3, 16], [3, 6], [6], [16], [1], [4]),
    "align": (2, 4),
    "region": ("1000..1199", "1010..1015"),
    "preferred": (True,),
}
"""What is tried of each key of a view."""

DOCS = frozenset({"region", "rounding", "functions", "type", "saturates"})
"""Keys that only tell readers something where no number, or no other function, could show it."""


class Verdict(NamedTuple):
    """What became of a key in a view: `refused`, `driver`, `simulator`, `docs` or `ignored`."""

    seed: Seed
    view: str
    key: str
    value: Any
    fate: str

    def line(self) -> str:
        """The combination on one line."""
        return f"{'/'.join(self.seed)}, {self.view}: {self.key}: {self.value!r}"


def judged(*, every: int) -> Iterator[Verdict]:
    """What becomes of one of `every` so many combinations whose map is sound without the key."""
    seeds = [one for one in maps.seeds() if one.place in {"views", "second"} and one.access == "rw"]
    everything = (
        (seed, view, key, value)
        for key, values in TRIALS.items()
        for value in values
        for view in ("base", "other")
        for seed in seeds
    )
    found = (_judge(*one) for one in islice(everything, 0, None, every))
    return (one for one in found if one is not None)


def _judge(seed: Seed, view: str, key: str, value: Any) -> Verdict | None:
    plain = maps.whole(seed, {}, {})
    told = plain["views"]["two"][view]
    is_preferred = key == "preferred" and (seed.place, view) == ("views", "base")  # the first is, where none is
    if is_preferred or told.get(key) == value or matrix.compiled(plain)[0] is None:
        return None
    told[key] = value
    register_map, _ = matrix.compiled(plain)
    if register_map is None:
        return Verdict(seed, view, key, value, "refused")
    before, now = _seen(seed), _watched(register_map, seed)
    fates = ("driver", "simulator", "docs") if key in DOCS else ("driver", "simulator")
    fate = next((fate for fate, was, found in zip(fates, before, now, strict=False) if was() != found()), "ignored")
    return Verdict(seed, view, key, value, fate)


@cache
def _seen(seed: Seed) -> tuple[Any, ...]:
    register_map, _ = matrix.compiled(maps.whole(seed, {}, {}))
    return tuple(cache(one) for one in _watched(register_map, seed))


def _watched(register_map: Any, seed: Seed) -> tuple[Any, ...]:
    module = watch.driver_of(register_map)
    return (
        lambda: (tuple(watch.by_driver(module, seed.path)), tuple(_rounded(module, seed.path))),
        lambda: tuple(watch.by_simulator(register_map, seed.path)),
        lambda: watch.by_docs(register_map),
    )


def _rounded(module: Any, path: str) -> Iterator[tuple[object, ...]]:
    """What a driver sends of values that are finer than a view."""
    subject = watch.Subject(module, path)
    for view in subject.declared.views:
        for value in FRACTIONS:
            subject.hold(view, (0,) * view.words, watch.STATES[0])
            yield subject.tried(partial(subject.bound.write, value, view=view.name, rounded=True, verify=False))
