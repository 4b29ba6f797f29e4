"""Ranges, special values and sentinels."""

from collections.abc import Iterable, Iterator
from fractions import Fraction
from itertools import pairwise
from math import ceil, floor

from regscribe.checks.held_values import NUMBERS
from regscribe.checks.representable import HELP_TYPE, Fit, end_values, ends_of, listed, numbers, unfit_limits, values_of
from regscribe.checks.rule import Finding, RuleScope, register_rule
from regscribe.model import Interval, Number, Range, Register, Sentinel, Special, show
from regscribe.reference.settled_scales import Form, forms, widest


@register_rule(
    "RS0435", "Range that is empty at the defaults", "A device is not shipped so that nothing can be written to it."
)
def empty(register: Register, scope: RuleScope) -> Iterator[Finding]:
    """Compare the ends of each interval with all other registers at their defaults; skip what cannot be known."""
    for low, high in scope.ends_at_defaults(register):
        if low is not None and high is not None and low > high:
            message = f"has the range {show(low)}..{show(high)} with all other registers at their defaults"
            yield Finding.at(register, message, "swap the ends, or correct the defaults of the registers they name")


@register_rule(
    "RS0436", "Intervals of a range overlap", "Parts of a union are apart; where they touch, one end was misread."
)
def intervals_overlap(register: Register, _: RuleScope) -> Iterator[Finding]:
    """Compare each interval of a union with the one above it."""
    for case in register.range:
        known = [
            (interval.low, interval.high)
            for interval in case.then.intervals
            if isinstance(interval.low, Number) and isinstance(interval.high, Number)
        ]
        for (low, high), (first, last) in pairwise(sorted(known)):
            if first <= high:
                message = f"has a range whose parts {show(low)}..{show(high)} and {show(first)}..{show(last)} overlap"
                yield Finding.at(register, message, "join the parts or correct an end")


@register_rule(
    "RS0437", "Special values not told apart", "Two special values of one code, id or label cannot both be meant."
)
def specials_twice(register: Register, _: RuleScope) -> Iterator[Finding]:
    """Compare codes, ids and labels of special values."""
    seen: dict[tuple[str, object], Special] = {}
    for one in register.specials:
        for key in (("code", one.code), ("id", one.id), ("label", one.label.casefold())):
            other = seen.setdefault(key, one)
            if other is not one:
                message = (
                    f'has special values {show(other.code)} ("{other.label}") and {show(one.code)} ("{one.label}")'
                )
                yield Finding.at(register, f"{message}, which cannot be told apart", "correct one of them")
                break


@register_rule("RS0438", "Sentinels not told apart", "Two faults of one number or id cannot both be reported.")
def sentinels_twice(register: Register, _: RuleScope) -> Iterator[Finding]:
    """Compare numbers and ids of sentinels."""
    seen: dict[tuple[str, object], Sentinel] = {}
    for one in register.sentinels:
        for key in (("stored", one.stored), ("id", one.id)):
            other = seen.setdefault(key, one)
            if other is not one:
                message = f'has sentinels {other.spelled} ("{other.label}") and {one.spelled} ("{one.label}")'
                yield Finding.at(register, f"{message}, which cannot be told apart", "correct one of them")
                break


@register_rule(
    "RS0439", "Special value is a fault too", "One number cannot be both a setting and the report of a fault."
)
def special_is_sentinel(register: Register, _: RuleScope) -> Iterator[Finding]:
    """Compare sentinels with the stored number of each special value, under every scale."""
    faults = {sentinel.stored for sentinel in register.sentinels}
    every = forms(register) if register.specials and faults else ()
    for special in register.specials if faults else ():
        stored = {form.stored(value) for value in values_of(register, special) for form in every}
        if stored and stored <= faults:
            message = f'has {show(special.code)} as special value "{special.label}" and as a fault'
            yield Finding.at(register, message, "remove one of them")


@register_rule(
    "RS0603",
    "Number with two codes",
    "A number that one special value stands for cannot be the code of another, nor what another stands for.",
)
def meant_by_two(register: Register, _: RuleScope) -> Iterator[Finding]:
    """Compare what special values stand for with each other, and with the codes of those that stand for nothing."""
    for place, special in enumerate(register.specials):
        if special.means is None:
            continue
        shown = f'has {show(special.means)} as what "{special.label}" means'
        for other in register.specials:
            if other.means is None and special.means in values_of(register, other):
                message = f'{shown} and as the code of "{other.label}"'
                yield Finding.at(register, message, "correct the number or the code")
        for other in register.specials[:place]:
            if other.means == special.means:
                message = f'{shown} and as what "{other.label}" means'
                yield Finding.at(register, message, "correct one of the numbers: only one code could be written for it")


