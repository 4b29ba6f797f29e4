"""Forms: where a property is read and written, and how its bytes are told from each other.

Of the orders, node-wot 0.8.16 looks at `byteSeq` in the content type alone, and it swaps bytes when it reads but not
when it writes several registers; so only what it writes rightly can be written.
"""

from typing import Any
from urllib.parse import quote

from regscribe.export.device import Device, Point
from regscribe.export.device.writes import obstacle, write_functions
from regscribe.export.wot_td.parts import is_object
from regscribe.model import Kind, Order, Space, WireType

ENTITIES = {
    Space.HOLDING: "HoldingRegister",
    Space.INPUT: "InputRegister",
    Space.COIL: "Coil",
    Space.DISCRETE: "DiscreteInput",
}
BYTE_SEQUENCES = {
    (Order.BIG, Order.BIG): "BIG_ENDIAN",
    (Order.LITTLE, Order.BIG): "LITTLE_ENDIAN_BYTE_SWAP",
    (Order.BIG, Order.LITTLE): "BIG_ENDIAN_BYTE_SWAP",
    (Order.LITTLE, Order.LITTLE): "LITTLE_ENDIAN",
}
PLAIN = "BIG_ENDIAN"
FLOATS = {WireType.FLOAT16: "", WireType.FLOAT32: "xsd:float", WireType.FLOAT64: "xsd:double"}
WHOLE = {
    (16, True): "xsd:short",
    (16, False): "xsd:unsignedShort",
    (32, True): "xsd:int",
    (32, False): "xsd:unsignedInt",
    (64, True): "xsd:long",
    (64, False): "xsd:unsignedLong",
}
"""The types of XML Schema by their bits, and whether they have a sign."""

TYPES = frozenset(
    one
    for one in WireType
    if one in {WireType.INT48, WireType.UINT48, WireType.STRING, *FLOATS}
    or (one.is_integer and one.code and one is not WireType.BIT)
)
CHARSETS = {"ascii": "utf-8", "utf-8": "utf-8", "latin-1": "latin1"}
"""What Node.js calls an encoding."""

MOST_BYTES = 6
"""The longest whole number that node-wot reads."""

SEVERAL = {Space.COIL: "writeMultipleCoils", Space.HOLDING: "writeMultipleHoldingRegisters"}
PATTERNS = frozenset({Kind.FLAGS, Kind.FIELDS})


def reads_whole(point: Point) -> bool:
    """Whether node-wot reads a whole number of this length (or it is none)."""
    wire_type = point.wire.type
    return wire_type.is_float or wire_type.is_octets or 2 * point.words <= MOST_BYTES or is_object(point)


def why_read_only(device: Device, point: Point) -> str:
    """Return why a register cannot be written by such a thing; empty if it can."""
    register, wire = point.register, point.wire
    protocol = device.register_map.protocol
    functions = write_functions(point, protocol)
    swapped = wire.space.is_words and "SWAP" in BYTE_SEQUENCES[wire.words, wire.bytes]  # type: ignore[index]  # it fits
    reasons = {
        "its parts share a word with others": register.kind in PATTERNS,
        "a version is not written as a number": register.kind is Kind.VERSION,
        "node-wot does not fill a text up": register.kind is Kind.STRING,
        (why := obstacle(point, protocol)): bool(why),
        "node-wot writes the words of this order in another one": swapped and (point.words > 1 or 6 not in functions),  # noqa: PLR2004 (FC 06)
        "node-wot does not write whole numbers of so many bytes": wire.type.is_integer and point.words > 2,  # noqa: PLR2004 (32 bits)
    }
    return next((why for why, holds in reasons.items() if holds), "")


def forms_of(device: Device, point: Point, *, writable: bool) -> list[dict[str, Any]]:
    """Return the forms of a property: one, or one to read and one to write where these differ."""
    read = _form(device, point, point.address) | {"op": ["readproperty", "observeproperty", "unobserveproperty"]}
    read["modv:pollingTime"] = 1000 * device.request.every
    forms = [read] if point.register.access.readable else []
    if not writable or point.write is None:
        return forms
    write = _form(device, point, point.write) | {"op": ["writeproperty"]}
    single = point.wire.space.write_functions[0]
    if point.words == 1 and single not in write_functions(point, device.register_map.protocol):
        del write["modv:entity"]
        write["modv:function"] = SEVERAL[point.wire.space]
    if forms and {**write, "op": read["op"], "modv:pollingTime": read["modv:pollingTime"]} == read:
        read["op"].append("writeproperty")
        return forms
    return [*forms, write]


def _form(device: Device, point: Point, address: int) -> dict[str, Any]:
    place, wire = device.place, point.wire
    where = f"modbus+tcp://{quote(place.host)}:{place.port}/{place.unit}/{address}?quantity={point.words}"
    form: dict[str, Any] = {
        "href": where,
        "contentType": _content_type(point),
        "modv:entity": ENTITIES[wire.space],
        "modv:zeroBasedAddressing": True,
        "modv:timeout": round(1000 * device.register_map.protocol.timeout),
    }
    if wire.space.is_words:
        form["modv:mostSignificantByte"] = wire.bytes is Order.BIG
        form["modv:mostSignificantWord"] = wire.words is Order.BIG
    kind = _type(wire.type)
    return form | ({"modv:type": kind} if kind else {})


def _content_type(point: Point) -> str:
    wire = point.wire
    if wire.space.is_bits:
        return "application/octet-stream;length=1;signed=false"
    if wire.type is WireType.STRING:
        what = f"charset={CHARSETS[point.register.text.encoding]}"
    else:
        signed = (wire.type.is_float or wire.type.minimum < 0) and point.register.kind not in PATTERNS
        what = f"signed={str(signed).lower()}"
    # the places of parts are those on the wire, so that no byte of them is to be moved
    order = PLAIN if is_object(point) else BYTE_SEQUENCES[wire.words, wire.bytes]  # type: ignore[index]  # it fits
    return f"application/octet-stream;length={2 * point.words};{what};byteSeq={order}"


def _type(wire_type: WireType) -> str:
    if wire_type is WireType.BIT:
        return "xsd:boolean"
    if wire_type is WireType.STRING:
        return "xsd:string"
    return FLOATS.get(wire_type, "") or WHOLE.get((wire_type.bits, wire_type.minimum < 0), "")
