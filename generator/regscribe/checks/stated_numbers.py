"""Types, kinds and defaults: every number that a map states must be one that the register can hold."""

from collections.abc import Iterator
from fractions import Fraction

from regscribe.checks.held_values import is_fault, outside_type, shown, wrong_sort
from regscribe.checks.representable import (
    HELP_TYPE,
    Fit,
    best_fit,
    ends_of,
    reach_of,
    same_bits,
    tells_apart,
    values_of,
)
from regscribe.checks.rule import Problem, RuleScope, register_rule
from regscribe.model import IDENTITY, Kind, NotANumber, Order, Register, Sentinel, Space, View, WireType, show
from regscribe.reference import number_of, sentinel_number
from regscribe_runtime.values.kinds import OCTETS
from regscribe_runtime.values.octets import KINDS

WORDS_OF_BITS = {Kind.FLAGS, Kind.FIELDS}
UNSCALED = OCTETS | {Kind.ENUM, Kind.FLAGS, Kind.FIELDS, Kind.VERSION, Kind.BOOLEAN}


@register_rule("RS0420", "Default outside the type")
def default_outside_type(register: Register, _: RuleScope) -> Iterator[Problem]:
    """A default that the words cannot carry was misread, or the type was."""
    for what, value in register.beginnings:
        if not wrong_sort(register, value) and outside_type(register, value):
            bits = same_bits(register, [value] if isinstance(value, Fraction) else [])
            yield f"has {what} {shown(value)}, outside {reach_of(register)}", bits or HELP_TYPE


@register_rule("RS0421", "Special value outside the type")
def special_outside_type(register: Register, _: RuleScope) -> Iterator[Problem]:
    """A special value that no word can spell can never be met."""
    for special in register.specials:
        values = values_of(register, special)
        fit = best_fit(register, values)
        shown = f'has special value {show(special.code)} ("{special.label}")'
        if fit is Fit.TOO_LARGE:
            yield f"{shown}, outside {ends_of(register)}", same_bits(register, [special.code]) or HELP_TYPE
        elif fit is Fit.TOO_FINE or not any(tells_apart(register, value) for value in values):
            yield f"{shown}, which its words cannot spell exactly", HELP_TYPE


@register_rule("RS0422", "Sentinel outside the type")
def sentinel_outside_type(register: Register, _: RuleScope) -> Iterator[Problem]:
    """A view that cannot spell a fault would show a number in its place."""
    for sentinel in register.sentinels:
        lacking = [view for view in register.views if not _reports(view, sentinel)]
        if lacking:
            where = f"view {lacking[0].name} ({lacking[0].type})" if len(register.views) > 1 else ends_of(register)
            message = f'has sentinel {sentinel.spelled} ("{sentinel.label}"), outside {where}'
            stored = [] if isinstance(sentinel.stored, NotANumber) else [sentinel.stored]
            yield message, same_bits(register, stored) or "correct the sentinel or the type"


def _reports(view: View, sentinel: Sentinel) -> bool:
    if isinstance(sentinel.stored, NotANumber):
        return view.type.is_float
    if view.type.is_octets:
        return all(end.denominator == 1 and 0 <= end < 1 << 16 * view.words for end in sentinel.ends or (Fraction(-1),))
    return view.times is not None or all(_carries(view, sentinel._replace(stored=end)) for end in sentinel.ends or ())


def _carries(view: View, sentinel: Sentinel) -> bool:
    number = Fraction(sentinel.spelled.partition("..")[0]) * view.factor
    clipped = view.saturates and not view.type.minimum <= number <= view.type.maximum
    return clipped or sentinel_number(view, sentinel) is not None


@register_rule("RS0601", "Sentinel that is a value too")
def sentinel_is_code(register: Register, _: RuleScope) -> Iterator[Problem]:
    """One code cannot be both a setting and the report of a fault."""
    if register.sentinels and register.base.space.is_bits:
        what = f"is of kind {register.kind} in {register.base.space}"
        yield f"{what} and has sentinels, which none of its values can be", "remove the sentinels"
        return
    codes = _labels(register)
    for sentinel in register.sentinels:
        for code, label in codes.items():
            if sentinel.reports(code):
                message = f'has {show(code)} as "{label}" and as the fault "{sentinel.label}"'
                yield message, "remove one of them: reading a sentinel raises an error, whatever else the code means"
    for what, value in register.beginnings if register.sentinels else ():
        if number_of(register, value) not in codes and is_fault(register, value):
            yield f"has {what} {shown(value)}, by which it reports a fault", f"correct the {what} or the sentinels"


def _labels(register: Register) -> dict[Fraction, str]:
    """What the codes of an enum, true and false are called."""
    members = register.enum.members if register.enum else ()
    truths = {Fraction(0): "false", Fraction(1): "true"} if register.kind is Kind.BOOLEAN else {}
    return {Fraction(member.code): member.label for member in members} | truths


