"""A bad line between drivers and simulated units: what is asked, what came of it, and who carried out what."""

import asyncio
import threading
import time
from collections import Counter
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

from regscribe.emit import python
from regscribe.model import RegisterMap
from regscribe.pipeline import compile_map
from regscribe.simulate import Exchange, Frame, Service, SimulatedDevice, Transport, start
from regscribe.simulate.line.line_faults import USUAL, LineFault, LineFaults
from regscribe.simulate.line.service import Chunk, Patience
from regscribe_runtime import AsyncBus, Bus, Retry
from regscribe_runtime.link import connect
from regscribe_runtime.link.links import SENT, Trace
from regscribe_runtime.wire.pdu import EXCEPTION_BIT

FURNACE = Path(__file__).parent / "furnace.yaml"
UNITS = (1, 2)
TIMEOUT, LATE = 0.06, 0.09
"""Seconds: of the response timeout, and of an answer that comes after it."""
LATE_SECONDS = 0.15
"""How long after the timeout the drivers of these tests expect a late answer."""
STALL = 0.1
"""Seconds by which this machine may delay an answer before it can be taken for another one's, where none has a name."""
FRAMINGS = {"tcp": "tcp", "rtu-tcp": "rtu", "ascii-tcp": "ascii", "pty": "rtu"}
LINE_FRAMINGS = {"tcp": "tcp", "rtu-tcp": "rtu", "ascii-tcp": "ascii", "pty": "rtu"}
WRITES = frozenset({5, 6, 15, 16})
Written = tuple[int, str, int, int]
"""Unit, space (coil or holding), address, word."""


class Op(NamedTuple):
    """Something that a program does with a driver. `values` by path; `unit` 0 is the broadcast."""

    verb: str
    unit: int = 1
    values: tuple[tuple[str, Any], ...] = ()
    cancel: int = 0
    """At which suspension the task is cancelled; 0: never."""

    @property
    def paths(self) -> tuple[str, ...]:
        return tuple(path for path, _ in self.values)


class Outcome(NamedTuple):
    """How an operation ended: a value, an error, or cancelled."""

    op: Op
    value: Any = None
    error: BaseException | None = None

    @property
    def cancelled(self) -> bool:
        return isinstance(self.error, asyncio.CancelledError)


@cache
def furnace() -> tuple[RegisterMap, ModuleType]:
    """The made-up device of these tests, and its driver."""
    register_map = compile_map(FURNACE).map
    assert register_map is not None
    ((_, code),) = python.render(register_map).items()
    module = ModuleType("furnace_driver")
    exec(code, vars(module))  # noqa: S102 - the driver that was just generated
    return register_map, module


class Far:
    """Simulated units behind a line with faults, served by a thread of their own; `executed` counts words written."""

    def __init__(self, transport: str, *, seed: int, rate: float, kinds: Sequence[LineFault] = USUAL) -> None:
        register_map, _ = furnace()
        self.devices = {unit: SimulatedDevice(register_map, "One", unit=unit) for unit in UNITS}
        able = [kind for kind in kinds if kind is not LineFault.HANGUP or transport != "pty"]
        self.faults = LineFaults(FRAMINGS[transport], rate=rate, late=LATE, seed=seed, kinds=able)
        self.executed: Counter[Written] = Counter()
        self.asked = time.time()
        self.lag = 0.0
        self._planned = 0.0
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._loop.run_forever, name="far", daemon=True)
        self._thread.start()
        service = Service(
            transport=Transport(transport),
            arrival=self._arrive,
            delivery=self._deliver,
            patience=Patience(idle=None, gap=0.03),
        )
        self.server: Any = self._wait(start(tuple(self.devices.values()), service))

    def _wait(self, work: Any) -> Any:
        return asyncio.run_coroutine_threadsafe(work, self._loop).result(10)

    def _arrive(self, request: Frame, act: Callable[[], bytes | None]) -> bytes | None:
        carried_out: list[bytes | None] = []

        def acting() -> bytes | None:
            carried_out.append(act())
            return carried_out[0]

        answer = self.faults.arrival(request, acting)
        refused = any(one and one[0] & EXCEPTION_BIT for one in carried_out)
        if carried_out and not refused and request.pdu[0] in WRITES:
            self.executed.update(written(request))
        return answer

    async def _deliver(self, exchange: Exchange) -> Sequence[Chunk]:
        pieces = await self.faults.delivery(exchange)
        self.lag = max(self.lag, time.time() - self.asked)
        return pieces

    def heard(self, trace: Trace) -> None:
        """The driver's tracer: when a request was sent."""
        if trace.direction == SENT:
            self.asked = trace.seconds

    def words(self, unit: int, path: str) -> tuple[int, ...]:
        """What a unit really holds."""
        return self.devices[unit].peek_words(path)

    def close(self) -> None:
        self._wait(self.server.stop())
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join(10)
        assert not self._thread.is_alive()
        assert not [task for task in asyncio.all_tasks(self._loop) if not task.done()]
        self._loop.close()


