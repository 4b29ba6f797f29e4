"""The template: items, value maps and the macros that say where the device answers."""

import hashlib
import re
import uuid
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

from regscribe import files
from regscribe.emit.words import one_line
from regscribe.export.device import Device, Place
from regscribe.export.device.names import Names
from regscribe.export.zabbix.items import LONGEST, Item, items_of
from regscribe.losses import Grade
from regscribe.plugins import OptionError

GROUP = "Templates/Modbus"
LONGEST_LABEL = 64
DAY = 86400
AT, UNIT = "{$MODBUS.AT}", "{$MODBUS.UNIT}"

Plain = dict[str, Any]


@dataclass(frozen=True, slots=True)
class _ValueMaps:
    """The labels of numbers, each set of them once."""

    device: Device
    names: Names = field(default_factory=lambda: Names(" "))
    found: dict[tuple[tuple[str, str], ...], str] = field(default_factory=dict)

    def name(self, item: Item) -> str:
        """The name of the map that has the labels of an item; a label that is too long is cut, which is told."""
        if any(len(label) > LONGEST_LABEL for _, label in item.labels):
            done = f"labels are cut to {LONGEST_LABEL} characters"
            self.device.lose(item.point.register, "label-cut", Grade.COSMETIC, done)
        labels = tuple((code, _cut(_plain(label), LONGEST_LABEL)) for code, label in item.labels)
        if labels not in self.found:
            self.found[labels] = self.names.give(_cut(item.set or item.point.path, LONGEST_LABEL - 4))
        return self.found[labels]


def template(device: Device) -> str:
    """Return the template as YAML that Zabbix imports."""
    every = device.request.every
    if every > DAY:
        message = f"--every {every}: Zabbix asks once a day ({DAY} seconds) at least"
        raise OptionError(message)
    maps = _ValueMaps(device)
    keys = Names()
    items = [_item(device, item, maps) for point in device.points for item in items_of(device, point, keys)]
    said = {
        "uuid": _uuid(device, "template"),
        "template": device.name,
        "name": device.name,
        "description": "\n".join(device.heading),
        "groups": [{"name": GROUP}],
        "items": items,
        "macros": [
            {"macro": AT, "value": _endpoint(device.place), "description": "where the device answers"},
            {"macro": UNIT, "value": str(device.request.unit), "description": "its unit id"},
        ],
        "valuemaps": list(_value_maps(device, maps)),
    }
    groups = [{"uuid": _hex("group", GROUP), "name": GROUP}]
    export = {"version": "6.0", "groups": groups, "templates": [{key: value for key, value in said.items() if value}]}
    return files.dump({"zabbix_export": export}, remarks=device.heading)


def _endpoint(place: Place) -> str:
    if place.host:
        return f"tcp://{place.host}:{place.port}"
    return f"rtu://{place.device}:{place.baud}:{place.format.lower()}"


def _item(device: Device, item: Item, maps: _ValueMaps) -> Plain:
    point = item.point
    said = {
        "uuid": _uuid(device, item.key),
        "name": _cut(_plain(item.name), LONGEST),
        "type": "DEPENDENT" if item.master else "",
        "key": item.key,
        "delay": "0" if item.master else f"{device.request.every}s",
        "trends": "0" if item.value_type == "TEXT" else "",
        "value_type": item.value_type,
        "units": f"!{_plain(item.unit)}" if item.unit else "",  # with ! it is not turned into kilo-units or days
        "description": _plain(item.description),
        "valuemap": {"name": maps.name(item)} if item.labels else {},
        "preprocessing": [{"type": kind, "parameters": [text]} for kind, text in item.steps],
        "master_item": {"key": item.master} if item.master else {},
        "tags": [{"tag": "component", "value": point.register.group}] if point.register.group else [],
    }
    return {key: value for key, value in said.items() if value}


def _value_maps(device: Device, maps: _ValueMaps) -> Iterator[Plain]:
    for labels, name in maps.found.items():
        yield {
            "uuid": _uuid(device, f"value map {name}"),
            "name": name,
            "mappings": [_mapping(code, label) for code, label in labels],
        }


def _mapping(code: str, label: str) -> Plain:
    return {"value": code, "newvalue": label} if code else {"type": "DEFAULT", "newvalue": label}


def _plain(text: str) -> str:
    """A text on one line in which Zabbix sees no macro that it would replace."""
    return re.sub(r"\{(?=[$#{])", "{ ", one_line(text))


def _cut(text: str, most: int) -> str:
    return text if len(text) <= most else f"{text[: most - 1]}…"


def _uuid(device: Device, what: str) -> str:
    return _hex(device.register_map.id, device.model.name, device.name, what)


def _hex(*parts: str) -> str:
    """A UUID of version 4 in form, always the same for the same thing: an import then changes what it made before."""
    digest = hashlib.sha256("\n".join(parts).encode()).digest()
    return uuid.UUID(bytes=digest[:16], version=4).hex
