"""Values to write to a register: those worth trying, and the intervals of all that can be written."""

from collections.abc import Iterable, Iterator
from fractions import Fraction
from math import ceil, floor
from typing import Any

from regscribe.emit.vectors.candidates import PATTERNS_OF_BITS, Proposal, codes, with_neighbours
from regscribe.emit.vectors.scale import LARGEST, Scale, range_now
from regscribe.model import Kind, Register, View, WireType, show
from regscribe.reference import Surroundings, existing_members, present_sentinels, special_value
from regscribe_runtime.values.kinds import OCTETS

Json = dict[str, Any]
CODED = frozenset({Kind.ENUM, Kind.FLAGS, Kind.FIELDS, Kind.BOOLEAN})
TEXTS = OCTETS | {Kind.VERSION}
WIDEST = LARGEST[WireType.FLOAT64]
"""No float holds a value beyond it."""
HALF, TENTH = Fraction(1, 2), Fraction(1, 10)
TOO_FINE_FOR_FLOAT32 = Fraction("16777217")
TOO_FINE = Fraction("0.000000001")
BEYOND_FLOAT32 = Fraction(10**39)


def numbers(
    register: Register, view: View, scale: Scale | None, known: Surroundings, *, full: bool
) -> Iterator[Proposal]:
    """Yield numbers to write, accepted and refused ones; the reference tells which is which."""
    if register.kind in CODED:
        yield from _coded(register)
        return
    for what, value in register.beginnings:
        if what == "default" and isinstance(value, Fraction):
            yield Proposal(value, what)
    if scale is None:
        yield Proposal(Fraction(1), "no scale holds")
        return
    if full:
        yield from _special(register, scale, known)
        yield from _around_limits(scale)
        if not scale.limits or None in (end for interval in scale.limits for end in interval):
            yield from _type_ends(view, scale)
    yield from _inside(scale)


def _coded(register: Register) -> Iterator[Proposal]:
    yield from (Proposal(Fraction(0), "zero"), Proposal(Fraction(1), "one"), Proposal(Fraction(-1), "below zero"))
    yield from codes(register)
    if register.kind is Kind.BOOLEAN:
        yield Proposal(Fraction(2), "neither true nor false")
    yield Proposal(Fraction(1 << register.bits), "one bit more than the type has")
    unsigned = register.kind in PATTERNS_OF_BITS
    for stored in register.faults:
        yield Proposal(stored % (1 << register.bits) if unsigned else stored, "how the device reports a fault")


def _special(register: Register, scale: Scale, known: Surroundings) -> Iterator[Proposal]:
    yield Proposal(Fraction(0), "zero")
    for special in register.specials:
        value, note = special.means, f"special: {special.id} stands for this number"
        if value is None:
            value, note = special_value(register, special, known), f"special: {special.id}"
        if value is not None:
            yield from with_neighbours(value, scale.step, note)
    yield from (Proposal(scale.value(stored), "how the device reports a fault") for stored in register.faults)


def _around_limits(scale: Scale) -> Iterator[Proposal]:
    for interval in scale.limits:
        for end, name, outward in zip(interval, ("lowest", "highest"), (-1, 1), strict=True):
            if end is None:
                continue
            yield Proposal(end, f"{name} of the range")
            yield Proposal(end + outward * scale.step, f"one step beyond the {name}")
            yield Proposal(end - outward * scale.step, f"one step inside the {name}")


def _type_ends(view: View, scale: Scale) -> Iterator[Proposal]:
    for stored, name, outward in ((scale.lowest, "lowest", -1), (scale.highest, "highest", 1)):
        yield Proposal(scale.value(stored), f"{name} that the view carries")
        yield Proposal(scale.value(stored + outward * (scale.wire_step or 1)), f"beyond what the view carries ({name})")
    if view.type.is_float:
        yield Proposal(scale.value(TOO_FINE_FOR_FLOAT32), "finer than a float32")
        yield Proposal(scale.value(BEYOND_FLOAT32), "larger than a float32")


def _inside(scale: Scale) -> Iterator[Proposal]:
    for low, high in scale.domain():
        middle = _on_step(scale, low + (high - low) * 3 / 7)
        yield Proposal(middle, "inside")
        yield Proposal(middle + scale.step * HALF, "half a step off")
        yield Proposal(middle + scale.step * TENTH, "a tenth of a step off")
        if not scale.wire_step:
            yield Proposal(middle + TOO_FINE, "finer than a float32")


