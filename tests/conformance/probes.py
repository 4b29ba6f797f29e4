"""Words and values that are worth trying on a register: ends, faults, special values, limits, codes, and any."""

import random
from collections.abc import Iterable, Iterator
from contextlib import suppress
from fractions import Fraction

from regscribe.emit.vectors.octet_vectors import TRIED
from regscribe.model import Kind, NotANumber, Number, Order, Register, Space, View, WireType
from regscribe.reference import RefusedError, transmit
from regscribe_runtime.values.kinds import OCTETS

Words = tuple[int, ...]
TEXTS = ("", "A", "AB\0", "ABCDEF", "1.2", "0.1", "00.01", "3", "123")
NUMBERS = (0, 1, -1, 2, 3, 7, 30, 70, 250, 70000, 2**31, 2**63, Fraction(1, 2), Fraction(999, 10), Fraction(1, 1000))
PATTERNS = {
    WireType.FLOAT32: (0x3F800000, 0x40490FDB, 0x80000000, 0x7F800000, 0x7FC00000, 0x7FC00001, 0xFF7FFFFF, 1),
    WireType.FLOAT64: (0x3FF0000000000000, 0x400921FB54442D18, 0x7FF0000000000000, 0x7FF8000000000000, 1),
    WireType.STRING: (0x41420043, 0x41202020, 0x41424344, 0x414280FF),
}
"""Bits with a meaning of their own: 1, pi, no numbers, the ends; letters with blanks, NUL and what is no ASCII."""


def plausible(view: View) -> list[Words]:
    """The words of small numbers, as most registers hold them."""
    return [] if view.type.is_octets else list(_transmitted(view, range(4)))


def words(register: Register, view: View, chance: random.Random) -> list[Words]:
    """Words of a view, in both orders."""
    if view.space.is_bits:
        return [(0,), (1,)]
    size = 8 if view.space is Space.STATUS else 16 * view.words
    bits = {0, 1, 2, 1 << size - 1, (1 << size - 1) - 1, (1 << size) - 1, chance.getrandbits(size)}
    bits |= {one % (1 << size) for one in PATTERNS.get(view.type, ())}
    found = {tuple(one >> 16 * place & 0xFFFF for place in reversed(range(view.words))) for one in bits}
    if not view.type.is_octets:
        found |= set(_transmitted(view, [*_stored(register), *NUMBERS]))
    return sorted(found | {one[::-1] for one in found})


def _transmitted(view: View, numbers: Iterable[Fraction | int | NotANumber]) -> Iterator[Words]:
    for number in numbers:
        with suppress(RefusedError):  # it does not fit
            stored = number if isinstance(number, NotANumber) else Fraction(number)
            turned = view.byte_order if isinstance(view.byte_order, Order) else Order.BIG
            yield transmit(view._replace(order=Order.BIG, byte_order=turned, times=None), stored)


def _stored(register: Register) -> Iterator[Fraction | NotANumber]:
    """Stored numbers with a meaning of their own, and limits, as far as no scale is between."""
    yield from (
        one.stored if isinstance(one.stored, NotANumber) else Fraction(one.stored) for one in register.sentinels
    )
    yield from (Fraction(one.high) for one in register.sentinels if one.high is not None)
    yield from (one.code for one in register.specials)
    yield from _codes(register)
    yield from _limits(register)


def _codes(register: Register) -> Iterator[Fraction]:
    enums = [one.enum for one in (register, *register.fields) if one.enum]
    yield from (Fraction(member.code) for enum in enums for member in enum.members)


def _limits(register: Register) -> Iterator[Fraction]:
    intervals = [interval for case in (*register.range, *register.valid) for interval in case.then.intervals]
    yield from (end for one in intervals for end in (one.low, one.high) if isinstance(end, Number))


def values(register: Register) -> list[Fraction] | list[str]:
    """Values of use to be written."""
    if register.kind in OCTETS | {Kind.VERSION}:
        return [*TEXTS, *TRIED.get(register.base.type, ())]
    steps = (Fraction(0), Fraction(1, 10), Fraction(-1, 10), Fraction(1), Fraction(-1))
    found = {Fraction(one) for one in NUMBERS} | {limit + step for limit in _limits(register) for step in steps}
    found |= {one for one in _stored(register) if isinstance(one, Fraction)}
    found |= {one.means for one in register.specials if one.means is not None}
    found |= {Fraction(1 << one.low) for one in register.fields}
    return sorted(found)
