"""Items of ESPHome's modbus_controller; the expected values follow from its documentation, by hand."""

from collections.abc import Callable
from fractions import Fraction

import pytest

from regscribe import plugins
from regscribe.importers.esphome import likeness
from regscribe.plugins import Likeness, OptionError

from .conftest import Import

CONFIGURATION = """\
substitutions: {node: heat-pump, factor: "0.1"}
esphome:
  name: ${node}
modbus_controller:
  - id: pump
    address: 0x1F
    update_interval: 30s
packages: !include common.yaml
.sensor: &sensor
  platform: modbus_controller
  modbus_controller_id: pump
sensor:
  - <<: *sensor
    name: Flow
    address: 0x10
    register_type: read
    value_type: S_WORD
    unit_of_measurement: °C
    skip_updates: 2
    filters:
      - offset: -400
      - multiply: ${factor}
      - delta: 0.2
  - {<<: *sensor, name: Energy, address: 20, value_type: U_DWORD_R}
  - {<<: *sensor, name: Power, address: 22, value_type: FP32}
  - {<<: *sensor, name: Nibble, address: 30, bitmask: 0x00F0}
  - {<<: *sensor, name: Scattered, address: 30, bitmask: 0x0101}
  - {<<: *sensor, name: Computed, address: 31, lambda: "return x * 3;"}
  - {<<: *sensor, name: Filtered, address: 32, filters: [lambda: "return x / 10;"]}
  - {<<: *sensor, name: Line, address: 33, filters: [{calibrate_linear: [0 -> 4, 100 -> 24]}]}
  - {<<: *sensor, name: Raw, address: 34, value_type: RAW}
  - {<<: *sensor, name: Behind, address: 35, offset: 2}
binary_sensor:
  - {<<: *sensor, name: Alarm, address: 40, register_type: holding, bitmask: 0x4}
  - {<<: *sensor, name: Run, address: 40, register_type: holding, bitmask: 1}
  - {<<: *sensor, name: Door, address: 3, register_type: discrete_input}
number:
  - {<<: *sensor, name: Setpoint, address: 50, multiply: 10, min_value: 5, max_value: 30.5, use_write_multiple: true}
select:
  - {<<: *sensor, name: Mode, address: 60, optionsmap: {"Off": 0, "Heat": 1, "Warm": 1}}
switch:
  - {<<: *sensor, name: Fan, address: 5, register_type: coil}
  - {<<: *sensor, name: Boost, address: 61, register_type: holding, bitmask: 0x10}
text_sensor:
  - {<<: *sensor, name: Serial, address: 70, register_type: holding, register_count: 2, raw_encode: ANSI}
"""


def test_filters_are_a_scale_in_their_order(imported: Import) -> None:
    found = imported("esphome", CONFIGURATION)
    assert found.value("flow", 615) == Fraction("21.5")  # (615 - 400) x 0.1
    assert found.register("flow").base.space == "input"
    assert found.register("flow").reading.poll == 90  # every third update of 30 s
    assert found.value("line", 50) == 14  # 4 + 50 x 20/100


def test_value_types_say_order_and_sign(imported: Import) -> None:
    found = imported("esphome", CONFIGURATION)
    assert found.value("energy", 2, 1) == 65538
    assert found.value("power", 0x4148, 0) == Fraction("12.5")
    assert found.value("flow", 0xFFFF) == Fraction("-40.1")


def test_a_bitmask_is_a_part_of_a_word(imported: Import) -> None:
    found = imported("esphome", CONFIGURATION)
    assert found.bits("nibble") == {"Nibble": (4, 7)}
    assert found.bits("word_holding_40") == {"Alarm": (2, 2), "Run": (0, 0)}
    assert found.bits("boost") == {"Boost": (4, 4)}
    assert "0x101" in found.left_out["Scattered"]


def test_lambdas_are_named_and_leave_raw_numbers(imported: Import) -> None:
    found = imported("esphome", CONFIGURATION)
    for name in ("computed", "filtered"):
        assert found.register(name).kind == "raw"
        assert "scale-unclear" in found.codes(name.title())
    assert "return x * 3;" in found.text
    assert "RAW" in found.left_out["Raw"]


def test_what_is_written(imported: Import) -> None:
    found = imported("esphome", CONFIGURATION)
    setpoint = found.register("setpoint")
    assert (setpoint.access, found.value("setpoint", 215)) == ("rw", Fraction("21.5"))
    assert set(setpoint.base.functions) == {3, 16}
    assert "range: 5..30.5" in found.text
    assert found.members("mode") == {0: "Off", 1: "Heat"}
    assert found.codes("Mode") == ["option-doubled"]
    assert found.register("fan").base.space == "coil"


def test_offsets_count_bytes_and_texts_words(imported: Import) -> None:
    found = imported("esphome", CONFIGURATION)
    assert found.register("behind").address == 36
    assert found.value("serial", 0x4142, 0x4300) == "ABC"


def test_what_stands_elsewhere_is_told(imported: Import) -> None:
    found = imported("esphome", CONFIGURATION)
    assert "what stands in other files is not read: packages" in found.draft.stated
    assert found.draft.title == "heat-pump"
    assert found.map.default_unit == 31


def test_of_several_controllers_one_must_be_said() -> None:
    text = "sensor:\n" + "".join(
        f"  - {{platform: modbus_controller, modbus_controller_id: {one}, name: A, address: 1}}\n" for one in "ab"
    )
    with pytest.raises(OptionError, match="say by --controller which controller, of a, b"):
        plugins.read("esphome", text.encode(), "x", {"controller": ""})


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("sensor: []\n", "1: there is no item of the platform modbus_controller"),
        ("a: &a [*a]\n", "1: the alias *a names nothing"),
        ("a: {b: [", "1: no YAML: the `[` of line 1, column 8 is not closed"),
    ],
)
def test_what_is_no_such_configuration_is_one_message(refusal: Callable[..., str], text: str, said: str) -> None:
    assert said in refusal("esphome", text)


def test_it_is_recognised() -> None:
    assert likeness(CONFIGURATION.encode(), "x.yaml") is Likeness.SURE
    assert likeness(b"sensor:\n  - platform: dht\n", "x.yaml") is Likeness.NO
