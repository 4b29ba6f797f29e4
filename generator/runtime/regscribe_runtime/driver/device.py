"""Drivers: a device behind a link, synchronous and asyncio, running the same operations."""

from collections.abc import Mapping
from typing import Any, ClassVar, Self, TypeVar, Unpack

from regscribe_runtime.driver.attributes import BoundRegister
from regscribe_runtime.driver.executor import run, run_async
from regscribe_runtime.driver.parts import AsyncPart, Catalogue, Group, Part, SubPart, groups_of
from regscribe_runtime.link import connect
from regscribe_runtime.link.links import (
    AsyncClient,
    AsyncLink,
    ClientSettings,
    LineSettings,
    Link,
    LinkSettings,
    SyncClient,
)
from regscribe_runtime.operations import tasks
from regscribe_runtime.operations.configure import ConfigureOptions
from regscribe_runtime.operations.session import Session
from regscribe_runtime.operations.snapshot import Snapshot
from regscribe_runtime.registers.register import Register
from regscribe_runtime.report import Wear, WriteReport
from regscribe_runtime.values.blocks import Header, RegisterBlock
from regscribe_runtime.values.facts import Identity, Page
from regscribe_runtime.values.programs import SetpointProgram
from regscribe_runtime.values.protocol import Protocol
from regscribe_runtime.values.wire_types import Space

T = TypeVar("T")
What = Group | Register[Any] | BoundRegister[Any, Any]


class SerialSettings(LineSettings, total=False):
    """Settings of a serial line: `baud` and those of `LineSettings`; the manual's are the default."""

    baud: int


class TcpSettings(LinkSettings, total=False):
    """Settings of a TCP link: `port` and those of `LinkSettings`."""

    port: int


class _Common:
    """The facts of the model and the session, for both kinds of driver."""

    model: ClassVar[str] = ""
    map_id: ClassVar[str] = ""
    map_sha256: ClassVar[str] = ""
    protocol: ClassVar[Protocol] = Protocol()
    identity: ClassVar[tuple[Identity, ...]] = ()
    setpoint_programs: ClassVar[tuple[SetpointProgram, ...]] = ()
    _pages: ClassVar[tuple[Page, ...]] = ()
    _unused: ClassVar[tuple[tuple[Space, int, int], ...]] = ()
    _blocks: ClassVar[tuple[RegisterBlock, ...]] = ()
    registers: ClassVar[Catalogue] = Catalogue(whole=True)
    session: Session

    def _begin(self, unit: int, givens: Mapping[str, Any]) -> None:
        owner: type = type(self)
        section = getattr(owner, "commands", None)
        self.session = Session(
            unit=unit,
            protocol=self.protocol,
            registers=type(self).registers,
            commands=section.commands() if isinstance(section, SubPart) else {},
            givens=givens,
            groups=groups_of(owner),
            unused=self._unused,
            pages=self._pages,
            blocks=self._blocks,
        )

    @property
    def wear(self) -> Wear:
        """Writes to the EEPROM by this driver, sent and spared, by register."""
        return self.session.wear

    def _chosen(self, what: tuple[What, ...]) -> list[Register[Any]]:
        found: list[Register[Any]] = []
        if not what:
            return [register for register in self.session.registers.values() if register.is_read_along]
        for one in what:
            if isinstance(one, Group):
                found += one.registers(type(self))
            else:
                found.append(self.session.own(one if isinstance(one, Register) else one.register))
        return found

    def __repr__(self) -> str:
        return f"<{type(self).__name__} unit {self.session.unit}>"


class LinkUser:
    """Opens and closes a synchronous link."""

    link: Link
    _on_bus = False

    def open(self) -> None:
        """Open the link, if it is not open; LinkLost if that fails."""
        self.link.open()

    def close(self) -> None:
        """Close the link, harmless if it is closed; a device of a bus leaves it open."""
        if not self._on_bus:
            self.link.close()

    def __enter__(self) -> Self:
        self.open()
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


class AsyncLinkUser:
    """Opens and closes an asyncio link."""

    link: AsyncLink
    _on_bus = False

    async def open(self) -> None:
        """As `LinkUser.open`."""
        await self.link.open()

    async def close(self) -> None:
        """As `LinkUser.close`."""
        if not self._on_bus:
            await self.link.close()

    async def __aenter__(self) -> Self:
        await self.open()
        return self

    async def __aexit__(self, *_: object) -> None:
        await self.close()


