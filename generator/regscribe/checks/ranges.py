"""Ranges, special values and sentinels."""

from collections.abc import Iterator
from fractions import Fraction
from itertools import chain, combinations, pairwise
from math import ceil, floor

from regscribe.checks.held_values import NUMBERS
from regscribe.checks.representable import (
    HELP_TYPE,
    Fit,
    end_values,
    listed,
    numbers,
    reach_of,
    unfit_limits,
    values_of,
)
from regscribe.checks.rule import Problem, RuleScope, doubled, register_rule
from regscribe.model import Cases, Interval, Number, Range, Register, Sentinel, show
from regscribe.reference import RefusedError, UnknownValueError, choose, limits, within
from regscribe.reference.limits import Limits
from regscribe.reference.settled_scales import Form, forms, widest


@register_rule("RS0435", "Range that is empty at the defaults")
def empty(register: Register, scope: RuleScope) -> Iterator[Problem]:
    """A device is not shipped so that nothing can be written to it."""
    for low, high in chain(*(_limits_at_defaults(cases, scope) for cases in _all_of(register))):
        if low is not None and high is not None and low > high:
            message = f"has the range {show(low)}..{show(high)} with all other registers at their defaults"
            yield message, "swap the ends, or correct the defaults of the registers they name"


@register_rule("RS0436", "Intervals of a range overlap")
def intervals_overlap(register: Register, _: RuleScope) -> Iterator[Problem]:
    """Parts of a union are apart; where they touch, one end was misread."""
    for case in chain(*_all_of(register)):
        numeric = [
            (low, high) for low, high in case.then.intervals if isinstance(low, Number) and isinstance(high, Number)
        ]
        for (low, high), (first, last) in pairwise(sorted(numeric)):
            if first <= high:
                message = f"has a range whose parts {show(low)}..{show(high)} and {show(first)}..{show(last)} overlap"
                yield message, "join the parts or correct an end"


@register_rule("RS0437", "Special values not told apart")
def specials_twice(register: Register, _: RuleScope) -> Iterator[Problem]:
    """Two special values of one code, id or label cannot both be meant."""
    for other, one in doubled(
        register.specials, lambda one: (("code", one.code), ("id", one.id), ("label", one.label.casefold()))
    ):
        message = f'has special values {show(other.code)} ("{other.label}") and {show(one.code)} ("{one.label}")'
        yield f"{message}, which cannot be told apart", "correct one of them"


@register_rule("RS0438", "Sentinels not told apart")
def sentinels_twice(register: Register, _: RuleScope) -> Iterator[Problem]:
    """Two faults of one number or id cannot both be reported."""
    for other, one in combinations(register.sentinels, 2):
        if one.when != other.when or not (one.id == other.id or _meet(one, other)):
            continue
        message = f'has sentinels {other.spelled} ("{other.label}") and {one.spelled} ("{one.label}")'
        yield f"{message}, which cannot be told apart", "correct one of them"


SPECIAL_OR_FAULT = (
    "`sentinels` if it says that there is no value (reading it raises an error), `special` if it is a value with a name"
)


def _meet(one: Sentinel, other: Sentinel) -> bool:
    """Whether a number is both faults."""
    if one.ends is None or other.ends is None:
        return one.ends == other.ends
    return one.ends[0] <= other.ends[1] and other.ends[0] <= one.ends[1]


@register_rule("RS0439", "Special value is a fault too")
def special_is_sentinel(register: Register, _: RuleScope) -> Iterator[Problem]:
    """One number cannot be both a setting and the report of a fault."""
    every = forms(register) if register.specials and register.sentinels else ()
    for special in register.specials if register.sentinels else ():
        stored = [form.stored(value) for value in values_of(register, special) for form in every]
        if stored and all(map(register.is_fault, stored)):
            message = f'has {show(special.code)} as special value "{special.label}" and as a fault'
            yield message, f"remove one of them: {SPECIAL_OR_FAULT}"


@register_rule("RS0670", "Special value at the end of what is only read", warns=True)
def special_reports(register: Register, _: RuleScope) -> Iterator[Problem]:
    """A special value is a value: programs get it and compute on. A code that says that there is none is a sentinel."""
    wire = register.base.type
    if register.access.writable or not wire.is_integer or len(register.scale) > 1:
        return
    for special in register.specials:
        if {form.stored(special.code) for form in forms(register)} & {wire.minimum or wire.maximum, wire.maximum}:
            message = f'has special value {show(special.code)} ("{special.label}"), the last that {wire} can spell'
            yield message, f"{SPECIAL_OR_FAULT}; waive this if it is a value"


