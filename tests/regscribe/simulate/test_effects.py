"""What a device does by itself: memories, commands with effects, values that wait, follow, or are converted."""

import struct
from fractions import Fraction
from pathlib import Path

import pytest

from regscribe.model import RegisterMap
from regscribe.pipeline import compile_map
from regscribe.simulate import SimulatedDevice


@pytest.fixture
def device(furnace: RegisterMap) -> SimulatedDevice:
    return SimulatedDevice(furnace, "F1")


def write(device: SimulatedDevice, address: int, word: int) -> bytes:
    answer = device.handle(struct.pack(">BHH", 6, address, word & 0xFFFF))
    assert answer is not None
    return answer


def accepted(device: SimulatedDevice, address: int, word: int) -> bool:
    return write(device, address, word)[0] == 6


def test_a_write_to_both_memories_counts_in_both(device: SimulatedDevice) -> None:
    write(device, 2, 1500)
    write(device, 1, 1200)
    assert (device.peek("setpoint"), device.peek("setpoint_ram")) == (120, 120)


def test_a_power_cycle_restores_ram_from_lasting_memory(device: SimulatedDevice) -> None:
    write(device, 1, 1200)
    write(device, 2, 1500)
    assert (device.peek("setpoint"), device.peek("setpoint_ram")) == (120, 150)
    device.power_cycle()
    assert (device.peek("setpoint"), device.peek("setpoint_ram")) == (120, 120)


def test_ram_that_nothing_restores_begins_anew_and_lasting_memory_stays(device: SimulatedDevice) -> None:
    write(device, 19, 99)
    write(device, 20, 5)
    device.power_cycle()
    assert (device.peek("scratch"), device.peek("address")) == (7, 5)


def test_writes_to_lasting_memory_are_counted_and_others_are_not(device: SimulatedDevice) -> None:
    for word in (1200, 1200, 1300):
        write(device, 1, word)
    write(device, 2, 1500)
    write(device, 1, 30001)
    write(device, 20, 9)
    assert device.wear == {"setpoint": 3, "address": 1}


def test_configuration_shows_at_once_and_counts_after_the_command(device: SimulatedDevice) -> None:
    write(device, 41, 600)
    assert (device.peek("configured_range"), device.peek("range"), device.pending) == (600, 400, ("configured_range",))
    write(device, 41, 700)
    assert device.peek("range") == 400
    assert accepted(device, 100, 21930)
    assert (device.peek("configured_range"), device.peek("range"), device.pending) == (700, 700, ())


def test_another_word_is_no_command_and_leaves_what_waits(device: SimulatedDevice) -> None:
    write(device, 41, 600)
    assert not accepted(device, 100, 21931)
    assert device.peek("range") == 400


def test_what_waits_comes_into_effect_with_power(device: SimulatedDevice) -> None:
    write(device, 41, 600)
    device.power_cycle()
    assert (device.peek("range"), device.pending) == (600, ())


def test_what_is_locked_opens_by_command_until_power_goes(device: SimulatedDevice) -> None:
    assert not accepted(device, 42, 5)
    assert accepted(device, 43, 4711)
    assert accepted(device, 42, 5)
    device.power_cycle()
    assert not accepted(device, 42, 6)
    assert (device.peek("zero"), device.commands_run) == (5, ("unlock",))


def test_loading_defaults_spares_what_the_map_keeps(device: SimulatedDevice) -> None:
    for address, word in ((1, 1200), (20, 9), (41, 600), (12, 1)):
        write(device, address, word)
    assert accepted(device, 101, 1)
    found = [device.peek(path) for path in ("setpoint", "setpoint_ram", "address", "configured_range", "control_type")]
    assert found == [100, 100, 9, 400, 0]
    assert device.pending == ()


def test_an_effect_needs_its_condition(device: SimulatedDevice) -> None:
    device.poke("mode", "standby")
    write(device, 103, 1)
    assert device.peek("mode") == 2
    device.poke("mode", "auto")
    write(device, 103, 1)
    assert device.peek("mode") == 1


def test_a_bit_follows_its_condition(device: SimulatedDevice) -> None:
    assert device.peek("status.by_hand") == 0
    write(device, 5, 1)
    assert device.peek("status.by_hand") == 1
    write(device, 5, 0)
    assert device.peek("status.by_hand") == 0


def test_a_register_follows_another_by_case(device: SimulatedDevice) -> None:
    write(device, 2, 1500)
    assert device.peek("setpoint_in_use") == 150
    write(device, 5, 3)
    assert device.peek("setpoint_in_use") == 50
    assert device.handle(struct.pack(">BHH", 3, 4, 1)) == bytes((3, 2)) + struct.pack(">h", 500)


def test_a_write_to_a_follower_goes_to_what_it_follows(device: SimulatedDevice) -> None:
    write(device, 4, 1800)
    assert (device.peek("setpoint_in_use"), device.peek("setpoint_ram"), device.peek("remote_setpoint")) == (
        180,
        180,
        50,
    )


