"""Intervals of values that can be written to a register in one situation, for tests that draw values from them."""

from collections.abc import Iterator
from fractions import Fraction
from typing import Any

from regscribe.emit.vectors.scale import LARGEST, Scale
from regscribe.model import Kind, Register, View, WireType, show
from regscribe.reference import Surroundings, special_value

Json = dict[str, Any]
CODED = frozenset({Kind.ENUM, Kind.FLAGS, Kind.FIELDS, Kind.BOOLEAN})
TEXTS = frozenset({Kind.STRING, Kind.VERSION})
WIDEST = LARGEST[WireType.FLOAT64]
"""No float holds a value beyond it."""


def domain(register: Register, view: View, scale: Scale | None, known: Surroundings) -> Iterator[Json]:
    """Yield the codes of an enum, or each interval of numbers that are the same when written and read back."""
    if register.kind is Kind.ENUM and register.enum is not None:
        yield from ({"low": str(member.code), "high": str(member.code)} for member in register.enum.members)
    elif scale is not None and register.kind not in CODED | TEXTS:
        line = _line(scale, view) if view.type.is_float else {}
        holes = _holes(register, scale, known)
        for low, high, step in _stretches(register, scale, line):
            inside = [show(value) for value in holes if low <= value <= high]
            found = {"low": show(low), "high": show(high), "step": show(step) if step else "", **line, "except": inside}
            yield {key: value for key, value in found.items() if value}


def _stretches(register: Register, scale: Scale, line: dict[str, str]) -> Iterator[tuple[Fraction, Fraction, Fraction]]:
    """Yield lowest and highest value and the step between values, 0 for none."""
    if register.fractional:
        yield from ((max(low, -WIDEST), min(high, WIDEST), scale.size) for low, high in scale.domain())
    elif not line:  # which whole numbers an IEEE number can carry along a line has no form here
        step, stretches = scale.whole_domain()
        yield from ((low, high, step) for low, high in stretches)


def _line(scale: Scale, view: View) -> dict[str, str]:
    """How a value follows from an IEEE number; nothing where both have the same digits."""
    slope = scale.slope / view.factor
    if scale.offset == 0 and show(slope).replace(".", "").strip("-0") == "1":
        return {}
    return {"slope": show(slope), "offset": show(scale.offset)}


def _holes(register: Register, scale: Scale, known: Surroundings) -> list[Fraction]:
    """Values inside the domain that do not come back: faults, and codes that stand for another number."""
    meant = (special_value(register, special, known) for special in register.specials if special.means is not None)
    return [*map(scale.value, register.faults), *(value for value in meant if value is not None)]
