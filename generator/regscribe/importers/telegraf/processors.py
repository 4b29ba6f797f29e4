"""Telegraf's processor `scale`, by which values of the input get an offset."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from fnmatch import fnmatchcase
from fractions import Fraction
from typing import NamedTuple

from regscribe.importers.shared.exact import number
from regscribe.importers.shared.points import Point
from regscribe.importers.shared.reading import unclear_scale
from regscribe.importers.shared.tree import Node


class Scaling(NamedTuple):
    """What is done with the fields of some names in some measurements; factor None: it is not understood."""

    measurements: tuple[str, ...]
    fields: tuple[str, ...]
    factor: Fraction | None
    offset: Fraction


def scalings(root: Node) -> tuple[Scaling, ...]:
    """Return the scalings of all processors, in their order."""
    processors = root.get("processors")
    listed = processors.get("scale") if processors else None
    return tuple(one for processor in (listed.each if listed else ()) for one in _of_processor(processor))


def _of_processor(processor: Node) -> Iterator[Scaling]:
    measurements = _texts(processor.get("namepass"))
    listed = processor.get("scaling")
    for one in listed.each if listed else ():
        factor, offset = number(one.word("factor") or "1"), number(one.word("offset") or "0")
        known = factor is not None and offset is not None and {*(one.members or {})} <= {"factor", "offset", "fields"}
        fields = _texts(one.get("fields"))
        yield Scaling(measurements, fields, factor if known else None, offset or Fraction(0))


def _texts(listed: Node | None) -> tuple[str, ...]:
    return tuple(one.text for one in (listed.each if listed else ()))


def scaled(point: Point, measurement: str, field: str, every: Sequence[Scaling]) -> Point:
    """Return the point with what processors do with its value; raw where one is not understood."""
    for one in every:
        if one.measurements and not any(fnmatchcase(measurement, pattern) for pattern in one.measurements):
            continue
        if not any(fnmatchcase(field, pattern) for pattern in one.fields) or point.multiply is None:
            continue
        if not one.factor:
            why = unclear_scale("a processor scales it in a way that is not understood")
            return replace(point, multiply=None, remarks=(*point.remarks, why))
        point = replace(point, multiply=point.multiply * one.factor, add=point.add * one.factor + one.offset)
    return point
