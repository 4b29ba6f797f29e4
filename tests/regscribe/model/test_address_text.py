"""Addresses as people write them: every notation is read, and each has all its meanings."""

import pytest

from regscribe.model import Space
from regscribe.model.address_text import hexadecimal, modicon, readings


def meanings(text: str) -> list[tuple[int, Space | None]]:
    return [(each.address, each.space) for each in readings(text)]


@pytest.mark.parametrize("text", ["4049", "0xFD1", "0XfD1", "FD1h", "0fd1H", "$FD1", " 4049 "])
def test_a_wire_address_is_read_in_every_notation(text: str) -> None:
    assert meanings(text) == [(4049, None)]


def test_a_number_of_five_digits_is_a_wire_address_and_one_of_modicon() -> None:
    assert meanings("44050") == [(44050, None), (4049, Space.HOLDING)]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("00001", [(1, None), (0, Space.COIL)]),
        ("10001", [(10001, None), (0, Space.DISCRETE)]),
        ("30001", [(30001, None), (0, Space.INPUT)]),
        ("400001", [(0, Space.HOLDING)]),
        ("465536", [(65535, Space.HOLDING)]),
        ("465537", []),
        ("40000", [(40000, None)]),
        ("65535", [(65535, None)]),
        ("65536", []),
        ("99999", []),
        ("000001", [(1, None), (0, Space.COIL)]),
    ],
)
def test_modicon_counts_from_one_and_says_the_space(text: str, expected: list[tuple[int, Space | None]]) -> None:
    assert meanings(text) == expected


@pytest.mark.parametrize(
    "text", ["", "0x", "0x10000", "-1", "12.5", "setpoint", "٤٠٤٩", "h", "each", "4049h1", "1234567", "0b1"]
)
def test_what_is_no_address_has_no_meaning(text: str) -> None:
    assert meanings(text) == []


def test_an_address_is_written_in_modicon_with_the_digits_that_it_needs() -> None:
    assert modicon(Space.HOLDING, 4049) == "44050"
    assert modicon(Space.HOLDING, 9998) == "49999"
    assert modicon(Space.HOLDING, 9999) == "410000"
    assert modicon(Space.COIL, 0) == "00001"
    assert modicon(Space.INPUT, 65535) == "365536"
    assert modicon(Space.FILE, 3) == ""
    assert hexadecimal(4049) == "0xFD1"