@register_rule(
    "RS0423",
    "Default outside the range",
    "Manuals do print such defaults; then the map needs a special value, another range, or a waiver that says why.",
)
def default_outside_range(register: Register, scope: RuleScope) -> Iterator[Finding]:
    """Judge the default with all other registers at theirs; what cannot be known so is not judged."""
    judged = register.beginnings if register.kind in NUMBERS else ()
    named = {special.value for special in register.specials}
    ends = scope.ends_at_defaults(register) if judged else ()
    for what, value in judged if ends else ():
        if isinstance(value, Fraction) and value not in named and not _inside(value, ends):
            text = " or ".join(f"{_end(low)}..{_end(high)}" for low, high in ends)
            message = f"has {what} {show(value)}, outside {text} with all other registers at their defaults"
            yield Finding.at(register, message, f"correct one of them, or add the {what} under `special`")


def _inside(value: Fraction, ends: Iterable[tuple[Fraction | None, Fraction | None]]) -> bool:
    return any((low is None or low <= value) and (high is None or value <= high) for low, high in ends)


def _end(number: Fraction | None) -> str:
    return "open" if number is None else show(number)


@register_rule("RS0424", "Limit outside the type", "A range that is wider than the words was misread, or the type was.")
def limit_outside_type(register: Register, _: RuleScope) -> Iterator[Finding]:
    """Try each numeric limit; ranges that fit nowhere are RS0425's."""
    every = forms(register) if register.range else ()
    for case in register.range:
        outside = unfit_limits(register, case.then, Fit.TOO_LARGE, every)
        if outside and _reachable(widest(register), case.then):
            message = f"has limits {listed(outside)}, outside {ends_of(register)} as scaled"
            yield Finding.at(register, message, HELP_TYPE)


@register_rule(
    "RS0425", "Range that cannot be encoded", "No value of the range has words: nothing could ever be written."
)
def range_outside_type(register: Register, _: RuleScope) -> Iterator[Finding]:
    """Compare each range as a whole with what type and scale reach."""
    reach = widest(register) if register.range else None
    for case in register.range:
        if case.then.intervals and not _reachable(reach, case.then):
            found = listed(list(numbers(case.then)))
            message = f"has a range ({found}) that lies wholly outside {ends_of(register)} as scaled"
            yield Finding.at(register, message, HELP_TYPE)
        elif _only_faults(register, case.then):
            message = "has a range of nothing but numbers by which it reports faults"
            yield Finding.at(register, message, "correct the range or the sentinels")


def _only_faults(register: Register, one: Range) -> bool:
    """Whether all numbers within a range that the base view can spell are faults, under every scale."""
    faults = {number * register.base.factor for number in register.faults}
    if not faults:
        return False
    spelled = [_spelled(register, form, one, interval) for form in forms(register) for interval in one.intervals]
    return all(
        numbers is not None and 0 < numbers.stop - numbers.start <= len(faults) and faults.issuperset(numbers)
        for numbers in spelled
    ) and bool(spelled)


def _spelled(register: Register, form: Form, one: Range, interval: Interval) -> range | None:
    """The whole numbers on the wire within an interval; None where they are not known, or not whole."""
    if not register.base.type.is_integer:
        return None
    if not isinstance(interval.low, Number) or not isinstance(interval.high, Number):
        return None
    ends = [end for limit in (interval.low, interval.high) for end in end_values(one, limit)]
    wire = [form.stored(end) * register.base.factor for end in ends]
    return range(ceil(min(wire)), floor(max(wire)) + 1)


def _reachable(reach: tuple[Fraction, Fraction] | None, one: Range) -> bool:
    """Whether any value of the range lies where type and scale reach; limits that are no numbers are no limits."""
    if reach is None:
        return True
    for interval in one.intervals:
        lows = end_values(one, interval.low) if isinstance(interval.low, Number) else (reach[0],)
        highs = end_values(one, interval.high) if isinstance(interval.high, Number) else (reach[1],)
        if min(lows) <= reach[1] and max(highs) >= reach[0]:
            return True
    return False
