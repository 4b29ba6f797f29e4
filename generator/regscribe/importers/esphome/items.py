"""Items of ESPHome's modbus_controller, by platform."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from fractions import Fraction
from typing import Any

from regscribe.dialects import ABCD, read_back
from regscribe.dialects.esphome import RAW, SPACES, TYPES, USUAL
from regscribe.draft import Remark
from regscribe.draft.labels import labelled
from regscribe.draft.numbers import plain
from regscribe.importers.esphome.filters import scaled
from regscribe.importers.shared.bits import bits_of
from regscribe.importers.shared.exact import whole
from regscribe.importers.shared.points import Point
from regscribe.importers.shared.reading import Keys, code_of, refuse, unclear_scale
from regscribe.model import Space, Span, WireType, show

INPUTS = read_back(SPACES)
FORMS = read_back(TYPES)

SHOWN = frozenset({"platform", "name", "id", "modbus_controller_id", "icon", "device_class", "state_class", "mode"}) | {
    *("accuracy_decimals", "entity_category", "internal", "disabled_by_default", "force_update", "web_server"),
    *("force_new_range", "restore_mode", "optimistic", "assumed_state", "inverted", "publish_initial_state"),
}
"""Keys that only matter to what ESPHome shows, or to how it groups requests."""


def _at(keys: Keys, space: Space) -> int:
    """The wire address; `offset` are bytes behind it (of coils, bits)."""
    at = keys.whole("address")
    if at is None:
        refuse("address", "it has no address (a custom_command?)")
    offset = keys.whole("offset") or 0
    if space.is_bits:
        return at + offset
    if offset % 2:
        refuse("offset", f"offset {offset} is half a register")
    return at + offset // 2


def _space(keys: Keys, usual: str = "holding") -> Space:
    return keys.choice("register_type", INPUTS, usual)


def _form(keys: Keys) -> tuple[WireType, Any]:
    if keys.text("value_type", USUAL) == RAW:
        refuse("value_type", "RAW: only a lambda knows what its bytes mean")
    return keys.choice("value_type", FORMS, USUAL)


def _poll(keys: Keys, every: int) -> dict[str, Any]:
    skipped = keys.whole("skip_updates")
    return {"poll": every * (skipped + 1)} if skipped else {}


def _lambdas(keys: Keys, *names: str) -> bool:
    """Tell each lambda that stands there; whether there is one."""
    found = [name for name in names if keys.take(name)]
    for name in found:
        value = keys.take(name)
        shown = value.shown if value else ""
        keys.remarks.append(Remark(code_of(name), f"{name} {shown} is not executed", todo=True))
    return bool(found)


def sensor(name: str, place: Span, every: int, keys: Keys) -> Point:
    """Return the register of a sensor. Raises LeftOutError."""
    space = _space(keys)
    wire, orders = (WireType.BIT, ABCD) if space.is_bits else _form(keys)
    at, more = _at(keys, space), _poll(keys, every)
    count = keys.whole("register_count")
    if not space.is_bits and count not in {None, wire.words}:
        keys.remarks.append(Remark("register-count", f"register_count {count} only widens the request", lossy=False))
    scale = scaled(keys)
    if _lambdas(keys, "lambda"):
        scale = None
        keys.remarks.append(unclear_scale("a lambda computes the value"))
    multiply, add = scale or (None, Fraction(0))
    unit = keys.text("unit_of_measurement")
    point = Point(name=name, place=place, at=at, space=space, type=wire, orders=orders, multiply=multiply, add=add)
    point = replace(point, unit=unit, more=more)
    mask = _mask(keys, space)
    return point if mask is None else replace(point, bits=mask)


def _mask(keys: Keys, space: Space, usual: int = 0) -> tuple[int, int] | None:
    """The bits that a bitmask leaves; None where it leaves all. Raises LeftOutError."""
    mask = keys.whole("bitmask")
    mask = usual if mask is None else mask
    if space.is_bits or mask in {0, 0xFFFFFFFF}:
        return None
    return bits_of(mask) or refuse("bitmask", f"the bits of bitmask 0x{mask:X} do not stand together")


def binary_sensor(name: str, place: Span, every: int, keys: Keys) -> Point:
    """Return the bit of a binary sensor. Raises LeftOutError."""
    space = _space(keys, "coil")
    at, more = _at(keys, space), _poll(keys, every)
    _lambdas(keys, "lambda")
    keys.drop("filters", "filters of a bit only delay or turn around what is shown")
    point = Point(name=name, place=place, at=at, space=space, more=more)
    if space.is_bits:
        return replace(point, type=WireType.BIT)
    mask = _mask(keys, space, 1)
    if mask is None or mask[0] != mask[1]:
        keys.remarks.append(Remark("bitmask-wide", "it is on where any of several bits is; here it is their number"))
    return replace(point, bits=mask or (0, 15))


def number(name: str, place: Span, every: int, keys: Keys) -> Point:
    """Return the register of a number: the value is the number on the wire, divided by `multiply`."""
    space = _space(keys)
    wire, orders = _form(keys)
    at, more = _at(keys, space), _poll(keys, every)
    factor = keys.scale("multiply")
    if factor == 0:
        refuse("multiply", "multiply 0")
    low, high, step = (keys.number(key) for key in ("min_value", "max_value", "step"))
    multiply = None if factor is None else 1 / factor
    if _lambdas(keys, "lambda", "write_lambda"):
        keys.remarks.append(unclear_scale("a lambda computes the value"))
        multiply = None
    if low is not None and high is not None:
        more["range"] = f"{show(low)}..{show(high)}"
    if step is not None and step > abs(multiply or Fraction(1)):
        more["step"] = plain(step)
    several = keys.truth("use_write_multiple")
    point = Point(name=name, place=place, at=at, space=space, type=wire, orders=orders, multiply=multiply, access="rw")
    point = replace(point, unit=keys.text("unit_of_measurement"), more=more | (_write_multiple() if several else {}))
    mask = _mask(keys, space)
    return point if mask is None else replace(point, bits=mask)


def _write_multiple() -> dict[str, Any]:
    return {"functions": [3, 16]}


def select(name: str, place: Span, every: int, keys: Keys) -> Point:
    """Return the register of a select: its options are codes."""
    wire, orders = _form(keys)
    at, more = _at(keys, Space.HOLDING), _poll(keys, every)
    _lambdas(keys, "lambda", "write_lambda")
    listed = keys.take("optionsmap")
    labels: dict[int, str] = {}
    for label, node in ((listed and listed.members) or {}).items():
        code = whole(node.text)
        if code is None:
            keys.remarks.append(Remark("option-unclear", f"optionsmap {label}: {node.shown} is no code"))
        elif code in labels:
            keys.remarks.append(Remark("option-doubled", f"optionsmap has {code} for {labels[code]} and for {label}"))
        else:
            labels[code] = label
    several = keys.truth("use_write_multiple")
    more |= {"enum": labelled(labels)} if labels else {}
    more |= _write_multiple() if several else {}
    return Point(name=name, place=place, at=at, type=wire, orders=orders, access="rw", more=more)


def switch(name: str, place: Span, every: int, keys: Keys) -> Point:
    """Return the coil or the bit of a word that a switch is."""
    space = _space(keys, "coil")
    at, more = _at(keys, space), _poll(keys, every)
    _lambdas(keys, "lambda", "write_lambda")
    keys.truth("use_write_multiple")
    point = Point(name=name, place=place, at=at, space=space, access="rw", more=more)
    if space.is_bits:
        return replace(point, type=WireType.BIT, access="rw" if space is Space.COIL else "r")
    return replace(point, bits=_mask(keys, space, 1) or (0, 15), access="rw" if space is Space.HOLDING else "r")


def text_sensor(name: str, place: Span, every: int, keys: Keys) -> Point:
    """Return the text or the bytes of a text sensor."""
    space = _space(keys)
    at, more = _at(keys, space), _poll(keys, every)
    count, size = keys.whole("register_count"), keys.whole("response_size")
    words = count or ((size or 0) + 1) // 2
    if words < 1:
        refuse("register_count", "it has no register_count")
    encoded = keys.text("raw_encode", "ANSI").upper()
    if _lambdas(keys, "lambda"):
        encoded = RAW
    wire = WireType.STRING if encoded in {"ANSI", "NONE"} else WireType.BYTES
    return Point(name=name, place=place, at=at, space=space, type=wire, words=words, more=more)


def output(name: str, place: Span, every: int, keys: Keys) -> Point:
    """Return the register that an output writes: a level of 0 to 1, times `multiply`."""
    space = _space(keys)
    point = number(name, place, every, keys) if not space.is_bits else switch(name, place, every, keys)
    keys.taken.add("type")
    return replace(point, access="w")


Maker = Callable[[str, Span, int, Keys], Point]
MAKERS: Mapping[str, Maker] = {
    "sensor": sensor,
    "binary_sensor": binary_sensor,
    "number": number,
    "select": select,
    "switch": switch,
    "text_sensor": text_sensor,
    "output": output,
}
"""What makes the register of an item, by the list that it stands in."""
