"""The units that need no declaration: each is of its quantity, as a library knows it; words of others lead to them."""

from collections.abc import Callable
from typing import Any

import pytest

from regscribe.model import Diagnostic
from regscribe.model.units import KNOWN_UNITS, UNITS, meant_unit

Diagnose = Callable[[str], list[Diagnostic]]
Small = Callable[..., str]

LIKE = {
    "ratio": "percent",
    "temperature": "kelvin",
    "time": "second",
    "voltage": "volt",
    "current": "ampere",
    "power": "watt",
    "energy": "joule",
    "charge": "ampere * second",
    "resistance": "ohm",
    "capacitance": "farad",
    "inductance": "henry",
    "conductivity": "siemens / meter",
    "frequency": "hertz",
    "length": "meter",
    "area": "meter ** 2",
    "volume": "meter ** 3",
    "angle": "radian",
    "speed": "meter / second",
    "acceleration": "meter / second ** 2",
    "volume flow": "meter ** 3 / second",
    "mass": "kilogram",
    "mass flow": "kilogram / second",
    "concentration": "kilogram / meter ** 3",
    "density": "kilogram / meter ** 3",
    "force": "newton",
    "torque": "newton * meter",
    "pressure": "pascal",
    "light": "",
    "radiant flux density": "watt / meter ** 2",
    "heat per temperature": "watt / kelvin",
    "temperature rate": "kelvin / second",
    "acidity": "",
    "level": "",
    "data": "",
}
"""What each quantity is measured like; those without are of several dimensions, or of none that the library has."""


def test_every_quantity_has_a_measure() -> None:
    assert LIKE.keys() == UNITS.keys()


def test_no_symbol_is_listed_twice() -> None:
    assert len(set(KNOWN_UNITS)) == len(KNOWN_UNITS)


@pytest.fixture(scope="module")
def library() -> Any:
    pint = pytest.importorskip("pint")
    return pint.UnitRegistry()


@pytest.mark.parametrize("quantity", [name for name, like in LIKE.items() if like])
def test_a_unit_is_of_its_quantity(quantity: str, library: Any) -> None:
    expected = library.parse_units(LIKE[quantity]).dimensionality
    for symbol in UNITS[quantity]:
        spelled = (
            symbol.removeprefix("0.1 ")
            .removeprefix("0.01 ")
            .replace("var", "VA")
            .replace("VAh", "VA*h")
            .replace("ppb", "ppm")
        )
        spelled = "newton*meter" if symbol == "Nm" else spelled.replace("°", "delta_deg") if "/" in spelled else spelled
        assert library.parse_units(spelled).dimensionality == expected, symbol


@pytest.mark.parametrize(
    ("text", "symbol"),
    [
        ("C", "°C"),
        ("degC", "°C"),
        ("deg C", "°C"),
        ("[°C]", "°C"),
        ("F", "F"),
        ("Secs", "s"),
        ("KW", "kW"),
        ("kVArh", "kvarh"),
        ("m3/h", "m³/h"),
        ("\u03bcA", "µA"),
        ("\u2126", "Ω"),
        ("deg", "°"),
        ("parsec", ""),
    ],
)
def test_what_others_write_leads_to_a_symbol(text: str, symbol: str) -> None:
    assert (text if text in KNOWN_UNITS else meant_unit(text)) == symbol


@pytest.mark.parametrize(
    ("unit", "advice"),
    [
        ("C", "did you mean `°C`? Else declare it under `units:`, as C: {}"),
        ("kVAr", "did you mean `kvar`? Else declare it under `units:`, as kVAr: {}"),
        ("'#/h'", "declare it under `units:`, as '#/h': {}"),
        ("'%x'", "declare it under `units:`, as '%x': {}"),
        ("'@'", "declare it under `units:`, as '@': {}"),
    ],
)
def test_an_unknown_unit_is_told_where_it_is_declared(diagnose: Diagnose, small: Small, unit: str, advice: str) -> None:
    (found,) = diagnose(small(f"at: 0, name: Setpoint, unit: {unit}"))

    assert (found.rule, found.span.line, found.span.column) == ("RS0311", 12, 39)
    assert found.help.endswith(advice)


@pytest.mark.parametrize("symbol", KNOWN_UNITS)
def test_every_known_unit_needs_no_declaration(diagnose: Diagnose, small: Small, symbol: str) -> None:
    assert diagnose(small(f"at: 0, name: Setpoint, unit: '{symbol}'")) == []