@register_rule("RS0603", "Number with two codes")
def meant_by_two(register: Register, _: RuleScope) -> Iterator[Problem]:
    """A number that one special value stands for cannot be the code of another, nor what another stands for."""
    for place, special in enumerate(register.specials):
        if special.means is None:
            continue
        shown = f'has {show(special.means)} as what "{special.label}" means'
        for other in register.specials:
            if other.means is None and special.means in values_of(register, other):
                yield f'{shown} and as the code of "{other.label}"', "correct the number or the code"
        for other in register.specials[:place]:
            if other.means == special.means:
                message = f'{shown} and as what "{other.label}" means'
                yield message, "correct one of the numbers: only one code could be written for it"


@register_rule("RS0423", "Default outside the range")
def default_outside_range(register: Register, scope: RuleScope) -> Iterator[Problem]:
    """Manuals do print such defaults; then the map needs a special value, another range, or a waiver that says why."""
    named = [(special.value, special.value) for special in register.specials]
    for what, value in register.beginnings if register.kind in NUMBERS else ():
        for ends in (_limits_at_defaults(cases, scope) for cases in _all_of(register)):
            if not ends or not isinstance(value, Fraction) or within((*ends, *named), value):
                continue
            parts = [["open" if end is None else show(end) for end in part] for part in ends]
            text = " or ".join(map("..".join, parts))
            message = f"has {what} {show(value)}, outside {text} with all other registers at their defaults"
            yield message, f"correct one of them, or add the {what} under `special`"


def _all_of(register: Register) -> tuple[Cases[Range], Cases[Range]]:
    """What may be written to a register, and what may be read of it."""
    return register.range, register.valid


def _limits_at_defaults(cases: Cases[Range], scope: RuleScope) -> Limits:
    """The limits of a register with all other registers at their defaults; none where they are not known."""
    try:
        now = choose(cases, scope.at_defaults)
        return limits(now, scope.at_defaults) if now else ()
    except (UnknownValueError, RefusedError):
        return ()


@register_rule("RS0424", "Limit outside the type")
def limit_outside_type(register: Register, _: RuleScope) -> Iterator[Problem]:
    """A range that is wider than the words was misread, or the type was."""
    every = forms(register) if register.range or register.valid else ()
    for case in chain(*_all_of(register)):
        outside = unfit_limits(register, case.then, Fit.TOO_LARGE, every)
        if outside and _reachable(widest(register), case.then):
            yield f"has limits {listed(outside)}, outside {reach_of(register)}", HELP_TYPE


@register_rule("RS0425", "Range that cannot be encoded")
def range_outside_type(register: Register, _: RuleScope) -> Iterator[Problem]:
    """No value of the range has words: nothing could ever be written."""
    reach = widest(register) if register.range or register.valid else None
    for case in chain(*_all_of(register)):
        if case.then.intervals and not _reachable(reach, case.then):
            found = listed(list(numbers(case.then)))
            yield f"has a range ({found}) that lies wholly outside {reach_of(register)}", HELP_TYPE
        elif _only_faults(register, case.then):
            yield "has a range of nothing but numbers by which it reports faults", "correct the range or the sentinels"


def _only_faults(register: Register, one: Range) -> bool:
    """Whether all numbers within a range that the base view can spell are faults, under every scale."""
    if not register.faults:
        return False
    spelled = [_spelled(register, form, one, interval) for form in forms(register) for interval in one.intervals]
    faults = [
        sorted(Fraction(end * register.base.factor) for end in each.ends) for each in register.sentinels if each.ends
    ]
    return bool(spelled) and all(each and _covered(each, faults) for each in spelled)


def _covered(numbers: range, stretches: list[list[Fraction]]) -> bool:
    """Whether every whole number lies in one of the stretches."""
    at = numbers.start
    for low, high in sorted(stretches):
        if low <= at:
            at = max(at, floor(high) + 1)
    return at >= numbers.stop


def _spelled(register: Register, form: Form, one: Range, interval: Interval) -> range:
    """The whole numbers on the wire within an interval; empty where they are not known, or not whole."""
    numeric = [limit for limit in (interval.low, interval.high) if isinstance(limit, Number)]
    if len(numeric) != len(interval) or not register.base.type.is_integer:
        return range(0)
    ends = [end for limit in numeric for end in end_values(one, limit)]
    wire = [form.stored(end) * register.base.factor for end in ends]
    return range(ceil(min(wire)), floor(max(wire)) + 1)


def _reachable(reach: tuple[Fraction, Fraction] | None, one: Range) -> bool:
    """Whether any value of the range lies where type and scale reach; limits that are no numbers do not count."""
    if reach is None:
        return True
    for interval in one.intervals:
        lows = end_values(one, interval.low) if isinstance(interval.low, Number) else (reach[0],)
        highs = end_values(one, interval.high) if isinstance(interval.high, Number) else (reach[1],)
        if min(lows) <= reach[1] and max(highs) >= reach[0]:
            return True
    return False
