"""The profile: what it describes, its resources, and a command for each group that reads all of it."""

from collections.abc import Iterator, Sequence
from typing import Any

from regscribe import files
from regscribe.emit.words import one_line
from regscribe.export.device import Device
from regscribe.export.device.names import Names
from regscribe.export.edgex.resources import resources_of

MOST_OPERATIONS = 128
"""Resources of one command, as a device service allows unless it is configured otherwise."""

Plain = dict[str, Any]


def profile(device: Device) -> str:
    """Return the profile as YAML."""
    names = Names()
    resources: list[Plain] = []
    groups: dict[str, list[Plain]] = {}
    for point in device.points:
        for resource in resources_of(device, point, names):
            resources.append(resource.said)
            if "R" in resource.said["properties"]["readWrite"] and point.register.group:
                operation = files.OneLine(deviceResource=resource.said["name"])
                operation |= {"mappings": files.OneLine(resource.labels)} if resource.labels else {}
                groups.setdefault(point.register.group, []).append(operation)
    said = {
        "name": device.name.replace(".", "-"),
        "manufacturer": one_line(device.register_map.maker),
        "model": one_line(device.model.name),
        "description": one_line(device.register_map.title),
        "labels": ["modbus"],
        "deviceResources": resources,
        "deviceCommands": list(_commands(groups, names)),
    }
    return files.dump({key: value for key, value in said.items() if value}, remarks=device.heading)


def _commands(groups: dict[str, list[Plain]], names: Names) -> Iterator[Plain]:
    """Yield the commands; a name that a resource has would hide it, so none has it twice."""
    for group, members in groups.items():
        for some in _parts(members):
            yield {
                "name": names.give(group),
                "isHidden": False,
                "readWrite": "R",
                "resourceOperations": list(some),
            }


def _parts(members: Sequence[Plain]) -> Iterator[Sequence[Plain]]:
    for first in range(0, len(members), MOST_OPERATIONS):
        yield members[first : first + MOST_OPERATIONS]
