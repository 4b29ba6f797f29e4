"""The keys of a register that the columns of a table say."""

import re
from collections.abc import Callable, Mapping
from fractions import Fraction
from typing import Any

from regscribe.draft.ids import Taken, free_id
from regscribe.draft.numbers import plain, scaling
from regscribe.evidence.cell_compare import access, number, objects
from regscribe.files import OneLine
from regscribe.model import Space, WireType, show
from regscribe.model.identifiers import snake
from regscribe_runtime.values.kinds import MOMENTS, Kind
from regscribe_runtime.values.octets import KINDS

Cells = Mapping[str, str]

FACTOR = r"[0-9.]+(?:/[0-9]+)?"
LINE = re.compile(rf"(?:(-?{FACTOR})\*)?x(?:/([0-9]+))?(?: ([+-]) ({FACTOR}))?")
"""`x/10`, `0.1*x - 40`: the value of a stored number by numbers alone."""
NUMBERS = frozenset({"integer", "number", "raw"})
BITS = frozenset({"coil", "discrete"})
PLAIN_UNIT = re.compile(r"[^;:]+")
"""A unit under no condition."""


def _space(cells: Cells) -> dict[str, Any] | None:
    space = cells["space"].lower()
    return None if space not in list(Space) else {} if space == Space.HOLDING else {"space": space}


def _access(cells: Cells) -> dict[str, Any] | None:
    found = access(cells["access"])
    return {"access": found} if found in {"r", "rw", "w"} else None


def _type(cells: Cells) -> dict[str, Any] | None:
    wire = cells["type"].lower()
    if wire not in list(WireType):
        return _length_of_bits(wire) if cells.get("kind", "") == Kind.FLAGS else None
    kind = KINDS.get(WireType(wire))
    if kind in MOMENTS:
        return {"type": wire} if "layout" in (objects(cells.get("more", "")) or {}) else None
    length = {"length": int(cells["words"])} if kind and cells.get("words", "").isdecimal() else {}
    return {} if wire == WireType.UINT16 else {"type": wire, **length}


def _length_of_bits(wire: str) -> dict[str, Any] | None:
    """The words of flags in a number too wide for a type of its own."""
    try:
        return {"length": WireType(wire).words}
    except ValueError:
        return None


def _unit(cells: Cells) -> dict[str, Any] | None:
    return {"unit": cells["unit"]} if PLAIN_UNIT.fullmatch(cells["unit"]) else None


def _range(cells: Cells) -> dict[str, Any] | None:
    """`a..b`, once both limits are plain numbers."""
    low, high = (number(cells.get(side, "")) for side in ("minimum", "maximum"))
    if low is None or high is None:
        return None
    both = f"{show(low)}..{show(high)}"
    return {} if (objects(cells.get("more", "")) or {}).get("valid") == both else {"range": both}


def _default(cells: Cells) -> dict[str, Any] | None:
    if ": " in cells["default"]:
        return None
    value = number(cells["default"])
    return {"default": cells["default"] if value is None else plain(value)}


def _values(cells: Cells) -> dict[str, Any] | None:
    """An enum, where nothing says that the codes stand beside a number."""
    faults = _sentinels(cells)
    found = {code: label for code, label in (objects(cells["values"]) or {}).items() if code not in faults}
    if faults and not found:
        return {}
    if not found or cells.get("minimum") or cells.get("kind", "enum") != "enum":
        return None
    codes = {number(code): label for code, label in found.items()}
    whole: dict[Any, str] = {
        code.numerator: str(label) for code, label in codes.items() if code is not None and code.denominator == 1
    }
    return {"enum": OneLine(whole)} if len(whole) == len(found) else None


def _sentinels(cells: Cells) -> dict[str, Any]:
    found = (objects(cells.get("more", "")) or {}).get("sentinels")
    return found if isinstance(found, dict) else {}


