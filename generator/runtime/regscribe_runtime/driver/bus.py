"""Several devices on one line: `Bus` for threads, `AsyncBus` for the tasks of an event loop.

The devices share one link. Requests are sent first come, first served. Operations of one unit are sequential, but
requests of other units may come between theirs: a long operation of one device does not block the others.
"""

from collections.abc import Iterator, Mapping
from contextlib import AsyncExitStack, ExitStack
from typing import Any, Generic, Self, TypedDict, TypeVar, Unpack

from regscribe_runtime.driver import broadcast
from regscribe_runtime.driver.device import AsyncBareDevice, AsyncLinkUser, BareDevice, LinkUser
from regscribe_runtime.errors import ValueRefused
from regscribe_runtime.link import connect
from regscribe_runtime.link.links import (
    MODBUS_TCP_PORT,
    AsyncClient,
    AsyncLink,
    ClientSettings,
    LineSettings,
    Link,
    LinkSettings,
    SyncClient,
)
from regscribe_runtime.registers.register import Register
from regscribe_runtime.values.serial_line import SerialLine
from regscribe_runtime.wire.requests import Request

ALL_UNITS = 0
USUAL_GAP = 4.0
"""Characters of silence between frames on a bus: the standard asks for 3.5, some manuals for 4."""

D = TypeVar("D", bound="BareDevice | AsyncBareDevice")
S = TypeVar("S", bound=BareDevice)
A = TypeVar("A", bound=AsyncBareDevice)


class BroadcastOptions(TypedDict, total=False):
    """Options of a broadcast: `view` and `confirm` as in `WriteOptions`.

    `state` has the values, equal in all units, of the registers that the written one depends on, by path.
    """

    view: str | None
    state: Mapping[str, Any] | None
    confirm: bool


class _Common(Generic[D]):
    """The devices of a bus, by unit."""

    def __init__(self, gap: float) -> None:
        self._devices: list[D] = []
        self._gap = gap

    def __iter__(self) -> Iterator[D]:
        return iter(tuple(self._devices))

    def __len__(self) -> int:
        return len(self._devices)

    def __getitem__(self, unit: int) -> D:
        for device in self._devices:
            if device.session.unit == unit:
                return device
        raise KeyError(unit)

    @property
    def units(self) -> tuple[int, ...]:
        """The ids of the devices, in ascending order, in which their locks are taken."""
        return tuple(sorted(device.session.unit for device in self._devices))

    def _add(self, device: D, line: SerialLine | None) -> None:
        unit, protocol = device.session.unit, device.protocol
        if unit in self.units:
            message = f"unit {unit} of this bus is {self[unit]!r} already: give each device an id of its own"
            raise ValueError(message)
        gap = float(protocol.serial.gap)
        if line is not None and gap > self._gap:
            message = f"{device!r} needs {gap:g} characters of silence: open the bus with gap={gap:g}"
            raise ValueError(message)
        device._on_bus = True  # noqa: SLF001 (its link is the bus's)
        self._devices.append(device)

    def _drivers(self, driver: broadcast.Driver | None) -> dict[str, broadcast.Driver]:
        found: dict[str, Any] = {f"unit {one.session.unit}": type(one) for one in self._devices}
        return found | ({driver.__name__: driver} if driver is not None else {})

    def _broadcast_request(
        self, register: Register[Any], value: object, driver: broadcast.Driver | None, how: BroadcastOptions
    ) -> Request:
        givens = [one.session.givens for one in self] or [{}]
        if any(one != givens[0] for one in givens):
            raise ValueRefused(register.path, "the units have different givens, so it may mean something else to each")
        return broadcast.request_for(register, value, self._drivers(driver), givens=givens[0], **how)

    def _forget(self) -> None:
        for device in self:
            device.session.forget()


