"""Labels of others as members of enums and flags: each gets an id that Python can have, unlike all others."""

from fractions import Fraction

import pytest

from regscribe.draft.labels import described, labelled
from regscribe.draft.numbers import plain, scaling, unscaled
from regscribe.draft.text import group_id


@pytest.mark.parametrize(
    ("labels", "keys"),
    [
        ({0: "off", 1: "on"}, {0: "off", 1: "on"}),
        ({1: "heat", 2: "heat"}, {1: "heat", 2: {"label": "heat", "id": "heat_2"}}),
        ({1: "a-b", 2: "a b"}, {1: "a-b", 2: {"label": "a b", "id": "a_b_2"}}),
        ({1: "关", -2: "°"}, {1: {"label": "关", "id": "code_1"}, -2: {"label": "°", "id": "code_minus_2"}}),
        ({1: "name"}, {1: {"label": "name", "id": "code_1"}}),
        ({1: "  two \n lines "}, {1: "two lines"}),
        ({3: ""}, {3: "code 3"}),
    ],
)
def test_a_label_that_gives_no_id_of_its_own_gets_one(labels: dict[int, str], keys: dict[int, object]) -> None:
    assert labelled(labels) == keys


def test_a_description_that_repeats_the_name_is_none() -> None:
    assert described("Flow Rate", "flow-rate") == {}
    assert described("Flow", " rate\n of it ") == {"description": "rate of it"}


def test_numbers_are_written_with_all_their_digits() -> None:
    assert str(plain(Fraction("0.10"))) == "0.1"
    assert plain(Fraction(7)) == 7
    assert plain(Fraction(1, 3)) == "1/3"


def test_a_power_of_ten_is_a_number_of_decimals() -> None:
    assert scaling(Fraction(1, 1000)) == {"decimals": 3}
    assert scaling(Fraction(1)) == {}
    assert scaling(Fraction(1, 10), Fraction(-40)) == {"multiply": plain(Fraction(1, 10)), "add": -40}
    assert scaling(Fraction(10)) == {"multiply": 10}


def test_a_raw_number_keeps_nothing_that_counts_in_its_unit() -> None:
    keys = {"at": 1, "unit": "V", "multiply": 2, "range": "0..5", "default": 3, "valid": "0..5", "access": "rw"}
    assert unscaled(keys) == {"at": 1, "unit": "V", "access": "rw", "decimals": "not_stated"}


def test_group_ids_that_readers_would_mistake_are_told_apart() -> None:
    assert group_id("Mode A", {"modea"}) == "mode_a_2"
