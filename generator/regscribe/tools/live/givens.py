"""Givens as text (what a device's manual leaves to another manual), for the constructors of generated drivers."""

import inspect
import re
from collections.abc import Iterable, Mapping
from typing import NamedTuple

from regscribe.tools.live.errors import TargetError, unknown
from regscribe_runtime import BareDevice

MOST_CODES = 0x10000
"""A register has no more codes than this, so a longer range is a slip."""


class GivenArgument(NamedTuple):
    """A keyword argument of a driver: a set of codes, or a yes or no."""

    id: str
    codes: bool

    @property
    def example(self) -> str:
        """How its value looks on a command line."""
        return "1,4..6" if self.codes else "true"


def givens_of(driver: type[BareDevice]) -> tuple[GivenArgument, ...]:
    """The givens that a generated driver asks for."""
    parameters = inspect.signature(driver.__init__).parameters.values()
    return tuple(
        GivenArgument(one.name, codes=one.annotation not in (bool, "bool"))
        for one in parameters
        if one.kind is inspect.Parameter.KEYWORD_ONLY and one.name != "unit"
    )


def understood(driver: type[BareDevice], texts: Mapping[str, str]) -> dict[str, bool | frozenset[int]]:
    """The givens as a driver takes them; TargetError for one that is missing, unknown or not understood."""
    known = {given.id: given for given in givens_of(driver)}
    for name in texts:
        if name not in known:
            fault = unknown("given", name, known) if known else f"it has no givens, so no `{name}`"
            message = f"{driver.model}: {fault}"
            raise TargetError(message)
    for name, given in known.items():
        if name not in texts:
            form = f"?given.{name}={given.example} or --given {name}={given.example}"
            message = f"{driver.model}: its manual leaves `{name}` to another manual, so it must be given: {form}"
            raise TargetError(message)
    return {name: _value(known[name], text) for name, text in texts.items()}


def _value(given: GivenArgument, text: str) -> bool | frozenset[int]:
    try:
        if not given.codes:
            return flag_of(given.id, text)
        return codes_in(filter(None, text.split(",")) if text != "none" else ())
    except ValueError as error:
        message = f"given {given.id}={text}: {error}"
        raise TargetError(message) from None


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
