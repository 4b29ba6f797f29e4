from fractions import Fraction

import pytest

from regscribe.reference.states import Stretch, combinations, listed, representatives


def codes(*pairs: tuple[int, int]) -> list[Stretch]:
    return [Stretch(Fraction(low), Fraction(high)) for low, high in pairs]


def test_a_wide_domain_is_represented_by_its_ends_and_by_both_sides_of_each_code() -> None:
    assert representatives(codes((0, 65535)), codes((3, 5))) == (0, 2, 3, 5, 6, 65535)


def test_members_that_no_code_tells_apart_are_represented_by_the_first_and_the_last_of_them() -> None:
    members = codes(*((code, code) for code in (0, 1, 2, 7, 9, 20)))
    assert representatives(members, codes((1, 7))) == (0, 1, 7, 9, 20)


def test_every_set_of_codes_that_a_value_can_lie_in_is_represented() -> None:
    domain, asked = codes((0, 9), (40, 60)), codes((2, 8), (4, 50), (100, 200))
    every = {tuple(one.holds(Fraction(value)) for one in asked) for value in (*range(10), *range(40, 61))}
    assert {tuple(one.holds(value) for one in asked) for value in representatives(domain, asked)} == every


def test_a_code_between_whole_numbers_is_a_value_of_a_short_range_as_well() -> None:
    half = Stretch(Fraction(1, 2), Fraction(1, 2))
    assert Fraction(1, 2) in representatives(codes((0, 3)), [half])


@pytest.mark.parametrize("many", [(0, 32), (-(10**30), 10**30)])
def test_a_domain_of_more_values_than_can_be_listed_lists_none(many: tuple[int, int]) -> None:
    assert listed(codes(many)) == ()
    assert listed(codes((0, 31))) == tuple(range(32))


def test_every_combination_is_made_and_the_last_choice_changes_first() -> None:
    found = list(combinations({"mode": "ab", "kind": "xy"}))
    assert [one["mode"] + one["kind"] for one in found] == ["ax", "ay", "bx", "by"]
