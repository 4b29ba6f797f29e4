"""States of devices in files: saved and loaded, from backups of real devices too; nothing else is taken for one."""

import contextlib
import struct
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from regscribe.model import RegisterMap
from regscribe.simulate import Running, SimulatedDevice, SimulatorError, find_map, simulate
from regscribe.tools.settings import backup, to_text
from regscribe_devices.athena.series_c import Athena16C
from regscribe_devices.fdc.series_100 import FdcC21

HEAD = "format: 1\nstate: {map: acme/furnace, model: F1}\n"


@pytest.fixture
def device(furnace: RegisterMap) -> SimulatedDevice:
    return SimulatedDevice(furnace, "F1")


@pytest.fixture
def write(tmp_path: Path) -> Callable[[str], Path]:
    def to_file(text: str) -> Path:
        path = tmp_path / "state.yaml"
        path.write_text(text, encoding="utf-8")
        return path

    return to_file


def changed(device: SimulatedDevice) -> SimulatedDevice:
    for address, word in ((1, 1234), (2, 1500), (11, 1), (41, 600), (20, 9)):
        assert device.handle(struct.pack(">BHH", 6, address, word)) is not None
    device.poke("process_value", "LOW")
    device.poke("status.output_on", 1)
    return device


def test_a_saved_state_is_loaded_whole(device: SimulatedDevice, furnace: RegisterMap, tmp_path: Path) -> None:
    changed(device).save(tmp_path / "furnace.yaml")
    other = SimulatedDevice(furnace, "F1")
    other.load(tmp_path / "furnace.yaml")
    assert other.snapshot() == device.snapshot()
    assert (other.wear, other.pending) == (device.wear, ("configured_range",))
    assert [other.peek(path) for path in ("process_value", "range", "configured_range")] == ["LOW", 400, 600]
    for register in device.model.registers:
        assert other.peek_words(register.path) == device.peek_words(register.path), register.path


def test_a_saved_state_is_for_people(device: SimulatedDevice, tmp_path: Path) -> None:
    changed(device).save(tmp_path / "furnace.yaml")
    lines = (tmp_path / "furnace.yaml").read_text(encoding="utf-8").splitlines()
    for line in (
        "  mode: AUTO",
        "  process_value: LOW",
        "  unit_of_measure: CELSIUS",
        "- output_on",
        "  setpoint: 50.8",
    ):
        assert any(line.strip() == each.strip() for each in lines), line


def test_a_short_state_by_hand_changes_what_it_names(device: SimulatedDevice, write: Callable[[str], Path]) -> None:
    device.load(write(f"{HEAD}values: {{setpoint: 150.5, mode: manual, status: [sensor_broken, by_hand]}}\n"))
    assert [device.peek(path) for path in ("setpoint", "mode", "status", "band")] == [pytest.approx(150.5), 1, 12, 90]


def test_values_that_others_scale_may_come_first(write: Callable[[str], Path]) -> None:
    device = SimulatedDevice(find_map("athena/series-c"), "16C")
    head = "format: 1\nstate: {map: athena/series-c, model: 16C}\n"
    device.load(write(f"{head}values: {{setpoint_ram: 30.5, linear_decimal_position: 1, input_type: 14}}\n"))
    assert (float(device.peek("setpoint_ram")), device.peek_words("setpoint_ram")) == (30.5, (305,))


def backup_of(driver: Any, running: Running, path: Path, **givens: Any) -> Path:
    with driver.tcp(running.host, port=running.port, unit=running.device.unit, **givens) as device:
        path.write_text(to_text(device.run(backup(driver))), encoding="utf-8")
    return path


def test_a_backup_of_a_device_is_a_state(tmp_path: Path) -> None:
    changes = {"setpoint_ram": "150.5", "alarm_1_action": "latched", "rate": "2.5", "ieee_register_ordering": 0}
    with simulate("athena/series-c", "16C") as running:
        for path, value in (changes | {"output_1_cycle_time": "0.2", "display_unit_of_measure": "celsius"}).items():
            running.poke(path, value)
        saved = backup_of(Athena16C, running, tmp_path / "backup.yaml")
        with simulate("athena/series-c", "16C", state=saved) as restored:
            writable = [each.path for each in running.device.model.registers if each.access.writable]
            for path in writable:
                assert restored.device.peek_words(path) == running.device.peek_words(path), path
            assert restored.peek("setpoint_ram") == Fraction("150.5")


