"""Exact numbers as the keys of a map say them."""

from collections.abc import Mapping
from decimal import Decimal
from fractions import Fraction
from typing import Any

from regscribe.model import show

MOST_DECIMALS = 18
"""Decimal places that the key `decimals` takes."""


def plain(value: Fraction) -> int | Decimal | str:
    """Return a number as YAML says it: whole, with all its digits, or a fraction (`1/3`) where these have no end."""
    if value.denominator == 1:
        return value.numerator
    text = show(value)
    return text if "/" in text else Decimal(text)


def scaling(multiply: Fraction, add: Fraction = Fraction(0)) -> dict[str, Any]:
    """Return the keys of value = multiply x stored + add: `decimals` where it is a power of ten, none for 1."""
    places = next((digits for digits in range(1, MOST_DECIMALS + 1) if multiply * 10**digits == 1), 0)
    if places and not add:
        return {"decimals": places}
    keys = {} if multiply == 1 else {"multiply": plain(multiply)}
    return keys | ({"add": plain(add)} if add else {})


IN_UNIT = frozenset(
    {"multiply", "divide", "exponent", "add", "decimals", "scale", "step", "kind"}
    | {"range", "valid", "special", "default", "delivered"}
)
"""Keys of a register that say its scale, or count in the unit of its value."""


def unscaled(keys: Mapping[str, Any]) -> dict[str, Any]:
    """Return the keys of a register whose scale is unclear: programs get the raw number, and the docs say so."""
    return {key: value for key, value in keys.items() if key not in IN_UNIT} | {"decimals": "not_stated"}
