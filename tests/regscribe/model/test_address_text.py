"""Addresses as people write them: every notation is read, and each has all its meanings."""

import pytest

from regscribe.model import Space
from regscribe.model.address_text import hexadecimal, modicon, readings

from .address_cases import MEANINGS, MODICON_NUMBERS, NO_ADDRESSES


@pytest.mark.parametrize(("text", "expected"), MEANINGS.items())
def test_an_address_has_all_meanings_that_it_can_have(text: str, expected: list[tuple[int, Space | None]]) -> None:
    assert [(each.address, each.space) for each in readings(text)] == expected


@pytest.mark.parametrize("text", NO_ADDRESSES)
def test_what_is_no_address_has_no_meaning(text: str) -> None:
    assert readings(text) == ()


@pytest.mark.parametrize(("space", "address", "expected"), MODICON_NUMBERS)
def test_an_address_is_written_in_modicon_with_the_digits_that_it_needs(
    space: Space, address: int, expected: str
) -> None:
    assert modicon(space, address) == expected


def test_an_address_is_written_in_hexadecimal_digits() -> None:
    assert hexadecimal(4049) == "0xFD1"
