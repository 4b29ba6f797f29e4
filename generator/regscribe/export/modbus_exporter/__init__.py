"""The exporter of a module of modbus_exporter, by which Prometheus scrapes a device on TCP.

Facts from its source (0.4.1 and later): the first digit of an address is the function; a word has `little` for turned
bytes, two and four words have `mixed`; of coils it takes two bytes where one is answered, and breaks; one request that
fails, as for a register that a device lacks, fails the whole scrape.
"""

from collections.abc import Mapping, Sequence

from regscribe.dialects.modbus_exporter import ENDIANNESS, TYPES
from regscribe.export.device import RESOLVED, Carries, Carry, Point, Request, Target, Wire, exported
from regscribe.export.device.options import DEVICE_OPTIONS
from regscribe.export.modbus_exporter.module import module
from regscribe.losses import Exported
from regscribe.model import RegisterMap, Space

name = "modbus-exporter"
summary = "a module of the Prometheus exporter modbus_exporter"
options = tuple(option for option in DEVICE_OPTIONS if option.name != "every")

carries: Carries = RESOLVED | {
    "boolean": Carry.PARTLY,
    **dict.fromkeys(("flags", "name", "description", "pause"), Carry.WHOLE),
    **dict.fromkeys(("scale", "offset", "unit", "enum", "functions", "limits"), Carry.PARTLY),
}

WORD_SPACES = frozenset({Space.HOLDING, Space.INPUT})


def _fits(wire: Wire) -> bool:
    known = wire.space in WORD_SPACES and wire.type in TYPES and not wire.apart
    return known and (wire.words, wire.bytes) in ENDIANNESS


def _refuses(point: Point, request: Request) -> str:
    register = point.register
    if register.path in request.named:
        return ""
    if not register.when.always:
        return "it exists under a condition, and a device without it fails the whole scrape: name it by --register"
    if register.mandatory is False:
        return "some devices lack it, and their whole scrape fails: name it by --register"
    return ""


TARGET = Target(name=name, carries=carries, fits=_fits, refuses=_refuses, truth_as_number=True)


def export(maps: Sequence[RegisterMap], options: Mapping[str, str]) -> Exported:
    """Return the module. Raises OptionError."""
    return exported(TARGET, maps, options, module)
