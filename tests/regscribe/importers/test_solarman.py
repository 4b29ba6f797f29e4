"""Inverter definitions of ha-solarman; expected values follow from its documentation, by hand."""

from collections.abc import Callable
from fractions import Fraction

import pytest

from regscribe import plugins
from regscribe.importers.solarman import likeness
from regscribe.plugins import Likeness, OptionError

from .conftest import Import

DEFINITION = """\
info: {manufacturer: Acme, model: Sun 3}
default: {update_interval: 5, code: 0x03}
requests:
  - {start: 100, end: 199, mb_functioncode: 0x04}
parameters:
  - group: Solar
    items:
      - {name: PV Power, rule: 1, registers: [0x000A], scale: 0.1, uom: W}
      - {name: Total, rule: 3, registers: [11, 12], scale: 0.1, uom: kWh}
      - {name: Reverse, rule: 4, registers: [14, 13]}
      - {name: Apart, rule: 3, registers: [20, 18]}
      - {name: Between, rule: 1, registers: [19]}
      - {name: Temperature, rule: 2, registers: [100], offset: 1000, scale: 0.1, uom: °C}
      - {name: Signed, rule: 2, registers: [15], magnitude: true, divide: 10}
      - {name: Inverted, rule: 2, registers: [16], inverted: true, validation: {min: 0}}
      - {name: Computed, rule: 1, sensors: [{registers: [1]}, {registers: [2]}]}
      - {name: Modded, rule: 1, registers: [17], scale: [1, 10]}
      - {name: Only one, rule: 1, registers: [[], [60]]}
      - name: Alarm
        rule: 1
        registers: [61]
        lookup: [{bit: 0, value: high, mode: "|"}, {key: 8, value: low, mode: "|"}]
      - {name: Step, rule: 1, registers: [62], lookup: [{bit: 0, value: one}, {bit: 3, value: eight}]}
  - group: State
    items:
      - name: Mode
        rule: 1
        registers: [30]
        platform: select
        lookup:
          - {key: 0, value: Standby}
          - {key: [1, 2], value: Running}
          - {key: default, value: Unknown}
      - {name: Grid, rule: 1, registers: [31], mask: 0x0F00, lookup: [{key: 0x100, value: on}, {key: 512, value: off}]}
      - {name: Relay, rule: 1, registers: [31], bit: 3}
      - {name: Charge, rule: 1, registers: [32], platform: switch, value: {on: 5, off: 0}}
      - {name: Serial, rule: 5, registers: [40, 41]}
      - {name: Bits, rule: 6, registers: [42, 43]}
      - {name: Version, rule: 7, registers: [44]}
      - {name: Clock, rule: 8, registers: [45, 46, 47], platform: datetime}
      - {name: Start, rule: 9, registers: [48], platform: time}
      - {name: Odd, rule: 11, registers: [49], plaform: number}
"""


def test_registers_stand_lowest_word_first(imported: Import) -> None:
    found = imported("solarman", DEFINITION)
    assert found.value("total", 2, 1) == Fraction("6553.8")
    assert found.register("reverse").address == 13
    assert found.value("reverse", 0xFFFF, 0xFFFE) == -2
    assert "at: [18, 20]" in found.text  # the highest word first, with another register between
    assert found.register("between").address == 19


def test_the_offset_comes_before_the_scale(imported: Import) -> None:
    found = imported("solarman", DEFINITION)
    assert found.value("temperature", 1215) == Fraction("21.5")  # (1215 - 1000) x 0.1
    assert found.register("temperature").base.space == "input"
    assert found.value("signed", 0x8005) == Fraction("-0.5")  # the highest bit is the sign
    assert found.value("inverted", 5) == -5


def test_a_list_of_scales_or_registers_is_of_variants_of_the_device(imported: Import) -> None:
    found = imported("solarman", DEFINITION)
    assert found.value("modded", 7) == 7
    assert "variant 0 of the device does not have it" in found.left_out["Only one"]
    assert any("taken is 0 (--mod)" in one for one in found.draft.stated)
    found = imported("solarman", DEFINITION, mod="3")  # the last of a shorter list
    assert found.value("modded", 7) == 70
    assert found.register("only_one").address == 60
    with pytest.raises(OptionError, match="--mod x"):
        plugins.read("solarman", DEFINITION.encode(), "source", {"mod": "x"})


def test_entries_of_a_lookup_with_the_mode_are_bits_and_others_codes(imported: Import) -> None:
    found = imported("solarman", DEFINITION)
    assert found.bits("alarm") == {"high": (0, 0), "low": (3, 3)}
    assert found.members("step") == {1: "one", 8: "eight"}


def test_what_a_scale_is_not_leaves_a_raw_number(imported: Import) -> None:
    found = imported("solarman", DEFINITION.replace("scale: [1, 10]", "scale: ten"))
    assert found.register("modded").kind == "raw"
    assert found.codes("Modded") == ["scale-unclear"]


def test_lookups_are_codes_and_keys_may_be_lists(imported: Import) -> None:
    found = imported("solarman", DEFINITION)
    assert found.members("mode") == {0: "Standby", 1: "Running", 2: "Running"}
    assert found.register("mode").access == "rw"
    assert found.codes("Mode") == ["lookup-dropped"]
    assert found.outcomes["Mode"] == "whole"
    assert found.members("charge") == {0: "off", 5: "on"}


def test_a_mask_is_a_part_whose_codes_are_not_shifted(imported: Import) -> None:
    found = imported("solarman", DEFINITION)
    grid, relay = found.register("word_holding_31").fields
    assert (grid.low, grid.high, relay.low) == (8, 11, 3)
    assert grid.enum is not None
    assert {one.code: one.label for one in grid.enum.members} == {1: "on", 2: "off"}


def test_texts_dates_and_times(imported: Import) -> None:
    found = imported("solarman", DEFINITION)
    assert found.value("serial", 0x4142, 0x4344) == "ABCD"
    assert found.value("clock", 0x1906, 0x0F0C, 0x1E05) == "2025-06-15T12:30:05"
    assert found.value("start", 1730) == "17:30:00"
    assert found.value("bits", 1, 2) == 65538
    assert found.codes("Version") == ["version-raw"]


def test_what_is_left_out_is_told(imported: Import) -> None:
    found = imported("solarman", DEFINITION)
    assert {*found.left_out} == {"Computed", "Odd", "Only one"}
    assert found.codes("Inverted") == ["validation-dropped"]
    assert found.draft.maker == "Acme"


def test_what_is_no_definition_is_one_message(refusal: Callable[..., str]) -> None:
    assert "there is no list `parameters`" in refusal("solarman", "a: 1\n")


def test_it_is_recognised() -> None:
    text = "parameters:\n  - group: a\n    items:\n      - name: b\n        rule: 1\n        registers: [1]\n"
    assert likeness(text.encode(), "x.yaml") is Likeness.SURE
    assert likeness(b"parameters: []\n", "x.yaml") is Likeness.NO
