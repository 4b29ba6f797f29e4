"""The unit symbols that a map may use without declaring them, by quantity, and what else people write for them.

They are written and shown as they stand; only °C, °F and K are ever converted, by a simulated device. So a table is
enough: importing a library of units costs more than compiling a map. The tests hold the table to one.
"""

import re

UNITS: dict[str, tuple[str, ...]] = {
    "ratio": ("%", "‰", "ppm", "ppb"),
    "temperature": ("°C", "°F", "K"),
    "time": ("ms", "s", "min", "h", "d", "0.1 s", "0.01 s"),
    "voltage": ("µV", "mV", "V", "kV"),
    "current": ("µA", "mA", "A", "kA"),
    "power": ("mW", "W", "kW", "MW", "GW", "VA", "kVA", "MVA", "var", "kvar", "Mvar"),
    "energy": ("J", "kJ", "MJ", "GJ", "Wh", "kWh", "MWh", "GWh", "VAh", "kVAh", "MVAh", "varh", "kvarh", "Mvarh"),
    "charge": ("mAh", "Ah", "kAh"),
    "resistance": ("mΩ", "Ω", "kΩ", "MΩ"),
    "capacitance": ("pF", "nF", "µF", "mF", "F"),
    "inductance": ("µH", "mH", "H"),
    "conductivity": ("µS/cm", "mS/cm", "S/m"),
    "frequency": ("Hz", "kHz", "MHz", "rpm"),
    "length": ("µm", "mm", "cm", "m", "km", "in", "ft"),
    "area": ("m²",),
    "volume": ("ml", "l", "m³", "gal", "ft³"),
    "angle": ("°", "rad"),
    "speed": ("mm/s", "m/s", "m/min", "km/h", "ft/min"),
    "acceleration": ("m/s²",),
    "volume flow": ("ml/min", "l/s", "l/min", "l/h", "m³/s", "m³/min", "m³/h", "gal/min", "ft³/min"),
    "mass": ("mg", "g", "kg", "t", "lb"),
    "mass flow": ("g/s", "kg/s", "kg/min", "kg/h", "t/h"),
    "concentration": ("mg/l", "µg/m³", "mg/m³", "g/m³", "g/l"),
    "density": ("kg/m³",),
    "force": ("N", "kN"),
    "torque": ("Nm",),
    "pressure": ("Pa", "hPa", "kPa", "MPa", "mbar", "bar", "psi", "mmHg", "inHg"),
    "light": ("lx", "klx", "lm", "cd"),
    "radiant flux density": ("W/m²", "kW/m²"),
    "heat per temperature": ("W/K",),
    "temperature rate": ("K/min", "K/h", "°C/s", "°C/min", "°C/h", "°F/min", "°F/h"),
    "acidity": ("pH",),
    "level": ("dB", "dBm", "dBA"),
    "data": ("B", "kB", "MB", "baud", "bit/s", "kbit/s", "Mbit/s", "words"),
}
"""Symbols by quantity, in the order in which the reference of the language lists them."""

KNOWN_UNITS = tuple(symbol for symbols in UNITS.values() for symbol in symbols)

_SPELLINGS = {
    "°C": "c degc celsius ℃ ºc ˚c grdc gradc gradcelsius oc degreec degreesc degreescelsius degcelsius",
    "°F": "f degf fahrenheit ℉ ºf ˚f",
    "K": "kelvin degk °k",
    "%": "percent pct prozent procent pourcent %rh %r.h. rh %rf %rel",
    "ppm": "partspermillion",
    "s": "sec secs second seconds sekunde sekunden sek seconde secondes secondi sekunder",
    "ms": "msec millisecond milliseconds",
    "min": "mins minute minutes minuten minuti minuter",
    "h": "hr hrs hour hours std stunde stunden heure heures uur timmar",
    "d": "day days tag tage jour jours giorni dagen dagar",
    "V": "volt volts vdc vac vrms",
    "A": "amp amps ampere amperes aac adc arms",
    "W": "watt watts",
    "var": "vars volt-ampere-reactive",
    "Ω": "ohm ohms ω",
    "kΩ": "kohm",
    "Hz": "hertz cps",
    "rpm": "1/min u/min tr/min r/min min-1 rev/min",
    "°": "deg degree degrees grad º",
    "m²": "m2 sqm m^2",
    "m³": "m3 cbm m^3",
    "l": "litre liter litres liters",
    "l/s": "lps",
    "l/min": "lpm",
    "l/h": "lph",
    "m³/h": "m3/h cmh m^3/h m³/hr",
    "m³/s": "m3/s",
    "m³/min": "m3/min",
    "ft³": "ft3 cf",
    "ft³/min": "cfm ft3/min scfm",
    "gal/min": "gpm",
    "W/m²": "w/m2 w/m^2",
    "kW/m²": "kw/m2",
    "µg/m³": "ug/m3 µg/m3 ug/m³",
    "mg/m³": "mg/m3",
    "g/m³": "g/m3",
    "kg/m³": "kg/m3",
    "m/s²": "m/s2",
    "lx": "lux",
    "lm": "lumen",
    "dB": "decibel db(a)",
    "bit/s": "bps",
    "kbit/s": "kbps",
    "Mbit/s": "mbps",
    "B": "byte bytes octets",
    "mmHg": "torr",
    "µS/cm": "us/cm",
    "µA": "ua",
    "µV": "uv",
    "µF": "uf",
    "µm": "um micron",
}
_MEANT = {word: symbol for symbol, words in _SPELLINGS.items() for word in words.split()}
_FOLDED = {symbol.lower(): symbol for symbol in reversed(KNOWN_UNITS)}
"""Symbols in lower case; of `mW` and `MW` the first, which the table has first."""


def meant_unit(text: str) -> str:
    """The known symbol that others write as `text`; empty if none is known."""
    word = re.sub(r"[\s_]|\A\[|\]\Z", "", text[:40]).lower().replace("\u03bc", "µ")
    return _MEANT.get(word) or _FOLDED.get(word) or _FOLDED.get(word.replace("·", ""), "")
