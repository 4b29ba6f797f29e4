"""The simulator of pymodbus, with a device by our export: it holds what was stated, and our driver reads it."""

import socket
import struct
import subprocess
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

from regscribe import plugins
from regscribe.map_files import shipped
from regscribe.model import RegisterMap, show
from regscribe.model.identifiers import module_names
from regscribe.reference import number_of
from regscribe.simulate import find_map

from .install import consumer
from .stage import MAP, UNIT, Held, module_of, told
from .test_device import agree, asked

pytestmark = pytest.mark.interop("pymodbus-simulator")

PATIENCE = 30


@contextmanager
def simulated(register_map: RegisterMap, folder: Path, stated: Sequence[str] = (), **more: str) -> Iterator[int]:
    """Run the simulator with the export of a map while the block runs; the port that it answers at."""
    port, page = (free_port() for _ in range(2))
    exporter = plugins.exporter("pymodbus-simulator")
    options = {one.name: one.default for one in exporter.options}
    options |= {"at": f"127.0.0.1:{port}", "unit": str(UNIT), "with": "\n".join(stated), **more}
    (text,) = plugins.export("pymodbus-simulator", [register_map], options).texts.values()
    file = folder / "device.json"
    file.write_text(str(text), encoding="utf-8")
    program = consumer("pymodbus-simulator").python.with_name("pymodbus.simulator")
    said = {"json_file": file, "modbus_server": "server", "modbus_device": "device", "http_host": "127.0.0.1"}
    arguments = [part for key, value in {**said, "http_port": page}.items() for part in (f"--{key}", str(value))]
    with (folder / "log").open("wb") as log:
        process = subprocess.Popen([program, *arguments], stdout=log, stderr=log, cwd=folder)  # noqa: S603 (fixed)
        try:
            wait_for(port, process, folder / "log")
            yield port
        finally:
            process.terminate()
            process.wait(PATIENCE)


def free_port() -> int:
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        return int(free.getsockname()[1])


def wait_for(port: int, process: "subprocess.Popen[bytes]", log: Path) -> None:
    end = time.monotonic() + PATIENCE
    while process.poll() is None and time.monotonic() < end:
        try:
            socket.create_connection(("127.0.0.1", port), timeout=1).close()
        except OSError:
            time.sleep(0.1)
        else:
            return
    raise AssertionError(log.read_text(encoding="utf-8"))


def statable(held: Held) -> bool:
    """Whether `--with` can say it: a number with a finite decimal."""
    plain = not held.fault and not held.special and not isinstance(held.value, str)
    return plain and 10**9 % held.number.denominator == 0


@pytest.fixture(scope="module")
def port(tmp_path_factory: pytest.TempPathFactory) -> Iterator[int]:
    stated = [f"{path}={show(one.number)}" for path, one in told().items() if statable(one)]
    with simulated(find_map(MAP), tmp_path_factory.mktemp("pymodbus"), stated) as found:
        yield found


def test_it_holds_the_words_by_hand_of_what_was_stated(port: int) -> None:
    registers = {one.path: one for one in find_map(MAP).models[0].registers}
    wrong = {}
    with socket.create_connection(("127.0.0.1", port), timeout=PATIENCE) as line:
        for path, held in told().items():
            base = registers[path].base
            if statable(held):
                found = asked(line, base.space, base.address(registers[path].at), base.words)
                wrong |= {path: (held.words, found)} if found != held.words else {}
    assert wrong == {}


def test_our_driver_reads_what_was_stated(port: int) -> None:
    with module_of(find_map(MAP)).InteropOne.tcp("127.0.0.1", port=port, unit=UNIT) as device:
        found = device.read()
        read = {path: found[path] for path, held in told().items() if statable(held) and path in found}
    assert len(read) > 60
    assert {path: value for path, value in read.items() if not agree(told()[path], value)} == {}


def test_what_may_be_written_is_written_and_nothing_else(port: int) -> None:
    with module_of(find_map(MAP)).InteropOne.tcp("127.0.0.1", port=port, unit=UNIT) as device:
        device.setpoint.write(21.5)
        assert device.setpoint.read() == 21.5
        device.fan.write(value=True)
        assert (device.fan.read(), device.valve.read().name) == (True, "OPENED")
    refused = struct.pack(">HHHBBHH", 1, 0, 6, UNIT, 6, 0, 7)
    with socket.create_connection(("127.0.0.1", port), timeout=PATIENCE) as line:
        line.sendall(refused)
        assert line.recv(300)[7:9] == b"\x86\x02"


@pytest.mark.parametrize("map_id", ["athena/series-c", "omega/cn8200"])
def test_every_default_of_a_shipped_map_comes_back(map_id: str, tmp_path: Path) -> None:
    register_map = find_map(shipped() / f"{map_id}.yaml")
    model = register_map.models[0]
    package, module = module_names(map_id)
    kind: Any = getattr(import_module(f"regscribe_devices.{package}.{module}"), model.class_name)
    with simulated(register_map, tmp_path, model=model.name) as port:
        with kind.tcp("127.0.0.1", port=port, unit=UNIT) as device:
            found = device.read()
        known = [one for one in model.registers if one.access.readable and one.path in found]
        defaults = {one.path: number for one in known if (number := number_of(one, one.default)) is not None}
    assert len(defaults) > 10
    wrong = {path: (value, found[path]) for path, value in defaults.items() if not same(found[path], float(value))}
    assert wrong == {}


def same(read: Any, default: float) -> bool:
    """Whether a value of the driver is a default: a number, a member or special value, or a word of flags."""
    return float(getattr(read, "value", read)) == pytest.approx(default, rel=1e-6)
