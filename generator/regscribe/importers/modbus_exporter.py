"""The importer of modbus_exporter's configuration: each metric of a module is a register.

The first digit of an address is the function that reads: 3 is a holding register and 4 an input register.
"""

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from typing import Any

from regscribe.dialects import ABCD, DCBA, read_back
from regscribe.dialects.modbus_exporter import BOOL, ENDIANNESS, FUNCTIONS, TYPES
from regscribe.dialects.prometheus import BASE_UNITS
from regscribe.draft import Draft
from regscribe.draft.labels import described
from regscribe.importers.shared.document import Collecting, chosen, has, reads, text_of
from regscribe.importers.shared.points import Point
from regscribe.importers.shared.read_yaml import read_yaml
from regscribe.importers.shared.reading import Keys, refuse
from regscribe.importers.shared.tree import Node, TreeError
from regscribe.model import Space, Span, WireType
from regscribe.plugins import Likeness, Option

name = "modbus-exporter"
summary = "a module of the Prometheus exporter modbus_exporter"
options = (Option("module", "name of the module; needed where there are several.", metavar="NAME"),)

SPACES = read_back(FUNCTIONS)
BY_TYPE = read_back(TYPES)
BY_ENDIANNESS = read_back(ENDIANNESS)
UNITS = {unit.suffix: symbol for symbol, unit in reversed([*BASE_UNITS.items()]) if unit.factor == 1}
"""Base units by the ends of names, as Prometheus has them."""
SHOWN = frozenset({"name", "metricType"})


def likeness(data: bytes, name: str) -> Likeness:  # noqa: ARG001 - the contract of importers
    """Surely, by modules with metrics that have a dataType."""
    found = has(data, r"^modules\s*:", r"^\s+metrics\s*:", r"^\s+(- )?dataType\s*:")
    return Likeness.SURE if found else Likeness.NO


@reads
def read(data: bytes, name: str, options: Mapping[str, str]) -> Draft:
    """Return the registers of one module. Raises OptionError where it is not clear which."""
    root, doubled = read_yaml(text_of(data))
    listed = root.get("modules")
    modules = {one.word("name") or f"module {at}": one for at, one in enumerate(listed.each if listed else (), start=1)}
    if not modules:
        raise TreeError(root.line, "there is no list `modules`", "is this a configuration of modbus_exporter?")
    module = modules[chosen("module", options.get("module", ""), [*modules], "module")]
    found = Collecting(name, SHOWN)
    found.doubled(doubled)
    metrics = module.get("metrics")
    for metric in metrics.each if metrics else ():
        called = _called(metric)
        found.add(called, metric, partial(_metric, called, found.place(metric)), group="Metrics")
    if any(isinstance(item, Point) and item.unit for item in found.items):
        found.stated.append("units are those in which the names of metrics end, as Prometheus wants it")
    told = ", ".join(key for key in module.members or {} if key not in {"name", "metrics"})
    found.stated += [f"how the module polls is no fact of a map: {told}"] if told else []
    return found.draft(title=module.word("name"))


def _called(metric: Node) -> str:
    """The name of a metric with the values of its labels, which tell metrics of one name apart."""
    labels = metric.get("labels")
    values = [one.text for one in ((labels and labels.members) or {}).values()]
    return " ".join([metric.word("name") or "unnamed", *values])


def _metric(name: str, place: Span, keys: Keys) -> Point:
    space, at = _place(keys)
    keys.taken.add("labels")
    more: dict[str, Any] = {**described(name, keys.text("help"))}
    point = Point(name=name, place=place, at=at, space=space, unit=_unit(keys.text("name")), more=more)
    told = keys.text("dataType")
    if space.is_bits:
        keys.taken |= {"bitOffset", "endianness"}
        return replace(point, type=WireType.BIT, unit="")
    orders = keys.choice("endianness", BY_ENDIANNESS, "big")
    if told == BOOL:
        bit = keys.whole("bitOffset")
        if bit is None:
            refuse("bitOffset", "a bool has no bitOffset")
        return replace(point, bits=(bit, bit), unit="")
    wire = keys.choice("dataType", BY_TYPE)
    factor = keys.scale("factor")
    if factor == 0:
        refuse("factor", "factor 0")
    turned = ABCD if wire.words == 1 and orders != DCBA else orders  # only `little` turns the bytes of one word
    return replace(point, type=wire, orders=turned, multiply=factor)


def _unit(metric: str) -> str:
    """The base unit that the name of a metric ends in, before `_total`; empty where it names none."""
    words = metric.removesuffix("_total").split("_")
    ends = ("_".join(words[-count:]) for count in range(min(len(words) - 1, 2), 0, -1))
    return next((UNITS[end] for end in ends if end in UNITS), "")


def _place(keys: Keys) -> tuple[Space, int]:
    """The space by the first digit, and the wire address by the others. Raises LeftOutError."""
    text = keys.text("address")
    if not text.isdecimal() or text[0] not in SPACES or len(text) == 1:
        refuse("address", f"address `{text}` is not a digit of {', '.join(SPACES)} and a wire address")
    return SPACES[text[0]], int(text[1:])
