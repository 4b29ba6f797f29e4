"""The file of things: a bridge to the device, a poller for each request of the plan, a data thing for each value."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from regscribe.export.device import Device, Point
from regscribe.export.device.names import Names
from regscribe.export.device.reads import planned_reads
from regscribe.export.device.writes import write_functions
from regscribe.export.openhab.values import SPACES, Datum, data_of, why_read_only, write_type
from regscribe.losses import Grade
from regscribe.visible import json_text
from regscribe_runtime.planning.plan import Block

PAUSE = 60
"""Milliseconds that the binding waits between two requests of TCP unless told otherwise."""

PARITIES = {"N": "none", "E": "even", "O": "odd"}
INDENT = "    "


@dataclass(frozen=True, slots=True, kw_only=True)
class Link:
    """A data thing: the value that it reads, its channel and whether it can be written."""

    point: Point
    datum: Datum
    id: str
    channel: str
    writable: bool


def bridge_id(device: Device) -> str:
    """Return what the bridge is called: no word of the file's own language has small letters only."""
    return device.name.lower().replace(".", "_")


def links_of(device: Device) -> tuple[list[str], list[Link]]:
    """Return the lines of the file of things, and what items link to."""
    place = device.place
    bridge, kind = bridge_id(device), "tcp" if place.host else "serial"
    head = [*(f"// {line}" for line in device.heading), "", _bridge(device, kind, bridge)]
    names = _names()
    lines, links = head, list[Link]()
    written = [point for point in device.points if not point.register.access.readable]
    for block, points in planned_reads(device):
        poller = f"{SPACES[block.space]}_{block.address}"
        found = _links(device, points, f"modbus:data:{bridge}:{poller}", names)
        lines += [INDENT + _poller(device, poller, block), *_data(device, found, 2), INDENT + "}"]
        links += found
    found = _links(device, written, f"modbus:data:{bridge}", names)
    return [*lines, *_data(device, found, 1), "}"], [*links, *found]


def _names() -> Names:
    names = Names()
    for word in ("true", "false"):
        names.give(word)  # words of the files' own language
    return names


def _bridge(device: Device, kind: str, bridge: str) -> str:
    place, protocol = device.place, device.register_map.protocol
    pause = -(-protocol.pause.numerator // protocol.pause.denominator)
    if kind == "tcp":
        settings = {"host": json_text(place.host), "port": place.port, "id": place.unit}
        settings["timeBetweenTransactionsMillis"] = max(PAUSE, pause)
    else:
        data, parity, stop = tuple(place.format)
        settings = {"port": json_text(place.device), "id": place.unit, "baud": place.baud}
        settings |= {"dataBits": json_text(data), "parity": json_text(PARITIES[parity]), "stopBits": f'"{stop}.0"'}
        settings |= {"encoding": '"rtu"', "receiveTimeoutMillis": round(1000 * protocol.timeout)}
        settings |= {"timeBetweenTransactionsMillis": pause} if pause else {}
    return f"Bridge modbus:{kind}:{bridge} {json_text(device.name)} [ {_settings(settings)} ] {{"


def _settings(settings: dict[str, object]) -> str:
    return ", ".join(f"{key}={value}" for key, value in settings.items())


def _poller(device: Device, poller: str, block: Block) -> str:
    settings: dict[str, object] = {"start": block.address, "length": block.quantity}
    settings |= {"refresh": 1000 * device.request.every, "type": f'"{SPACES[block.space]}"'}
    return f"Bridge poller {poller} [ {_settings(settings)} ] {{"


def _links(device: Device, points: Sequence[Point], below: str, names: Names) -> list[Link]:
    found = []
    for point in points:
        why = why_read_only(device.register_map.protocol, point)
        writable = point.write is not None and not why
        if point.write is not None and why:
            device.lose(point.register, "write", Grade.LOST, f"read only: {why}")
        for datum in data_of(point):
            called = names.give("_".join(filter(None, (point.id, datum.suffix))))
            channel = f"{below}:{called}:{datum.channel}"
            found.append(Link(point=point, datum=datum, id=called, channel=channel, writable=writable))
    return found


def _data(device: Device, links: Sequence[Link], depth: int) -> Iterator[str]:
    for link in links:
        settings: dict[str, object] = {}
        if link.point.register.access.readable:
            settings |= {"readStart": f'"{link.datum.start}"', "readValueType": f'"{link.datum.type}"'}
        if link.writable and link.point.write is not None:
            settings |= _write(device, link.point, link.point.write)
        label = link.datum.label or link.point.register.name
        yield f"{depth * INDENT}Thing data {link.id} {json_text(label)} [ {_settings(settings)} ]"


def _write(device: Device, point: Point, address: int) -> dict[str, object]:
    single = point.wire.space.write_functions[0]
    settings: dict[str, object] = {"writeStart": f'"{address}"', "writeType": f'"{SPACES[point.wire.space]}"'}
    if point.wire.space.is_words:
        settings["writeValueType"] = f'"{write_type(point)}"'
    if point.words == 1 and single not in write_functions(point, device.register_map.protocol):
        settings["writeMultipleEvenWithSingleRegisterOrCoil"] = "true"
    return settings
