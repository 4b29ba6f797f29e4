"""The reference codec against numbers worked out by hand or printed in manuals."""

from dataclasses import replace
from fractions import Fraction

import pytest

from regscribe.model import (
    ALWAYS,
    Access,
    Case,
    Condition,
    Conversion,
    Decimals,
    Kind,
    Order,
    Register,
    Rounding,
    Sentinel,
    Special,
    View,
    WireType,
    always,
    order_from,
)
from regscribe.model import Is as Asked
from regscribe.reference import Meaning, RefusedError, Surroundings, decode, encode, transmit

INT16 = View("base", WireType.INT16, offset=36, rounding=Rounding.HALF_UP)
UINT16 = View("base", WireType.UINT16)
X10 = INT16._replace(name="x10", offset=1036, factor=Fraction(10), saturates=True)
FLOAT = View("ieee", WireType.FLOAT32, offset=8072, words=2)
AFFINE = Conversion(Fraction(65535, 655350), Fraction(-19999, 10))


def register(*views: View, kind: Kind = Kind.NUMBER) -> Register:
    return Register(at=0, id="r", path="r", name="R", kind=kind, access=Access.READ_WRITE, views=views)


def state(**values: int) -> Surroundings:
    return Surroundings({name: Fraction(value) for name, value in values.items()})


@pytest.mark.parametrize(("raw", "value"), [(20249, "25"), (0, "-1999.9"), (65535, "4553.6"), (19999, "0")])
def test_an_affine_word_is_a_straight_line_between_the_ends(raw: int, value: str) -> None:
    set_point = replace(register(UINT16), scale=always(AFFINE))
    assert decode(set_point, UINT16, (raw,)).value == Fraction(value)
    assert encode(set_point, UINT16, Fraction(value)) == (raw,)


@pytest.mark.parametrize(
    ("words", "value"),
    [
        ((0x437A, 0x0000), "250"),
        ((0x437A, 0x6666), "250.4"),
        ((0x3F80, 0x0000), "1"),
        ((0xC2F6, 0xE979), "-123.456"),
        ((0x0000, 0x0000), "0"),
        ((0x0000, 0x0001), "1e-45"),
    ],
)
def test_a_float32_is_its_shortest_decimal(words: tuple[int, int], value: str) -> None:
    assert decode(register(FLOAT), FLOAT, words).value == Fraction(value)
    assert encode(register(FLOAT), FLOAT, Fraction(value)) == words


def test_a_number_midway_between_two_floats_is_sent_as_the_even_one() -> None:
    assert transmit(FLOAT, Fraction(2**24 + 1)) == (0x4B80, 0x0000)
    assert transmit(FLOAT, Fraction(2**24 + 3)) == (0x4B80, 0x0002)


def test_the_word_order_can_come_from_a_register() -> None:
    view = FLOAT._replace(order=order_from("order", ((0, Order.BIG), (1, Order.LITTLE))))
    assert decode(register(view), view, (0x0000, 0x437A), state(order=1)).value == 250
    assert decode(register(view), view, (0x437A, 0x0000), state(order=0)).value == 250
    assert decode(register(view), view, (0x437A, 0x0000), state(order=2)).meaning is Meaning.NOT_DECODABLE


@pytest.mark.parametrize(
    ("rounding", "sent"),
    [
        (Rounding.HALF_UP, (3, -2)),
        (Rounding.HALF_AWAY, (3, -3)),
        (Rounding.HALF_EVEN, (2, -2)),
        (Rounding.DOWN, (2, -2)),
    ],
)
def test_a_device_rounds_a_half_as_its_view_says(rounding: Rounding, sent: tuple[int, int]) -> None:
    view = INT16._replace(rounding=rounding)
    both = (Fraction(5, 2), Fraction(-5, 2))
    assert tuple(transmit(view, half)[0] for half in both) == tuple(word % 65536 for word in sent)