class BareDevice(_Common, LinkUser, Part):
    """A synchronous driver of one unit behind a link; `givens` are the facts that the manual leaves open."""

    def __init__(self, link: Link, *, unit: int, **givens: Any) -> None:
        Part.__init__(self, self)
        self.link = link
        self._begin(unit, givens)

    def run(self, task: tasks.Task[T]) -> T:
        """Run an operation; others of this unit wait, requests of other units may come between its own."""
        return run(task, self.session, self.link)

    def read(self, *what: What, fresh: bool = True) -> Snapshot:
        """Read groups and registers (all without arguments) in the requests of least cost on this line.

        Registers that the values depend on (decimals, input type, word order) are read along, so that no scale is
        stale; Unsteady is raised if they change during several reads. Without `fresh` remembered values are used.
        """
        return self.run(tasks.read_many(self._chosen(what), fresh=fresh))

    def configure(self, values: Mapping[Any, Any], **how: Unpack[ConfigureOptions]) -> WriteReport:
        """Write several values as one operation; `values` by path, declaration or attribute; `how`: `ConfigureOptions`.

        All values are checked before the first is sent, each in the state that those before it leave. They are written
        in the map's order, neighbours in one request, without those that the device holds already; it unlocks and
        applies once, and reads all back at the end. Raises ValueRefused (ValuesRefused for several) before anything is
        sent, and NotConfigured with a report of every register if it fails after that.
        """
        return self.run(tasks.configure(values, **how))

    def chain_headers(self) -> dict[str, tuple[Header, ...]]:
        """The headers (id, base, length) of the blocks that each chain of this device has, unknown ones too."""
        return self.run(tasks.headers())

    def loopback(self, data: int = 0x55AA) -> int:
        """Function 08: send one word, return the echo."""
        return self.run(tasks.loopback(data))

    def exception_status(self) -> int:
        """Function 07: the eight status bits."""
        return self.run(tasks.exception_status())


class Device(BareDevice):
    """A synchronous driver of a device without givens."""

    @classmethod
    def tcp(cls, host: str, *, unit: int, **settings: Unpack[TcpSettings]) -> Self:
        """A driver over TCP; see `TcpSettings`."""
        return cls(connect.tcp(host, **settings), unit=unit)

    @classmethod
    def rtu(cls, port: str, *, unit: int, **line: Unpack[SerialSettings]) -> Self:
        """A driver over a serial line; see `SerialSettings`."""
        return cls(serial_link(cls.protocol, port, **line), unit=unit)

    @classmethod
    def over(cls, client: SyncClient, *, unit: int, **settings: Unpack[ClientSettings]) -> Self:
        """A driver over a connected pymodbus client, which the driver does not close; see `ClientSettings`."""
        return cls(client_link(cls.protocol, client, **settings), unit=unit)


class AsyncBareDevice(_Common, AsyncLinkUser, AsyncPart):
    """An asyncio driver; otherwise as `BareDevice`."""

    def __init__(self, link: AsyncLink, *, unit: int, **givens: Any) -> None:
        AsyncPart.__init__(self, self)
        self.link = link
        self._begin(unit, givens)

    async def run(self, task: tasks.Task[T]) -> T:
        """As `BareDevice.run`."""
        return await run_async(task, self.session, self.link)

    async def read(self, *what: What, fresh: bool = True) -> Snapshot:
        """As `BareDevice.read`."""
        return await self.run(tasks.read_many(self._chosen(what), fresh=fresh))

    async def configure(self, values: Mapping[Any, Any], **how: Unpack[ConfigureOptions]) -> WriteReport:
        """As `BareDevice.configure`."""
        return await self.run(tasks.configure(values, **how))

    async def chain_headers(self) -> dict[str, tuple[Header, ...]]:
        """As `BareDevice.chain_headers`."""
        return await self.run(tasks.headers())

    async def loopback(self, data: int = 0x55AA) -> int:
        """Function 08: send one word, return the echo."""
        return await self.run(tasks.loopback(data))

    async def exception_status(self) -> int:
        """Function 07: the eight status bits."""
        return await self.run(tasks.exception_status())


class AsyncDevice(AsyncBareDevice):
    """An asyncio driver of a device without givens."""

    @classmethod
    def tcp(cls, host: str, *, unit: int, **settings: Unpack[TcpSettings]) -> Self:
        """As `Device.tcp`."""
        return cls(connect.async_tcp(host, **settings), unit=unit)

    @classmethod
    def rtu(cls, port: str, *, unit: int, **line: Unpack[SerialSettings]) -> Self:
        """As `Device.rtu`."""
        return cls(async_serial_link(cls.protocol, port, **line), unit=unit)

    @classmethod
    def over(cls, client: AsyncClient, *, unit: int, **settings: Unpack[ClientSettings]) -> Self:
        """As `Device.over`, with an asyncio client."""
        return cls(async_client_link(cls.protocol, client, **settings), unit=unit)


def _serial_settings(protocol: Protocol, port: str, line: SerialSettings) -> dict[str, Any]:
    return {**protocol.serial.line._asdict(), "gap": float(protocol.serial.gap), **line, "port": port}


def serial_link(protocol: Protocol, port: str, **line: Unpack[SerialSettings]) -> Link:
    """A serial link; the manual's settings are the default."""
    return connect.serial(**_serial_settings(protocol, port, line))


def async_serial_link(protocol: Protocol, port: str, **line: Unpack[SerialSettings]) -> AsyncLink:
    """As `serial_link`, for asyncio."""
    return connect.async_serial(**_serial_settings(protocol, port, line))


def client_link(protocol: Protocol, client: SyncClient, **settings: Unpack[ClientSettings]) -> Link:
    """A link over a pymodbus client, by default with the manual's silence between frames."""
    settings.setdefault("gap", float(protocol.serial.gap))
    return connect.over(client, **settings)


def async_client_link(protocol: Protocol, client: AsyncClient, **settings: Unpack[ClientSettings]) -> AsyncLink:
    """As `client_link`, for asyncio."""
    settings.setdefault("gap", float(protocol.serial.gap))
    return connect.async_over(client, **settings)
