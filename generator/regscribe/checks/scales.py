"""Scales and resolution."""

from collections.abc import Iterator
from fractions import Fraction
from itertools import islice

from regscribe.checks.held_values import NUMBERS, too_fine, wrong_sort
from regscribe.checks.representable import Fit, listed, unfit_limits
from regscribe.checks.rule import Finding, RuleScope, register_rule
from regscribe.model import Register
from regscribe.reference.settled_scales import Form, forms


@register_rule("RS0430", "Scale of zero", "A factor of 0 makes every value the same and can never be undone.")
def scale_of_zero(register: Register, _: RuleScope) -> Iterator[Finding]:
    """Look at the factor of every case and every view."""
    if any(case.then.multiply == 0 for case in register.scale):
        yield Finding.at(register, "has a scale that multiplies by 0", "correct `multiply`, or `from` and `to`")
    for view in register.views:
        if view.factor == 0:
            yield Finding.at(register, f"has view {view.name} with factor 0", "correct the view's `factor`")


@register_rule(
    "RS0604",
    "Scale beyond a float",
    "A program reads numbers as floats of 64 bits; what these cannot tell apart, or hold, was misread.",
)
def beyond_a_float(register: Register, _: RuleScope) -> Iterator[Finding]:
    """Look for two stored numbers that are two floats, under every scale."""
    for form in forms(register) if register.kind in NUMBERS else ():
        if not _differ(_as_float(form, stored) for stored in (*_ends(register), 0, 1)):
            message = "has a scale that makes one float of all its numbers, or more than a float can hold"
            yield Finding.at(register, message, "correct `multiply` and `add`, or `from` and `to`")
            return


def _ends(register: Register) -> tuple[int, int]:
    return (register.base.type.minimum, register.base.type.maximum) if register.base.type.is_integer else (-1, 1)


def _differ(found: Iterator[float | None]) -> bool:
    """Whether two of them are different numbers; the ends come first, and mostly are."""
    known = [one for one in islice(found, 2) if one is not None]
    return len({*known}) > 1 or len({*known, *found} - {None}) > 1


def _as_float(form: Form, stored: int) -> float | None:
    try:
        return float(form.used(stored))
    except OverflowError:
        return None


@register_rule(
    "RS0432",
    "Number finer than the resolution",
    "A default or limit between two steps can never be read or written: a decimal is missing, or one too many.",
)
def between_steps(register: Register, _scope: RuleScope) -> Iterator[Finding]:
    """Try the default and the numeric limits in every view under every scale."""
    every = forms(register) if register.range else ()
    fine = list(_fine_defaults(register))
    fine += [limit for case in register.range for limit in unfit_limits(register, case.then, Fit.TOO_FINE, every)]
    if fine:
        message = f"has default or limits that its words cannot spell exactly: {listed(list(dict.fromkeys(fine)))}"
        yield Finding.at(register, message, "correct the number, the scale or the decimals")


def _fine_defaults(register: Register) -> Iterator[Fraction]:
    for _, value in register.beginnings:
        if isinstance(value, Fraction) and not wrong_sort(register, value) and too_fine(register, value):
            yield value
