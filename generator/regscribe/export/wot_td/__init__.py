"""The exporter of a W3C Web of Things Thing Description with Modbus forms (docs/export.md).

What a value of the thing is stands in the vocabulary of TD 1.1 where that has it. It has no scale, so a value is the
number on the wire; what turns it into the value of use stands in terms of our own, which begin with `x-`.
"""

from collections.abc import Mapping, Sequence
from typing import Any

from regscribe.export.device import RESOLVED, Carries, Carry, Device, Point, Request, Target, Wire, exported
from regscribe.export.device.names import Names
from regscribe.export.device.options import DEVICE_OPTIONS
from regscribe.export.wot_td.forms import (
    BYTE_SEQUENCES,
    CHARSETS,
    ENTITIES,
    TYPES,
    forms_of,
    reads_whole,
    why_read_only,
)
from regscribe.export.wot_td.schema import schema_of
from regscribe.losses import Exported, Grade
from regscribe.model import Kind, Order, RegisterMap, WireType
from regscribe.plugins import OptionError
from regscribe.visible import json_text

name = "wot-td"
summary = "a W3C Thing Description with Modbus forms, for node-wot and others"
options = DEVICE_OPTIONS

CONTEXT = [
    "https://www.w3.org/2022/wot/td/v1.1",
    {"modv": "https://www.w3.org/2019/wot/modbus#", "ex": "http://www.example.org/bits#"},
]
"""`ex` is the prefix under which node-wot looks for the bits of a part."""

carries: Carries = RESOLVED | {
    **dict.fromkeys(("enum", "string", "write-only", "name", "description", "functions"), Carry.WHOLE),
    **dict.fromkeys(("scale", "offset", "unit", "range", "sentinel", "special-value", "boolean"), Carry.PARTLY),
    **dict.fromkeys(("flags", "fields", "version", "special-number", "write", "step"), Carry.PARTLY),
}


def _fits(wire: Wire) -> bool:
    if wire.apart or wire.space not in ENTITIES:
        return False
    if wire.type is WireType.STRING and wire.words is not Order.BIG:
        return False
    return wire.space.is_bits or (wire.type in TYPES and (wire.words, wire.bytes) in BYTE_SEQUENCES)


def _refuses(point: Point, _: Request) -> str:
    form = point.register.text
    if point.register.kind is not Kind.STRING:
        return ""
    if form.encoding not in CHARSETS or form.per_register:
        one = " with one character a register" if form.per_register else ""
        return f"the form does not have texts in {form.encoding}{one}"
    return ""


TARGET = Target(
    name=name,
    carries=carries,
    fits=_fits,
    refuses=_refuses,
    verified="node-wot 0.8.16, but for whole numbers of 64 bits, which it does not read",
)


def export(maps: Sequence[RegisterMap], options: Mapping[str, str]) -> Exported:
    """Return the Thing Description. Raises OptionError."""
    return exported(TARGET, maps, options, _text)


def _text(device: Device) -> str:
    if not device.place.host:
        message = f"--at {device.place.device}: a Thing Description has no serial lines; write HOST:PORT"
        raise OptionError(message)
    names = Names()
    thing = {
        "@context": CONTEXT,
        "@type": "Thing",
        "id": f"urn:regscribe:{device.register_map.id}:{device.name}",
        "title": device.name,
        "description": "; ".join(device.heading),
        "securityDefinitions": {"nosec_sc": {"scheme": "nosec"}},
        "security": ["nosec_sc"],
        "properties": {names.give(point.id): _property(device, point) for point in device.points},
    }
    return json_text(thing, indent=2) + "\n"


def _property(device: Device, point: Point) -> dict[str, Any]:
    register = point.register
    said: dict[str, Any] = {"title": register.name}
    if register.description:
        said["description"] = register.description
    read_only = why_read_only(device, point)
    if read_only and point.write is not None:
        device.lose(register, "write", Grade.LOST, f"read only: {read_only}")
    if read_only:
        said["readOnly"] = True
    elif not register.access.readable:
        said["writeOnly"] = True
    if not reads_whole(point):
        done = "exported all the same: node-wot reads whole numbers of at most 6 bytes, and refuses this one"
        device.lose(register, "type-unread", Grade.LOST, done)
    said |= schema_of(device, point, writable=not read_only)
    return said | {"observable": register.access.readable, "forms": forms_of(device, point, writable=not read_only)}
