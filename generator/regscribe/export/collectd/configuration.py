"""A configuration of collectd's modbus plugin that polls every number of one model (docs/export.md is its contract).

The plugin reads a number at a fixed address with a fixed type, scale and shift. What depends on other registers is
therefore worked out for one state of the device: that of its defaults, and of what is said beside them.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from math import isfinite

from regscribe.emit.words import condition_words, one_line, sentinel_words
from regscribe.model import IDENTITY, Kind, Model, Order, Register, RegisterMap, Space, View, WireType
from regscribe.reference import Surroundings, UnknownValueError, holds
from regscribe.reference.surroundings import choose
from regscribe.reference.terms import present_view, straight
from regscribe.reference.words import word_order

NUMBERS = frozenset({Kind.NUMBER, Kind.INTEGER, Kind.RAW, Kind.ENUM, Kind.FLAGS, Kind.FIELDS})
READS = {Space.HOLDING: "ReadHolding", Space.INPUT: "ReadInput"}
TYPES = {
    WireType.INT16: "Int16",
    WireType.UINT16: "Uint16",
    WireType.INT32: "Int32",
    WireType.UINT32: "Uint32",
    WireType.FLOAT32: "Float",
    WireType.INT64: "Int64",
    WireType.UINT64: "Uint64",
}
"""What the plugin calls a type whose most significant word comes first."""

SWAPPED = frozenset({WireType.INT32, WireType.UINT32, WireType.FLOAT32})
"""Types that it also has with the least significant word first, by `LE` behind the name."""

LONGEST_NAME = 127
"""collectd cuts longer names off."""

DECIMALS = 17

EVERY = 10
"""Seconds, as collectd itself polls."""

BAUD = 9600


@dataclass(frozen=True, slots=True, kw_only=True)
class Poll:
    """A device to poll, and the seconds between polls: `host` and `port`, or the serial `device` and its `baud`.

    `name` is what collectd calls the device; blocks of several devices can stand in one file if their names differ.
    """

    name: str
    unit: int
    every: int = EVERY
    host: str = ""
    port: int = 502
    device: str = ""
    baud: int = BAUD


class LeftOutError(Exception):
    """The plugin cannot poll a register; the message says why."""


def collectd_text(register_map: RegisterMap, model: Model, poll: Poll, known: Surroundings) -> str:
    """Return the configuration: one `Data` block for each number, one `Host` that collects them all.

    What is no number for the plugin, or cannot be worked out from `known`, stands in a comment with the reason.
    """
    lines: list[str] = []
    names: list[str] = []
    for register in model.registers:
        if register.kind not in NUMBERS or not register.access.readable:
            continue
        name = f"{poll.name}.{_instance(register)}"  # the plugin knows one set of blocks for all hosts
        try:
            lines += list(_data(name, register, known))
            names.append(name)
        except LeftOutError as why:
            lines.append(f"  # left out: {register.path} - {why}")
    head = f"# {one_line(register_map.title)} {one_line(model.name)} for collectd, from the map {register_map.id}"
    ends = "LoadPlugin modbus", "<Plugin modbus>", "</Plugin>"
    return "\n".join([head, *ends[:2], *lines, *_host(poll, names), ends[2]]) + "\n"


def _data(name: str, register: Register, known: Surroundings) -> Iterator[str]:
    if len(name) > LONGEST_NAME:
        message = f"its name has more than {LONGEST_NAME} characters"
        raise LeftOutError(message)
    if register.page:
        message = "it stands on a page or at another unit id, which the plugin cannot select"
        raise LeftOutError(message)
    _check_existence(register, known)
    view = _view(register)
    scale, shift = _scale(register, view, known)
    kind = TYPES[view.type] + ("LE" if _order(view, known) is Order.LITTLE else "")
    yield f"  <Data {_quoted(name)}>"
    yield from (f"    # no value: {one_line(sentinel_words(each))}" for each in register.sentinels)
    if register.kind is Kind.RAW:
        yield "    # the manual does not state the scale"
    yield f"    RegisterBase {view.address(register.at)}"
    yield f"    RegisterType {kind}"
    yield f"    RegisterCmd {READS[view.space]}"
    yield '    Type "gauge"'
    yield f"    Instance {_quoted(_instance(register))}"
    if scale != 1:
        yield f"    Scale {_decimal(scale)}"
    if shift:
        yield f"    Shift {_decimal(shift)}"
    yield "  </Data>"


def _check_existence(register: Register, known: Surroundings) -> None:
    try:
        exists = holds(register.when, known)
    except UnknownValueError as unknown:
        raise _unknown(unknown, "whether it exists") from None
    if not exists:
        message = f"it exists only while {one_line(condition_words(register.when))}"
        raise LeftOutError(message)


def _view(register: Register) -> View:
    """Return the view to poll: the one that drivers prefer where the plugin has its type, else the first that fits."""
    views = (register.read_view, *(view for view in register.views if view.readable))
    fitting = [
        view for view in views if view.space in READS and view.type in TYPES and view.byte_order is not Order.LITTLE
    ]
    if not fitting:
        base = register.base
        message = f"the plugin does not read {base.type.value} in the {base.space.value} space"
        raise LeftOutError(message)
    return fitting[0]


def _order(view: View, known: Surroundings) -> Order:
    try:
        order = word_order(view, known)
    except UnknownValueError as unknown:
        raise _unknown(unknown, "its word order") from None
    if order is None:
        message = "its word order is not that of any code"
        raise LeftOutError(message)
    if order.bytes is not Order.BIG or not isinstance(order.words, Order):
        message = "the plugin has no such order of words and bytes"
        raise LeftOutError(message)
    if order.words is Order.LITTLE and view.type not in SWAPPED:
        message = f"the plugin has no {view.type.value} with the least significant word first"
        raise LeftOutError(message)
    return order.words


def _scale(register: Register, view: View, known: Surroundings) -> tuple[Fraction, Fraction]:
    """Return factor and summand that turn the number on the wire into the value of use."""
    if register.kind not in {Kind.NUMBER, Kind.INTEGER}:
        return Fraction(1), Fraction(0)
    try:
        line = straight(choose(register.scale, known) if register.scale else IDENTITY, known)
        seen = present_view(view, known)
    except UnknownValueError as unknown:
        raise _unknown(unknown, "its scale") from None
    if line is None or seen is None:
        message = "no scale is stated for this state of the device"
        raise LeftOutError(message)
    return line.slope / Fraction(seen.factor), line.offset


def _unknown(unknown: UnknownValueError, what: str) -> LeftOutError:
    return LeftOutError(f"{what} depends on {unknown}, which has no default: say it by --with or --given")


def _host(poll: Poll, names: list[str]) -> Iterator[str]:
    yield f"  <Host {_quoted(poll.name)}>"
    if poll.device:
        yield f"    Device {_quoted(poll.device)}"
        yield f"    Baudrate {poll.baud}"
    else:
        yield f"    Address {_quoted(poll.host)}"
        yield f'    Port "{poll.port}"'
    yield f"    Interval {poll.every}"
    yield f"    <Slave {poll.unit}>"
    yield from (f"      Collect {_quoted(name)}" for name in names)
    yield "    </Slave>"
    yield "  </Host>"


def _instance(register: Register) -> str:
    """Return the path without brackets, since collectd makes names of files of it."""
    return register.path.replace("[", "_").replace("]", "").replace(".", "_")


def _quoted(text: str) -> str:
    escaped = one_line(text).replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'


def _decimal(number: Fraction) -> str:
    """Return the nearest double without an exponent, which collectd does not read."""
    nearest = float(number)
    text = f"{nearest:.{DECIMALS}f}".rstrip("0").rstrip(".") if isfinite(nearest) else ""
    return min((text, repr(nearest)), key=len) if "e" not in repr(nearest) else text
