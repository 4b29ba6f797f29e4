"""Decodes and encodes one register, step by step as the map language defines it."""

from fractions import Fraction
from math import floor

from regscribe.model.enums import BitField, Member, Special
from regscribe.model.register import Register
from regscribe.reference.ieee import ieee_bits
from regscribe.reference.limits import in_range, is_valid
from regscribe.reference.octets import meaning_of, octets_of
from regscribe.reference.outcome import (
    NOT_DECODABLE,
    OUT_OF_RANGE,
    SATURATED,
    Meaning,
    Reading,
    RefusalReason,
    RefusedError,
)
from regscribe.reference.surroundings import NOTHING_KNOWN, Known, choose, decimal_factor, holds
from regscribe.reference.terms import present_view, straight
from regscribe.reference.words import HALF, bytes_in_order, carried, spelled, wire_number, word_order, words_in_order
from regscribe_runtime.values.kinds import Kind
from regscribe_runtime.values.numbers import show
from regscribe_runtime.values.scales import NAN, Conversion, NotANumber, Sentinel
from regscribe_runtime.values.views import View
from regscribe_runtime.values.wire_types import WireType

PATTERNS = frozenset({Kind.FLAGS, Kind.FIELDS})
"""Kinds whose value is a pattern of bits: no number, so it has neither sign nor scale."""


def decode(register: Register, view: View, words: tuple[int, ...], known: Known = NOTHING_KNOWN) -> Reading:
    """Return what `words`, read from `view`, mean; raises UnknownValueError if that depends on an unknown value."""
    order, seen = word_order(view, known), present_view(view, known)
    if order is None or seen is None:
        return NOT_DECODABLE
    view = seen
    if view.type.is_octets:
        return _of_octets(register, bytes(bytes_in_order(words, order)), known)
    return _of_number(register, view, wire_number(view, words, order), known)


def _of_octets(register: Register, raw: bytes, known: Known) -> Reading:
    number = int.from_bytes(raw, "big")
    for sentinel in present_sentinels(register, known):
        if sentinel.stored <= number <= (sentinel.stored if sentinel.high is None else sentinel.high):  # type: ignore[operator] # numbers
            return Reading(Meaning.FAULT, fault=sentinel.id)
    text = meaning_of(register, raw)
    return NOT_DECODABLE if text is None else Reading(Meaning.VALUE, text)


def _of_number(register: Register, view: View, number: Fraction | NotANumber | None, known: Known) -> Reading:
    if view.saturates and view.type.is_integer and number in {view.type.minimum, view.type.maximum}:
        return SATURATED
    for sentinel in present_sentinels(register, known):
        if number is not None and is_reported(view, sentinel, number):
            return Reading(Meaning.FAULT, fault=sentinel.id)
    if not isinstance(number, Fraction):
        return NOT_DECODABLE
    if register.kind in PATTERNS:
        missing_bits(register, known)  # what decides which of its bits have a meaning must be known
        return Reading(Meaning.VALUE, number % (1 << view.type.bits))
    return _meaning(register, view, number, known)


def sentinel_number(view: View, sentinel: Sentinel) -> Fraction | NotANumber | None:
    """Return the wire number by which a view reports a fault; None if it cannot."""
    return NAN if isinstance(sentinel.stored, NotANumber) else carried(view, Fraction(sentinel.stored * view.factor))


def part_value(field: BitField, word: int) -> Fraction | Sentinel:
    """Return the number of use in the bits of a field, or the fault that they report."""
    size = 2**field.width
    number = word // 2**field.low % size
    if field.signed and number >= size // 2:
        number -= size
    for sentinel in field.sentinels:
        if sentinel.ends and sentinel.ends[0] <= number <= sentinel.ends[1]:
            return sentinel
    return Fraction(field.multiply * number + field.add)


def part_bits(field: BitField, value: Fraction) -> int | None:
    """Return the number of the bits that spell a value of use; None where none do."""
    number = (value - field.add) / field.multiply
    least = -(2 ** (field.width - 1)) if field.signed else 0
    fits = number.denominator == 1 and least <= number < least + 2**field.width
    return int(number) % 2**field.width if fits else None


