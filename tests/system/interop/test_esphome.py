"""ESPHome itself checks an export, and its program, built for this machine, polls the device: states are the values."""

import os
import re
import subprocess
import time
from collections.abc import Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from fractions import Fraction
from pathlib import Path

import pytest
import yaml

from regscribe.export.esphome import TARGET
from regscribe.losses import Exported
from regscribe.simulate import Running, simulate

from . import odd
from .install import consumer
from .stage import MAP, UNIT, Held, Stage, fill, told

pytestmark = pytest.mark.interop("esphome")

DEVICE, ODD = "interopone_1", "oddone_1"
NAMED = re.compile(r"'(?:InteropOne-1 |(OddOne-1) )(.+?)' >> (.*)")
COLOURS = re.compile(r"\x1b\[[0-9;]*m")
PORT, ODD_PORT = "/dev/placeholder", "/dev/another"
PATIENCE = 60
"""Seconds until every entity has a state."""

FLAGS = ["-std=gnu++20", "-O0", "-w", "-fno-exceptions", "-DUSE_HOST", "-DESPHOME_LOG_LEVEL=ESPHOME_LOG_LEVEL_VERBOSE"]
"""As its own build has them, but for what makes the program smaller."""

WRITES = f"""\
      - number.set: {{id: {DEVICE}_setpoint, value: 12.5}}
      - number.set: {{id: {DEVICE}_limit, value: 70000}}
      - number.set: {{id: {DEVICE}_gain, value: -2.5}}
      - select.set: {{id: {DEVICE}_choice, option: slow}}
      - number.set: {{id: {ODD}_moved, value: 20.5}}
      - number.set: {{id: {ODD}_thirds, value: 6}}
      - number.set: {{id: {ODD}_negative, value: 7.5}}
      - select.set: {{id: {ODD}_way, option: !literal "on ${{q}}"}}
      - switch.turn_off: {{id: {ODD}_truth}}
      - switch.turn_off: {{id: {ODD}_several}}
      - switch.turn_off: {{id: {ODD}_coil}}
      - switch.turn_on: {{id: {DEVICE}_fan}}
"""
NODE = f"""
esphome:
  name: node
  on_boot:
    priority: -100
    then:
      - delay: 12s
{WRITES}
host:
logger:
  level: VERBOSE
packages:
  device: !include device.yaml
  odd: !include odd.yaml
uart:
  - id: !extend {DEVICE}_uart
    port: {PORT}
  - id: !extend {ODD}_uart
    port: {ODD_PORT}
"""


def esphome(*arguments: str) -> str:
    """What the program says; it must succeed."""
    program = consumer("esphome").python.with_name("esphome")
    done = subprocess.run([str(program), *arguments], capture_output=True, text=True, timeout=120, check=False)  # noqa: S603 (fixed)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout + done.stderr


@pytest.fixture(scope="module")
def made(stage: Stage) -> Exported:
    return stage.export("esphome", every="3")


@pytest.fixture(scope="module")
def folder(made: Exported) -> Path:
    """Where the node is built; what is there from before is built again only as far as it changed."""
    found = consumer("esphome").folder / "node"
    found.mkdir(exist_ok=True)
    (found / "device.yaml").write_text(str(made.texts[""]), encoding="utf-8")
    (found / "odd.yaml").write_text(odd.text("esphome", every="3"), encoding="utf-8")
    (found / "node.yaml").write_text(NODE, encoding="utf-8")
    return found


@pytest.fixture(scope="module")
def running() -> Iterator[Running]:
    """The device on a serial line of its own, which is written to."""
    with simulate(MAP, unit=UNIT, transport="pty") as served:
        fill(served, told())
        yield served


@pytest.fixture(scope="module")
def other() -> Iterator[Running]:
    """The odd device on another line."""
    with odd.served("pty") as served:
        yield served


@pytest.fixture(scope="module")
def states(folder: Path, running: Running, other: Running) -> Mapping[str, str]:
    """The first state of each entity, by what it is called behind the name of the device."""
    log, wanted = folder / "log", names(folder)
    with log.open("wb") as out:
        command = [str(built(folder, running.path, other.path))]
        home = {**os.environ, "HOME": str(folder)}
        process = subprocess.Popen(command, stdout=out, stderr=subprocess.STDOUT, env=home)  # noqa: S603 (our own)
        try:
            until = time.monotonic() + PATIENCE
            while not (wanted <= found(log).keys() and running.device.state.stored("fan")) and time.monotonic() < until:
                time.sleep(0.5)
        finally:
            process.terminate()
            process.wait(10)
    return found(log)


def names(folder: Path) -> set[str]:
    text = (folder / "device.yaml").read_text(encoding="utf-8").replace("!lambda", "")
    document = yaml.safe_load(text)
    lists = (some for key, some in document.items() if key not in {"uart", "modbus", "modbus_controller"})
    return {one["name"].removeprefix("InteropOne-1 ") for some in lists for one in some}


def built(folder: Path, port: str, other: str) -> Path:
    """The program of the node for this machine and these ports."""
    esphome("compile", "--only-generate", str(folder / "node.yaml"))
    source = folder / ".esphome" / "build" / "node" / "src"
    main = source / "main.cpp"
    text = main.read_text(encoding="utf-8").replace(PORT, port).replace(ODD_PORT, other)
    main.write_text(text, encoding="utf-8")
    sources = sorted(source.rglob("*.cpp"))
    newest = max(one.stat().st_mtime for one in source.rglob("*.h"))  # one of them counts the entities
    with ThreadPoolExecutor(os.cpu_count()) as several:
        objects = list(several.map(lambda one: compiled(one, source, newest), sources))
    program = folder / "node"
    subprocess.run(["g++", "-o", str(program), *map(str, objects), "-lpthread"], check=True, timeout=120)  # noqa: S603, S607
    return program