def _on_step(scale: Scale, value: Fraction) -> Fraction:
    step = scale.step
    return scale.offset + step * int((value - scale.offset) / step)


def rounded(scale: Scale) -> Iterator[Proposal]:
    """Yield values between two steps, above and below zero where the range has both, for writes that may round."""
    for low, high in scale.domain():
        for middle in sorted({_on_step(scale, low + (high - low) * part) for part in (Fraction(1, 5), Fraction(4, 5))}):
            yield Proposal(middle + scale.step * HALF, "half a step: the rule decides")
            yield Proposal(middle + scale.step * Fraction(49, 100), "less than half a step")
            yield Proposal(middle + scale.step * Fraction(51, 100), "more than half a step")


def domain(register: Register, view: View, scale: Scale | None, known: Surroundings) -> Iterator[Json]:
    """Yield the codes of an enum, or each interval of numbers that are the same when written and read back."""
    if register.enum is not None:
        yield from ({"low": str(one.code), "high": str(one.code)} for one in existing_members(register, known))
    elif scale is not None and register.kind not in CODED | TEXTS and _may_be_written(register, known):
        line = _line(scale, view)
        holes = _holes(register, scale, known)
        for low, high, step in _faultless(register, scale, known, _stretches(register, scale, line)):
            inside = [show(value) for value in holes if low <= value <= high]
            found = {"low": show(low), "high": show(high), "step": step, **line, "except": inside}
            yield {key: value for key, value in found.items() if value}


def _may_be_written(register: Register, known: Surroundings) -> bool:
    """Whether numbers are taken now: a range of which no case holds takes none."""
    return not register.range or range_now(register, known) is not None


def _stretches(register: Register, scale: Scale, line: dict[str, str]) -> Iterator[tuple[Fraction, Fraction, str]]:
    """Yield lowest and highest value and the step between values, empty for none."""
    if register.fractional:
        step = show(scale.size) if scale.size else ""
        inner = (scale.on_steps(max(low, -WIDEST), min(high, WIDEST)) for low, high in scale.domain())
        yield from ((low, high, step) for low, high in inner if low <= high)
    elif not line:  # which whole numbers an IEEE number can carry along a line has no form here
        whole_step, stretches = scale.whole_domain()
        yield from ((low, high, show(whole_step)) for low, high in stretches)


def _faultless(
    register: Register, scale: Scale, known: Surroundings, stretches: Iterable[tuple[Fraction, Fraction, str]]
) -> Iterable[tuple[Fraction, Fraction, str]]:
    """Return the stretches without the intervals of numbers that are faults."""
    for sentinel in present_sentinels(register, known):
        if sentinel.high is not None and sentinel.ends is not None:
            low, high = sorted(scale.value(Fraction(end)) for end in sentinel.ends)
            stretches = [part for stretch in stretches for part in _beside(low, high, scale.step, stretch)]
    return stretches


def _beside(
    low: Fraction, high: Fraction, least: Fraction, stretch: tuple[Fraction, Fraction, str]
) -> Iterator[tuple[Fraction, Fraction, str]]:
    """Yield what of a stretch lies below and above an interval."""
    first, last, step = stretch
    size = Fraction(step) if step else least
    below = min(last, first + size * (ceil((low - first) / size) - 1))
    above = max(first, first + size * (floor((high - first) / size) + 1))
    yield from ((one, other, step) for one, other in ((first, below), (above, last)) if one <= other)


def _line(scale: Scale, view: View) -> dict[str, str]:
    """How a value follows from an IEEE number; nothing where both have the same digits, or for other numbers."""
    slope = scale.slope / view.factor
    if not view.type.is_float or (scale.offset == 0 and show(slope).replace(".", "").strip("-0") == "1"):
        return {}
    return {"slope": show(slope), "offset": show(scale.offset)}


def _holes(register: Register, scale: Scale, known: Surroundings) -> list[Fraction]:
    """Values inside the domain that do not come back: faults, and codes that stand for another number."""
    meant = (special_value(register, special, known) for special in register.specials if special.means is not None)
    return [*map(scale.value, register.faults), *(value for value in meant if value is not None)]
