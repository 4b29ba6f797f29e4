"""What may be written at a cursor, in texts that are as broken as texts are while they are typed."""

import pytest

from regscribe.language_server.completion import Proposal, complete

from .conftest import At
from .texts import HEAD


def proposed(at: At, text: str, **more: str) -> list[Proposal]:
    return complete(*at(text, **more))


def labels(at: At, text: str, **more: str) -> list[str]:
    return [one.label for one in proposed(at, text, **more)]


@pytest.mark.parametrize(
    "line",
    [
        "      - {at: 15, name: Lo, │",
        "      - {at: 15, name: Lo, │}",
        "      - {at: 15, │, name: Lo}",
        "      - {at: 15, name: Lo, un│",
        "      - at: 15\n        name: Lo\n        │",
        "      - at: 15\n        │\n        name: Lo",
    ],
)
def test_a_register_gets_the_keys_that_it_has_not(at: At, line: str) -> None:
    found = labels(at, f"{HEAD}{line}\n      - {{at: 16, name: Hi}}\n")
    assert {"unit", "enum", "range", "when", "models"} <= set(found)
    assert not {"at", "name", "registers", "repeat", "set", "maker"} & set(found)


@pytest.mark.parametrize(
    "line",
    [
        "      -│",
        "      -│ {at: 15, name: Lo}",
        "      │- {at: 15, name: Lo}",
        "    │  - {at: 15, name: Lo}",
        "      - {at:│ 15, name: Lo}",
        "      - {at: 15, access:│}",
        "      - {at: 15, name: Lo, range: [0, 1]│}",
        "      - at: 15\n        access: r│\n          and\n",
    ],
)
def test_nothing_is_proposed_where_no_word_can_stand(at: At, line: str) -> None:
    assert labels(at, f"{HEAD}{line}\n") == []


def test_a_key_that_would_not_go_with_another_is_not_proposed(at: At) -> None:
    found = labels(at, f"{HEAD}      - {{at: 15, models: [A1], │}}\n")
    assert "models" not in found
    assert "except" not in found


def test_what_is_to_be_an_element_may_become_a_register_an_array_or_a_set(at: At) -> None:
    assert {"at", "name", "registers", "set"} <= set(labels(at, f"{HEAD}      - {{│}}\n"))
    assert {"at", "name", "registers", "set"} <= set(labels(at, f"{HEAD}      - │\n"))


def test_an_array_gets_the_keys_of_an_array(at: At) -> None:
    found = labels(at, f"{HEAD}      - {{id: zones, registers: [], │}}\n")
    assert {"repeat", "stride", "each"} <= set(found)
    assert "unit" not in found


def test_the_top_of_a_map_gets_what_a_map_may_hold_and_no_key_of_a_library(at: At) -> None:
    found = labels(at, f"{HEAD}│\n")
    assert {"protocol", "examples", "sets"} <= set(found)
    assert not {"groups", "library"} & set(found)


def test_an_element_of_a_list_starts_with_its_dash(at: At) -> None:
    found = proposed(at, f"{HEAD}examples:\n  │\n")
    assert "- register: " in {one.insert for one in found}


def test_a_key_is_told_with_what_the_schema_says_of_it(at: At) -> None:
    found = next(one for one in proposed(at, f"{HEAD}      - {{at: 15, │}}\n") if one.label == "name")
    assert found.insert == "name: "
    assert found.detail == "needed"
    assert "The manual's name of the register" in found.about


def test_a_key_before_its_colon_gets_no_second_one(at: At) -> None:
    found = proposed(at, f"{HEAD}      - {{at: 15, un│: s}}\n")
    assert "unit" in {one.insert for one in found}


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("{at: 15, access: │}", ["r", "rw", "w"]),
        ("{at: 15, static: │}", ["true", "false"]),
        ("{at: 15, enum: │", ["mode"]),
        ("{at: 15, when: │", ["manual_mode"]),
        ("{at: 15, models: [│", ["A1", "B2"]),
        ("{at: 15, models: [A1, │]}", ["B2"]),
        ("{at: 15, when: {mode: │", ["automatic", "manual"]),
        ("{at: 15, when: {mode: [manual, │", ["automatic", "manual"]),
        ("{at: 15, enum: mode, default: │", ["0 = automatic", "1 = manual"]),
        ("{at: 15, rescales: │", ["temperature"]),
        ("{at: 15, shadows: set│}", ["mode", "fahrenheit", "setpoint"]),
    ],
)
def test_values_are_the_words_and_names_that_fit(at: At, line: str, expected: list[str]) -> None:
    found = labels(at, f"{HEAD}      - {line}\n")
    assert found[: len(expected)] == expected
    assert len(found) == len(expected) or line.startswith("{at: 15, rescales") or "shadows" in line


def test_units_are_those_of_the_map_and_the_known_ones_as_yaml_reads_them(at: At) -> None:
    found = {one.label: one.insert for one in proposed(at, f"{HEAD}      - {{at: 15, unit: │\n")}
    assert found["temperature"] == "temperature"
    assert found["%"] == "'%'"


def test_tests_of_a_condition_are_registers_and_its_own_words(at: At) -> None:
    found = [one.insert for one in proposed(at, f"{HEAD}      - {{at: 15, when: {{│\n")]
    assert {"any: ", "mode: ", "setpoint: "} <= set(found)


def test_names_of_a_library_and_of_the_base_count_as_well(at: At) -> None:
    common = "format: 1\nlibrary: {id: acme/common, title: T}\nenums:\n  shared: {0: a}\n"
    text = HEAD.replace("conditions:", "uses: [acme/common]\nconditions:", 1)
    found = labels(at, f"{text}      - {{at: 15, enum: │\n", common__library__yaml=common)
    assert set(found) == {"mode", "shared"}


def test_registers_of_the_same_element_are_called_by_their_ids(at: At) -> None:
    array = "      - {id: zones, repeat: 1..2, registers: [{at: 50, name: Limit}, {at: 51, shadows: │}]}\n"
    assert "limit" in labels(at, HEAD + array)


@pytest.mark.parametrize("text", ["# a comm│ent\n", "map: {title: Bo│iler}\n", "notes:\n  - any │text\n"])
def test_nothing_is_proposed_in_comments_and_free_texts(at: At, text: str) -> None:
    assert labels(at, text) == []
