"""Scales and resolution: factors of zero, numbers that a float cannot tell apart, values between two steps."""

from collections.abc import Iterator
from fractions import Fraction

from regscribe.checks.held_values import NUMBERS, too_fine, wrong_sort
from regscribe.checks.representable import Fit, listed, unfit_limits
from regscribe.checks.rule import Problem, RuleScope, register_rule
from regscribe.model import Register, WireType
from regscribe.reference.settled_scales import Form, forms


@register_rule("RS0430", "Scale of zero")
def scale_of_zero(register: Register, _: RuleScope) -> Iterator[Problem]:
    """A factor of 0 makes every value the same and can never be undone."""
    if any(case.then.multiply == 0 for case in register.scale):
        yield "has a scale that multiplies by 0", "correct `multiply`, or `from` and `to`"
    for view in register.views:
        if view.factor == 0:
            yield f"has view {view.name} with factor 0", "correct the view's `factor`"


@register_rule("RS0604", "Scale beyond a float")
def beyond_a_float(register: Register, _: RuleScope) -> Iterator[Problem]:
    """A program reads numbers as floats of 64 bits; what these cannot tell apart, or hold, was misread."""
    for form in forms(register) if register.kind in NUMBERS else ():
        if not _differ(form, register.base.type):
            message = "has a scale that makes one float of all its numbers, or more than a float can hold"
            yield message, "correct `multiply` and `add`, or `from` and `to`"
            return


def _differ(form: Form, wire: WireType) -> bool:
    """Whether a conversion makes different floats of stored numbers; the ends come first, as they mostly differ."""
    ends = (wire.minimum, wire.maximum) if wire.is_integer else (-1, 1)
    floats = (_as_float(form, stored) for stored in (*ends, 0, 1))
    held = (number for number in floats if number is not None)
    first = next(held, None)
    return any(number != first for number in held)


def _as_float(form: Form, stored: int) -> float | None:
    try:
        return float(form.used(stored))
    except OverflowError:
        return None


@register_rule("RS0432", "Number finer than the resolution")
def between_steps(register: Register, _scope: RuleScope) -> Iterator[Problem]:
    """A default or limit between two steps can never be read or written: a decimal is missing, or one too many."""
    every = forms(register) if register.range else ()
    fine = [
        value
        for _, value in register.beginnings
        if isinstance(value, Fraction) and not wrong_sort(register, value) and too_fine(register, value)
    ]
    fine += [limit for case in register.range for limit in unfit_limits(register, case.then, Fit.TOO_FINE, every)]
    if fine:
        message = f"has default or limits that its words cannot spell exactly: {listed(list(dict.fromkeys(fine)))}"
        yield message, "correct the number, the scale or the decimals"
