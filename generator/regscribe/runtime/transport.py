"""The only module that imports pymodbus (3.16): it frames and transports, nothing else.

Its clients never retry here (`retries=0`): a timed-out write that is sent again would be carried out twice. Arguments
are checked before, answers after, by `request.verify`.
"""

import asyncio
import threading
from typing import Any, NamedTuple, Self

from pymodbus import FramerType
from pymodbus.client import AsyncModbusSerialClient, AsyncModbusTcpClient, ModbusSerialClient, ModbusTcpClient
from pymodbus.exceptions import ConnectionException, ModbusException

from regscribe.runtime import request as functions
from regscribe.runtime.errors import LinkLost, NoAnswer
from regscribe.runtime.request import Reply, Request

FRAMERS = {"tcp": FramerType.SOCKET, "rtu": FramerType.RTU, "ascii": FramerType.ASCII}
ADDRESSINGS = {"modbus": 0, "jbus": 1}
"""The number of a device's first address: JBUS counts from 1 what Modbus counts from 0."""

UNADDRESSED = frozenset({functions.READ_STATUS, functions.LOOPBACK})

RECONNECT_SECONDS = 5.0
"""Upper bound of pymodbus' growing reconnect delay, which it lets grow to 300 s."""
BITS_IN_BYTE = 8


class Line(NamedTuple):
    """A serial line: device, speed in baud, character format."""

    port: str
    baud: int
    data_bits: int
    parity: str
    stop_bits: int

    def settings(self) -> dict[str, Any]:
        """The keyword arguments of pymodbus' serial clients."""
        return {"baudrate": self.baud, "bytesize": self.data_bits, "parity": self.parity, "stopbits": self.stop_bits}


def _framer(framing: str) -> FramerType:
    if framing not in FRAMERS:
        message = f"framing {framing!r} is none of {', '.join(FRAMERS)}"
        raise ValueError(message)
    return FRAMERS[framing]


def _send(client: Any, unit: int, asked: Request) -> Any:  # noqa: PLR0911 (a row for each function code)
    match asked.function:
        case functions.READ_COILS:
            return client.read_coils(asked.address, count=asked.quantity, device_id=unit)
        case functions.READ_DISCRETE_INPUTS:
            return client.read_discrete_inputs(asked.address, count=asked.quantity, device_id=unit)
        case functions.READ_HOLDING:
            return client.read_holding_registers(asked.address, count=asked.quantity, device_id=unit)
        case functions.READ_INPUT:
            return client.read_input_registers(asked.address, count=asked.quantity, device_id=unit)
        case functions.WRITE_COIL:
            return client.write_coil(asked.address, bool(asked.words[0]), device_id=unit)
        case functions.WRITE_REGISTER:
            return client.write_register(asked.address, asked.words[0], device_id=unit)
        case functions.READ_STATUS:
            return client.read_exception_status(device_id=unit)
        case functions.LOOPBACK:
            return client.diag_query_data(asked.words[0].to_bytes(2, "big"), device_id=unit)
        case functions.WRITE_COILS:
            return client.write_coils(asked.address, [bool(bit) for bit in asked.words], device_id=unit)
        case _:
            return client.write_registers(asked.address, list(asked.words), device_id=unit)


def _reply(asked: Request, answer: Any) -> Reply:  # noqa: PLR0911 (as above)
    code = answer.function_code
    if answer.isError():
        return Reply(code & 0x7F, exception=answer.exception_code or 0xFF)
    if code in (functions.READ_HOLDING, functions.READ_INPUT):
        return Reply(code, tuple(answer.registers))
    if code in (functions.READ_COILS, functions.READ_DISCRETE_INPUTS):
        return Reply(code, _bits(answer.bits, asked.quantity))
    if code == functions.WRITE_REGISTER:
        return Reply(code, tuple(answer.registers), answer.address)
    if code == functions.WRITE_COIL:
        return Reply(code, (int(answer.bits[0]),), answer.address)
    if code in (functions.WRITE_COILS, functions.WRITE_REGISTERS):
        return Reply(code, (), answer.address, answer.count)
    if code == functions.READ_STATUS:
        return Reply(code, (answer.status,))
    return Reply(code, _echo(answer))


