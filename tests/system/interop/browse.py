"""Loads a nodeset with asyncua, makes a device of its type, and prints as JSON what a client finds there.

Runs with the Python of the installed asyncua: browse.py NODESET TYPE. For each variable below the type's object its
path of browse names, type, data type, access, description and properties; a value is written and read back over TCP.
"""

import asyncio
import json
import socket
import sys
from collections.abc import Mapping
from typing import Any

from asyncua import Client, Server, ua

EXAMPLES: Mapping[Any, object] = {
    ua.VariantType.Boolean: True,
    ua.VariantType.String: "x",
    ua.VariantType.ByteString: b"x",
    ua.VariantType.Float: 1.5,
    ua.VariantType.Double: 1.5,
}
"""A value of each data type; of others 1."""


def free_port() -> int:
    """A port of the loopback interface that nobody has."""
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return int(one.getsockname()[1])


def plain(value: Any) -> Any:
    """A value of OPC UA in the words of JSON."""
    if isinstance(value, list):
        return [plain(one) for one in value]
    if isinstance(value, ua.LocalizedText):
        return value.Text
    if isinstance(value, ua.Range):
        return [value.Low, value.High]
    if isinstance(value, ua.EUInformation):
        return {"unit": value.DisplayName.Text, "id": value.UnitId, "namespace": value.NamespaceUri}
    if isinstance(value, ua.EnumValueType):
        return [value.Value, value.DisplayName.Text]
    return value


async def told(node: Any) -> dict[str, Any]:
    """What a client finds at a variable."""
    kind = await node.read_data_type_as_variant_type()
    access = await node.read_attribute(ua.AttributeIds.AccessLevel)
    properties = {}
    for one in await node.get_properties():
        properties[(await one.read_browse_name()).Name] = plain(await one.read_value())
    definition = await node.read_type_definition()
    return {
        "type": ua.ObjectIdNames[definition.Identifier],
        "data": kind.name,
        "access": access.Value.Value,
        "title": (await node.read_display_name()).Text,
        "properties": properties,
    }


async def walked(node: Any, path: str, found: dict[str, Any]) -> None:
    """Everything below a node, by path."""
    for child in await node.get_children(refs=ua.ObjectIds.HasComponent):
        name = (await child.read_browse_name()).Name
        inside = f"{path}/{name}" if path else name
        if await child.read_node_class() == ua.NodeClass.Variable:
            found[inside] = await told(child)
        await walked(child, inside, found)


async def round_trip(server: Any, endpoint: str, device: Any) -> int:
    """Write a value of its data type to every variable on the server, read all by a client; how many came back."""
    count = 0
    async with Client(endpoint) as client:
        for group in await device.get_children():
            for node in await group.get_children():
                if await node.read_node_class() != ua.NodeClass.Variable:
                    continue
                kind = await node.read_data_type_as_variant_type()
                value = EXAMPLES.get(kind, 1)
                await server.write_attribute_value(node.nodeid, ua.DataValue(ua.Variant(value, kind)))
                count += await client.get_node(node.nodeid).read_value() == value
    return count


async def main(nodeset: str, kind: str) -> None:
    """Print what is found."""
    server = Server()
    await server.init()
    endpoint = f"opc.tcp://127.0.0.1:{free_port()}/"
    server.set_endpoint(endpoint)
    await server.import_xml(nodeset)
    space = await server.get_namespace_index((await server.get_namespace_array())[-1])
    base = server.get_node(ua.NodeId(f"{kind}Type", space))
    found: dict[str, Any] = {}
    await walked(base, "", found)
    async with server:
        device = await server.nodes.objects.add_object(space, "device", base.nodeid)
        count = await round_trip(server, endpoint, device)
    print(json.dumps({"found": found, "read": count, "title": (await base.read_display_name()).Text}))  # noqa: T201


asyncio.run(main(*sys.argv[1:]))
