"""Modules of modbus_exporter; expected values follow from its documentation, by hand."""

from collections.abc import Callable
from fractions import Fraction

import pytest

from regscribe import plugins
from regscribe.importers.modbus_exporter import likeness
from regscribe.plugins import Likeness, OptionError

from .conftest import Import

MODULE = """\
modules:
  - name: meter
    protocol: tcp/ip
    metrics:
      - {name: power, help: Active power, address: 310, dataType: int16, factor: 0.5, labels: {phase: "1"}}
      - {name: power, help: Active power, address: 311, dataType: int16, factor: 0.5, labels: {phase: "2"}}
      - {name: energy, address: "400020", dataType: uint32, endianness: yolo, metricType: counter}
      - {name: level, address: 300030, dataType: float32, endianness: mixed}
      - {name: back, address: 300032, dataType: float32, endianness: little}
      - {name: alarm, address: 340, dataType: bool, bitOffset: 9}
      - {name: run, address: 340, dataType: bool, bitOffset: 0}
      - {name: valve, address: 17, dataType: bool, bitOffset: 0}
      - {name: nowhere, address: 3, dataType: int16}
      - {name: half, address: 350, dataType: float16}
      - {name: naught, address: 351, dataType: int16, factor: 0}
"""


def test_the_first_digit_is_the_function_and_three_is_holding(imported: Import) -> None:
    found = imported("modbus-exporter", MODULE)
    assert (found.register("power_1").base.space, found.register("power_1").address) == ("holding", 10)
    assert (found.register("energy").base.space, found.register("energy").address) == ("input", 20)
    assert (found.register("valve").base.space, found.register("valve").address) == ("coil", 7)
    assert "3" in found.left_out["nowhere"]


def test_values_by_endianness_and_factor(imported: Import) -> None:
    found = imported("modbus-exporter", MODULE)
    assert found.value("power_2", 0xFFFD) == Fraction("-1.5")
    assert found.value("energy", 2, 1) == 65538
    assert found.value("level", 0x4841, 0) == Fraction("12.5")
    assert found.value("back", 0, 0x4841) == Fraction("12.5")
    assert found.bits("word_holding_40") == {"alarm": (9, 9), "run": (0, 0)}


@pytest.mark.parametrize(("endianness", "value"), [("big", 1), ("mixed", 1), ("yolo", 1), ("little", 256)])
def test_of_one_word_only_little_turns_the_bytes(imported: Import, endianness: str, value: int) -> None:
    module = MODULE.replace(
        'dataType: int16, factor: 0.5, labels: {phase: "2"}',
        f'dataType: uint16, endianness: {endianness}, labels: {{phase: "2"}}',
    )
    assert imported("modbus-exporter", module).value("power_2", 0x0001) == value


def test_what_it_cannot_mean_is_left_out(imported: Import) -> None:
    assert {*imported("modbus-exporter", MODULE).left_out} == {"nowhere", "half", "naught"}


def test_of_several_modules_one_must_be_said() -> None:
    text = "modules:\n  - {name: a, metrics: []}\n  - {name: b, metrics: []}\n"
    with pytest.raises(OptionError, match="--module which module, of a, b"):
        plugins.read("modbus-exporter", text.encode(), "x", {"module": ""})


def test_what_is_no_such_configuration_is_one_message(refusal: Callable[..., str]) -> None:
    assert "there is no list `modules`" in refusal("modbus-exporter", "a: 1\n")


def test_it_is_recognised() -> None:
    text = "modules:\n  - name: a\n    metrics:\n      - name: b\n        dataType: int16\n"
    assert likeness(text.encode(), "x.yml") is Likeness.SURE
    assert likeness(b"modules: []\n", "x.yml") is Likeness.NO
