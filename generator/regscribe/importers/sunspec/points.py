"""Points of SunSpec's models: their types, the numbers that say that a point is not implemented, symbols and scales."""

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

from regscribe.draft.labels import described, labelled
from regscribe.files import OneLine
from regscribe.importers.shared.exact import whole
from regscribe.importers.shared.reading import Keys, refuse
from regscribe.importers.shared.tree import Node
from regscribe.model import WireType
from regscribe.model.units import meant_unit

NOT_IMPLEMENTED = "not implemented"


class Type(NamedTuple):
    """A type of SunSpec: its wire type, the number that is none, and what its symbols are."""

    wire: WireType
    none: int | str | None = None
    symbols: str = ""


TYPES: Mapping[str, Type] = {
    "int16": Type(WireType.INT16, -(1 << 15)),
    "int32": Type(WireType.INT32, -(1 << 31)),
    "int64": Type(WireType.INT64, -(1 << 63)),
    "uint16": Type(WireType.UINT16, 0xFFFF),
    "count": Type(WireType.UINT16, 0xFFFF),
    "uint32": Type(WireType.UINT32, 0xFFFFFFFF),
    "uint64": Type(WireType.UINT64, 0xFFFFFFFFFFFFFFFF),
    "raw16": Type(WireType.UINT16),
    "acc16": Type(WireType.UINT16, 0),
    "acc32": Type(WireType.UINT32, 0),
    "acc64": Type(WireType.UINT64, 0),
    "sunssf": Type(WireType.INT16, -(1 << 15)),
    "enum16": Type(WireType.UINT16, 0xFFFF, "enum"),
    "enum32": Type(WireType.UINT32, 0xFFFFFFFF, "enum"),
    "bitfield16": Type(WireType.UINT16, 0xFFFF, "flags"),
    "bitfield32": Type(WireType.UINT32, 0xFFFFFFFF, "flags"),
    "bitfield64": Type(WireType.UINT64, 0xFFFFFFFFFFFFFFFF, "flags"),
    "float32": Type(WireType.FLOAT32, "nan"),
    "float64": Type(WireType.FLOAT64, "nan"),
    "string": Type(WireType.STRING),
    "ipaddr": Type(WireType.IPV4, 0),
    "ipv6addr": Type(WireType.IPV6, 0),
    "eui48": Type(WireType.EUI48, 0xFFFFFFFFFFFF),
}
"""Types of points, with the number that stands for a point which is not implemented."""

PAD = "pad"
SUNSSF = "sunssf"
HEADER = frozenset({"ID", "L"})
SHOWN = frozenset({"standards", "comments", "detail", "notes", "name", "size"})

Find = Callable[[str], str]
"""The id of the point that has a name, in the groups around."""


def register_of(keys: Keys, at: int, own: str, find: Find) -> dict[str, Any]:
    """Return the keys of the register of a point. Raises LeftOutError."""
    told, size = keys.text("type"), keys.whole("size") or 0
    if told not in TYPES:
        refuse("type", f"type `{told}` is none of SunSpec's")
    form, code = TYPES[told], keys.text("name")
    found: dict[str, Any] = {"at": at, "name": keys.text("label") or code, "id": own, "symbol": code}
    found["access"] = "rw" if keys.text("access") == "RW" else "r"
    found |= _wire(form, size, told)
    found |= _scale(keys, told, find)
    unit = keys.text("units")
    if unit and told != SUNSSF:
        found["unit"] = meant_unit(unit) or " ".join(unit.split())
    found |= described(str(found["name"]), keys.text("desc"))
    found |= _symbols(keys, form)
    if form.none is not None and code not in HEADER:
        none: dict[Any, str] = {form.none: NOT_IMPLEMENTED}
        found["sentinels"] = OneLine(none)
    found |= {"static": True} if keys.text("static") == "S" else {}
    keys.taken |= {"value", "sf"}
    return found | {"mandatory": keys.text("mandatory") == "M"}


def _wire(form: Type, size: int, told: str) -> dict[str, Any]:
    wire = form.wire
    found: dict[str, Any] = {} if wire is WireType.UINT16 else {"type": wire.value}
    if wire is WireType.STRING or (wire.is_octets and size > wire.words):
        return found | {"length": size}
    if size != wire.words:
        refuse("size", f"size {size} is not that of {told}, which has {wire.words}")
    return found


def _scale(keys: Keys, told: str, find: Find) -> dict[str, Any]:
    """The scale factor of a point: the register that holds it, or a constant."""
    if told == SUNSSF:
        return {"range": "-10..10"}
    factor = keys.text("sf")
    constant = whole(factor)
    if constant is not None:
        return {"decimals": -constant} if constant else {}
    return {"exponent": find(factor)} if factor else {}


def _symbols(keys: Keys, form: Type) -> dict[str, Any]:
    """The codes of an enum, or the numbers of bits, with their labels."""
    listed = keys.take("symbols")
    labels: dict[int, str] = {}
    for symbol in listed.each if listed else ():
        number = whole(symbol.word("value"))
        label = symbol.word("label") or symbol.word("name")
        if number is None or number in labels or (form.symbols == "flags" and number >= form.wire.bits):
            keys.drop("symbols", f"the symbol {label} has the value {symbol.word('value')}, twice or beyond the type")
        else:
            labels[number] = label
    if not labels or not form.symbols:
        return {}
    return {form.symbols: _described(labelled(labels, "bit" if form.symbols == "flags" else "code"), listed)}


def _described(labels: OneLine, listed: Node | None) -> OneLine:
    """The labels with the descriptions of their symbols."""
    texts = {whole(one.word("value")): " ".join(one.word("desc").split()) for one in (listed.each if listed else ())}
    found: dict[Any, Any] = {}
    for code, label in labels.items():
        text = texts.get(whole(str(code)))
        details = label if isinstance(label, dict) else {"label": label}
        found[code] = OneLine({**details, "description": text}) if text else label
    return OneLine(found)