class Bus(_Common[BareDevice], LinkUser):
    """Several synchronous drivers on one link, for any number of threads."""

    def __init__(self, link: Link, *, gap: float = USUAL_GAP) -> None:
        super().__init__(gap)
        self.link = link

    @classmethod
    def tcp(cls, host: str, *, port: int = MODBUS_TCP_PORT, **settings: Unpack[LinkSettings]) -> Self:
        """A bus behind a gateway; see `LinkSettings`."""
        return cls(connect.tcp(host, port=port, **settings))

    @classmethod
    def rtu(cls, port: str, *, baud: int, **settings: Unpack[LineSettings]) -> Self:
        """A bus on a serial port, 8N1 unless said otherwise; see `LineSettings`."""
        gap = settings.setdefault("gap", USUAL_GAP)
        return cls(connect.serial(port, baud=baud, **settings), gap=gap)

    @classmethod
    def over(cls, client: SyncClient, **settings: Unpack[ClientSettings]) -> Self:
        """A bus over a connected pymodbus client, which the bus does not close; see `ClientSettings`."""
        gap = settings.setdefault("gap", USUAL_GAP)
        return cls(connect.over(client, **settings), gap=gap)

    def device(self, driver: type[S], *, unit: int, **givens: Any) -> S:
        """A driver of a unit of this bus; ValueError if the unit has one already. Closing it leaves the bus open."""
        device = driver(self.link, unit=unit, **givens)
        self._add(device, self.link.line)
        return device

    def broadcast(
        self,
        register: Register[Any],
        value: object,
        *,
        driver: type[BareDevice] | None = None,
        **how: Unpack[BroadcastOptions],
    ) -> None:
        """Write a register (`Athena16C.setpoint_ram`) of all units at once; returns when all had time to carry it out.

        No unit answers, so success is unknown. ValueRefused if a manual does not allow it, a unit of the bus has
        another register there, or the value depends on registers that are not in `state`. `driver` stands for the units
        of a bus without devices.
        """
        request = self._broadcast_request(register, value, driver, how)
        self.broadcast_raw(request, driver=driver)

    def broadcast_raw(self, request: Request, *, driver: type[BareDevice] | None = None) -> None:
        """Send a request of function 05, 06, 15 or 16 to all units, if the manuals allow it; ValueRefused otherwise."""
        timed = broadcast.timed(request, self._drivers(driver), self.link.line)
        with ExitStack() as held:
            for unit in self.units:
                held.enter_context(self.link.lock.of(unit))
            try:
                self.link.call(ALL_UNITS, timed)
            finally:  # broken off, it may have been carried out
                self._forget()


class AsyncBus(_Common[AsyncBareDevice], AsyncLinkUser):
    """As `Bus`, for asyncio."""

    def __init__(self, link: AsyncLink, *, gap: float = USUAL_GAP) -> None:
        super().__init__(gap)
        self.link = link

    @classmethod
    def tcp(cls, host: str, *, port: int = MODBUS_TCP_PORT, **settings: Unpack[LinkSettings]) -> Self:
        """As `Bus.tcp`."""
        return cls(connect.async_tcp(host, port=port, **settings))

    @classmethod
    def rtu(cls, port: str, *, baud: int, **settings: Unpack[LineSettings]) -> Self:
        """As `Bus.rtu`."""
        gap = settings.setdefault("gap", USUAL_GAP)
        return cls(connect.async_serial(port, baud=baud, **settings), gap=gap)

    @classmethod
    def over(cls, client: AsyncClient, **settings: Unpack[ClientSettings]) -> Self:
        """As `Bus.over`, with an asyncio client."""
        gap = settings.setdefault("gap", USUAL_GAP)
        return cls(connect.async_over(client, **settings), gap=gap)

    def device(self, driver: type[A], *, unit: int, **givens: Any) -> A:
        """As `Bus.device`."""
        device = driver(self.link, unit=unit, **givens)
        self._add(device, self.link.line)
        return device

    async def broadcast(
        self,
        register: Register[Any],
        value: object,
        *,
        driver: type[AsyncBareDevice] | None = None,
        **how: Unpack[BroadcastOptions],
    ) -> None:
        """As `Bus.broadcast`."""
        request = self._broadcast_request(register, value, driver, how)
        await self.broadcast_raw(request, driver=driver)

    async def broadcast_raw(self, request: Request, *, driver: type[AsyncBareDevice] | None = None) -> None:
        """As `Bus.broadcast_raw`."""
        timed = broadcast.timed(request, self._drivers(driver), self.link.line)
        async with AsyncExitStack() as held:
            for unit in self.units:
                await held.enter_async_context(self.link.lock.of(unit))
            try:
                await self.link.call(ALL_UNITS, timed)
            finally:  # as above
                self._forget()
