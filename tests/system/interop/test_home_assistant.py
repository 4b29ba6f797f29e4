"""Home Assistant itself loads an export and polls the device; its states are the driver's values."""

import json
import subprocess
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from regscribe.export.home_assistant import TARGET
from regscribe.export.home_assistant.sensors import DECIMALS
from regscribe.losses import Exported
from regscribe_runtime import SensorFault

from . import odd
from .install import consumer
from .stage import UNIT, Stage, staged

pytestmark = pytest.mark.interop("home-assistant")

PROGRAM = Path(__file__).parent / "programs" / "home_assistant.py"
HEAD = f"test/interop:InteropOne-{UNIT}:"


def polled(text: str, folder: Path, *switches: str) -> dict[str, Any]:
    """What the program says of a configuration."""
    configuration = folder / "configuration.yaml"
    configuration.write_text(text, encoding="utf-8")
    command = [str(consumer("home-assistant").python), str(PROGRAM), str(configuration), str(folder), *switches]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=True)  # noqa: S603 (fixed, no shell)
    said: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    return said


def test_home_assistant_shows_what_the_driver_reads(stage: Stage, tmp_path: Path) -> None:
    made = stage.export("home-assistant")
    found = polled(str(made.texts[""]), tmp_path)
    assert (found["accepted"], found["said"]) == (True, [])
    states = {unique_id.removeprefix(HEAD): one for unique_id, one in found["states"].items()}
    assert states.keys() == stage.held.keys() - left_out(made)
    assert len(states) == found["wanted"]
    wrong = {
        path: one["state"] for path, one in states.items() if not agree(one["state"], stage, path, about(made, path))
    }
    assert wrong == {}


def about(made: Exported, path: str) -> set[str]:
    return {loss.fact for loss in made.losses if loss.register == path}


def left_out(made: Exported) -> set[str]:
    return {loss.register for loss in made.losses if loss.fact == "register"}


def agree(state: str, stage: Stage, path: str, lost: set[str]) -> bool:
    """Whether a state is the value by hand, which is the driver's: exactly so, but for digits that are told as lost."""
    held, said = stage.held[path], stage.driver[path]
    if held.fault:
        return isinstance(said, SensorFault) and state == "unavailable"
    if "version" in lost:
        return state == str(held.words[0])
    if isinstance(held.value, str):
        return state.rstrip("\0") == held.value
    if state in {"on", "off"}:
        return (state == "on") is bool(held.number)
    cut = Fraction(1, 2 * 10**DECIMALS) if "decimals-cut" in lost else Fraction(0)
    rounded = abs(held.number) / 2**53 if "precision-float64" in lost else Fraction(0)
    return abs(Fraction(state) - held.number) <= max(cut, rounded)


def test_units_and_classes_are_those_of_the_map(stage: Stage, tmp_path: Path) -> None:
    states = polled(stage.text("home-assistant", register="tenth\nenergy\nquarter"), tmp_path)["states"]
    tenth, energy, quarter = (states[HEAD + path]["attributes"] for path in ("tenth", "energy", "quarter"))
    assert (tenth["unit_of_measurement"], tenth["state_class"], "device_class" in tenth) == ("°C", "measurement", False)
    assert (energy["unit_of_measurement"], energy["device_class"], "state_class" in energy) == ("kWh", "energy", False)
    assert (quarter["unit_of_measurement"], quarter["device_class"]) == ("V", "voltage")


def test_a_switch_that_is_turned_on_is_on_in_the_device(tmp_path: Path) -> None:
    with staged() as stage:
        text = stage.text("home-assistant", register="fan\npump")
        found = polled(text, tmp_path, f"{HEAD}fan")
        assert found["states"][f"{HEAD}fan"]["state"] == "on"
        assert stage.running.device.state.stored("fan") == 1


ODD = {
    "low": "154",
    "high": "139",
    "signed_low": "-5",
    "signed_high": "-100",
    "absent": "unavailable",
    "both_signs": "unavailable",
    "broken": "6553.0",  # shown as a value: told
    "wide_bits": "9223372045444710400",  # 2^63 + 2^33 + 1 in a float of 64 bits: told
    "turned_bits": "2147483648",
    "halves": "35408",
    "hostile": "7",
    "moved": "-12.5",
    "thirds": "3.0",
    "negative": "-20.0",
    "way": "-1",
    "truth": "on",
    "several": "on",
    "coil": "on",
}


def test_bytes_faults_and_settings_of_the_odd_device_are_shown(tmp_path: Path) -> None:
    with odd.served() as running:
        found = polled(odd.text("home-assistant", at=f"{running.host}:{running.port}"), tmp_path)
    head = f"test/odd:{odd.NAME}:"
    assert {unique_id.removeprefix(head): one["state"] for unique_id, one in found["states"].items()} == ODD
    name = found["states"][f"{head}hostile"]["attributes"]["friendly_name"]
    assert name == odd.NAME + " ${x} <% y %> !lambda \" ' {{ z }}"


def test_the_version_that_read_it_is_the_one_that_the_output_names() -> None:
    assert f"homeassistant=={TARGET.verified.removeprefix('Home Assistant ')}" in consumer("home-assistant").pip
