"""Words of a register that are worth decoding: ends of the type, byte orders, limits, members, bits, faults.

The words are only proposed here; the reference decides what they mean.
"""

from collections.abc import Iterator
from fractions import Fraction
from typing import NamedTuple

from regscribe.emit.vectors.scale import Scale
from regscribe.model import BitField, Enum, Kind, Register, Space, View, WireType
from regscribe.reference import Surroundings, ieee_bits, special_value, whole_bits


class Proposal(NamedTuple):
    """A wire number, a pattern of bits or a value, and what is special about it."""

    value: Fraction
    note: str


FLOATS = {
    "0": "zero",
    "1": "one",
    "-1": "minus one",
    "0.1": "no binary fraction",
    "250.4": "0x437A6666 as a float32",
    "-1234.5": "negative",
    "16777216": "from here on a float32 skips whole numbers",
    "0.123456724": "only nine digits tell this float32 from its neighbours",
    "100.250015": "only nine digits tell this float32 from its neighbours",
}
"""Numbers as decimal text and what is special about them, for IEEE views."""

PATTERNS = {
    WireType.FLOAT16: {
        0x0400: "smallest normal number",
        0x7BFF: "largest number",
        0xFBFF: "lowest number",
        0x7C00: "infinity",
        0xFC00: "minus infinity",
        0x7E00: "not a number",
        0xFC01: "not a number either",
    },
    WireType.FLOAT32: {
        0x00800000: "smallest normal number",
        0x7F7FFFFF: "largest number",
        0xFF7FFFFF: "lowest number",
        0x7F800000: "infinity",
        0xFF800000: "minus infinity",
        0x7FC00000: "not a number",
        0xFF800001: "not a number either",
    },
    WireType.FLOAT64: {
        0x0010000000000000: "smallest normal number",
        0x7FEFFFFFFFFFFFFF: "largest number",
        0xFFEFFFFFFFFFFFFF: "lowest number",
        0x7FF0000000000000: "infinity",
        0xFFF0000000000000: "minus infinity",
        0x7FF8000000000000: "not a number",
        0xFFF0000000000001: "not a number either",
    },
}
"""Bits of IEEE numbers that no decimal text spells briefly."""

PATTERNS_OF_BITS = frozenset({Kind.FLAGS, Kind.FIELDS})

ORDERED = 0x0123456789ABCDEF
"""Its bytes all differ, so that a wrong order of words or bytes shows (of 128 bits the upper half)."""


def wire_bits(
    register: Register, view: View, scale: Scale | None, known: Surroundings, *, full: bool
) -> dict[int, str]:
    """Return the bits of the words to decode (most significant first) with their notes."""
    found: dict[int, str] = {}
    for bits, note in _patterns(view, full=full):
        found.setdefault(bits, note)
    numbers = [*_stored_numbers(register, full=full), *(_scaled_numbers(register, scale, known) if scale else ())]
    numbers += [*scale.stored_limits()] if scale and full else []
    for stored, note in numbers:
        pattern = bits_of(view, stored * view.factor)
        if pattern is not None:
            found.setdefault(pattern, note)
    return found


def bits_of(view: View, number: Fraction) -> int | None:
    """The bits of a wire number (most significant first); None for one that the type has not."""
    if view.type.is_float:
        return ieee_bits(number, view.type)
    highest = max(view.type.maximum, (1 << view.type.bits) - 1)  # a pattern of bits has no sign
    fits = number.denominator == 1 and view.type.minimum <= number <= highest
    return whole_bits(int(number), view.type) if fits else None


def _patterns(view: View, *, full: bool) -> Iterator[tuple[int, str]]:
    if view.type.is_float:
        texts: dict[str, str] = FLOATS if full else {"250.4": FLOATS["250.4"]}
        yield from ((ieee_bits(Fraction(text), view.type) or 0, note) for text, note in texts.items())
        yield from PATTERNS[view.type].items() if full else ()
        return
    width = view.type.bits or 16 * len(view.offsets)
    words = width if view.type is WireType.BIT or view.space is Space.STATUS else 16 * len(view.offsets)
    yield ORDERED << max(0, width - 64) >> max(0, 56 - width) & ((1 << words) - 1), "every byte differs"
    if full:
        lowest, highest = view.type.minimum, view.type.maximum
        ends = ((lowest, "lowest of the type"), (highest, "highest of the type"), (lowest + 1, "next to the lowest"))
        for number, note in (*ends, (highest - 1, "next to the highest"), (0, "zero"), (1, "one")):
            yield whole_bits(number, view.type), note
        yield from ((1 << (width - 1), "only the sign bit"), ((1 << words) - 1, "all bits"))


def _stored_numbers(register: Register, *, full: bool) -> Iterator[Proposal]:
    for sentinel in register.sentinels:  # what is no number is among the patterns of a float already
        for end, outward in zip(sentinel.ends or (), (-1, 1), strict=False):
            yield Proposal(Fraction(end), f"fault: {sentinel.id}")
            sides = (-1, 1) if sentinel.high is None else (outward,)
            yield from (Proposal(Fraction(end) + side, f"beside fault {sentinel.id}") for side in sides if full)
    yield from codes(register)


def _scaled_numbers(register: Register, scale: Scale, known: Surroundings) -> Iterator[Proposal]:
    for special in register.specials:
        value = special_value(register, special, known)
        if value is not None:
            yield from with_neighbours(scale.stored(value), scale.wire_step or Fraction(1), f"special: {special.id}")


def with_neighbours(value: Fraction, step: Fraction, note: str) -> Iterator[Proposal]:
    """Yield a value and both its neighbours, which the note is not true of."""
    yield Proposal(value, note)
    yield from (Proposal(value + side * step, f"beside {note}") for side in (-1, 1))


def codes(register: Register) -> Iterator[Proposal]:
    """Yield codes of a register of codes or bits: members and other codes of its enum, or bits and fields."""
    if register.enum is not None:
        yield from _enum_codes(register.enum)
    if register.kind in PATTERNS_OF_BITS:
        yield from (Proposal(Fraction(1 << bit), f"bit {bit} alone") for bit in range(register.bits))
        for bits in register.fields:
            if not bits.is_flag:
                yield from _field_codes(bits)
            for sentinel in bits.sentinels:
                for end in sentinel.ends or ():
                    yield Proposal(
                        Fraction(int(end) % (1 << bits.width) << bits.low), f"{bits.id}: fault {sentinel.id}"
                    )


def _enum_codes(enum: Enum) -> Iterator[Proposal]:
    """Yield each code, codes that the manual calls invalid, and two that it does not list."""
    yield from (Proposal(Fraction(member.code), f"member {member.id}") for member in enum.members)
    yield from (Proposal(Fraction(code), "the manual calls it invalid") for code, _ in enum.invalid)
    listed = {member.code for member in enum.members} | {code for code, _ in enum.invalid}
    gap = next(code for code in range(len(listed) + 1) if code not in listed)
    for code in sorted({gap, max(listed, default=0) + 1}):
        yield Proposal(Fraction(code), "not in the manual's list")


def _field_codes(bits: BitField) -> Iterator[Proposal]:
    """Yield each member of a field, an unknown code of it, and the field filled with ones."""
    full = (1 << bits.width) - 1
    listed = [member.code for member in bits.enum.members] if bits.enum else []
    unknown = next((code for code in range(full + 1) if code not in listed), full)
    for code in (*listed, unknown, full):
        yield Proposal(Fraction(code << bits.low), f"{bits.id} = {code}")