def test_a_register_that_follows_nothing_now_keeps_its_last_value(device: SimulatedDevice) -> None:
    device.poke("output", 35)
    assert device.peek("manual_output") == 35
    write(device, 5, 1)
    device.poke("output", 60)
    assert device.peek("manual_output") == 35
    write(device, 7, 80)
    assert device.peek("manual_output") == 80


def test_a_new_unit_converts_values_and_differences(device: SimulatedDevice) -> None:
    device.poke("setpoint_ram", 100)
    device.poke("process_value", "LOW")
    write(device, 11, 1)
    found = {path: device.peek(path) for path in ("setpoint_ram", "setpoint_in_use", "band", "alarm_limit", "ramp_up")}
    expected = {"setpoint_ram": "37.8", "setpoint_in_use": "37.8", "band": 50, "alarm_limit": "93.3", "ramp_up": 0}
    assert found == {path: Fraction(value) for path, value in expected.items()}
    assert device.peek("process_value") == "LOW"
    write(device, 11, 0)
    assert device.peek("band") == 90


def test_a_unit_that_is_poked_converts_nothing(device: SimulatedDevice) -> None:
    device.poke("unit_of_measure", "celsius")
    assert device.peek("setpoint") == 100


def test_devices_of_a_model_share_no_state(furnace: RegisterMap) -> None:
    one, other = (SimulatedDevice(furnace, "F1") for _ in range(2))
    write(one, 1, 1200)
    assert (other.peek("setpoint"), other.wear, SimulatedDevice(furnace, "F1").peek("setpoint_in_use")) == (
        100,
        {},
        100,
    )


SMALL = """format: 1
map: {id: test/small, title: Small, maker: Nobody, class_prefix: Small}
manual: {title: Small Manual, number: "1"}
models: {A: {}}
decimals: {places: {register: places}}
groups:
  - id: all
    name: All
    source: "1"
    each: {access: rw, type: int16}
    registers:
"""


FOLLOWING = (
    SMALL.replace("decimals: {places: {register: places}}\n", "")
    + """
      - {at: 10, name: Source, access: r, default: 3}
      - {at: 11, name: Lamps, flags: {0: {label: lit, follows: {source: 4}}, 1: other}}
      - {at: 12, name: Parts, fields: {lit: {bit: 0, follows: {source: 4}}, other: {bits: "1..2"}}}
"""
)


@pytest.mark.parametrize(("at", "sent", "stays"), [(11, 3, 2), (12, 7, 6)])
def test_a_write_does_not_keep_a_bit_from_following(at: int, sent: int, stays: int, tmp_path: Path) -> None:
    path = tmp_path / "following.yaml"
    path.write_text(FOLLOWING, encoding="utf-8")
    compiled = compile_map(path)
    assert compiled.map is not None, compiled.diagnostics
    device = SimulatedDevice(compiled.map, "A")
    write(device, at, sent)
    assert device.handle(struct.pack(">BHH", 3, at, 1)) == bytes((3, 2)) + struct.pack(">H", stays)


@pytest.fixture
def shadows(tmp_path: Path) -> SimulatedDevice:
    """C shadows B, which lasts, and A shadows C; E shadows F, which follows B; Places shadow Kept Places."""
    path = tmp_path / "shadows.yaml"
    registers = """
      - {at: 0, name: A, access: r, shadows: c}
      - {at: 5, name: B, default: 3, persistence: eeprom}
      - {at: 6, name: C, shadows: b, default: 9}
      - {at: 7, name: E, shadows: f}
      - {at: 8, name: F, follows: b, default: 4}
      - {at: 10, name: Value, decimals: places, default: 50}
      - {at: 11, name: Places, range: 0..2, default: 0, shadows: kept_places}
      - {at: 12, name: Kept Places, range: 0..2, default: 1, persistence: eeprom}
"""
    path.write_text(SMALL + registers, encoding="utf-8")
    compiled = compile_map(path)
    assert compiled.map is not None, compiled.diagnostics
    return SimulatedDevice(compiled.map, "A")


def test_a_new_device_has_just_got_power_so_its_shadows_hold_what_they_shadow(shadows: SimulatedDevice) -> None:
    assert [shadows.peek(path) for path in "abcef"] == [3, 3, 3, 3, 3]
    assert shadows.handle(struct.pack(">BHH", 3, 6, 1)) == bytes.fromhex("03 02 00 03")


def test_a_shadow_of_a_shadow_takes_what_that_one_takes(shadows: SimulatedDevice) -> None:
    write(shadows, 5, 8)
    assert [shadows.peek(path) for path in "abc"] == [8, 8, 8]
    write(shadows, 6, 9)
    assert [shadows.peek(path) for path in "abc"] == [9, 8, 9]
    shadows.power_cycle()
    assert [shadows.peek(path) for path in "abce"] == [8, 8, 8, 8]


def test_what_depends_on_a_shadow_begins_with_what_it_shadows(shadows: SimulatedDevice) -> None:
    assert (shadows.peek("value"), shadows.peek_words("value")) == (50, (500,))