def _bits(cells: Cells) -> dict[str, Any] | None:
    found = objects(cells["bits"])
    if found and cells.get("kind", "") == Kind.FIELDS:
        return _fields({bits: str(label) for bits, label in found.items()})
    if not found or not all(bit.isdecimal() for bit in found):
        return None
    flags: dict[Any, str] = {int(bit): str(label) for bit, label in found.items()}
    return {"flags": OneLine(flags)}


PART = re.compile(r"([^:]+)(?:: (-?[0-9]+ = .*))?")
"""A label, and the codes of its values."""

CODE = re.compile(r"(-?[0-9]+) = ([^,=]+)")


def _fields(parts: Mapping[str, str]) -> dict[str, Any] | None:
    """The parts of a word by their bits, where nothing but codes is said of them."""
    taken: Taken = {}
    found: dict[str, Any] = {}
    for bits, label in parts.items():
        part = PART.fullmatch(label)
        codes = part and [CODE.fullmatch(code) for code in (part[2] or "").split(", ") if code]
        if not part or codes is None or not all(codes):
            return None
        keys: dict[str, Any] = {"bits": bits} if ".." in bits else {"bit": int(bits)}
        enum: dict[Any, str] = {int(code[1]): code[2] for code in codes if code}
        more = {"enum": OneLine(enum)} if enum else {}
        found[free_id(snake(part[1]), {"at": bits}, taken, "part")] = OneLine({**keys, "label": part[1], **more})
    return {"fields": OneLine(found)}


def _scale(cells: Cells) -> dict[str, Any] | None:
    if cells["scale"] == "not stated":
        return {"decimals": "not_stated"}
    found = LINE.fullmatch(cells["scale"])
    if not found:
        return None
    factor, divisor, sign, distance = found.groups()
    numbers = [number(factor or "1"), number(divisor or "1"), number(f"{sign or ''}{distance or 0}")]
    multiply, divide, add = (Fraction(0) if one is None else one for one in numbers)
    return scaling(multiply / divide, add) if multiply and divide else None


def _kind(cells: Cells) -> dict[str, Any] | None:
    kind, of_bits = cells["kind"], cells.get("space", "") in BITS
    apart = kind == "integer" and bool(LINE.fullmatch(cells.get("scale", "")))
    if (kind == "boolean" and not of_bits) or (kind in NUMBERS and of_bits) or apart:
        return {"kind": kind}
    told = cells["kind"] != "version" or "version" in (objects(cells.get("more", "")) or {})
    return {} if told and (kind != Kind.FIELDS or "bits" in cells) else None


def _views(cells: Cells) -> dict[str, Any] | None:
    """Nothing, where the one view is that of the row, or the other one is what `write_at` says."""
    apart = "write_at" in (objects(cells.get("more", "")) or {})
    return {} if len(objects(cells["views"]) or {}) <= 1 + apart else None


def _whole(key: str) -> Callable[[Cells], dict[str, Any] | None]:
    return lambda cells: {key: int(cells[key])} if cells[key].isdecimal() else None


def _aliases(cells: Cells) -> dict[str, Any] | None:
    words = re.split(r"[\s,;]+", cells["aliases"])
    return {"aliases": [int(word) for word in words]} if all(word.isdecimal() for word in words) else None


KEYS: dict[str, Callable[[Cells], dict[str, Any] | None]] = {
    "address": lambda _: {},
    "name": lambda _: {},
    "kind": _kind,
    "space": _space,
    "access": _access,
    "type": _type,
    "unit": _unit,
    "minimum": _range,
    "maximum": _range,
    "default": _default,
    "values": _values,
    "bits": _bits,
    "scale": _scale,
    "aliases": _aliases,
    "symbol": lambda cells: {"symbol": cells["symbol"]},
    "persistence": lambda cells: {"persistence": cells["persistence"]},
    "section": lambda cells: {"source": cells["section"]},
    "views": _views,
    "file": _whole("file"),
    "queue": _whole("queue"),
}
"""The keys of a register that a column says; None: it cannot be said so."""
