"""The facts of the JSON export for the page: every number exact, and nothing that says nothing."""

from decimal import Decimal
from typing import Any

Json = Any

SAFE = 1 << 53
"""Whole numbers below it are the same in JavaScript."""

USUAL: dict[str, Json] = {
    "scale": [{}],
    "special_scale": [{}],
    "unit": [{}],
    "multiply": 1,
    "add": 0,
    "factor": 1,
    "stride": 1,
    "words": 1,
    "align": 1,
    "rounding": "none",
    "space": "holding",
    "word_order": "big",
    "byte_order": "big",
    "text": {"encoding": "ascii", "padding": 32, "ends": [0]},
    "reading": {"poll": 0, "good_for": 0},
    "settle": 0,
    "page": 0,
    "version_digits": 0,
    "version_group": 0,
    "base": 10,
}
"""What a fact of this name is where it is left out; the others are empty or false."""

NOTHING: tuple[Json, ...] = (None, "", [], {})


def exact(value: Json) -> Json:
    """Return plain JSON with numbers that JavaScript would change as `{"n": .., "d": ..}`, less what says nothing."""
    if isinstance(value, dict):
        if "numerator" in value:
            return _ratio(value["numerator"], value["denominator"])
        found = {name: exact(each) for name, each in value.items()}
        return {name: each for name, each in found.items() if not _is_usual(name, each)}
    if isinstance(value, list):
        return [exact(each) for each in value]
    if isinstance(value, float):
        return _ratio(*Decimal(repr(value)).as_integer_ratio())
    if isinstance(value, int) and abs(value) >= SAFE:
        return _ratio(value, 1)
    return value


def _ratio(numerator: int, denominator: int) -> Json:
    return {"n": str(numerator), "d": str(denominator)}


def _is_usual(name: str, value: Json) -> bool:
    if name in USUAL:
        return bool(value == USUAL[name]) and isinstance(value, bool) is isinstance(USUAL[name], bool)
    return value is False or any(value == one and type(value) is type(one) for one in NOTHING)
