"""The file: a controller, its bus unless the user has one, and the entities of each platform."""

import re
from collections.abc import Iterator, Sequence
from math import ceil

from regscribe.emit.words import one_line
from regscribe.export.device import LEFT_OUT, Device
from regscribe.export.device.names import Names, distinct
from regscribe.export.esphome.entities import items
from regscribe.export.esphome.items import Item, Keys, doubled, forced
from regscribe.files import Tagged, dump
from regscribe.losses import Grade
from regscribe.model import show
from regscribe.model.identifiers import label_id
from regscribe.plugins import Option

BUS = Option("bus", "id of your own `modbus:`; else the file brings one, with its `uart:`.", metavar="ID")

LONGEST_NAME = 110
"""Bytes; the program takes 120, and a number may come behind."""

SLASH = "\u2044"
"""What the program has in place of `/`, which no name may have."""

PARITIES = {"N": "NONE", "E": "EVEN", "O": "ODD"}
LITERAL = re.compile(r"\$|<%")
"""What the program would replace or calculate in a text."""


def configuration(device: Device, bus: str) -> str:
    """Return the file, for the id of a bus or none."""
    controller = label_id(device.name)
    every = _kept(device, [item for point in device.points for item in items(device, point)])
    alone = forced(every, device.register_map.protocol)
    lists: dict[str, list[Keys]] = {}
    names = Names("_")
    for item, called in zip(every, _called(device, every), strict=True):
        new = {"force_new_range": True} if (item.space, item.address) in alone else {}
        head = {
            "platform": "modbus_controller",
            "modbus_controller_id": controller,
            "id": names.give(f"{controller}_{item.id}"),
        }
        lists.setdefault(item.platform, []).append({**head, "name": literal(called), **_literal(item.keys), **new})
    return dump({**_line(device, controller, bus), **lists}, remarks=device.heading)


def _kept(device: Device, every: Sequence[Item]) -> list[Item]:
    for item in (short := doubled(every)):
        done = "left out: another register of another length begins at its address, and only one of them is read whole"
        device.lose(item.path, LEFT_OUT, Grade.LOST, done)
    return [item for item in every if item not in short]


def _called(device: Device, every: Sequence[Item]) -> Iterator[str]:
    """What the entities are called: the device and the manual's name, as the program takes names."""
    names = Names(" ", _key)
    wanted = [(f"{device.name} {one_line(item.label)}", item.path) for item in every]
    for item, (plain, _), found in zip(every, wanted, distinct(wanted, _key), strict=True):
        name = found.replace("/", SLASH)
        if len(name.encode()) > LONGEST_NAME:
            name = name.encode()[:LONGEST_NAME].decode(errors="ignore")
        name = names.give(name)
        if name != plain:
            device.lose(item.point.register, "name", Grade.COSMETIC, f"called {name}")
        yield name


def _key(name: str) -> str:
    """What names are told apart by."""
    return re.sub(r"[^a-z0-9_-]", "_", name.lower())


def literal(text: str) -> str:
    """The text, marked as one in which nothing is replaced where that is needed."""
    return Tagged(text, "!literal") if LITERAL.search(text) else text


def _literal(keys: Keys) -> Keys:
    """The keys with texts of the map marked as such."""
    found = dict(keys)
    if unit := found.get("unit_of_measurement"):
        found["unit_of_measurement"] = literal(str(unit))
    options = found.get("optionsmap")
    if isinstance(options, dict):
        found["optionsmap"] = {literal(label): code for label, code in options.items()}
    return found


def _line(device: Device, controller: str, bus: str) -> Keys:
    protocol = device.register_map.protocol
    throttle = {"command_throttle": f"{ceil(protocol.pause)}ms"} if protocol.pause else {}
    if throttle:
        done = f"{show(protocol.pause)} ms are counted from the request, not from the answer"
        device.lose("", "pause", Grade.LOST, done)
    own = bus or f"{controller}_modbus"
    polled: Keys = {
        "id": controller,
        "modbus_id": own,
        "address": device.request.unit,
        "update_interval": f"{device.request.every}s",
        **throttle,
    }
    return {**({} if bus else _bus(device, controller, own)), "modbus_controller": [polled]}


def _bus(device: Device, controller: str, own: str) -> Keys:
    protocol = device.register_map.protocol
    data, parity, stop = tuple(protocol.serial.format)
    uart: Keys = {
        "id": f"{controller}_uart",
        "baud_rate": protocol.serial.baud,
        "data_bits": int(data),
        "parity": PARITIES[parity],
        "stop_bits": int(stop),
    }
    wait = f"{ceil(1000 * protocol.timeout)}ms"
    return {"uart": [uart], "modbus": [{"id": own, "uart_id": uart["id"], "send_wait_time": wait}]}
