"""Givens as text (what a device's manual leaves to another manual), for the constructors of generated drivers."""

import inspect
import re
from collections.abc import Iterable, Mapping
from fractions import Fraction
from typing import NamedTuple, get_args

from regscribe.tools.live.errors import TargetError, unknown
from regscribe_runtime import AsyncBareDevice, BareDevice, Fact
from regscribe_runtime.values.numbers import parse

Given = bool | str | Fraction | frozenset[int]
"""What is given, as a driver takes it."""

MOST_CODES = 0x10000
"""A register has no more codes than this, so a longer range is a slip."""


class GivenArgument(NamedTuple):
    """A keyword argument of a driver: `annotation` is its type as the driver spells it, `needed`: without default."""

    id: str
    annotation: str
    needed: bool = True

    @property
    def form(self) -> str:
        """The kind of given: codes, boolean, number, choice."""
        kinds = {"Collection": "codes", "bool": "boolean", "Literal": "choice"}
        return kinds.get(self.annotation.partition("[")[0], "number")

    @property
    def choices(self) -> tuple[str, ...]:
        """What may be chosen."""
        return tuple(re.findall(r"'([^']*)'", self.annotation))

    @property
    def example(self) -> str:
        """How its value looks on a command line."""
        return {"codes": "1,4..6", "boolean": "true", "number": "1.5"}.get(self.form) or self.choices[0]


def givens_of(driver: type[BareDevice]) -> tuple[GivenArgument, ...]:
    """The givens that a generated driver asks for."""
    parameters = inspect.signature(driver.__init__).parameters.values()
    return tuple(
        GivenArgument(one.name, _spelled(one.annotation), one.default is inspect.Parameter.empty)
        for one in parameters
        if one.kind is inspect.Parameter.KEYWORD_ONLY and one.name != "unit"
    )


def defaults(driver: type[BareDevice] | type[AsyncBareDevice]) -> dict[str, object]:
    """What counts where nothing is given."""
    parameters = inspect.signature(driver.__init__).parameters.values()
    return {one.name: one.default for one in parameters if one.default is not inspect.Parameter.empty}


def _spelled(annotation: object) -> str:
    plain = isinstance(annotation, type) and not get_args(annotation)
    return (
        str(getattr(annotation, "__name__", ""))
        if plain
        else re.sub(r"^(typing|collections\.abc)\.", "", str(annotation))
    )


def understood(driver: type[BareDevice], texts: Mapping[str, str]) -> dict[str, Given]:
    """The givens as a driver takes them; TargetError for one that is missing, unknown or not understood."""
    known = {given.id: given for given in givens_of(driver)}
    for name in texts:
        if name not in known:
            fault = unknown("given", name, known) if known else f"it has no givens, so no `{name}`"
            message = f"{driver.model}: {fault}"
            raise TargetError(message)
    for name, given in known.items():
        if name not in texts and given.needed:
            form = f"?given.{name}={given.example} or --given {name}={given.example}"
            message = f"{driver.model}: its manual leaves `{name}` to another manual, so it must be given: {form}"
            raise TargetError(message)
    return {name: _value(known[name], text) for name, text in texts.items()}


def _value(given: GivenArgument, text: str) -> Given:
    try:
        return given_of(given.id, given.form, text, given.choices)
    except ValueError as error:
        message = f"given {given.id}={text}: {error}"
        raise TargetError(message) from None


def given_of(name: str, form: str, text: str, choices: Iterable[str] = ()) -> Given:
    """What a text gives: codes, a yes or no, a number, or a choice; ValueError where it gives none."""
    if form == "boolean":
        return flag_of(name, text)
    if form == "number":
        return parse(text)
    if form == "choice":
        return Fact.choice(name, text, *choices)
    return codes_in(() if text == "none" else text.split(","))


def flag_of(name: str, text: str) -> bool:
    """The yes or no of `true` or `false`; ValueError for another text."""
    if text not in {"true", "false"}:
        message = f"`{name}` is true or false"
        raise ValueError(message)
    return text == "true"


def codes_in(parts: Iterable[str]) -> frozenset[int]:
    """The codes of texts like `1` and `4..6`; ValueError for one that is neither a code nor a range."""
    codes: set[int] = set()
    for part in parts:
        found = re.fullmatch(r"\s*(-?[0-9]{1,6})(?:\.\.(-?[0-9]{1,6}))?\s*", part)
        if not found or int(found[2] or found[1]) - int(found[1]) not in range(MOST_CODES):
            message = f"`{part}` is neither a code nor a range of codes; for example 1,4..6"
            raise ValueError(message)
        codes.update(range(int(found[1]), int(found[2] or found[1]) + 1))
    return frozenset(codes)