def present_sentinels(register: Register, known: Known) -> tuple[Sentinel, ...]:
    """Return the sentinels of the first case that holds."""
    for first in register.sentinels:
        if holds(first.when, known):
            return tuple(sentinel for sentinel in register.sentinels if sentinel.when == first.when)
    return ()


def is_reported(view: View, sentinel: Sentinel, number: Fraction | NotANumber) -> bool:
    """Tell whether a number on the wire of a view reports a fault."""
    low = sentinel_number(view, sentinel)
    if sentinel.high is None or not isinstance(low, Fraction) or not isinstance(number, Fraction):
        return low == number
    high = carried(view, Fraction(sentinel.high * view.factor))
    return high is not None and min(low, high) <= number <= max(low, high)


def special_value(register: Register, special: Special, known: Known) -> Fraction | None:
    """Return the code of a special value as a value of use; None if no scale holds or its decimals are no number."""
    conversion = choose(register.special_scale, known)
    factor = None if conversion is None else decimal_factor(conversion.decimals, known)
    return None if factor is None else special.code / factor


def _meaning(register: Register, view: View, number: Fraction, known: Known) -> Reading:
    line = straight(choose(register.scale, known), known)
    if line is None:
        return NOT_DECODABLE
    for special in register.specials:
        named = special_value(register, special, known)
        if named is None:
            return NOT_DECODABLE
        if carried(view, line.stored(named) * view.factor) == number:
            return Reading(Meaning.VALUE, named if special.means is None else special.means)
    value = line.value(number / view.factor)
    reading = _of_kind(register, value, known)
    if reading is NOT_DECODABLE or not register.valid:
        return reading
    try:
        return reading if is_valid(register, value, known) else OUT_OF_RANGE
    except RefusedError:
        return NOT_DECODABLE


def existing_members(register: Register, known: Known) -> tuple[Member, ...]:
    """Return the members of a register's enum that exist as things stand."""
    return tuple(member for member in register.enum.members if holds(member.when, known)) if register.enum else ()


def missing_bits(register: Register, known: Known) -> int:
    """Return the bits of flags and parts that do not exist as things stand."""
    gone = [field for field in register.fields if not holds(field.when, known)]
    return sum((2**field.width - 1) * 2**field.low for field in gone)


def _is_member(register: Register, value: Fraction, known: Known) -> bool:
    return register.enum is None or any(member.code == value for member in existing_members(register, known))


def _of_kind(register: Register, value: Fraction, known: Known) -> Reading:
    if register.kind is Kind.VERSION:
        text = version_text(register, value)
        return NOT_DECODABLE if text is None else Reading(Meaning.VALUE, text)
    if register.kind is Kind.BOOLEAN:
        return Reading(Meaning.VALUE, value) if value in {0, 1} else NOT_DECODABLE
    if register.fractional:
        beyond = ieee_bits(value, WireType.FLOAT64) is None  # no float of any program can hold it
        return NOT_DECODABLE if beyond else Reading(Meaning.VALUE, value)
    if value.denominator != 1:
        return NOT_DECODABLE
    if not _is_member(register, value, known):
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
    raise RefusedError(RefusalReason.TYPE, f"{text!r} is no version of {register.version_digits} digits")


def number_of(register: Register, value: Fraction | str | None) -> Fraction | None:
    """Return the number of a value, that which a version packs included; None for a text that packs none."""
    if not isinstance(value, str):
        return value
    try:
        return version_number(register, value) if register.kind is Kind.VERSION else None
    except RefusedError:
        return None


