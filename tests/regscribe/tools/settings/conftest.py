"""Real maps, compiled once, their devices served on loopback, and links that break where a test says so."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import pytest

import regscribe
from regscribe.model import GivenKind, RegisterMap
from regscribe.pipeline import compile_map
from regscribe.simulate import SimulatedDevice, simulate
from regscribe.tools.live import catalogue
from regscribe_runtime import BareDevice, LinkLost
from regscribe_runtime.driver import executor
from regscribe_runtime.link.connect import tcp

ROOT = Path(regscribe.__file__).parents[2]


@cache
def compiled(name: str) -> RegisterMap:
    found = compile_map(ROOT / "maps" / f"{name}.yaml").map
    assert found is not None
    return found


class Bench(NamedTuple):
    """A driver and the simulated device that it talks to."""

    driver: BareDevice
    device: SimulatedDevice
    requests: list[bytes]
    host: str
    port: int


class Breaking:
    """A link that is lost at the request of number `at`, before it was sent or after it was carried out."""

    def __init__(self, link: Any, *, at: int, after: bool) -> None:
        self._link, self._at, self._after, self.calls, self.broken = link, at, after, 0, False

    def __getattr__(self, name: str) -> Any:
        return getattr(self._link, name)

    def call(self, unit: int, request: Any) -> Any:
        self.calls += 1
        if self.calls < self._at:
            return self._link.call(unit, request)
        self.broken = True
        if self.calls == self._at and self._after:
            self._link.call(unit, request)
        message = "the cable was pulled"
        raise LinkLost(message)


def givens_of(register_map: RegisterMap) -> dict[str, Any]:
    return {one.id: frozenset({4}) if one.kind is GivenKind.CODES else True for one in register_map.givens}


Serve = Callable[..., Any]


@pytest.fixture(scope="session")
def serve() -> Serve:
    """Serves a model of a shipped map and gives an open driver of it; `at`: where the link breaks."""

    @contextmanager
    def served(name: str, model: str, *, at: int = 0, after: bool = False, **more: Any) -> Iterator[Bench]:
        register_map = compiled(name)
        givens = givens_of(register_map)
        with simulate(register_map, model, givens=givens, **more) as running:
            link: Any = tcp(running.host, port=running.port)
            if at:
                link = Breaking(link, at=at, after=after)
            known = catalogue.find(f"{name}:{model}")
            with known.driver(link, unit=running.device.unit, **givens) as driver:
                yield Bench(driver, running.device, running.requests, running.host, running.port)

    return served


@pytest.fixture
def hurried(monkeypatch: pytest.MonkeyPatch) -> None:
    """A driver that does not wait between attempts: what it waits for is in this process."""
    monkeypatch.setattr(executor.time, "sleep", lambda _: None)
