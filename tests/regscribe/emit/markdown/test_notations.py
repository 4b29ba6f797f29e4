"""Beside a wire address stands each way to write it once; what is no number in a request has none."""

from collections.abc import Callable
from dataclasses import replace

import pytest

from regscribe.emit.markdown.notations import columns, notations
from regscribe.model import Notation, RegisterMap, Space


@pytest.mark.parametrize(
    ("space", "address", "expected"),
    [
        (Space.HOLDING, 4049, "0xFD1, Modicon 44050"),
        (Space.HOLDING, 12544, "0x3100, Modicon 412545"),
        (Space.INPUT, 9, "0x9, Modicon 30010"),
        (Space.COIL, 16, "0x10, Modicon 00017"),
        (Space.DISCRETE, 16, "0x10, Modicon 10017"),
        (Space.HOLDING, (2 << 16) + 10, "0xA"),  # on page 2: Modicon counts no pages
        (Space.ENRON, Space.ENRON.within(5001), "0x1389"),  # Modicon's registers have 16 bits
        (Space.FILE, (4 << 16) + 10, ""),
        (Space.QUEUE, (3 << 6) + 1, ""),
        (Space.IDENTIFICATION, 5 << 8, ""),
        (Space.STATUS, 0, ""),
    ],
)
def test_an_address_has_the_notations_of_its_space(
    oven: RegisterMap, space: Space, address: int, expected: str
) -> None:
    assert notations(replace(oven, notations=()), space, address) == expected


@pytest.mark.parametrize("offset", [40001, 400001])
def test_modicons_number_is_not_repeated_where_the_map_says_it(oven: RegisterMap, offset: int) -> None:
    own = replace(oven, notations=(Notation("list", Space.HOLDING, offset),))
    assert notations(own, Space.HOLDING, 10) == f"0xA, list {offset + 10}"
    assert [name for name, _ in columns(own, Space.HOLDING)] == ["list"]


def test_another_numbering_of_the_map_stands_beside_modicons(oven: RegisterMap) -> None:
    own = replace(oven, notations=(Notation("JBUS", Space.HOLDING, 1), Notation("JBUS", Space.COIL, 1)))
    assert notations(own, Space.HOLDING, 10) == "0xA, JBUS 11, Modicon 40011"
    assert notations(own, Space.INPUT, 10) == "0xA, Modicon 30011"


def test_hexadecimal_is_not_repeated_where_the_map_counts_in_it(oven: RegisterMap) -> None:
    own = replace(oven, notations=(Notation("list", Space.HOLDING, 0, base=16),))
    assert notations(own, Space.HOLDING, 10) == "list 0x000A, Modicon 40011"


def test_a_section_begins_with_the_address(section: Callable[[str], str]) -> None:
    assert section("register-input_type").splitlines()[2].startswith("holding 4000 (0xFA0, absolute 44001) · ")
    assert section("register-segments-ramp_time").splitlines()[2].startswith("holding 4200 to 4209 (0x1068 to 0x1071) ")
