"""Exact numbers: what is written reads back, what cannot be held is refused."""

import math
import struct
from decimal import Decimal
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from regscribe import reference
from regscribe_runtime import (
    Conversion,
    NotDecodable,
    Order,
    ReadWrite,
    ValueRefused,
    View,
    WireType,
    always,
    integer,
    number,
    text,
    within,
    word,
)
from regscribe_runtime.values.numbers import ROUNDINGS, exact, shortest

tenths = ReadWrite(0, word(WireType.UINT16), number, scale=always(Conversion(Fraction("0.1"), Fraction("-1999.9"))))
ieee = ReadWrite(0, (View("base", WireType.FLOAT32, words=2),), number)
swapped = ReadWrite(0, (View("base", WireType.INT32, words=2, order=Order.LITTLE),), integer)
label = ReadWrite(0, (View("base", WireType.UINT16, words=3),), text)
label_low_first = ReadWrite(0, (View("base", WireType.UINT16, words=3, byte_order=Order.LITTLE),), text)


@pytest.mark.parametrize("value", [2.0**63, 2**63, 2.0**100, -(2.0**63), 1 + 2.0**-23])
def test_what_a_float32_carries_exactly_is_written_though_its_shortest_decimal_is_another_number(value: float) -> None:
    assert ieee.encode(value) == struct.unpack(">2H", struct.pack(">f", value))


@pytest.mark.parametrize("value", [Decimal("9.223372036854776E+18"), Decimal("1.00000000000000001"), 1 + 2.0**-24])
def test_what_is_no_float_counts_as_it_is_spelled(value: float) -> None:
    with pytest.raises(ValueRefused, match="finer than float32"):
        ieee.encode(value)


@given(st.integers(0, 65535))
def test_an_affine_scale_gives_the_float_nearest_to_the_exact_value(raw: int) -> None:
    value = tenths.decode((raw,))

    assert value == float(Fraction(raw, 10) - Fraction("1999.9"))
    assert tenths.encode(value) == (raw,)


@pytest.mark.parametrize("value", [25.05, -1999.95, 4553.65, 4553.7, -2000, math.nan, math.inf, "25", True, None])
def test_what_the_words_cannot_hold_is_refused(value: object) -> None:
    with pytest.raises(ValueRefused):
        tenths.encode(value)  # type: ignore[arg-type] # on purpose


def test_numbers_of_any_kind_are_exact() -> None:
    assert {tenths.encode(value) for value in (25.1, Decimal("25.1"), Fraction(251, 10))} == {(20250,)}  # type: ignore[arg-type] # accepted at run time


@given(st.floats(width=32, allow_nan=False, allow_infinity=False))
def test_a_float32_reads_as_its_shortest_decimal_and_writes_back(value: float) -> None:
    words = struct.unpack(">2H", struct.pack(">f", value))
    shown = ieee.decode(words)

    assert struct.pack(">f", shown) == struct.pack(">f", value + 0.0)
    assert ieee.encode(shown) == struct.unpack(">2H", struct.pack(">f", value + 0.0))


@pytest.mark.parametrize(
    ("wire_type", "lowest", "beyond"), [(WireType.FLOAT32, -149, 128), (WireType.FLOAT64, -1074, 1024)]
)
def test_every_power_of_two_reads_as_the_reference_says(wire_type: WireType, lowest: int, beyond: int) -> None:
    powers = [2.0**power for power in range(lowest, beyond)]
    assert [Fraction(shortest(one, wire_type)) for one in powers] == [
        reference.shortest(Fraction(one), wire_type) for one in powers
    ]


def test_a_float32_of_250_4_is_250_4() -> None:
    assert ieee.decode((0x437A, 0x6666)) == 250.4


@pytest.mark.parametrize("words", [(0x7F80, 0), (0xFF80, 0), (0x7FC0, 0), (0x7F80, 1)])
def test_infinities_and_nans_are_no_values(words: tuple[int, int]) -> None:
    with pytest.raises(NotDecodable):
        ieee.decode(words)


@pytest.mark.parametrize("value", [123456.789, 1e39, 16777217])
def test_a_value_finer_or_larger_than_a_float32_is_refused(value: float) -> None:
    with pytest.raises(ValueRefused):
        ieee.encode(value)


@given(st.integers(-(2**31), 2**31 - 1))
def test_little_word_order_puts_the_low_word_first(value: int) -> None:
    low, high = swapped.encode(value)

    assert (high << 16 | low) == value & 0xFFFFFFFF
    assert swapped.decode((low, high)) == value


@given(st.text(st.characters(min_codepoint=33, max_codepoint=126), max_size=6))
def test_texts_are_two_characters_a_word_in_either_order(value: str) -> None:
    assert label.decode(label.encode(value)) == value
    assert [w >> 8 | (w & 255) << 8 for w in label.encode(value)] == list(label_low_first.encode(value))


@pytest.mark.parametrize("value", ["seven c", "°C", 5])
def test_a_text_that_does_not_fit_is_refused(value: object) -> None:
    with pytest.raises(ValueRefused):
        label.encode(value)  # type: ignore[arg-type] # on purpose


def test_a_negative_number_is_twos_complement() -> None:
    signed = ReadWrite(0, word(WireType.INT16), integer, range=within(-1999, 9999))

    assert signed.encode(-1999) == (0xF831,)
    assert signed.decode((0xF831,)) == -1999


@pytest.mark.parametrize(
    ("rule", "rounded"),
    [("half_up", [1, -1, 2]), ("half_away", [1, -2, 2]), ("half_even", [0, -2, 2]), ("down", [0, -1, 1])],
)
def test_halves_are_rounded_as_the_device_does(rule: str, rounded: list[int]) -> None:
    halves = [Fraction(1, 2), Fraction(-3, 2), Fraction(3, 2)]

    assert [ROUNDINGS[rule](half) for half in halves] == rounded


@given(st.floats(min_value=-1e300, max_value=1e300))
def test_a_float_counts_as_its_shortest_decimal(value: float) -> None:
    assert exact(value) == Fraction(repr(value))


def test_the_wrong_number_of_words_is_a_mistake_of_the_caller() -> None:
    with pytest.raises(ValueError, match="2 words"):
        ieee.decode((1,))
