"""The module: a metric for each number and each named bit, by the conventions of Prometheus."""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from decimal import Decimal
from fractions import Fraction
from typing import Any

from regscribe import files
from regscribe.dialects import DCBA
from regscribe.dialects.modbus_exporter import BOOL, ENDIANNESS, FUNCTIONS, TYPES
from regscribe.dialects.prometheus import BASE_UNITS, BaseUnit
from regscribe.emit.words import one_line
from regscribe.export.device import Device, Point
from regscribe.export.device.names import Names
from regscribe.export.device.numbers import decimal, is_exact
from regscribe.losses import Grade
from regscribe.model import BitField, Kind, Order, show
from regscribe.model.identifiers import module_names, opened, snake
from regscribe.plugins import OptionError

Metric = dict[str, Any]

WORD = 16
EXACT_BITS = 53
INDEX = re.compile(r"([^.\[\]]+)\[(\d+)\]")
RESERVED = re.compile(r"_(total|count|sum|bucket|info|created)$")
"""Ends of names that mean something else to Prometheus."""

TYPE_WORDS = re.compile(r"_(counter|gauge|histogram|summary|untyped)(?=_|$)")
"""Types have no place in a name."""


@dataclass(frozen=True, slots=True)
class _Metrics:
    """Makes the metrics of a device; elements of an array have one name, and their index as a label."""

    device: Device
    names: Names = field(default_factory=Names)
    known: dict[str, str] = field(default_factory=dict)
    helps: dict[str, str] = field(default_factory=dict)

    def of(self, point: Point) -> Iterator[Metric]:
        """Yield the metrics of a point: its number, and each of its named bits."""
        flags = [one for one in point.fields if one.is_flag]
        if len(flags) < len(point.fields) or not point.fields:
            yield self._number(point)
        for flag in flags:
            help_ = f"{_name(point)}: {flag.label}"
            yield self._named(point, f".{flag.id}", "", help_) | _bit(point, flag)

    def _number(self, point: Point) -> Metric:
        unit = _base_unit(self.device, point)
        if point.offset:
            done = f"the number on the wire is exported, without unit: {show(point.slope)} times it"
            self.device.lose(point.register, "offset", Grade.WRONG, f"{done} and {show(point.offset)} is the value")
        factor = Fraction(1) if point.offset else point.slope * unit.factor
        if point.register.kind is Kind.BOOLEAN:
            self.device.lose(point.register, "truth-of-words", Grade.LOST, "any other number is told as it is")
        if not is_exact(factor):
            done = f"{decimal(factor)} for {show(factor)}"
            self.device.lose(point.register, "scale-rounded", Grade.COSMETIC, done)
        if point.wire.type.is_integer and point.wire.type.bits > EXACT_BITS:
            done = f"a double has the number: beyond {EXACT_BITS} bits the last digits are lost"
            self.device.lose(point.register, "precision-float64", Grade.LOST, done)
        suffix = "raw" if point.offset else unit.suffix
        metric = self._named(point, "", suffix, _help(self.device, point)) | _place(point, 0)
        metric |= {"dataType": TYPES[point.wire.type], "endianness": _endianness(point)}
        return metric | {"metricType": "gauge"} | ({} if factor == 1 else {"factor": Decimal(decimal(factor))})

    def _named(self, point: Point, part: str, suffix: str, help_: str) -> Metric:
        family = opened(point.path) + part
        if family not in self.known:
            prefix = module_names(self.device.register_map.id)[1]
            path = snake(family)
            bare = "_".join(filter(None, (prefix, path, "" if f"_{path}".endswith(f"_{suffix}") else suffix)))
            plain = RESERVED.sub(r"_\1_value", TYPE_WORDS.sub(r"_\1s", bare))
            self.known[family] = self.names.give(plain)
        labels = {snake(name): number for name, number in INDEX.findall(point.path)}
        said = self.helps.setdefault(family, one_line(help_))  # samples of one name have one help
        return {"name": self.known[family], "help": said} | ({"labels": labels} if labels else {})


def module(device: Device) -> str:
    """Return the module as YAML."""
    place = device.place
    if not place.host:
        message = (
            f"--at {place.device}: modbus_exporter asks devices on TCP only; write HOST:PORT, perhaps of a gateway"
        )
        raise OptionError(message)
    metrics = _Metrics(device)
    pause = device.register_map.protocol.pause
    said = {
        "name": device.name,
        "protocol": "tcp/ip",
        "workarounds": {"scrapeInterludeWait": f"{show(pause)}ms"} if pause else {},
        "metrics": [metric for point in device.points for metric in metrics.of(point)],
    }
    asked = f"target {place.host}:{place.port}, sub_target {device.request.unit}, module {device.name}"
    remarks = (*device.heading, f"asked by: {asked}")
    return files.dump({"modules": [{key: value for key, value in said.items() if value}]}, remarks=remarks)


def _place(point: Point, further: int) -> Metric:
    return {"address": int(f"{FUNCTIONS[point.wire.space]}{point.address + further:05d}")}


def _endianness(point: Point) -> str:
    """Of one word `mixed` turns nothing: its bytes are turned by `little`."""
    wire = point.wire
    turned = DCBA if wire.type.words == 1 and wire.bytes is Order.LITTLE else (wire.words, wire.bytes)
    return ENDIANNESS[turned]  # type: ignore[index]  # only what fits is here


def _bit(point: Point, flag: BitField) -> Metric:
    """Where a flag is: bits are taken of one word, whose bytes are never turned."""
    word, bit = divmod(flag.low, WORD)
    further = word if point.wire.words is Order.LITTLE else point.words - 1 - word
    turned = (bit + WORD // 2) % WORD if point.wire.bytes is Order.LITTLE else bit
    return _place(point, further) | {"dataType": BOOL, "bitOffset": turned, "metricType": "gauge"}


def _base_unit(device: Device, point: Point) -> BaseUnit:
    if not point.unit:
        return BaseUnit("", Fraction(1))
    found = BASE_UNITS.get(point.unit)
    if found is not None and not point.offset:
        if found.factor != 1:
            device.lose(point.register, "unit-base", Grade.COSMETIC, f"{point.unit} is exported in {found.suffix}")
        return found
    if found is None:
        device.lose(point.register, "unit-unmapped", Grade.COSMETIC, f"{point.unit} is no unit of Prometheus")
    return BaseUnit(snake(point.unit), Fraction(1))


def _name(point: Point) -> str:
    """What the manual calls a register, without the index of its element, which is a label."""
    said = point.register.name
    for index in point.register.index:
        said = re.sub(rf"\s*\b{index}\b", "", said, count=1)
    return said or point.register.name


def _help(device: Device, point: Point) -> str:
    register = point.register
    codes = ", ".join(f"{one.code} = {one.label}" for one in point.members)
    if codes:
        device.lose(register, "enum", Grade.COSMETIC, "labels stand in the help text, the value is the code")
    unit = f" in {point.unit}" if point.unit else ""
    value = f"{show(point.slope)} times this and {show(point.offset)} is the value{unit}" if point.offset else ""
    return "; ".join(filter(None, (_name(point), register.description, codes, value)))
