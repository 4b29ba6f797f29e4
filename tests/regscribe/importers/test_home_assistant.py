"""`modbus:` of Home Assistant; the expected values follow from the documentation of the integration, by hand."""

from collections.abc import Callable
from fractions import Fraction

import pytest

from regscribe import plugins
from regscribe.importers.home_assistant import likeness
from regscribe.plugins import Likeness, OptionError

from .conftest import Import

HUB = """\
modbus:
  - name: heat
    type: tcp
    host: 192.168.0.2
    message_wait_milliseconds: 30
"""
SENSORS = (
    HUB
    + """\
    sensors:
      - name: Flow
        address: 10
        slave: 3
        scale: 0.1
        offset: -40
        unit_of_measurement: °C
        nan_value: 0x8000
      - {name: Energy, slave: 3, address: 0x10, data_type: uint32, swap: word, input_type: input, max_value: 100}
      - {name: Serial, slave: 3, address: 20, data_type: string, count: 2, swap: byte}
      - {name: Levels, slave: 3, address: 30, virtual_count: 2, data_type: float32, swap: word_byte}
      - {name: Two, slave: 3, address: 50, data_type: custom, count: 4, structure: ">2i"}
      - {name: Mixed, slave: 3, address: 60, data_type: custom, count: 3, structure: ">hi"}
      - {name: Twice, slave: 3, address: 10, scale: 0.1, offset: -40, unit_of_measurement: K}
      - {name: Contrary, slave: 3, address: 10, scale: 1}
      - {name: Sideways, slave: 3, address: 11, swap: sideways}
      - {name: Secret, slave: 3, address: !secret where}
      - {name: Templated, slave: 3, address: 12, scale: "{{ factor }}", unit_of_measurement: V}
      - {name: Third, slave: 3, address: 13, data_type: int16, scale: 0.333333333333333333333, scan_interval: 60}
      - {name: read, slave: 3, address: 14}
      - {name: 温度, slave: 3, address: 15}
"""
)


def test_a_value_is_the_scaled_number_and_the_offset(imported: Import) -> None:
    found = imported("home-assistant", SENSORS)
    assert found.value("flow", 0xFF38) == Fraction("-60")  # -200 x 0.1 - 40
    assert found.value("flow", 0x8000) == "fault"
    assert found.register("flow").unit[0].then == "°C"


def test_a_swap_is_the_order_of_words_and_bytes(imported: Import) -> None:
    found = imported("home-assistant", SENSORS)
    assert found.register("energy").base.space == "input"
    assert found.value("energy", 2, 1) == 65538
    assert found.value("serial", 0x4241, 0x4443) == "ABCD"
    assert found.value("levels[3].value", 0x0000, 0x4841) == Fraction("12.5")


def test_virtual_counts_and_structures_of_several_numbers_are_arrays(imported: Import) -> None:
    found = imported("home-assistant", SENSORS)
    assert [found.register(f"levels[{i}].value").address for i in (1, 2, 3)] == [30, 32, 34]
    assert found.value("two[2].value", 0xFFFF, 0xFFFE) == -2
    assert found.register("two[2].value").address == 52


@pytest.mark.parametrize(("structure", "value"), [(">xB", 0xFE), (">xb", -2), (">Bx", 0x81), (">bx", -127)])
def test_a_structure_may_be_one_byte_of_a_word(imported: Import, structure: str, value: int) -> None:
    sensor = f'{{name: Half, address: 1, data_type: custom, count: 1, structure: "{structure}"}}'
    assert imported("home-assistant", f"{HUB}    sensors:\n      - {sensor}\n").value("half", 0x81FE) == value


def test_what_is_not_understood_is_left_out_by_row_with_its_line(imported: Import) -> None:
    found = imported("home-assistant", SENSORS)
    assert {*found.left_out} == {"Mixed", "Contrary", "Sideways", "Secret"}
    assert "`>hi`" in found.left_out["Mixed"]
    assert "sideways" in found.left_out["Sideways"]
    assert "!secret where" in found.left_out["Secret"]
    assert found.line("Mixed") == 18


def test_a_scale_that_is_no_number_leaves_a_raw_number(imported: Import) -> None:
    found = imported("home-assistant", SENSORS)
    assert found.codes("Templated") == ["scale-unclear"]
    assert found.register("templated").kind == "raw"
    assert "# TODO scale `{{ factor }}` is no number" in found.text


def test_a_clamp_is_told_and_is_no_range(imported: Import) -> None:
    found = imported("home-assistant", SENSORS)
    assert found.codes("Energy") == ["max-value-dropped"]
    assert found.register("energy").valid == ()


def test_two_sensors_of_one_register_are_one_and_contrary_ones_a_finding(imported: Import) -> None:
    found = imported("home-assistant", SENSORS)
    assert found.outcomes["Twice"] == "with loss"  # the unit is another one
    (finding,) = found.draft.findings
    assert "`Contrary`" in finding.message
    assert "`Flow` (source:7:1)" in finding.message
    assert finding.related[0].span.line == 7


def test_names_that_no_driver_can_have_get_ids(imported: Import) -> None:
    found = imported("home-assistant", SENSORS)
    assert found.register("read_register").address == 14
    assert found.register("register_15").name == "温度"


