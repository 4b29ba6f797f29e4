"""The vectors of a map as read from its JSON file."""

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path
from typing import Any

Json = Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class Vectors:
    """A vector file: sets of cases for registers of models, and the manual's worked examples."""

    map_id: str
    models: tuple[str, ...]
    sets: tuple[Json, ...] = field(repr=False)
    examples: tuple[Json, ...] = field(default=(), repr=False)
    protocol: Json = field(default_factory=dict, repr=False)
    commands: tuple[Json, ...] = field(default=(), repr=False)

    def registers(self, model: str) -> Iterator[tuple[Json, Json]]:
        """Yield each register of a model as its place (path, addresses) and the set that is true of it."""
        for entry in self.sets:
            yield from ((place, entry) for place in entry["registers"] if model in place["models"])

    def examples_of(self, model: str) -> Iterator[Json]:
        """Yield the worked examples that the manual gives for a model."""
        return (example for example in self.examples if example["model"] == model)


def load(path: Path) -> Vectors:
    """Read a vector file; OSError or ValueError if it cannot be read."""
    data = json.loads(path.read_text(encoding="utf-8"))
    return Vectors(
        map_id=data["map"],
        models=tuple(data["models"]),
        sets=tuple(data["sets"]),
        examples=tuple(data["examples"]),
        protocol=data["protocol"],
        commands=tuple(data["commands"]),
    )


def number(text: str) -> int | float | Fraction:
    """Return the number that a vector spells as a program would write it; a Fraction where no float spells it."""
    exactly = Fraction(text)
    if exactly.denominator == 1:
        return exactly.numerator
    try:
        nearest = exactly.numerator / exactly.denominator
    except OverflowError:  # beyond every float
        return exactly
    return nearest if Fraction(repr(nearest)) == exactly else exactly
