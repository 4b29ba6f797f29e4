"""What the README shows works: its Python runs against simulated devices, its commands and links exist."""

import asyncio
import re
import shlex
import threading
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

import click
import pytest

from regscribe.cli.app import regscribe
from regscribe.model import RegisterMap
from regscribe.simulate import Service, SimulatedDevice, simulate, start
from regscribe.simulate.map_cache import find_map
from regscribe_devices.athena.series_c import Athena16C

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")
SERIES_C, SERIES_100, X5000, BUS, TEST = re.findall(r"```python\n(.*?)```", README, re.DOTALL)
(RUNTIME,), (DEVICES,) = (
    re.findall(r"```python\n(.*?)```", (ROOT / folder / "README.md").read_text(encoding="utf-8"), re.DOTALL)
    for folder in ("generator/runtime", "generated")
)
COMMANDS = re.findall(r"^regscribe [^#\n]+", README, re.MULTILINE)


@pytest.mark.parametrize(
    ("code", "map_id", "model", "where", "givens"),
    [
        (SERIES_C, "athena/series-c", "16C", 'rtu("/dev/ttyUSB0"', {}),
        (SERIES_100, "fdc/series-100", "BTC-9100", 'tcp("10.0.0.7"', {"linear_inputs": {16, 17}}),
        (X5000, "athena/platinum-x5000", "X5000", 'tcp("10.0.0.8"', {}),
        (RUNTIME, "athena/series-c", "16C", 'rtu("/dev/ttyUSB0"', {}),
        (DEVICES, "fdc/series-100", "C21", 'tcp("10.0.0.7"', {"linear_inputs": {16, 17}}),
    ],
)
def test_the_python_of_the_readme_runs(
    code: str, map_id: str, model: str, where: str, givens: dict[str, set[int]]
) -> None:
    register_map = find_map(ROOT / "maps" / f"{map_id}.yaml")
    assert where in code
    with simulate(register_map, model, unit=1, givens=givens) as running:
        exec(code.replace(where, f'tcp("127.0.0.1", port={running.port}'), {})  # noqa: S102 - our own README
        assert running.requests


def test_the_bus_of_the_readme_runs() -> None:
    register_map = find_map(ROOT / "maps/athena/series-c.yaml")
    with running_bus(register_map) as (port, oven):
        names: dict[str, object] = {}
        exec(BUS.replace('rtu("/dev/ttyUSB0", baud=9600)', f'tcp("127.0.0.1", port={port})'), names)  # noqa: S102 - our own README
        assert oven.peek("input_filter") == 9
        assert names["report"].written == ("setpoint_high_limit", "input_filter")  # type: ignore[attr-defined]  # of exec


def test_the_test_of_the_readme_runs() -> None:
    names: dict[str, Any] = {"Athena16C": Athena16C}
    exec(TEST.replace("...  ", "controller.input_type.read()"), names)  # noqa: S102 - our own README
    with ExitStack() as stack:
        names["test_heating_stops_when_the_sensor_breaks"](lambda *which: stack.enter_context(simulate(*which)))


@contextmanager
def running_bus(register_map: RegisterMap) -> Iterator[tuple[int, SimulatedDevice]]:
    """Two units on one port."""
    devices = [SimulatedDevice(register_map, "16C", unit=unit) for unit in (1, 2)]
    loop = asyncio.new_event_loop()
    thread = threading.Thread(target=loop.run_forever)
    thread.start()
    server = asyncio.run_coroutine_threadsafe(start(devices, Service()), loop).result()
    try:
        yield server.port, devices[0]
    finally:
        asyncio.run_coroutine_threadsafe(server.stop(), loop).result()
        loop.call_soon_threadsafe(loop.stop)
        thread.join()
        loop.close()


@pytest.mark.parametrize("line", COMMANDS)
def test_the_commands_of_the_readme_are_understood(line: str) -> None:
    name, *arguments = shlex.split(line)[1:]
    command = regscribe.get_command(click.Context(regscribe), name)
    if isinstance(command, click.Group):
        name, *arguments = arguments
        command = command.get_command(click.Context(command), name)
    assert command is not None
    assert command.make_context(name, arguments).params


def test_the_lines_of_a_map_in_the_readme_stand_in_that_map() -> None:
    (shown,) = re.findall(r"```yaml\n(.*?)```", README, re.DOTALL)
    lines = (ROOT / "maps/athena/series-c.yaml").read_text(encoding="utf-8").splitlines()
    assert set(shown.splitlines()) <= {line.strip() for line in lines}


def test_the_links_of_the_readme_lead_somewhere() -> None:
    links = re.findall(r"\]\(([^)#:]+)\)", README)
    assert [link for link in links if not (ROOT / link).exists()] == []
    assert links
