"""Device classes that a unit alone decides; where it leaves a doubt, a sensor has none.

With a class Home Assistant converts units by the user's wish, and temperatures by the user's country: 5 °C that are a
difference would become 41 °F. A map tells differences only where its units change, so only there °C is a temperature.
"""

from collections.abc import Mapping

from regscribe.export.device import Point
from regscribe.export.home_assistant.entities import Entity

CLASSES: Mapping[str, tuple[str, ...]] = {
    "temperature": ("°C", "°F"),
    "voltage": ("mV", "V"),
    "current": ("mA", "A"),
    "power": ("W", "kW"),
    "apparent_power": ("VA",),
    "reactive_power": ("var",),
    "energy": ("Wh", "kWh", "MWh"),
    "frequency": ("Hz", "kHz", "MHz"),
    "pressure": ("Pa", "hPa", "kPa", "mbar", "bar", "psi", "mmHg", "inHg"),
    "illuminance": ("lx",),
    "irradiance": ("W/m²",),
}
"""By device class the units that belong to it alone, as Home Assistant spells them since 2023."""

CLASS_OF = {unit: name for name, units in CLASSES.items() for unit in units}
TEMPERATURE = "temperature"

MEASURED = frozenset(CLASSES) - {"energy"}
"""Classes of momentary values; whether energy counts up for ever no unit says."""


def classes(point: Point) -> Entity:
    """The class of a sensor, and of what is only read that it is measured."""
    name, register = CLASS_OF.get(point.unit, ""), point.register
    sure = name != TEMPERATURE or (len(register.unit) > 1 and not register.difference)
    found: Entity = {"device_class": name} if name and sure else {}
    measured = name in MEASURED and not register.access.writable
    return found | ({"state_class": "measurement"} if measured else {})