def test_a_loaded_state_does_not_change_the_unit(write: Callable[[str], Path]) -> None:
    device = SimulatedDevice(find_map("athena/series-c"), "16C", unit=3)
    device.load(write("format: 1\nstate: {map: athena/series-c, model: 16C}\nvalues: {controller_id: 9}\n"))
    assert device.handle(struct.pack(">BHH", 6, 2, 100)) is not None
    assert (device.unit, device.peek("controller_id")) == (3, 3)


def test_a_backup_with_bit_fields_and_affine_scales_is_a_state(tmp_path: Path) -> None:
    givens = {"linear_inputs": {16}}
    with simulate("fdc/series-100", "C21", givens=givens) as running:
        running.poke("inpt", 16)
        running.poke("dp", 2)
        running.poke("sp1", "12.34")
        saved = backup_of(FdcC21, running, tmp_path / "backup.yaml", **givens)
    with simulate("fdc/series-100", "C21", givens=givens, state=saved) as restored:
        assert (restored.peek("sp1"), restored.peek("dp")) == (Fraction("12.34"), 2)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("format: 1\nstate: {map: acme/furnace, model: F2}\nvalues: {}\n", "is of acme/furnace, model F2, but this is"),
        ("format: 1\nstate: {map: acme/oven, model: F1}\nvalues: {}\n", "is of acme/oven, model F1, but this is"),
        ("format: 2\nstate: {map: acme/furnace, model: F1}\nvalues: {}\n", "no state of format 1: its `format` is 2"),
        ("format: 1\nvalues: {}\n", "neither `state` and `values` nor `backup`"),
        ("- 1\n", "it is no mapping"),
        ("a: [", "is no state: 1:"),
        ("", "is no state"),
        (f"{HEAD}values: {{setpoind: 1}}\n", "has no register `setpoind`; did you mean `setpoint`?"),
        (f"{HEAD}values: {{mode: atuo}}\n", "'atuo' is no value of 'mode'"),
        (f"{HEAD}values: {{setpoint: [1]}}\n", "is no value of `setpoint`"),
        (f"{HEAD}values: {{setpoint: {{a: 1}}}}\n", "is no value of `setpoint`"),
        (f"{HEAD}values: {{setpoint: 1e999999}}\n", "is no state: 3:20: the exponent"),
        (f"{HEAD}values: {{setpoint: '1e999999999'}}\n", "is no value of `setpoint`"),
        (f"{HEAD}values: {{status: [outptu_on]}}\n", "has no flag `outptu_on`; did you mean `output_on`?"),
        (f"{HEAD}values: {{status: 'x'}}\n", "status"),
    ],
)
def test_what_is_no_state_of_this_model_changes_nothing(
    device: SimulatedDevice, write: Callable[[str], Path], text: str, message: str
) -> None:
    before = device.snapshot()
    with pytest.raises(SimulatorError) as error:
        device.load(write(text))
    assert message in str(error.value)
    assert device.snapshot() == before


def test_files_that_are_not_there_are_one_clear_message(device: SimulatedDevice, tmp_path: Path) -> None:
    with pytest.raises(SimulatorError, match="cannot read the state"):
        device.load(tmp_path / "none.yaml")
    with pytest.raises(SimulatorError, match="cannot write the state"):
        device.save(tmp_path / "none" / "state.yaml")


PLAIN = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=20),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=12), inner, max_size=4),
    max_leaves=12,
)


@settings(max_examples=200, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(values=st.dictionaries(st.sampled_from(["setpoint", "mode", "status", "band", "x"]), PLAIN), more=PLAIN)
def test_any_document_is_taken_or_refused(furnace: RegisterMap, values: dict[str, Any], more: Any) -> None:
    device = SimulatedDevice(furnace, "F1")
    document = {"format": 1, "state": {"map": "acme/furnace", "model": "F1"}, "values": values}
    for found in (
        document,
        document | {"in_effect": more, "wear": more},
        {"format": 1, "backup": {}, "settings": more},
    ):
        with contextlib.suppress(SimulatorError):
            device.restore(found)
        assert device.snapshot()["state"]["map"] == "acme/furnace"
