"""Scales and resolution."""

from collections.abc import Iterator
from fractions import Fraction

from regscribe.checks.carrying import Fit, best_fit, end_values, forms, is_meant, listed, numbers
from regscribe.checks.registry import Finding, Scope, register_rule
from regscribe.model import Kind, Register, Rule, show


@register_rule(Rule("RS0430", "Scale of zero", "A factor of 0 makes every value the same and can never be undone."))
def scale_of_zero(register: Register, _: Scope) -> Iterator[Finding]:
    """Look at the factor of every case and every view."""
    if any(case.then.multiply == 0 for case in register.scale):
        yield Finding.at(register, "has a scale that multiplies by 0", "correct `multiply`, or `from` and `to`")
    for view in register.views:
        if view.factor == 0:
            yield Finding.at(register, f"has view {view.name} with factor 0", "correct the view's `factor`")


@register_rule(
    Rule(
        "RS0604",
        "Scale beyond a float",
        "A program reads numbers as floats of 64 bits; what these cannot tell apart, or hold, was misread.",
    )
)
def beyond_a_float(register: Register, _: Scope) -> Iterator[Finding]:
    """Compare the values of the stored numbers 0 and 1 as floats, under every scale."""
    for form in forms(register) if register.kind in {Kind.NUMBER, Kind.INTEGER, Kind.RAW} else ():
        values = [(form.conversion.multiply * stored + form.conversion.add) / form.factor for stored in (0, 1)]
        try:
            first, second = map(float, values)
        except OverflowError:
            first = second = 0.0
        if first == second:
            message = (
                f"makes {show(values[0])} of 0 and {show(values[1])} of 1, which no float of a program tells apart"
            )
            yield Finding.at(register, message, "correct `multiply` and `add`, or `from` and `to`")
            return


@register_rule(
    Rule(
        "RS0432",
        "Number finer than the resolution",
        "A default or limit between two steps can never be read or written: a decimal is missing, or one too many.",
    )
)
def too_fine(register: Register, _scope: Scope) -> Iterator[Finding]:
    """Try the default and the numeric limits in every view under every scale."""
    if register.kind not in {Kind.NUMBER, Kind.INTEGER, Kind.RAW}:
        return
    fine: list[Fraction] = []
    for _what, value in register.beginnings:
        if isinstance(value, Fraction) and not is_meant(register, value):
            fine += [value] if best_fit(register, (value,)) is Fit.TOO_FINE else []
    for case in register.range:
        fine += [n for n in numbers(case.then) if best_fit(register, end_values(case.then, n)) is Fit.TOO_FINE]
    if fine:
        message = f"has default or limits that its words cannot spell exactly: {listed(list(dict.fromkeys(fine)))}"
        yield Finding.at(register, message, "correct the number, the scale or the decimals")
