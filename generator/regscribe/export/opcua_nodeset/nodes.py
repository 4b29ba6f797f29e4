"""Nodes of an address space as XML: objects, variables, properties and the values that these have."""

from collections.abc import Iterable, Sequence
from fractions import Fraction
from xml.etree import ElementTree as ET

from regscribe.export.device.numbers import decimal
from regscribe.export.opcua_nodeset.units import CEFACT, NO_ID, OWN, unit_id
from regscribe.visible import safe

NODES = "http://opcfoundation.org/UA/2011/03/UANodeSet.xsd"
TYPES = "http://opcfoundation.org/UA/2008/02/Types.xsd"
CORE = "http://opcfoundation.org/UA/"
CORE_VERSION = {"Version": "1.04.3", "PublicationDate": "2019-09-09T00:00:00Z"}
"""The model of OPC UA itself that has all types that are used."""

REFERENCES = {
    "HasModellingRule": "i=37",
    "HasTypeDefinition": "i=40",
    "HasSubtype": "i=45",
    "HasProperty": "i=46",
    "HasComponent": "i=47",
}
DATA = {
    "Boolean": "i=1",
    "SByte": "i=2",
    "Byte": "i=3",
    "Int16": "i=4",
    "UInt16": "i=5",
    "Int32": "i=6",
    "UInt32": "i=7",
    "Int64": "i=8",
    "UInt64": "i=9",
    "Float": "i=10",
    "Double": "i=11",
    "String": "i=12",
    "ByteString": "i=15",
    "LocalizedText": "i=21",
    "Range": "i=884",
    "EUInformation": "i=887",
    "EnumValueType": "i=7594",
}
"""The data types that are used, by name."""

VARIABLES = {
    "BaseDataVariableType": "i=63",
    "PropertyType": "i=68",
    "TwoStateDiscreteType": "i=2373",
    "MultiStateValueDiscreteType": "i=11238",
    "OptionSetType": "i=11487",
    "BaseAnalogType": "i=15318",
}
BODIES = {"Range": "i=885", "EUInformation": "i=888", "EnumValueType": "i=7616"}
"""The encodings in XML of the structures that are used."""

OBJECT, FOLDER = "i=58", "i=61"
MANDATORY, OPTIONAL = "i=78", "i=80"


def element(parent: ET.Element, name: str, text: str = "", **attributes: str) -> ET.Element:
    """Add an element; what XML cannot hold is in the text as an escape sequence."""
    found = ET.SubElement(parent, name, {key: safe(value) for key, value in attributes.items()})
    found.text = safe(text) if text else None
    return found


class Nodes:
    """The nodes of a set, in the order in which they are added."""

    def __init__(self, root: ET.Element) -> None:
        """`root` is the element that holds them."""
        self._root = root

    def add(self, kind: str, path: str, name: str, title: str, said: str = "", **more: str) -> ET.Element:
        """Add a node: its kind, path (which is its id), browse name, display name, description."""
        node = element(self._root, kind, NodeId=f"ns=1;s={path}", BrowseName=name, **more)
        element(node, "DisplayName", title)
        if said:
            element(node, "Description", said)
        element(node, "References")
        return node

    def child(self, kind: str, path: str, name: str, title: str, said: str = "", **more: str) -> ET.Element:
        """Add a node below another one: `parent` is its path, `type` the type of the new node.

        `rule`: whether every instance has it; `reference`: how it hangs there, as a component unless told.
        """
        parent, form = more.pop("parent"), more.pop("type")
        rule, how = more.pop("rule", MANDATORY), more.pop("reference", "HasComponent")
        node = self.add(kind, path, name, title, said, ParentNodeId=f"ns=1;s={parent}", **more)
        refer(node, "HasTypeDefinition", form)
        refer(node, "HasModellingRule", rule)
        refer(node, how, f"ns=1;s={parent}", back=True)
        return node

    def own(self, parent: str, name: str, data: str, *texts: str, several: bool = False) -> None:
        """Add a property of one of the plain types, or a list, under a name of the set's own namespace."""
        value = self.property(parent, f"1:{name}", data, several=several)
        into = ET.SubElement(value, f"ListOf{data}", xmlns=TYPES) if several else value
        for text in texts:
            element(into, data, text, **({} if several else {"xmlns": TYPES}))

    def property(self, parent: str, name: str, data: str, *, several: bool = False) -> ET.Element:
        """Add a property; the element that takes its value. A standard property has a name without a namespace."""
        rank = {"ValueRank": "1", "ArrayDimensions": "0"} if several else {}
        plain = name.partition(":")[2] or name
        path = f"{parent}.{plain}"
        node = self.child(
            "UAVariable",
            path,
            name,
            plain,
            parent=parent,
            type=VARIABLES["PropertyType"],
            reference="HasProperty",
            DataType=DATA[data],
            **rank,
        )
        return element(node, "Value")


def refer(node: ET.Element, kind: str, target: str, *, back: bool = False) -> None:
    """Add a reference to a node; `back`: it leads from the target to this node."""
    (references,) = node.iter("References")
    element(references, "Reference", target, ReferenceType=kind, **({"IsForward": "false"} if back else {}))


def put_range(value: ET.Element, low: Fraction, high: Fraction) -> None:
    """Set a value to a range."""
    body = _structure(_extension(value), "Range")
    element(body, "Low", decimal(low))
    element(body, "High", decimal(high))


def put_unit(value: ET.Element, symbol: str) -> None:
    """Set a value to a unit; one without a common code has its symbol alone."""
    number = unit_id(symbol)
    body = _structure(_extension(value), "EUInformation")
    element(body, "NamespaceUri", OWN if number == NO_ID else CEFACT)
    element(body, "UnitId", str(number))
    for name in ("DisplayName", "Description"):
        element(element(body, name), "Text", symbol)


def put_codes(value: ET.Element, codes: Iterable[tuple[int, str, str]]) -> None:
    """Set a value to codes with their labels and descriptions."""
    into = ET.SubElement(value, "ListOfExtensionObject", xmlns=TYPES)
    for code, label, said in codes:
        body = _structure(ET.SubElement(into, "ExtensionObject"), "EnumValueType")
        element(body, "Value", str(code))
        element(element(body, "DisplayName"), "Text", label)
        element(element(body, "Description"), "Text", said)


def put_texts(value: ET.Element, texts: Sequence[str]) -> None:
    """Set a value to a list of texts for people."""
    into = ET.SubElement(value, "ListOfLocalizedText", xmlns=TYPES)
    for text in texts:
        element(element(into, "LocalizedText"), "Text", text)


def put_text(value: ET.Element, text: str) -> None:
    """Set a value to one text for people."""
    element(ET.SubElement(value, "LocalizedText", xmlns=TYPES), "Text", text)


def _extension(value: ET.Element) -> ET.Element:
    return ET.SubElement(value, "ExtensionObject", xmlns=TYPES)


def _structure(extension: ET.Element, name: str) -> ET.Element:
    element(element(extension, "TypeId"), "Identifier", BODIES[name])
    return element(element(extension, "Body"), name)
