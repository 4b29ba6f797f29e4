"""Types, kinds and defaults: every number that a map states must be one that the register can hold."""

from collections.abc import Iterator
from fractions import Fraction

from regscribe.checks.held_values import is_fault, outside_type, shown, wrong_sort
from regscribe.checks.representable import HELP_TYPE, Fit, best_fit, ends_of, tells_apart, values_of
from regscribe.checks.rule import Finding, RuleScope, register_rule
from regscribe.model import IDENTITY, Kind, NotANumber, Order, Register, Sentinel, Space, View, WireType, show
from regscribe.reference import number_of, sentinel_number

WORDS_OF_BITS = {Kind.FLAGS, Kind.FIELDS}
UNSCALED = {Kind.ENUM, Kind.FLAGS, Kind.FIELDS, Kind.STRING, Kind.VERSION, Kind.BOOLEAN}


@register_rule(
    "RS0420", "Default outside the type", "A default that the words cannot carry was misread, or the type was."
)
def default_outside_type(register: Register, _: RuleScope) -> Iterator[Finding]:
    """Try the default in every view under every scale."""
    for what, value in register.beginnings:
        if not wrong_sort(register, value) and outside_type(register, value):
            yield Finding.at(register, f"has {what} {shown(value)}, outside {ends_of(register)}", HELP_TYPE)


@register_rule("RS0421", "Special value outside the type", "A special value that no word can spell can never be met.")
def special_outside_type(register: Register, _: RuleScope) -> Iterator[Finding]:
    """Try each special value as the ranges count it."""
    for special in register.specials:
        values = values_of(register, special)
        fit = best_fit(register, values)
        if fit is Fit.EXACT and not any(tells_apart(register, value) for value in values):
            fit = Fit.TOO_FINE
        if fit is not Fit.EXACT:
            shown = f'has special value {show(special.code)} ("{special.label}")'
            message = {
                Fit.TOO_LARGE: f"{shown}, outside {ends_of(register)}",
                Fit.TOO_FINE: f"{shown}, which its words cannot spell exactly",
            }[fit]
            yield Finding.at(register, message, HELP_TYPE)


@register_rule(
    "RS0422", "Sentinel outside the type", "A view that cannot spell a fault would show a number in its place."
)
def sentinel_outside_type(register: Register, _: RuleScope) -> Iterator[Finding]:
    """Try each sentinel, a stored number, in every view; one that saturates shows its end, which is no value either."""
    for sentinel in register.sentinels:
        lacking = [view for view in register.views if not _reports(view, sentinel)]
        if lacking:
            where = f"view {lacking[0].name} ({lacking[0].type})" if len(register.views) > 1 else ends_of(register)
            message = f'has sentinel {sentinel.spelled} ("{sentinel.label}"), outside {where}'
            yield Finding.at(register, message, "correct the sentinel or the type")


def _reports(view: View, sentinel: Sentinel) -> bool:
    if isinstance(sentinel.stored, NotANumber):
        return view.type.is_float
    number = sentinel.stored * view.factor
    clipped = view.saturates and not view.type.minimum <= number <= view.type.maximum
    return clipped or sentinel_number(view, sentinel) is not None


@register_rule("RS0601", "Sentinel that is a value too", "One code cannot be both a setting and the report of a fault.")
def sentinel_is_code(register: Register, _: RuleScope) -> Iterator[Finding]:
    """Compare sentinels with the default, the codes of an enum, true and false; a text and a bit have none to spare."""
    if register.sentinels and (register.kind is Kind.STRING or register.base.space.is_bits):
        message = (
            f"is of kind {register.kind} in {register.base.space} and has sentinels, which none of its values can be"
        )
        yield Finding.at(register, message, "remove the sentinels")
        return
    codes = _labels(register)
    for sentinel in register.sentinels:
        if sentinel.stored in codes:
            message = f'has {sentinel.spelled} as "{codes[sentinel.stored]}" and as the fault "{sentinel.label}"'
            yield Finding.at(register, message, "remove one of them")
    for what, value in register.beginnings if register.sentinels else ():
        if number_of(register, value) not in codes and is_fault(register, value):
            message = f"has {what} {shown(value)}, by which it reports a fault"
            yield Finding.at(register, message, f"correct the {what} or the sentinels")


def _labels(register: Register) -> dict[object, str]:
    """What the codes of an enum, true and false are called."""
    members = register.enum.members if register.enum else ()
    truths: dict[object, str] = {Fraction(0): "false", Fraction(1): "true"} if register.kind is Kind.BOOLEAN else {}
    return {Fraction(member.code): member.label for member in members} | truths


BITS, STATUS = {Space.COIL, Space.DISCRETE}, {Space.STATUS}
_OF_SPACE = {WireType.BIT: BITS, WireType.UINT8: STATUS}
"""The types that do not stand in words, and where they stand."""