BITS, STATUS, TEXTS = {Space.COIL, Space.DISCRETE}, {Space.STATUS}, {Space.IDENTIFICATION}
WORDS = {space for space in Space if space.is_words} - TEXTS
_OF_SPACE = {WireType.BIT: BITS, WireType.UINT8: STATUS | WORDS, WireType.STRING: WORDS | TEXTS}
"""The types that do not stand in words alone, and where they stand."""


@register_rule("RS0602", "Type that the space cannot hold")
def type_and_space(register: Register, _: RuleScope) -> Iterator[Problem]:
    """A coil or discrete input is one bit, function 07 gives one byte, all other addresses hold words of 16 bits."""
    for view in register.views:
        spaces = _OF_SPACE.get(view.type, WORDS)
        if view.space not in spaces:
            what = f"has view {view.name} of type {view.type} in {view.space}"
            help_ = "a flag in a word is `flags: {0: ...}` or `kind: boolean`, a number needs words"
            yield f"{what}, which is in {' or '.join(sorted(spaces))}", f"correct `type` or `space`; {help_}"
        elif view.space not in WORDS and (view.order, view.byte_order) != (Order.BIG, Order.BIG):
            message = f"has an order of words or bytes in {view.space}, where a value has no words"
            yield message, "remove `word_order` and `byte_order`"


@register_rule("RS0426", "Kind does not fit the type")
def kind_and_type(register: Register, _: RuleScope) -> Iterator[Problem]:
    """Bits in a float or a number in a text cannot be decoded."""
    for view in register.views:
        problem, help_text = _of_view(register.kind, view)
        if problem:
            yield f"is of kind {register.kind}{problem}", help_text
            return
    yield from _of_parts(register)


def _of_view(kind: Kind, view: View) -> tuple[str, str]:
    """Why a view cannot carry values of a kind, and what to do; empty if it can."""
    wrong = (
        ((kind in OCTETS or view.type.is_octets) and KINDS.get(view.type) is not kind)
        or (kind in UNSCALED - {Kind.ENUM} and view.type.is_float)
        or (kind in {*WORDS_OF_BITS, Kind.VERSION} and view.type is WireType.BIT)
        or (kind in WORDS_OF_BITS and not view.type.bits)
    )
    if wrong:
        return f", but view {view.name} has type {view.type}", "correct `kind` or `type`"
    if view.saturates and (kind in UNSCALED or not view.type.is_integer):
        problem = f" and type {view.type}, of which view {view.name} can clip nothing"
        return problem, "remove `saturates`, or give the register a view set of its own"
    return "", ""


def _of_parts(register: Register) -> Iterator[Problem]:
    """What does not fit the kind among enum, bits, digits and special values."""
    if (register.enum is not None) != (register.kind is Kind.ENUM):
        has = "an" if register.enum else "no"
        yield f"is of kind {register.kind} but has {has} enum", "correct `kind` or the enum"
    elif bool(register.fields) != (register.kind in WORDS_OF_BITS):
        yield f"is of kind {register.kind} but its bits say otherwise", "correct `kind` or the bits"
    elif register.kind is Kind.VERSION and not register.version_digits:
        yield "is of kind version, but has no digits", "give them under `version`, as nn.nn"
    elif not register.fractional:
        for special in register.specials:
            for number in filter(None, (special.code, special.means)):
                if number.denominator != 1:
                    what = f"is of kind {register.kind}, so whole"
                    message = f'{what}, but its special value "{special.label}" is {show(number)}'
                    yield message, "correct the special value, or remove `kind`"


@register_rule("RS0427", "Scale on a value that is no number")
def scaled_codes(register: Register, _: RuleScope) -> Iterator[Problem]:
    """Codes, bits and texts are not multiplied; one of them is wrong."""
    if register.kind not in UNSCALED:
        return
    own = [1 << view.type.fraction if register.kind is Kind.ENUM else 1 for view in register.views]
    scaled = any(view.factor != one or view.times for view, one in zip(register.views, own, strict=True))
    if scaled or any(case.then != IDENTITY for case in register.scale):
        yield f"is of kind {register.kind} but has a scale", "remove the scale, or correct `kind`"


@register_rule("RS0428", "Default of the wrong sort")
def default_of_wrong_sort(register: Register, _: RuleScope) -> Iterator[Problem]:
    """A text for a number, or one that the words or the pattern cannot spell, is never read and cannot be written."""
    for what, value in register.beginnings:
        problem = wrong_sort(register, value)
        if problem:
            message = f"is of kind {register.kind} and has {what} {shown(value)}, {problem}"
            yield message, f"correct the {what}, or the kind and its keys"


@register_rule("RS0429", "Version longer than its type", warns=True)
def version_too_long(register: Register, _: RuleScope) -> Iterator[Problem]:
    """The type cannot hold the largest version of so many digits."""
    largest = 10**register.version_digits - 1
    if register.kind is Kind.VERSION and register.base.type.is_integer and largest > register.base.type.maximum:
        message = f"packs {register.version_digits} digits (up to {largest}) into {ends_of(register)}"
        yield message, "correct `version` or `type`, or waive this with what the manual says"