@pytest.mark.parametrize("rounding", [Rounding.HALF_UP, Rounding.HALF_AWAY, Rounding.HALF_EVEN])
def test_what_is_nearer_is_sent_whatever_becomes_of_a_half(rounding: Rounding) -> None:
    view = INT16._replace(rounding=rounding)
    assert [transmit(view, Fraction(text))[0] for text in ("2.4", "2.6", "-2.4", "-2.6")] == [2, 3, 65534, 65533]


def test_a_stored_half_is_sent_rounded_and_ten_times_exactly() -> None:
    assert transmit(INT16, Fraction("120.5")) == (121,)
    assert transmit(X10, Fraction("150.5")) == (1505,)


@pytest.mark.parametrize(("stored", "word"), [(7895, 0x7FFF), (-7895, 0x8000)])
def test_a_saturating_view_stops_at_its_ends_and_is_not_decoded_there(stored: int, word: int) -> None:
    assert transmit(X10, Fraction(stored)) == (word,)
    assert decode(register(X10), X10, (word,)).meaning is Meaning.SATURATED


def test_decimals_from_a_register_count_while_their_condition_holds() -> None:
    linear = Condition((Asked("input", codes=((Fraction(13), Fraction(22)),)),))
    scale = (Case(linear, Conversion(decimals=Decimals("digits", 3))), Case(ALWAYS, Conversion()))
    alarm = replace(register(INT16), scale=scale)
    assert decode(alarm, INT16, (9575,), state(input=14, digits=2)).value == Fraction("95.75")
    assert decode(alarm, INT16, (9575,), state(input=3, digits=2)).value == 9575
    assert encode(alarm, INT16, Fraction("95.75"), state(input=14, digits=2)) == (9575,)


@pytest.mark.parametrize("at_most", [None, 3])
@pytest.mark.parametrize("digits", [10, 65535, 10**30])
def test_what_is_no_number_of_decimals_neither_scales_nor_takes_forever(digits: int, at_most: int | None) -> None:
    alarm = replace(register(INT16), scale=always(Conversion(decimals=Decimals("digits", at_most))))
    assert decode(alarm, INT16, (9575,), state(digits=9)).value in {Fraction(9575, 10**9), Fraction(9575, 10**3)}
    assert decode(alarm, INT16, (9575,), state(digits=digits)).meaning is Meaning.NOT_DECODABLE
    with pytest.raises(RefusedError):
        encode(alarm, INT16, Fraction(1), state(digits=digits))


def test_a_sentinel_is_a_fault_and_no_number() -> None:
    sensor = replace(register(INT16), sentinels=(Sentinel(Fraction(-32768), "low", "sensor low"),))
    assert decode(sensor, INT16, (0x8000,)).fault == "low"
    with pytest.raises(RefusedError):
        encode(sensor, INT16, Fraction(-32768))


def test_a_special_value_stands_for_the_number_it_means() -> None:
    cycle = replace(register(INT16), specials=(Special(Fraction(0), "0.2 s", "fast", means=Fraction("0.2")),))
    assert decode(cycle, INT16, (0,)).value == Fraction("0.2")
    assert encode(cycle, INT16, Fraction("0.2")) == (0,)


def test_a_version_packs_its_digits_in_groups() -> None:
    version = replace(register(INT16, kind=Kind.VERSION), version_digits=6, version_group=2)
    assert decode(version, INT16, (13100,)).value == "01.31.00"


def test_a_text_has_two_characters_a_word_in_the_order_of_the_bytes() -> None:
    view = View("base", WireType.STRING, words=2)
    tag = register(view, kind=Kind.STRING)
    swapped = view._replace(byte_order=Order.LITTLE)
    assert decode(tag, view, (0x4D33, 0x0000)).value == "M3"
    assert decode(register(swapped, kind=Kind.STRING), swapped, (0x334D, 0x0000)).value == "M3"