@register_rule(
    "RS0602",
    "Type that the space cannot hold",
    "A coil or discrete input is one bit, function 07 gives one byte, all other addresses hold words of 16 bits.",
)
def type_and_space(register: Register, _: RuleScope) -> Iterator[Finding]:
    """Compare the type of each view with its space, and its orders where there is nothing to order."""
    for view in register.views:
        spaces = _OF_SPACE.get(view.type, {Space.HOLDING, Space.INPUT})
        if view.space not in spaces:
            message = (
                f"has view {view.name} of type {view.type} in {view.space}, which is in {' or '.join(sorted(spaces))}"
            )
            help_ = "a flag in a word is `flags: {0: ...}` or `kind: boolean`, a number of words is in holding or input"
            yield Finding.at(register, message, f"correct `type` or `space`; {help_}")
        elif spaces in (BITS, STATUS) and (view.order, view.byte_order) != (Order.BIG, Order.BIG):
            message = f"has an order of words or bytes in {view.space}, where a value has no words"
            yield Finding.at(register, message, "remove `word_order` and `byte_order`")


@register_rule("RS0426", "Kind does not fit the type", "An enum in a float or a number in a text cannot be decoded.")
def kind_and_type(register: Register, _: RuleScope) -> Iterator[Finding]:
    """Compare the kind with the types of all views, and an enum or fields with the kind."""
    for view in register.views:
        problem, help_text = _of_view(register.kind, view)
        if problem:
            yield Finding.at(register, f"is of kind {register.kind}{problem}", help_text)
            return
    yield from _of_parts(register)


def _of_view(kind: Kind, view: View) -> tuple[str, str]:
    """Why a view cannot carry values of a kind, and what to do; empty if it can."""
    wrong = (
        (kind is Kind.STRING) != (view.type is WireType.STRING)
        or (kind in UNSCALED - {Kind.STRING} and view.type.is_float)
        or (kind in {*WORDS_OF_BITS, Kind.VERSION} and view.type is WireType.BIT)
    )
    if wrong:
        return f", but view {view.name} has type {view.type}", "correct `kind` or `type`"
    if view.saturates and (kind in UNSCALED or not view.type.is_integer):
        problem = f" and type {view.type}, of which view {view.name} can clip nothing"
        return problem, "remove `saturates`, or give the register a view set of its own"
    return "", ""


def _of_parts(register: Register) -> Iterator[Finding]:
    """What does not fit the kind among enum, bits, digits and special values."""
    if (register.enum is not None) != (register.kind is Kind.ENUM):
        has = "an" if register.enum else "no"
        yield Finding.at(register, f"is of kind {register.kind} but has {has} enum", "correct `kind` or the enum")
    elif bool(register.fields) != (register.kind in WORDS_OF_BITS):
        yield Finding.at(
            register, f"is of kind {register.kind} but its bits say otherwise", "correct `kind` or the bits"
        )
    elif register.kind is Kind.VERSION and not register.version_digits:
        yield Finding.at(register, "is of kind version, but has no digits", "give them under `version`, as nn.nn")
    elif not register.fractional:
        yield from _parts_of_wholes(register)


def _parts_of_wholes(register: Register) -> Iterator[Finding]:
    for special in register.specials:
        for number in (special.code, special.means):
            if number is not None and number.denominator != 1:
                message = (
                    f'is of kind {register.kind}, so whole, but its special value "{special.label}" is {show(number)}'
                )
                yield Finding.at(register, message, "correct the special value, or remove `kind`")


@register_rule(
    "RS0427", "Scale on a value that is no number", "Codes, bits and texts are not multiplied; one of them is wrong."
)
def scaled_codes(register: Register, _: RuleScope) -> Iterator[Finding]:
    """Allow nothing but the identity, and factor 1, for codes, bits, texts and versions."""
    if register.kind not in UNSCALED:
        return
    if any(case.then != IDENTITY for case in register.scale) or any(view.factor != 1 for view in register.views):
        yield Finding.at(register, f"is of kind {register.kind} but has a scale", "remove the scale, or correct `kind`")


@register_rule(
    "RS0428",
    "Default of the wrong sort",
    "A text for a number, or one that the words or the pattern cannot spell, is never read and cannot be written.",
)
def default_of_wrong_sort(register: Register, _: RuleScope) -> Iterator[Finding]:
    """Compare the default with the kind; a text with the words it has, a version with its pattern."""
    for what, value in register.beginnings:
        problem = wrong_sort(register, value)
        if problem:
            message = f"is of kind {register.kind} and has {what} {shown(value)}, {problem}"
            yield Finding.at(register, message, f"correct the {what}, or the kind and its keys")


@register_rule(
    "RS0429", "Version longer than its type", "The type cannot hold the largest version of so many digits.", warns=True
)
def version_too_long(register: Register, _: RuleScope) -> Iterator[Finding]:
    """Compare the largest number of the digits with the type."""
    largest = 10**register.version_digits - 1
    if register.kind is Kind.VERSION and register.base.type.is_integer and largest > register.base.type.maximum:
        message = f"packs {register.version_digits} digits (up to {largest}) into {ends_of(register)}"
        yield Finding.at(register, message, "correct `version` or `type`, or waive this with what the manual says")
