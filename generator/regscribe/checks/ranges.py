"""Ranges, special values and sentinels."""

from collections.abc import Iterator
from fractions import Fraction
from itertools import combinations

from regscribe.checks.registry import Finding, Scope, register_rule
from regscribe.model import Interval, Number, Register, Rule, show
from regscribe.model.reference import RefusedError, UnknownValueError, choose, limits


def _numeric(interval: Interval) -> bool:
    return isinstance(interval.low, Number) and isinstance(interval.high, Number)


def _text(interval: Interval) -> str:
    ends = (interval.low, interval.high)
    return "..".join(show(end.value) if isinstance(end, Number) else "?" for end in ends)


@register_rule(
    Rule(
        "RS0435", "Range that is empty at the defaults", "A device is not shipped so that nothing can be written to it."
    )
)
def empty(register: Register, scope: Scope) -> Iterator[Finding]:
    """Compare the ends of each interval with all other registers at their defaults; skip what cannot be known."""
    try:
        now = choose(register.range, scope.defaults)
        ends = limits(now, scope.defaults) if now else ()
    except (UnknownValueError, RefusedError):
        return
    for low, high in ends:
        if low is not None and high is not None and low > high:
            message = f"has the range {show(low)}..{show(high)} with all other registers at their defaults"
            yield Finding.at(register, message, "swap the ends, or correct the defaults of the registers they name")


@register_rule(
    Rule("RS0436", "Intervals of a range overlap", "Parts of a union are apart; where they touch, one end was misread.")
)
def intervals_overlap(register: Register, _: Scope) -> Iterator[Finding]:
    """Compare the intervals of each union in pairs (unions are short)."""
    for case in register.range:
        for one, other in combinations(filter(_numeric, case.then.intervals), 2):
            if _value(one.low) <= _value(other.high) and _value(other.low) <= _value(one.high):
                message = f"has a range whose parts {_text(one)} and {_text(other)} overlap"
                yield Finding.at(register, message, "join the parts or correct an end")


def _value(limit: object) -> Fraction:
    return limit.value if isinstance(limit, Number) else Fraction(0)


@register_rule(
    Rule("RS0437", "Special values not told apart", "Two special values of one code, id or label cannot both be meant.")
)
def specials_twice(register: Register, _: Scope) -> Iterator[Finding]:
    """Compare codes, ids and labels of special values."""
    for one, other in combinations(register.specials, 2):
        if one.code == other.code or one.id == other.id or one.label.casefold() == other.label.casefold():
            message = f'has special values {show(one.code)} ("{one.label}") and {show(other.code)} ("{other.label}")'
            yield Finding.at(register, f"{message}, which cannot be told apart", "correct one of them")


@register_rule(Rule("RS0438", "Sentinels not told apart", "Two faults of one number or id cannot both be reported."))
def sentinels_twice(register: Register, _: Scope) -> Iterator[Finding]:
    """Compare numbers and ids of sentinels."""
    for one, other in combinations(register.sentinels, 2):
        if one.stored == other.stored or one.id == other.id:
            message = f'has sentinels {show(one.stored)} ("{one.label}") and {show(other.stored)} ("{other.label}")'
            yield Finding.at(register, f"{message}, which cannot be told apart", "correct one of them")


@register_rule(
    Rule("RS0439", "Special value is a fault too", "One number cannot be both a setting and the report of a fault.")
)
def special_is_sentinel(register: Register, _: Scope) -> Iterator[Finding]:
    """Compare special values with sentinels where the scale leaves numbers as they are stored."""
    if any(case.then.multiply != 1 or case.then.add or case.then.decimals for case in register.scale):
        return
    faults = {sentinel.stored: sentinel for sentinel in register.sentinels}
    for special in register.specials:
        if special.code in faults:
            message = f'has {show(special.code)} as special value "{special.label}" and as a fault'
            yield Finding.at(register, message, "remove one of them")
