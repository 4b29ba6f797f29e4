"""What a command sets by its effect is held exactly, or the map is refused."""

from typing import Any

import pytest

from regscribe.simulate.device.device import SimulatedDevice

from .matrix_watch import Wire
from .suite import Json, build, diagnose, errors_of, whole_map

FAST = {"special": {0: {"label": "fast", "means": 0.25}}}
PARTS = {"fields": {"x": {"bits": "4..5"}, "y": {"bits": "6..7", "enum": {1: "one"}}}}


def with_effect(keys: Json, sets: Json) -> str:
    """A map of one register, which a command sets besides the words that it writes."""
    go = {"name": "Go", "source": "1", "steps": [{"at": 90, "words": [1]}], "effects": [{"set": sets}]}
    return whole_map({"registers": [{"at": 0, "name": "V", **keys}], "commands": {"go": go}})


@pytest.mark.parametrize(
    ("keys", "given", "read"),
    [
        ({"decimals": 1}, 0.3, 0.3),
        ({"range": "0..10"}, 50, 50),
        ({"type": "float32"}, 0.1, 0.1),
        ({"enum": {1: "one", 2: "two"}}, "two", 2),
        ({"space": "coil"}, 1, True),
        ({"flags": {0: "low"}}, 3, 3),
        ({"version": "nn.nn"}, "01.20", "01.20"),
        ({"type": "string", "length": 2}, "ab", "ab"),
        (FAST, "fast", 0.25),
        (FAST, 0.25, 0.25),
    ],
)
def test_an_effect_sets_a_value_of_the_register(keys: Json, given: Any, read: object) -> None:
    built = build(with_effect(keys, {"v": given}))
    driver = built.module.CaseA(Wire(SimulatedDevice(built.map, "A", unit=1).handle), unit=1)
    driver.commands.go()
    assert driver.v.read() == read


@pytest.mark.parametrize(
    ("keys", "sets"),
    [
        ({"decimals": 1}, {"v": 0.25}),
        ({"decimals": 1}, {"v": 99999}),
        ({}, {"v": -1}),
        ({"type": "float32"}, {"v": 16777217}),
        ({"space": "coil"}, {"v": 2}),
        ({"kind": "boolean"}, {"v": 2}),
        ({"enum": {1: "one"}}, {"v": 2}),
        ({"version": "nn.nn"}, {"v": 1.2}),
        ({"version": "nn.nn"}, {"v": "1.20"}),
        ({"type": "string", "length": 2}, {"v": "abcde"}),
        (PARTS, {"v": 65536}),
        (PARTS, {"v": 0}),
        (PARTS, {"v.x": 9}),
        (PARTS, {"v.x": 0.5}),
        (PARTS, {"v.x": -1}),
        (PARTS, {"v.y": 2}),
    ],
)
def test_an_effect_that_the_register_cannot_hold_is_refused(keys: Json, sets: Json) -> None:
    _, found = diagnose(with_effect(keys, sets))
    assert [one.rule for one in errors_of(found)] == ["RS0497"]
