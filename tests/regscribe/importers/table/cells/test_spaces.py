"""Address spaces by words, functions and leading digits."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from regscribe.importers.table.cells import Unclear
from regscribe.importers.table.cells.spaces import SpaceCell, parse_space, parse_spaces
from regscribe.model import Space

HOLDING, INPUT, COIL, DISCRETE = Space.HOLDING, Space.INPUT, Space.COIL, Space.DISCRETE


@pytest.mark.parametrize(
    ("text", "space"),
    [
        ("Holding", HOLDING),
        ("holding register", HOLDING),
        ("4x", HOLDING),
        ("Halteregister", HOLDING),
        ("HR", HOLDING),
        ("Input Register", INPUT),
        ("Eingangsregister", INPUT),
        ("3x", INPUT),
        ("MODBUS_INPUT_REGISTER", INPUT),
        ("Coil", COIL),
        ("Digital output", COIL),
        ("Discrete Input", DISCRETE),
        ("DI", DISCRETE),
        ("1x", DISCRETE),
        ("input status", DISCRETE),
        ("保持寄存器", HOLDING),
        ("Registres d'entrée", INPUT),
    ],
)
def test_words_say_the_space(text: str, space: Space) -> None:
    assert parse_spaces([text]).cells == (SpaceCell(space),)


@pytest.mark.parametrize(
    ("text", "space", "functions"),
    [
        ("03", HOLDING, (3,)),
        ("FC3", HOLDING, (3,)),
        ("FC 04", INPUT, (4,)),
        ("0x03/0x06", HOLDING, (3, 6)),
        ("3,6,16", HOLDING, (3, 6, 16)),
        ("R:03 W:06/16", HOLDING, (3, 6, 16)),
        ("03 (R)", HOLDING, (3,)),
        ("0x10", HOLDING, (16,)),
        ("01/05/15", COIL, (1, 5, 15)),
        ("02", DISCRETE, (2,)),
        ("03h", HOLDING, (3,)),
    ],
)
def test_functions_say_the_space(text: str, space: Space, functions: tuple[int, ...]) -> None:
    assert parse_spaces([text]).cells == (SpaceCell(space, functions),)


def test_functions_of_two_spaces_are_unclear() -> None:
    assert parse_spaces(["03/04"]).cells == (Unclear("the functions `03/04` are not all of one space"),)


def test_bare_3_and_4_are_unclear_until_the_heading_the_other_rows_or_the_user_say_what_they_are() -> None:
    assert all(isinstance(cell, Unclear) for cell in parse_spaces(["3", "4"]).cells)
    by_function, by_region = (SpaceCell(HOLDING, (3,)), SpaceCell(INPUT, (4,))), (SpaceCell(INPUT), SpaceCell(HOLDING))
    assert parse_spaces(["3", "4"], "Function").cells == by_function
    assert parse_spaces(["3", "4"], "Region").cells == by_region
    assert parse_spaces(["3", "4", "0"]).cells[:2] == by_region
    assert parse_spaces(["3", "4", "2"]).cells[:2] == by_function
    assert parse_spaces(["3", "4"], digits="region").cells == by_region


def test_what_says_no_space_is_unclear_in_a_column_and_nothing_in_a_title() -> None:
    assert isinstance(parse_spaces(["bla"]).cells[0], Unclear)
    assert parse_space("Alarms") is None
    assert parse_space("Input registers of the meter") == SpaceCell(INPUT)


@given(st.lists(st.text(max_size=20), max_size=5), st.text(max_size=10))
def test_no_column_raises(texts: list[str], heading: str) -> None:
    assert len(parse_spaces(texts, heading).cells) == len(texts)
