"""The vectors of a map as read from its JSON file, and a trial: a register of a driver in one of their situations."""

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path
from typing import Any, NamedTuple

Json = Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class Vectors:
    """A vector file: sets of cases for registers of models, the manual's worked examples, limits and commands."""

    map_id: str
    models: tuple[str, ...]
    sets: tuple[Json, ...] = field(repr=False)
    examples: tuple[Json, ...] = field(default=(), repr=False)
    protocol: Json = field(default_factory=dict, repr=False)
    commands: tuple[Json, ...] = field(default=(), repr=False)
    computed: tuple[Json, ...] = field(default=(), repr=False)

    def registers(self, model: str) -> Iterator[tuple[Json, Json]]:
        """Yield the place (path, addresses) and the vector set of each register of a model."""
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
        computed=tuple(data.get("computed", ())),
    )


def number(text: str) -> int | float | Fraction:
    """Return the number in a vector as an int or a float; a Fraction where no float has the same digits."""
    exactly = Fraction(text)
    if exactly.denominator == 1:
        return exactly.numerator
    try:
        nearest = exactly.numerator / exactly.denominator
    except OverflowError:  # beyond every float
        return exactly
    return nearest if Fraction(repr(nearest)) == exactly else exactly


class Trial(NamedTuple):
    """A register of a driver in one view and situation: `case` has its vectors, `entry` is their vector set."""

    register: Any  # a Register; named so, pyright would let the field take what its __set__ takes, which is nothing
    entry: Json
    case: Json
    state: Mapping[str, Any]
    givens: Mapping[str, Any]

    @property
    def view(self) -> str:
        """The name of the view."""
        return str(self.case["view"])

    def decode(self, words: Sequence[int]) -> Any:  # noqa: ANN401 (whatever the register holds)
        """Decode with the driver under the state of this trial."""
        return self.register.decode(words, view=self.view, state=self.state, givens=self.givens)

    def encode(self, value: object, *, rounded: bool = False) -> tuple[int, ...]:
        """Encode with the driver under the state of this trial."""
        words: tuple[int, ...] = self.register.encode(
            value, view=self.view, state=self.state, givens=self.givens, rounded=rounded
        )
        return words

    def __repr__(self) -> str:
        given = {name: codes for name, codes in self.givens.items() if name in self.case.get("givens", {})}
        return f"{self.register.path} ({self.view}) with {dict(self.state) | given}"


def known(case: Json) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return the state and the givens of a case as a driver takes them."""
    givens = case.get("givens", {})
    stated = {**case.get("assumed", {}), **case.get("state", {})}
    return (
        {path: _number_or_text(text) for path, text in stated.items()},
        {name: _given(value) for name, value in givens.items()},
    )


def _number_or_text(text: str) -> int | float | Fraction | str:
    """The number that a text spells; of a version or a choice the text itself."""
    try:
        return number(text)
    except ValueError:
        return text


def _given(value: bool | str | list[str]) -> Any:  # noqa: ANN401, FBT001 (as JSON has it)
    if isinstance(value, list):
        return {number(text) for text in value}
    return value if isinstance(value, bool) else _number_or_text(value)
