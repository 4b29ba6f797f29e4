"""Simulated devices in this process, for tests: served from a thread of their own while a `with` block runs."""

import asyncio
import threading
from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TypedDict, Unpack

from regscribe.model import RegisterMap
from regscribe.simulate.device.device import SimulatedDevice
from regscribe.simulate.device.state import Value
from regscribe.simulate.device.value_arguments import Fault, GivenValue, Plain
from regscribe.simulate.line.server_context import Foreign
from regscribe.simulate.line.servers import Server
from regscribe.simulate.line.service import Arrival, Delivery, Patience, Service, Transport, Watcher
from regscribe.simulate.line.serving import start
from regscribe.simulate.map_cache import find_map
from regscribe.simulate.process.thermal_process import ThermalProcess
from regscribe_runtime.values.serial_line import SerialLine


class SimulatorOptions(TypedDict, total=False):
    """The options of `Service`; `speed` is 0 by default, so that time passes by `advance` only."""

    host: str
    port: int
    line: SerialLine | None
    latency: float | str
    paced: bool
    strict_gaps: bool
    speed: float
    foreign: Foreign | None
    connections: int
    patience: Patience | None
    arrival: Arrival | None
    delivery: Delivery | None
    watcher: Watcher | None


@dataclass(frozen=True, slots=True, kw_only=True)
class Running:
    """A simulated device being served in this process: `path` is a pty's, `host` and `port` are of TCP.

    `peek`, `poke`, `advance` and `power_cycle` are those of the device. `requests` holds every request to the device
    (function code and data), broadcasts too, in the order they came; clear it as you like.
    """

    device: SimulatedDevice
    host: str
    port: int
    path: str
    requests: list[bytes]

    def peek(self, path: str) -> Value:
        """Return the present value of a register or `register.field` (see `SimulatedDevice.peek`)."""
        return self.device.peek(path)

    def poke(self, path: str, value: Plain | Fault) -> None:
        """Set a register or `register.field`, read-only ones too (see `SimulatedDevice.poke`)."""
        self.device.poke(path, value)

    def advance(self, seconds: float) -> None:
        """Let simulated time pass (see `SimulatedDevice.advance`)."""
        self.device.advance(seconds)

    def power_cycle(self) -> None:
        """Take power away and give it back (see `SimulatedDevice.power_cycle`)."""
        self.device.power_cycle()


@contextmanager
def simulate(  # noqa: PLR0913 (all but two are keywords for tests)
    register_map: RegisterMap | str | Path,
    model: str = "",
    *,
    unit: int | None = None,
    transport: str = Transport.TCP,
    givens: Mapping[str, GivenValue] | None = None,
    seed: int = 0,
    addressing: str = "modbus",
    process: ThermalProcess | bool = False,
    state: str | Path | None = None,
    bases: Mapping[str, int] | None = None,
    without: Collection[str] = (),
    **options: Unpack[SimulatorOptions],
) -> Iterator[Running]:
    """Serve one device from a thread of its own while the block runs; for sync and async clients in tests.

    `register_map` may be the id of a map (`athena/series-c`) or a map file; `model` may be left out where it has one.
    `transport` is tcp, rtu-tcp, ascii-tcp or
    pty. `process` lets the process value move as time passes: by `advance`, or with a `speed` by itself. `state` is a
    state file to load; `bases` as of `SimulatedDevice`. Raises SimulatorError as that and `start` do.
    """
    simulated = find_map(register_map)
    device = SimulatedDevice(
        simulated,
        model or simulated.only_model,
        unit=unit,
        givens=givens,
        seed=seed,
        addressing=addressing,
        process=process,
        bases=bases,
        without=without,
    )
    if state is not None:
        device.load(state)
    requests: list[bytes] = []
    given: SimulatorOptions = {"speed": 0.0, **options}
    service = Service(transport=Transport(transport), recorder=lambda request: requests.append(request.pdu), **given)
    with in_thread((device,), service) as server:
        yield Running(device=device, host=server.host, port=server.port, path=server.path, requests=requests)


@contextmanager
def in_thread(devices: Sequence[SimulatedDevice], service: Service) -> Iterator[Server]:
    """Serve devices from a thread of its own while the block runs. Raises SimulatorError as `start` does."""
    loop = asyncio.new_event_loop()
    thread = threading.Thread(target=loop.run_forever, name="regscribe simulator", daemon=True)
    thread.start()
    try:
        server = asyncio.run_coroutine_threadsafe(start(devices, service), loop).result()
        try:
            yield server
        finally:
            asyncio.run_coroutine_threadsafe(server.stop(), loop).result()
    finally:
        loop.call_soon_threadsafe(loop.stop)
        thread.join()
        loop.close()