def _bits(bits: list[bool], count: int) -> tuple[int, ...]:
    # bits come in whole bytes: more or fewer bytes than asked for must not look like a good answer
    whole = -(-count // BITS_IN_BYTE) * BITS_IN_BYTE
    return tuple(map(int, bits[:count] if len(bits) == whole else bits))


def _echo(answer: Any) -> tuple[int, ...]:
    message = getattr(answer, "message", b"")
    if isinstance(message, bytes):
        return tuple(int.from_bytes(message[i : i + 2], "big") for i in range(0, len(message), 2))
    return (message,) if isinstance(message, int) else tuple(message or ())


class _Base:
    def __init__(self, client: Any, name: str, seconds: float, addressing: str) -> None:
        if addressing not in ADDRESSINGS:
            message = f"addressing {addressing!r} is none of {', '.join(ADDRESSINGS)}"
            raise ValueError(message)
        self.client, self.name, self.seconds = client, name, seconds
        self.first = ADDRESSINGS[addressing]
        self.epoch = 0
        self.opened = False

    def _outward(self, asked: Request) -> Request:
        if not self.first or asked.function in UNADDRESSED:
            return asked
        return asked._replace(address=asked.address + self.first)

    def _inward(self, asked: Request, answer: Any) -> Reply:
        reply = _reply(asked, answer)
        return reply._replace(address=reply.address - self.first) if self.first else reply

    def _closed(self) -> LinkLost:
        return LinkLost(f"{self.name} is not open: use the driver in a `with` statement, or call open()")

    def _lost(self, error: Exception) -> LinkLost:
        return LinkLost(f"{self.name}: the link was lost ({error})")

    def _silent(self, unit: int, asked: Request) -> NoAnswer:
        return NoAnswer(unit=unit, function=asked.function, address=asked.address, seconds=self.seconds)


class SyncTransport(_Base):
    """A pymodbus synchronous client as a `Link`."""

    def __init__(self, client: Any, name: str, seconds: float, addressing: str) -> None:
        super().__init__(client, name, seconds, addressing)
        self.lock = threading.RLock()

    @classmethod
    def tcp(cls, host: str, *, port: int, framing: str, timeout: float, addressing: str) -> Self:
        """Over TCP; nothing is sent before `open`."""
        client = ModbusTcpClient(host, port=port, framer=_framer(framing), timeout=timeout, retries=0)
        return cls(client, f"tcp://{host}:{port}", timeout, addressing)

    @classmethod
    def serial(cls, line: Line, *, framing: str, timeout: float, addressing: str) -> Self:
        """Over a serial line."""
        client = ModbusSerialClient(line.port, framer=_framer(framing), timeout=timeout, retries=0, **line.settings())
        return cls(client, line.port, timeout, addressing)

    def open(self) -> None:
        """Open it; LinkLost if the other end does not take the connection."""
        self.opened = True
        if not self._connect():
            self.opened = False
            message = f"cannot open {self.name}: nobody answers there"
            raise LinkLost(message)

    def _connect(self) -> bool:
        try:
            connected = bool(self.client.connect())
        except OSError as error:
            raise self._lost(error) from error
        self.epoch += connected
        return connected

    def close(self) -> None:
        """Close it."""
        self.opened = False
        self.client.close()

    def call(self, unit: int, request: Request) -> Reply:
        """Send one request once; see `Link.call`."""
        if not self.opened:
            raise self._closed()
        try:
            if not self.client.connected and not self._connect():
                message = f"{self.name}: nobody answers there any more"
                raise LinkLost(message)
            return self._inward(request, _send(self.client, unit, self._outward(request)))
        except ConnectionException as error:
            raise self._lost(error) from error
        except ModbusException as error:
            self.client.close()  # a late answer must not be taken for the answer to the next request
            raise self._silent(unit, request) from error
        except OSError as error:
            self.client.close()
            raise self._lost(error) from error


class AsyncTransport(_Base):
    """A pymodbus asyncio client as an `AsyncLink`."""

    lock: asyncio.Lock

    @classmethod
    def tcp(cls, host: str, *, port: int, framing: str, timeout: float, addressing: str) -> Self:
        """Over TCP; nothing is sent before `open`."""
        client = AsyncModbusTcpClient(
            host,
            port=port,
            framer=_framer(framing),
            timeout=timeout,
            retries=0,
            reconnect_delay_max=RECONNECT_SECONDS,
        )
        return cls(client, f"tcp://{host}:{port}", timeout, addressing)

    @classmethod
    def serial(cls, line: Line, *, framing: str, timeout: float, addressing: str) -> Self:
        """Over a serial line."""
        client = AsyncModbusSerialClient(
            line.port,
            framer=_framer(framing),
            timeout=timeout,
            retries=0,
            reconnect_delay_max=RECONNECT_SECONDS,
            **line.settings(),
        )
        return cls(client, line.port, timeout, addressing)

    def __init__(self, client: Any, name: str, seconds: float, addressing: str) -> None:
        super().__init__(client, name, seconds, addressing)
        self.lock = asyncio.Lock()
        client.ctx.trace_connect = self._traced

    def _traced(self, connected: bool) -> None:  # noqa: FBT001 (pymodbus calls it so)
        self.epoch += connected

    async def open(self) -> None:
        """Open it; LinkLost if the other end does not take the connection."""
        if not await self.client.connect():
            self.client.close()
            message = f"cannot open {self.name}: nobody answers there"
            raise LinkLost(message)
        self.opened = True

    async def close(self) -> None:
        """Close it."""
        self.opened = False
        self.client.close()

    async def call(self, unit: int, request: Request) -> Reply:
        """Send one request once; see `Link.call`."""
        if not self.opened:
            raise self._closed()
        try:
            if not self.client.connected and not await self.client.connect():
                message = f"{self.name}: nobody answers there any more"
                raise LinkLost(message)
            return self._inward(request, await _send(self.client, unit, self._outward(request)))
        except ConnectionException as error:
            raise self._lost(error) from error
        except ModbusException as error:
            self.client.close()  # a late answer must not be taken for the answer to the next request
            raise self._silent(unit, request) from error
        except OSError as error:
            self.client.close()
            raise self._lost(error) from error
