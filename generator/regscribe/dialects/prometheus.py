"""Base units of Prometheus: what a metric of a unit is called, and the factor that makes base units of its values."""

from collections.abc import Mapping
from fractions import Fraction
from typing import NamedTuple


class BaseUnit(NamedTuple):
    """The end of a metric's name, and how many of the base unit one of the map's unit is."""

    suffix: str
    factor: Fraction


def _with(suffix: str, **symbols: str) -> dict[str, BaseUnit]:
    return {symbol: BaseUnit(suffix, Fraction(factor)) for symbol, factor in symbols.items()}


BASE_UNITS: Mapping[str, BaseUnit] = {
    **_with("volts", V="1", mV="1/1000", kV="1000"),
    **_with("amperes", A="1", mA="1/1000", kA="1000"),
    **_with("watts", W="1", mW="1/1000", kW="1000", MW="1000000"),
    **_with("voltamperes", VA="1", kVA="1000", MVA="1000000"),
    **_with("vars", var="1", kvar="1000", Mvar="1000000"),
    **_with("joules", J="1", kJ="1000", MJ="1000000", Wh="3600", kWh="3600000", MWh="3600000000"),
    **_with("hertz", Hz="1", kHz="1000", MHz="1000000"),
    **_with("seconds", s="1", ms="1/1000", min="60", h="3600", d="86400"),
    **_with("pascals", Pa="1", hPa="100", kPa="1000", MPa="1000000", mbar="100", bar="100000"),
    **_with("meters", m="1", mm="1/1000", cm="1/100", km="1000"),
    **_with("grams", g="1", kg="1000", t="1000000"),
    **_with("liters", l="1", L="1", ml="1/1000"),
    **_with("bytes", B="1", kB="1000", MB="1000000"),
    "°C": BaseUnit("celsius", Fraction(1)),
    "°F": BaseUnit("fahrenheit", Fraction(1)),
    "K": BaseUnit("kelvins", Fraction(1)),
    "%": BaseUnit("ratio", Fraction(1, 100)),
    "‰": BaseUnit("ratio", Fraction(1, 1000)),
    "Ω": BaseUnit("ohms", Fraction(1)),
    "kΩ": BaseUnit("ohms", Fraction(1000)),
    "m³": BaseUnit("cubic_meters", Fraction(1)),
    "rpm": BaseUnit("rpm", Fraction(1)),
}
"""By the symbol of the map; °F stays what it is, in its name."""
