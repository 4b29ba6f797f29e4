"""The exporter of an OPC UA nodeset: one object type for a model, its registers as variables with unit, range, codes.

It follows no companion specification. What OPC UA has no word for (where a value stands on the wire, its exact scale,
its faults) stands in properties of a namespace of its own.
"""

import re
from collections.abc import Mapping, Sequence
from xml.etree import ElementTree as ET

from regscribe.emit.words import one_line
from regscribe.export.device import RESOLVED, Carries, Carry, Device, Point, Request, Target, Wire, exported
from regscribe.export.device.options import CHOICE, MODEL, STATE
from regscribe.export.opcua_nodeset.nodes import (
    CORE,
    CORE_VERSION,
    NODES,
    OBJECT,
    REFERENCES,
    Nodes,
    element,
    refer,
)
from regscribe.export.opcua_nodeset.variables import DOUBLE_BITS, Variables
from regscribe.losses import Exported, Grade
from regscribe.model import Kind, Order, RegisterMap

name = "opcua-nodeset"
summary = "an OPC UA nodeset: an object type with a variable for each register"
options = (MODEL, *CHOICE, *STATE)

WIDEST = 64
RUN = re.compile("-(?=-)")
"""A hyphen before another one, which a comment of XML must not have."""

WHOLE = (
    *("scale", "offset", "scale-not-stated", "enum", "flags", "sentinel", "special-value", "boolean", "string"),
    *("version", "bytes", "date", "write", "write-only", "danger", "group", "name", "symbol", "description", "source"),
)

carries: Carries = (
    RESOLVED
    | dict.fromkeys(WHOLE, Carry.WHOLE)
    | dict.fromkeys(("condition", "unit", "range", "valid", "fields"), Carry.PARTLY)
)


def _fits(wire: Wire) -> bool:
    if wire.apart or (wire.type.is_integer and wire.type.bits > WIDEST):
        return False
    return wire.space.is_bits or (isinstance(wire.words, Order) and isinstance(wire.bytes, Order))


def _refuses(point: Point, _: Request) -> str:
    taken = point.register.kind is Kind.FLAGS and any(not part.is_flag for part in point.fields)
    return "its flags are wider than a bit" if taken else ""


TARGET = Target(name=name, carries=carries, fits=_fits, refuses=_refuses, verified="asyncua 2.1.0", placed=False)


def export(maps: Sequence[RegisterMap], options: Mapping[str, str]) -> Exported:
    """Return the nodeset. Raises OptionError."""
    return exported(TARGET, maps, options, _nodeset)


def _nodeset(device: Device) -> str:
    root = ET.Element("UANodeSet", xmlns=NODES)
    root.append(ET.Comment(f" {RUN.sub('- ', '; '.join(device.heading))} "))
    uri = f"urn:regscribe:{device.register_map.id.replace('/', ':')}"
    element(element(root, "NamespaceUris"), "Uri", uri)
    model = element(element(root, "Models"), "Model", ModelUri=uri, Version="1")
    element(model, "RequiredModel", ModelUri=CORE, **CORE_VERSION)
    aliases = element(root, "Aliases")
    for alias, target in REFERENCES.items():
        element(aliases, "Alias", target, Alias=alias)
    _type(device, Nodes(root))
    ET.indent(root)
    return '<?xml version="1.0" encoding="utf-8"?>\n' + ET.tostring(root, encoding="unicode") + "\n"


def _type(device: Device, nodes: Nodes) -> None:
    """The object type of the model, an object for each group below it, and the variables of the registers there."""
    model = device.model
    path = f"{model.class_name}Type"
    said = f"{one_line(device.register_map.title)}, model {one_line(model.name)}"
    node = nodes.add("UAObjectType", path, f"1:{path}", one_line(model.name), said)
    refer(node, "HasSubtype", OBJECT, back=True)
    used = {point.register.group for point in device.points}
    groups = {group.id: group for group in model.groups if group.id in used}
    for group in groups.values():
        where, title, about = f"{path}.{group.id}", one_line(group.name), one_line(group.description)
        nodes.child("UAObject", where, f"1:{group.id}", title, about, parent=path, type=OBJECT)
    variables = Variables(device, nodes)
    for point in device.points:
        parent = f"{path}.{point.register.group}" if point.register.group in groups else path
        variables.add(point, parent)
        if point.is_scaled and point.wire.type.is_integer and point.wire.type.bits > DOUBLE_BITS:
            done = "a Double, which tells 15 digits apart"
            device.lose(point.register, "precision-float64", Grade.LOST, done)