def test_a_scale_keeps_all_its_digits(imported: Import) -> None:
    found = imported("home-assistant", SENSORS)
    assert found.value("third", 1) == Fraction("0.333333333333333333333")
    assert found.register("third").reading.poll == 60


OUTPUTS = (
    HUB
    + """\
    binary_sensors:
      - {name: Pump, address: 5}
      - {name: Alarm, address: 70, input_type: holding, virtual_count: 2}
      - {name: Door, address: 6, input_type: discrete_input, virtual_count: 1}
    switches:
      - {name: Heater, address: 80, command_on: 5, command_off: 7, verify: {delay: 2}}
      - {name: Valve, address: 9, write_type: coil, verify: {address: 4, input_type: discrete_input}}
      - {name: Blower, address: 81}
    climates:
      - name: Room
        address: 100
        target_temp_register: 101
        min_temp: 5
        max_temp: 30.5
        scale: 0.1
        hvac_mode_register: {address: 102, values: {state_off: 0, state_heat: [1, 2], state_auto: 3}}
    covers:
      - {name: Blind, address: 110, status_register: 111, state_open: 9}
"""
)


def test_bits_of_a_register_are_flags_of_a_word(imported: Import) -> None:
    found = imported("home-assistant", OUTPUTS)
    assert found.bits("word_holding_70") == {"Alarm 0": (0, 0), "Alarm 1": (1, 1), "Alarm 2": (2, 2)}
    assert found.register("pump").base.space == "coil"
    assert found.register("door_1").address == 7


def test_a_switch_is_read_where_it_is_verified_and_else_is_write_only(imported: Import) -> None:
    found = imported("home-assistant", OUTPUTS)
    heater, valve, blower = (found.register(name) for name in ("heater", "valve", "blower"))
    assert (heater.access, found.members("heater"), heater.settle) == ("rw", {5: "on", 7: "off"}, 2000)
    assert (valve.base.space, valve.address, valve.views[1].space) == ("discrete", 4, "coil")
    assert (blower.access, found.members("blower")) == ("w", {0: "off", 1: "on"})


def test_a_coil_that_is_on_while_it_is_0_is_told(imported: Import) -> None:
    found = imported(
        "home-assistant",
        HUB + "    switches:\n      - {name: Valve, address: 9, write_type: coil, command_on: 0, command_off: 1}\n"
        "      - {name: Lamp, address: 8, write_type: coil}\n",
    )
    assert found.codes("Valve") == ["command-on-dropped"]
    assert found.codes("Lamp") == []


def test_a_climate_is_a_temperature_a_setpoint_and_modes(imported: Import) -> None:
    found = imported("home-assistant", OUTPUTS)
    assert found.value("room_temperature", 215) == Fraction("21.5")
    assert found.register("room_setpoint").access == "rw"
    assert "range: 5..30.5" in found.text
    assert found.members("room_mode") == {0: "off", 1: "heat", 2: "heat", 3: "auto"}


def test_a_cover_has_the_codes_that_are_given(imported: Import) -> None:
    found = imported("home-assistant", OUTPUTS)
    assert found.members("blind") == {0: "closed", 9: "open"}
    assert found.members("blind_status") == {0: "closed", 2: "opening", 3: "closing", 9: "open"}


def test_of_several_hubs_or_units_one_must_be_said() -> None:
    two = HUB + "    sensors:\n      - {name: A, address: 1, slave: 1}\n      - {name: B, address: 2, slave: 2}\n"
    given = {"hub": "", "unit": ""}
    with pytest.raises(OptionError, match="say by --unit which unit id, of 1, 2"):
        plugins.read("home-assistant", two.encode(), "x", given)
    with pytest.raises(OptionError, match="--hub cold: there is no such hub, of heat"):
        plugins.read("home-assistant", two.encode(), "x", given | {"hub": "cold"})
    draft = plugins.read("home-assistant", two.encode(), "x", given | {"unit": "2"})
    assert [entry.name for entry in draft.entries] == ["B"]
    assert draft.head["protocol"] == {"default_unit": 2, "pause": 30}


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("- a\n", "1: there is no hub"),
        ("modbus: text\n", "1: there is no hub"),
        ("a: [\n", "1: no YAML: the `[` of line 1, column 4 is not closed"),
        ("modbus:\n  - " + "[" * 100, "2: values are nested more than 40 deep"),
        ("a: " + "x" * 5_000_000, "1: a value of 5000000 characters"),
        ("a: \0", "1: there is a NUL"),
        ("", "1: there is nothing in it"),
    ],
)
def test_what_is_no_such_configuration_is_one_message(refusal: Callable[..., str], text: str, said: str) -> None:
    assert said in refusal("home-assistant", text)


def test_it_is_recognised_by_its_hub() -> None:
    assert likeness(SENSORS.encode(), "x.yaml") is Likeness.SURE
    assert likeness(b"sensors:\n  - name: a\n    address: 1\n", "x.yaml") is Likeness.PERHAPS
    assert likeness(b"modbus: 3\n", "x.yaml") is Likeness.NO