def written(request: Frame) -> list[Written]:
    """The words of a write request, each with its place."""
    pdu, unit = request.pdu, request.unit
    address = int.from_bytes(pdu[1:3], "big")
    if pdu[0] == 5:
        return [(unit, "coil", address, int(pdu[3] != 0))]
    if pdu[0] == 15:
        bits = int.from_bytes(pdu[6:], "little")
        return [(unit, "coil", address + at, bits >> at & 1) for at in range(int.from_bytes(pdu[3:5], "big"))]
    data = pdu[3:5] if pdu[0] == 6 else pdu[6:]
    return [
        (unit, "holding", address + at // 2, int.from_bytes(data[at : at + 2], "big")) for at in range(0, len(data), 2)
    ]


def begun(bus: Any, op: Op) -> Any:
    """Call the driver: the result, or for asyncio something to await."""
    device = bus[op.unit or UNITS[0]]
    path, value = op.values[0] if op.values else ("", None)
    driver = type(device)
    calls: dict[str, Callable[[], Any]] = {
        "read": lambda: getattr(device, path).read(),
        "read_many": lambda: device.read(*[driver.registers[one] for one in op.paths]),
        "write": lambda: getattr(device, path).write(value, confirm=True),
        "change": lambda: getattr(device, path).change(lambda _: value, confirm=True),
        "configure": lambda: device.configure(dict(op.values), confirm=True),
        "command": lambda: getattr(device.commands, path)(confirm=True),
        "loopback": lambda: device.loopback(value),
        "broadcast": lambda: bus.broadcast(driver.registers[path], value, state={"places": 1}),
        "open": bus.open,
        "close": bus.close,
    }
    return calls[op.verb]()


class SyncSide:
    """Threads that use a `Bus`."""

    def __init__(self, far: Far, transport: str) -> None:
        self.far = far
        self._transport, self.retry = transport, Retry(1, 0.001)
        how: dict[str, Any] = {
            "framing": LINE_FRAMINGS[transport],
            "timeout": TIMEOUT,
            "retry": self.retry,
            "trace": far.heard,
        }
        where = far.server
        serial, tcp = self._links()
        wired = {**how, "baud": 115200, "echo": False}
        self.bus = self._bus(serial(where.path, **wired) if where.path else tcp(where.host, port=where.port, **how))
        for unit in UNITS:
            self.bus.device(self._driver(), unit=unit)
        self.perform(Op("open"))

    def _links(self) -> Any:
        return connect.serial, connect.tcp

    def _bus(self, line: Any) -> Any:
        return Bus(line)

    def _driver(self) -> Any:
        return furnace()[1].FurnaceOne

    def perform(self, op: Op) -> Outcome:
        """Carry out one operation."""
        try:
            return Outcome(op, begun(self.bus, op))
        except Exception as error:  # noqa: BLE001 - what it may be is judged elsewhere
            return Outcome(op, error=error)

    def together(self, ops: Sequence[Op]) -> list[Outcome]:
        """Carry out operations in threads of their own."""
        with ThreadPoolExecutor(len(ops)) as pool:
            return list(pool.map(self.perform, ops))

    def close(self) -> None:
        """Close the link; nothing may be left."""
        self.perform(Op("close"))


class AsyncSide(SyncSide):
    """Tasks that use an `AsyncBus`, and may be cancelled at any of their suspensions."""

    def __init__(self, far: Far, transport: str) -> None:
        self.loop = asyncio.new_event_loop()
        super().__init__(far, transport)

    def _links(self) -> Any:
        return connect.async_serial, connect.async_tcp

    def _bus(self, line: Any) -> Any:
        return AsyncBus(line)

    def _driver(self) -> Any:
        return furnace()[1].AsyncFurnaceOne

    def perform(self, op: Op) -> Outcome:
        return self.together([op])[0]

    def together(self, ops: Sequence[Op]) -> list[Outcome]:
        return self.loop.run_until_complete(self._gathered(ops))

    async def _gathered(self, ops: Sequence[Op]) -> list[Outcome]:
        tasks = [asyncio.ensure_future(Breakable(begun(self.bus, op), op.cancel)) for op in ops]
        found = await asyncio.gather(*tasks, return_exceptions=True)
        assert asyncio.all_tasks() == {asyncio.current_task()}, "a task was left behind"
        return [
            Outcome(op, error=one) if isinstance(one, BaseException) else Outcome(op, one)
            for op, one in zip(ops, found, strict=True)
        ]

    def close(self) -> None:
        super().close()
        assert not asyncio.all_tasks(self.loop)
        self.loop.run_until_complete(self.loop.shutdown_default_executor())  # as asyncio.run does
        self.loop.close()


class Breakable:
    """An awaitable whose task is cancelled at its suspension number `at` (0: never); `count` tells how many it had."""

    def __init__(self, work: Any, at: int) -> None:
        self.work, self.at, self.count = work, at, 0

    def __await__(self) -> Any:
        steps = self.work.__await__()
        back: Any = None
        error: BaseException | None = None
        while True:
            try:
                waits_for = steps.throw(error) if error is not None else steps.send(back)
            except StopIteration as done:
                return done.value
            back, error = None, None
            self.count += 1
            if self.count == self.at:
                task = asyncio.current_task()
                assert task is not None
                task.cancel()
            try:
                back = yield waits_for
            except BaseException as thrown:  # noqa: BLE001 - handed on to the work
                error = thrown


SIDES: dict[str, type[SyncSide]] = {"sync": SyncSide, "async": AsyncSide}
