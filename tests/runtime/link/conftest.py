"""A controller that is simulated, several of them on one line, and a line whose far end does what a test says."""

import asyncio
import os
import select
import threading
import time
import tty
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest

from regscribe.model import RegisterMap
from regscribe.simulate import SimulatedDevice
from regscribe.simulate.line.service import Service, Transport
from regscribe.simulate.line.serving import start
from regscribe.simulate.map_cache import find_map
from regscribe_runtime.wire.client_framing import framing_for

MAPS = Path(__file__).parents[3] / "maps"
Plan = Callable[[bytes], Iterable[tuple[float, bytes]]]
"""What the far end sends after a request: bytes, each after so many seconds from the request on."""


def compiled(name: str) -> RegisterMap:
    return find_map(MAPS / name)


@pytest.fixture(scope="session")
def athena() -> RegisterMap:
    return compiled("athena/series-c.yaml")


@pytest.fixture(scope="session")
def platinum() -> RegisterMap:
    return compiled("athena/platinum-m5000.yaml")


@contextmanager
def serving(devices: Sequence[SimulatedDevice], **service: Any) -> Iterator[Any]:
    """Serve devices from a thread of its own."""
    loop = asyncio.new_event_loop()
    thread = threading.Thread(target=loop.run_forever, daemon=True)
    thread.start()
    settings = {**service, "transport": Transport(service.get("transport", "tcp"))}
    try:
        server = asyncio.run_coroutine_threadsafe(start(devices, Service(**settings)), loop).result()
        try:
            yield server
        finally:
            asyncio.run_coroutine_threadsafe(server.stop(), loop).result()
    finally:
        loop.call_soon_threadsafe(loop.stop)
        thread.join()
        loop.close()


@pytest.fixture
def units(athena: RegisterMap) -> list[SimulatedDevice]:
    """Three controllers with ids of their own."""
    return [SimulatedDevice(athena, "16C", unit=unit) for unit in (1, 2, 3)]


def frame(unit: int, pdu: bytes) -> bytes:
    return framing_for("rtu").build(unit, pdu)


def words(unit: int, *values: int, function: int = 3) -> bytes:
    """The answer to a read."""
    return frame(unit, bytes([function, 2 * len(values)]) + b"".join(value.to_bytes(2, "big") for value in values))


def sound(data: bytes) -> bool:
    return len(data) >= 4 and frame(data[0], data[1:-2]) == data


@dataclass
class FarEnd:
    """The other end of a pty: `plan` says what it sends after a request, `heard` is what came in, frame by frame."""

    path: str
    fd: int
    plan: Plan = lambda _: ()
    echo: Callable[[bytes], bytes] = lambda _: b""
    heard: list[bytes] = field(default_factory=list)
    times: list[float] = field(default_factory=list)
    _stop: bool = False

    def serve(self) -> None:
        pending, due = b"", list[tuple[float, bytes]]()
        while not self._stop:
            ready, _, _ = select.select([self.fd], [], [], 0.002)
            now = time.monotonic()
            if ready:
                data = os.read(self.fd, 1000)
                os.write(self.fd, self.echo(data))
                pending += data
                if sound(pending) or sound(pending[1:]):
                    self.heard.append(pending)
                    self.times.append(now)
                    request = pending if sound(pending) else pending[1:]
                    due += [(now + delay, answer) for delay, answer in self.plan(request)]
                    pending = b""
            for one in sorted(due):
                if one[0] <= now:
                    os.write(self.fd, one[1])
                    due.remove(one)


@pytest.fixture
def far() -> Iterator[FarEnd]:
    """A serial line whose far end a test plays."""
    ours, theirs = os.openpty()
    tty.setraw(theirs)
    end = FarEnd(os.ttyname(theirs), ours)
    thread = threading.Thread(target=end.serve, daemon=True)
    thread.start()
    yield end
    end._stop = True
    thread.join()
    os.close(ours)
    os.close(theirs)


@pytest.fixture
def open_descriptors() -> Callable[[], int]:
    return lambda: len(list(Path("/proc/self/fd").iterdir()))
