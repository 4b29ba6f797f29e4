"""A default is what a new device reads as: driver, simulator and reference page say the same, and it may be written."""

from typing import Any, NamedTuple

import pytest

from regscribe.emit import markdown
from regscribe.model import RegisterMap
from regscribe.simulate.device.device import SimulatedDevice
from regscribe.tools.settings import factory

from .matrix_watch import Wire
from .suite import Json, build, whole_map

FAST = {"special": {0: {"label": "fast", "means": 0.25}}, "range": "1..20"}
SWAPPED = {"special": {0: {"label": "five", "means": 5}, 5: {"label": "none", "means": 0}}}


class New(NamedTuple):
    """A new device and its driver."""

    map: RegisterMap
    device: SimulatedDevice
    driver: Any


def new(*registers: Json, **tables: Json) -> New:
    """A new device that has these registers, each at an address of its own."""
    built = build(whole_map({"registers": [{"at": 4 * at, **one} for at, one in enumerate(registers)], **tables}))
    device = SimulatedDevice(built.map, "A", unit=1)
    return New(built.map, device, built.module.CaseA(Wire(device.handle), unit=1))


@pytest.mark.parametrize(
    ("keys", "default", "words", "told"),
    [
        (FAST | {"default": "fast"}, 0.25, (0,), "0.25 = fast"),
        (FAST | {"default": 0}, 0.25, (0,), "0.25 = fast"),
        (FAST | {"default": 0.25}, 0.25, (0,), "0.25 = fast"),
        (FAST | {"default": 7}, 7, (7,), "7"),
        (SWAPPED | {"default": 0}, 0, (5,), "0 = none"),
        (SWAPPED | {"default": "five"}, 5, (0,), "5 = five"),
        ({"version": "nn.nn", "default": "01.20"}, "01.20", (120,), "01.20"),
        ({"special": {1: {"label": "far", "means": 100000}}, "default": "far"}, 100000, (1,), "100000 = far"),
    ],
)
def test_a_new_device_reads_as_its_default(keys: Json, default: object, words: tuple[int, ...], told: str) -> None:
    made = new({"name": "V", **keys})
    declared = made.driver.registers["v"].default
    assert (declared, made.driver.v.read(), made.device.peek_words("v")) == (default, default, words)
    made.driver.v.write(declared)
    assert made.device.peek_words("v") == words
    assert factory(made.driver)["v"].value == default
    assert any(f"{told} |" in page for page in markdown.render(made.map).values())


def test_what_is_delivered_may_be_told_by_its_code() -> None:
    assert new({"name": "V", **FAST, "default": 3, "delivered": 0}).device.peek_words("v") == (0,)


def test_what_is_delivered_of_a_version_is_its_text() -> None:
    assert new({"name": "V", "version": "nn.nn", "delivered": "01.20"}).device.peek_words("v") == (120,)


def test_a_device_may_be_delivered_with_bits_that_have_no_name() -> None:
    assert int(new({"name": "V", "flags": {0: "low"}, "delivered": 3}).driver.v.read()) == 3


def test_a_condition_names_a_special_value_that_stands_for_another_number() -> None:
    made = new({"name": "V", **FAST}, {"name": "W", "writable": {"when": {"v": "fast"}, "reason": "when it is fast"}})
    made.driver.v.write(0.25)
    made.driver.w.write(3)
    assert made.device.peek("w") == 3
