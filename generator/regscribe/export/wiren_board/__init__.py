"""The exporter of a device template for Wiren Board's wb-mqtt-serial (docs/export.md).

Facts from the service's own code, of 2.260: a value is scale x raw + offset in floats of 64 bits, an error value is the
pattern of the bits, a part of a word is `register:shift:width`, a text ends at NUL or FF.
"""

from collections.abc import Mapping, Sequence
from math import ceil

from regscribe.dialects.wiren_board import SPACES, TYPES
from regscribe.emit.words import one_line
from regscribe.export.device import RESOLVED, Carries, Carry, Device, Point, Request, Target, Wire, exported
from regscribe.export.device.names import Names
from regscribe.export.device.options import CHOICE, MODEL, STATE
from regscribe.export.wiren_board.channels import channels
from regscribe.export.wiren_board.values import Channel
from regscribe.losses import Exported, Grade
from regscribe.model import Order, RegisterMap, Space, WireType
from regscribe.model.identifiers import snake
from regscribe.visible import json_text

name = "wiren-board"
summary = "a device template of Wiren Board's wb-mqtt-serial"
options = (MODEL, *CHOICE, *STATE)

carries: Carries = RESOLVED | {
    **dict.fromkeys(("scale", "offset", "unit", "enum", "flags", "boolean", "string", "group"), Carry.WHOLE),
    **dict.fromkeys(("functions", "limits", "pause"), Carry.WHOLE),
    **dict.fromkeys(("sentinel", "fields", "version", "write", "range", "poll", "name"), Carry.PARTLY),
}

ENCODINGS = frozenset({"ascii", "utf-8"})
FORBIDDEN = str.maketrans({"/": "\u2044", "$": " ", "#": " ", "+": " ", '"': "\u201d", "'": "\u2019"})
"""Characters that no name may have, as it becomes a part of a topic, and what stands there instead."""


def _fits(wire: Wire) -> bool:
    if wire.apart or wire.space not in SPACES:
        return False
    ordered = isinstance(wire.words, Order) and isinstance(wire.bytes, Order)
    return wire.space.is_bits or (wire.type in TYPES and ordered)


def _refuses(point: Point, request: Request) -> str:
    if point.wire.type is not WireType.STRING or point.wire.space.is_bits:
        return ""
    if point.register.text.codec not in ENCODINGS:
        return f"its text is {point.register.text.encoding}, and the service takes the bytes for UTF-8"
    most = request.register_map.protocol.most_read(point.wire.space)
    return f"it has {point.words} registers, and the device sends {most} at once" if point.words > most else ""


TARGET = Target(name=name, carries=carries, fits=_fits, refuses=_refuses, placed=False)


def export(maps: Sequence[RegisterMap], options: Mapping[str, str]) -> Exported:
    """Return the template. Raises OptionError."""
    return exported(TARGET, maps, options, _text)


def _text(device: Device) -> str:
    model, protocol = device.model, device.register_map.protocol
    title = f"{one_line(device.register_map.title)} {one_line(model.name)}"
    used = {point.register.group for point in device.points}
    settings = {
        "max_read_registers": min(protocol.most_read(space) for space in (Space.HOLDING, Space.INPUT)),
        "response_timeout_ms": ceil(1000 * protocol.timeout),
        **({"guard_interval_us": ceil(1000 * protocol.pause)} if protocol.pause else {}),
    }
    template = {
        "title": title,
        "device_type": model.class_name,
        "device": {
            "name": title.translate(FORBIDDEN),
            "id": snake(model.class_name),
            **settings,
            "groups": [{"title": one_line(one.name), "id": one.id} for one in model.groups if one.id in used],
            "channels": _channels(device),
        },
    }
    return "".join(f"// {line}\n" for line in device.heading) + json_text(template, indent=2) + "\n"


def _channels(device: Device) -> list[Channel]:
    """The channels with names and ids that differ."""
    made: list[Channel] = []
    names, ids = Names(" "), Names("_")
    for point in device.points:
        for part, label, keys in channels(device, point):
            plain = one_line(label)
            called = names.give(plain.translate(FORBIDDEN))
            if called != plain:
                device.lose(point.register, "name", Grade.COSMETIC, f"called {called}")
            group = {"group": point.register.group} if point.register.group else {}
            made.append({"name": called, "id": ids.give(f"{point.id}_{part}" if part else point.id), **group, **keys})
    return made
