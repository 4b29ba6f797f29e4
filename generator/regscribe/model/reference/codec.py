"""Decode and encode one register, step by step as the map's language defines it."""

from fractions import Fraction
from math import floor

from regscribe.model.number import show
from regscribe.model.reference.known import NOTHING_KNOWN, Surroundings, choose, decimal_factor, in_range
from regscribe.model.reference.outcome import NOT_DECODABLE, SATURATED, Meaning, Reading, Reason, RefusedError
from regscribe.model.reference.words import HALF, spelled, text_of, wire_number, word_order, words_of_text
from regscribe.model.register import Kind, Register
from regscribe.model.value import Conversion
from regscribe.model.wire import Order, View, WireType

PATTERNS = frozenset({Kind.FLAGS, Kind.FIELDS})
"""Kinds whose value is a pattern of bits: no number, so it has neither sign nor scale."""


def decode(register: Register, view: View, words: tuple[int, ...], known: Surroundings = NOTHING_KNOWN) -> Reading:
    """Say what `words`, read from `view`, mean; raises UnknownValueError for a value that decides and is not known."""
    if view.type is WireType.STRING:
        text = text_of(view, words)
        return NOT_DECODABLE if text is None else Reading(Meaning.VALUE, text)
    order = word_order(view, known)
    number = None if order is None else wire_number(view, words, order)
    if number is None:
        return NOT_DECODABLE
    if register.kind in PATTERNS:
        return Reading(Meaning.VALUE, number % (1 << view.type.bits))
    if view.saturates and view.type.is_integer and number in {view.type.minimum, view.type.maximum}:
        return SATURATED
    stored = number / view.factor
    for sentinel in register.sentinels:
        if stored == sentinel.stored:
            return Reading(Meaning.FAULT, fault=sentinel.id)
    return _meaning(register, stored, known)


def _meaning(register: Register, stored: Fraction, known: Surroundings) -> Reading:
    conversion = choose(register.scale, known)
    factor = None if conversion is None else decimal_factor(conversion.decimals, known)
    if conversion is None or factor is None:
        return NOT_DECODABLE
    value = (conversion.multiply * stored + conversion.add) / factor
    for special in register.specials:
        if special.means is not None and value == special.code:
            return Reading(Meaning.VALUE, special.means)
    if register.kind is Kind.VERSION:
        text = version_text(register, value)
        return NOT_DECODABLE if text is None else Reading(Meaning.VALUE, text)
    if register.kind is not Kind.NUMBER and value.denominator != 1:
        return NOT_DECODABLE
    if register.enum is not None and all(member.code != value for member in register.enum.members):
        return Reading(Meaning.UNKNOWN_MEMBER, value)
    return Reading(Meaning.VALUE, value)


def version_text(register: Register, number: Fraction) -> str | None:
    """Return a version as text (13100 with six digits in groups of two: 01.31.00); None for what does not fit."""
    if number.denominator != 1 or not 0 <= number < 10**register.version_digits:
        return None
    digits = str(number.numerator).zfill(register.version_digits)
    size = register.version_group or register.version_digits
    return ".".join(digits[start : start + size] for start in range(0, len(digits), size))


def version_number(register: Register, text: str) -> Fraction:
    """Return the number that packs a version text; RefusedError for any other text."""
    digits = text.replace(".", "")
    if digits.isascii() and digits.isdigit() and version_text(register, Fraction(digits)) == text:
        return Fraction(digits)
    raise RefusedError(Reason.TYPE, f"{text!r} is no version of {register.version_digits} digits")


def encode(
    register: Register,
    view: View,
    value: Fraction | str,
    known: Surroundings = NOTHING_KNOWN,
    *,
    rounded: bool = False,
) -> tuple[int, ...]:
    """Return the words that transmit `value` in `view`; raises RefusedError, or UnknownValueError as `decode` does.

    With `rounded`, a value between two wire numbers is rounded as the device rounds, else refused.
    """
    if view.type is WireType.STRING:
        return words_of_text(view, str(value))
    number = version_number(register, value) if isinstance(value, str) else value
    number = _checked(register, number, known)
    if register.kind in PATTERNS:
        return _pattern(view, number, known)
    stored = _stored(register, number, known, rounded=rounded)
    if any(stored == sentinel.stored for sentinel in register.sentinels):
        raise RefusedError(Reason.SENTINEL, f"{show(stored)} is how the device reports a fault")
    order = word_order(view, known)
    if order is None:
        raise RefusedError(Reason.CONDITION, "the order of the words is not known")
    return spelled(view, stored * view.factor, order, rounded=rounded)


def _pattern(view: View, number: Fraction, known: Surroundings) -> tuple[int, ...]:
    size = 1 << view.type.bits
    if not 0 <= number < size:
        raise RefusedError(Reason.TYPE, f"{show(number)} has more than {view.type.bits} bits")
    signed = number - size if number > view.type.maximum else number
    return spelled(view, signed, word_order(view, known) or Order.BIG, rounded=False)


def _checked(register: Register, value: Fraction, known: Surroundings) -> Fraction:
    for special in register.specials:
        if special.means is not None and value == special.means:
            return special.code
    if any(value == special.code for special in register.specials):
        return value
    if register.enum is not None and all(member.code != value for member in register.enum.members):
        raise RefusedError(Reason.MEMBER, f"{show(value)} is no member of {register.enum.id}")
    if register.kind is Kind.FLAGS:
        _check_bits(register, value)
    if register.kind is not Kind.NUMBER and value.denominator != 1:
        raise RefusedError(Reason.TYPE, f"{show(value)} is no whole number")
    if not in_range(register, value, known):
        raise RefusedError(Reason.RANGE, f"{show(value)} lies outside the range")
    return value


def _check_bits(register: Register, value: Fraction) -> None:
    named = sum(((1 << bits.width) - 1) << bits.low for bits in register.fields)
    if value.denominator != 1 or value < 0 or int(value) & ~named:
        raise RefusedError(Reason.BITS, f"{show(value)} sets bits that mean nothing")


def _stored(register: Register, value: Fraction, known: Surroundings, *, rounded: bool) -> Fraction:
    conversion = choose(register.scale, known)
    factor = None if conversion is None else decimal_factor(conversion.decimals, known)
    if conversion is None or factor is None:
        raise RefusedError(Reason.CONDITION, "no scale holds as things stand")
    stored = (value * factor - conversion.add) / conversion.multiply
    return _on_step(conversion, stored, rounded=rounded)


def _on_step(conversion: Conversion, stored: Fraction, *, rounded: bool) -> Fraction:
    if conversion.step is None or (stored / conversion.step).denominator == 1:
        return stored
    if not rounded:
        raise RefusedError(Reason.RESOLUTION, f"{show(stored)} is no multiple of {show(conversion.step)}")
    return conversion.step * floor(stored / conversion.step + HALF)
