"""Defaults beside what a device holds: conditions on what has no default make no differences."""

from typing import Any

import pytest

from regscribe.tools import settings

from .matrix_watch import Wire
from .suite import build, whole_map
from .wire import Memory

Rows = list[dict[str, Any]]
CARD = {"at": 0, "name": "Card", "type": "uint16"}
WITH_CARD = {"card": 1}
BY_CASE = {"enum": [{"when": WITH_CARD, "is": {0: "a", 1: "aa"}}, {"is": {0: "b", 1: "bb"}}]}
FIELDS = {"fields": {"a": {"bits": "0..3"}, "b": {"bits": "4..7", "when": WITH_CARD}}}
FLAGS = {"flags": {0: "on", 4: {"label": "hot", "when": WITH_CARD}}}
UNITS = {"unit": [{"when": WITH_CARD, "is": "°C"}, {"is": "°F"}]}


def found(register: dict[str, Any], word: int, *, card: int, standard: int | None) -> list[tuple[str, Any, Any]]:
    """The differences of a device and its defaults; `standard` is the default of the register of the condition."""
    first = CARD if standard is None else {**CARD, "default": standard}
    built = build(whole_map({"registers": [first, {"at": 10, "name": "It", "type": "uint16", **register}]}))
    memory = Memory()
    memory.put("holding", 0, [card])
    memory.put("holding", 10, [word])
    driver = built.module.CaseA(Wire(memory.answer), unit=1)
    held = settings.Side.of(driver.run(settings.backup(type(driver))), "device")
    factory = settings.factory(type(driver), held.settings)
    sides = settings.Side("factory", held.map_id, held.model, factory)
    all_of = settings.differences(held, sides, missing=False)
    return [(one.path, one.left and one.left.value, one.right and one.right.value) for one in all_of]


@pytest.mark.parametrize("card", [0, 1])
@pytest.mark.parametrize(
    ("register", "default"), [(BY_CASE, 1), (FIELDS, 0x10), (FLAGS, 0x11), (UNITS, 5), ({"when": WITH_CARD}, 5)]
)
def test_the_default_is_no_difference_whatever_the_condition_without_a_default_is(
    register: dict[str, Any], default: int, card: int
) -> None:
    assert found({**register, "default": default}, default, card=card, standard=None) == []


@pytest.mark.parametrize("register", [BY_CASE, FIELDS, FLAGS])
def test_another_code_is_a_difference(register: dict[str, Any]) -> None:
    ((path, _, default),) = found({**register, "default": 1}, 0, card=1, standard=None)
    assert (path, default) == ("it", 1)


@pytest.mark.parametrize("register", [FIELDS, FLAGS])
def test_bits_of_what_does_not_exist_as_delivered_are_shown_as_on_the_device(register: dict[str, Any]) -> None:
    assert found({**register, "default": 0x11}, 0x11, card=0, standard=0) == []


def test_what_does_not_exist_as_delivered_has_no_default() -> None:
    assert found({"when": WITH_CARD, "default": 5}, 7, card=1, standard=0) == [("card", 1, 0)]


@pytest.mark.parametrize("count", [0, 1, 2])
def test_an_element_that_does_not_exist_is_no_difference(count: int) -> None:
    inside = [{"at": 10, "name": "It", "type": "uint16", "default": 5}]
    array = {"id": "items", "name": "Items", "repeat": {"from": 1, "to": "card", "most": 2}, "stride": 1}
    built = build(whole_map({"registers": [CARD, {**array, "registers": inside}]}))
    memory = Memory()
    memory.put("holding", 0, [count])
    memory.put("holding", 10, [5, 5])
    driver = built.module.CaseA(Wire(memory.answer), unit=1)
    held = settings.Side.of(driver.run(settings.backup(type(driver))), "device")
    factory = settings.Side("factory", "", "", settings.factory(type(driver), held.settings))
    assert settings.differences(held, factory, missing=False) == ()