def compiled(one: Path, source: Path, newest: float) -> Path:
    made = one.with_suffix(".o")
    if not made.exists() or made.stat().st_mtime < max(newest, one.stat().st_mtime) or one.name == "main.cpp":
        command = ["g++", *FLAGS, f"-I{source}", "-c", str(one), "-o", str(made)]
        subprocess.run(command, check=True, timeout=300)  # noqa: S603 (fixed, no shell)
    return made


def found(log: Path) -> dict[str, str]:
    first: dict[str, str] = {}
    for line in COLOURS.sub("", log.read_text(encoding="utf-8", errors="replace")).splitlines():
        if said := NAMED.search(line):
            first.setdefault(" ".join(filter(None, said.group(1, 2))), said[3].strip())
    return first


def test_its_own_check_takes_the_configuration(folder: Path) -> None:
    assert "Configuration is valid!" in esphome("config", str(folder / "node.yaml"))


def test_every_register_of_the_export_has_the_value_that_the_driver_reads(
    stage: Stage, made: Exported, states: Mapping[str, str]
) -> None:
    left_out = {loss.register for loss in made.losses if loss.fact == "register"}
    called = {one.path: one.name for one in stage.running.device.model.registers if one.path not in left_out}
    wrong = {path: states.get(name) for path, name in called.items() if not shown(stage.held[path], name, states)}
    assert wrong == {}


def shown(held: Held, name: str, states: Mapping[str, str]) -> bool:
    """Whether a register (or its bits and parts) is shown as it is by hand, which is what the driver reads."""
    if held.flags or held.fields is not None:
        return all(states[one] == value for one, value in BITS[name].items())
    state = states[name]
    if held.fault:
        return state.startswith("nan")
    if isinstance(held.value, str):  # a version is shown as the number that packs it
        return state == (str(held.words[0]) if name == "Firmware" else f"'{held.value}'")
    if state in {"ON", "OFF"}:
        return (state == "ON") is bool(held.number)
    if held.member and not state[:1].isdigit() and state[:1] != "-":
        return state.startswith(f"{held.member} (")
    number = Fraction(state.split(maxsplit=1)[0])
    value = held.number - 2**64 if name in NEGATIVE else held.number
    return abs(number - value) <= max(abs(value) / 2**23, cut(state, value))


def cut(state: str, value: Fraction) -> Fraction:
    """Half a unit of the last decimal, where the value has more."""
    _, _, decimals = state.split(maxsplit=1)[0].partition(".")
    unit = Fraction(1, 10 ** len(decimals))
    return Fraction(0) if value % unit == 0 else unit / 2


NEGATIVE = {"U64 ABCD", "U64 CDAB", "Total"}
"""Held above 2^63, which the export tells to be shown below zero."""

BITS = {
    "Status": {"Status heating": "OFF", "Status alarm": "ON", "Status fault": "ON"},
    "Wide Status": {"Wide Status run": "OFF", "Wide Status door": "ON", "Wide Status trip": "ON"},
    "Parts": {"Parts zone": "5", "Parts level": "188", "Parts stage": "10"},
}


@pytest.mark.usefixtures("states")
def test_numbers_choices_and_switches_are_written_as_the_map_says(running: Running) -> None:
    # 12.5 with one decimal is 125, 70000 is two words, slow is 3
    stored = {path: running.device.state.stored(path) for path in ("setpoint", "limit", "gain", "choice", "fan")}
    assert stored == {"setpoint": 125, "limit": 70000, "gain": Fraction(-5, 2), "choice": 3, "fan": 1}


ODD_STATES = {
    "Low": "154",
    "High": "139",
    "Absent": "nan",
    "Both Signs": "nan",
    "Broken": "nan",
    "Wide Bits a": "ON",
    "Wide Bits b": "OFF",
    "Wide Bits c": "ON",
    "Wide Bits d": "ON",
    "Turned Bits e": "OFF",
    "Turned Bits f": "ON",
    "Halves half": "72.5",
    "Halves on": "ON",
    "${x} <% y %> !lambda \" ' {{ z }}": "7",
    "Moved": "-12.50",
    "Thirds": "3.00",
    "Negative": "-20.00",
    "Way": "back (0)",
    "Truth": "ON",
    "Several": "ON",
    "Coil": "ON",
}


def test_bytes_bits_faults_and_hostile_names_of_the_odd_device_are_shown(states: Mapping[str, str]) -> None:
    assert {name: states.get(f"{odd.NAME} {name}") for name in ODD_STATES} == ODD_STATES


@pytest.mark.usefixtures("states")
def test_settings_of_the_odd_device_are_written_and_no_request_is_too_long(other: Running) -> None:
    # 60.5 tenths, 6 in steps of 0.3, 7.5 in halves below zero
    stored = {path: other.device.state.stored(path) for path in ("moved", "thirds", "negative", "way")}
    assert stored == {"moved": 605, "thirds": 20, "negative": -15, "way": 1}
    assert [other.device.state.stored(path) for path in ("truth", "several", "coil")] == [0, 0, 0]
    asked = [request for request in other.requests if request[0] == 3]
    assert max(int.from_bytes(request[3:5]) for request in asked) == 4
    assert {request[0] for request in other.requests} == {1, 3, 6, 15, 16}


def test_the_version_that_read_it_is_the_one_that_the_output_names() -> None:
    assert f"esphome=={TARGET.verified.removeprefix('ESPHome ')}" in consumer("esphome").pip
