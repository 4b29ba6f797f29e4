"""Real maps and a made-up kiln, compiled once, their devices served on loopback."""

import importlib.util
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from regscribe import checks, lower, schema, source
from regscribe.emit import python
from regscribe.model import RegisterMap, Severity
from regscribe.pipeline import compile_map
from regscribe.simulate import Running, simulate
from regscribe_devices.athena.platinum_m5000 import AthenaM5000
from regscribe_devices.athena.platinum_x100_x400 import AthenaX100, AthenaX400
from regscribe_devices.athena.platinum_x5000 import AthenaX5000
from regscribe_devices.athena.series_c import Athena1ZC, Athena16C
from regscribe_devices.omega.cn8200 import OmegaCN8200
from regscribe_runtime import BareDevice

MAPS = Path(__file__).parents[4] / "maps"
KILN = (Path(__file__).parent / "kiln.yaml").read_text(encoding="utf-8")
PATIENCE = 20
"""Seconds to wait for an answer: a busy machine is no reason to fail."""

DRIVERS: tuple[type[BareDevice], ...] = (
    Athena16C,
    Athena1ZC,
    OmegaCN8200,
    AthenaM5000,
    AthenaX100,
    AthenaX400,
    AthenaX5000,
)


class Bench(NamedTuple):
    """A simulated device and its open driver."""

    running: Running
    device: Any

    def poke(self, **values: Any) -> None:
        """Set registers of the simulated device."""
        for path, value in values.items():
            self.running.device.poke(path, value)

    @property
    def written(self) -> list[int]:
        """The addresses of all requests that wrote something."""
        return [int.from_bytes(pdu[1:3]) for pdu in self.running.requests if pdu[0] in {5, 6, 15, 16}]


@cache
def shipped(name: str) -> RegisterMap:
    found = compile_map(MAPS / f"{name}.yaml").map
    assert found is not None
    return found


def compile_text(text: str, name: str = "maps/test/kiln.yaml") -> RegisterMap:
    """All phases; fails the test with the diagnostics if there is an error."""
    document, found = source.parse(text, name=name)
    assert document is not None, found
    found = [*found, *schema.validate(document)]
    assert not found, found
    register_map, lowered = lower.lower(document)
    assert register_map is not None, lowered
    errors = [one for one in checks.check(register_map) if one.severity is Severity.ERROR]
    assert not errors, errors
    return register_map


Serve = Callable[..., AbstractContextManager[Bench]]


@pytest.fixture(scope="session")
def serve() -> Serve:
    """Serves the device of a driver, its limits wide open and with a decimal, while a `with` block runs."""

    @contextmanager
    def served(driver: type[BareDevice]) -> Iterator[Bench]:
        with (
            simulate(shipped(driver.map_id), driver.model, unit=1) as running,
            driver.tcp(running.host, port=running.port, unit=1, timeout=PATIENCE) as device,  # type: ignore[attr-defined]  # none needs givens
        ):
            bench = Bench(running, device)
            if driver.map_id.startswith("athena/platinum"):
                bench.poke(setpoint_low_limit=0, setpoint_high_limit=2000)
            else:
                bench.poke(temperature_decimal_position=1)
            yield bench

    return served


class Built(NamedTuple):
    """A compiled map and its generated driver classes."""

    map: RegisterMap
    driver: Any
    asynchronous: Any


@pytest.fixture(scope="session")
def build(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Built]:
    """Compile, generate and import a map of one model."""

    def make(text: str) -> Built:
        register_map = compile_text(text)
        ((_, code),) = python.render(register_map).items()
        path = tmp_path_factory.mktemp("generated") / "driver.py"
        path.write_text(code, encoding="utf-8")
        spec = importlib.util.spec_from_file_location(f"kiln_{path.parent.name}", path)
        assert spec is not None
        assert spec.loader is not None
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        name = register_map.models[0].class_name
        return Built(register_map, getattr(module, name), getattr(module, f"Async{name}"))

    return make


@pytest.fixture(scope="session")
def kiln_map(build: Callable[[str], Built]) -> Built:
    """The made-up kiln."""
    return build(KILN)


@pytest.fixture
def kiln(kiln_map: Built) -> Iterator[Bench]:
    """A simulated kiln."""
    with (
        simulate(kiln_map.map, "K1", unit=1) as running,
        kiln_map.driver.tcp(running.host, port=running.port, unit=1, timeout=PATIENCE) as device,
    ):
        yield Bench(running, device)