def encode(
    register: Register,
    view: View,
    value: Fraction | str,
    known: Known = NOTHING_KNOWN,
    *,
    rounded: bool = False,
) -> tuple[int, ...]:
    """Return the words that transmit `value` in `view`; raises RefusedError, or UnknownValueError as `decode` does.

    With `rounded`, a value between two wire numbers is rounded as the device rounds, else refused.
    """
    order, seen = word_order(view, known), present_view(view, known)
    if order is None or seen is None:
        raise RefusedError(RefusalReason.CONDITION, "the order of the words, or the factor of the view, is not known")
    view = seen
    if view.type.is_octets:
        raw = octets_of(register, str(value), 2 * view.words)
        if _of_octets(register, raw, known).meaning is Meaning.FAULT:
            raise RefusedError(RefusalReason.SENTINEL, f"{value} is how the device reports a fault")
        return words_in_order(list(raw), order)
    number = version_number(register, value) if isinstance(value, str) else value
    number = _checked(register, number, known)
    pattern = register.kind in PATTERNS
    stored = _pattern(view, number) if pattern else _stored(register, number, known, rounded=rounded)
    words = spelled(view, stored * view.factor, order, rounded=rounded)
    sent = wire_number(view, words, order)
    if sent is not None and any(is_reported(view, each, sent) for each in present_sentinels(register, known)):
        raise RefusedError(RefusalReason.SENTINEL, f"{show(stored)} is how the device reports a fault")
    return words


def _pattern(view: View, number: Fraction) -> Fraction:
    """Return a pattern of bits as a number of the view's type."""
    size = 1 << view.type.bits
    if not 0 <= number < size:
        raise RefusedError(RefusalReason.TYPE, f"{show(number)} has more than {view.type.bits} bits")
    return number - size if number > view.type.maximum else number


def _checked(register: Register, value: Fraction, known: Known) -> Fraction:
    """Return the number to be scaled: the code of a special value, or a value that the register may be given."""
    code = _special_code(register, value, known)
    if code is not None:
        return code
    _check_kind(register, value, known)
    if not in_range(register, value, known) or not is_valid(register, value, known):
        raise RefusedError(RefusalReason.RANGE, f"{show(value)} lies outside the range")
    return value


def _check_kind(register: Register, value: Fraction, known: Known) -> None:
    if register.kind is Kind.BOOLEAN and value not in {0, 1}:
        raise RefusedError(RefusalReason.TYPE, f"{show(value)} is neither 0 nor 1")
    if not _is_member(register, value, known):
        raise RefusedError(RefusalReason.MEMBER, f"{show(value)} is no member of {register.enum and register.enum.id}")
    if register.kind is Kind.FLAGS and value != int(value) & register.named_bits:
        raise RefusedError(RefusalReason.BITS, f"{show(value)} sets bits that mean nothing")
    if register.fields and value.denominator == 1 and int(value) & missing_bits(register, known):
        raise RefusedError(RefusalReason.BITS, f"{show(value)} sets bits of what does not exist")
    if not register.fractional and value.denominator != 1:
        raise RefusedError(RefusalReason.TYPE, f"{show(value)} is no whole number")


def _special_code(register: Register, value: Fraction, known: Known) -> Fraction | None:
    """Return the code of the special value that `value` is; None if it is no special value."""
    codes: set[Fraction] = set()
    for special in register.specials:
        named = special_value(register, special, known)
        if named is None:
            raise RefusedError(RefusalReason.CONDITION, "the decimals of special values are not known")
        if value == (named if special.means is None else special.means):
            return named
        codes.add(named)
    if value in codes:
        raise RefusedError(RefusalReason.RANGE, f"{show(value)} is a code that stands for another number")
    return None


def _stored(register: Register, value: Fraction, known: Known, *, rounded: bool) -> Fraction:
    conversion = choose(register.scale, known)
    line = straight(conversion, known)
    if conversion is None or line is None:
        raise RefusedError(RefusalReason.CONDITION, "no scale holds as things stand")
    return _on_step(conversion, line.stored(value), known, rounded=rounded)


def _on_step(conversion: Conversion, stored: Fraction, known: Known, *, rounded: bool) -> Fraction:
    factor = decimal_factor(conversion.places, known)
    if factor is None:
        raise RefusedError(RefusalReason.CONDITION, "nobody can tell how many decimals the device keeps")
    step = None if conversion.step is None else conversion.step / factor
    if step is None or (stored / step).denominator == 1:
        return stored
    if not rounded:
        raise RefusedError(RefusalReason.RESOLUTION, f"{show(stored)} is no multiple of {show(step)}")
    return step * floor(stored / step + HALF)
