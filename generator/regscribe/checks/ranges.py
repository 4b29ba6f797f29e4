"""Ranges, special values and sentinels."""

from collections.abc import Iterator
from itertools import pairwise

from regscribe.checks.representable import values_of
from regscribe.checks.rule import Finding, RuleScope, register_rule
from regscribe.model import Number, Register, Sentinel, Special, show
from regscribe.reference.settled_scales import forms


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
