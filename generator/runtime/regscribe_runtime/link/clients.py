"""Links over a pymodbus client of one's own: it opens, frames and waits, and what it answers is judged as on our links.

Each request is encoded once: the client, which would send it again after silence, then finds nothing to send. So a
write is never sent twice, and what the client does for others stays as it is. Only this module knows pymodbus' clients.
"""

import asyncio
import select
import struct
import time
from collections.abc import Callable
from typing import Any, NamedTuple, NoReturn, Unpack

from pymodbus.client import ModbusBaseClient, ModbusBaseSyncClient
from pymodbus.exceptions import ConnectionException, ModbusException, ModbusIOException
from pymodbus.framer import FramerAscii, FramerRTU
from pymodbus.pdu import ModbusPDU

from regscribe_runtime.errors import LinkLost, NoAnswer, WrongAnswer
from regscribe_runtime.link.exchange import BROADCAST
from regscribe_runtime.link.links import ClientSettings
from regscribe_runtime.link.locks import AsyncTurns, Turns
from regscribe_runtime.link.retry import Retry
from regscribe_runtime.link.stale_replies import StaleReplies
from regscribe_runtime.values.serial_line import MODBUS, LineChange, SerialLine, first_address
from regscribe_runtime.wire import pdu
from regscribe_runtime.wire.requests import Reply, Request

SILENT = "No response received"
"""How pymodbus' error begins, or goes on after "ERROR:", when nothing came; its other errors are about what came."""


class _SentBefore(Exception):  # noqa: N818 (no error: how the client's second attempt ends)
    """The client wants to send a request again."""


class _Once(ModbusPDU):
    """A request that is encoded, and so sent, only once; `before` is called ahead of it, while the client is ours."""

    def __init__(self, unit: int, data: bytes, before: Callable[[], None]) -> None:
        super().__init__(dev_id=unit)
        self.function_code = data[0]
        self._data, self._before, self._sent = data[1:], before, False

    def encode(self) -> bytes:
        """The data behind the function code."""
        if self._sent:
            raise _SentBefore
        self._sent = True
        self._before()
        return self._data


class _Sent(NamedTuple):
    """A request as the caller made it and as it stands on the line, and the connection it goes over."""

    unit: int
    shown: Request
    wire: Request
    over: object

    def __str__(self) -> str:
        return f"unit {self.unit}, function {self.shown.function:02d}, address {self.shown.address}"

    @property
    def silent(self) -> bool:
        """Whether nobody answers it."""
        return self.unit == BROADCAST and not self.wire.reads


class _Base:
    """What both kinds of link have; see `Link` for the attributes."""

    def __init__(self, client: Any, settings: ClientSettings) -> None:
        self._client, self._gap = client, settings.get("gap", 0.0)
        self.retry = settings.get("retry") or Retry()
        self.addressing = settings.get("addressing", MODBUS)
        self.retune(LineChange(addressing=self.addressing))
        self._late, self._silent_from = StaleReplies(), 0.0
        self._opened, self._last = 0, None

    @property
    def timeout(self) -> float:
        """The client's own: it waits, we cannot."""
        return float(self._client.comm_params.timeout_connect)

    @property
    def line(self) -> SerialLine | None:
        """The serial line of a serial client."""
        line = self._client.comm_params
        if not line.baudrate or line.baudrate < 0:
            return None
        return SerialLine(line.host, line.baudrate, line.bytesize, line.parity, line.stopbits)

    @property
    def epoch(self) -> int:
        """How many connections of the client were seen."""
        connection = self._connection()
        if connection is not None and connection is not self._last:
            self._last, self._opened = connection, self._opened + 1
        return self._opened

    def _connection(self) -> Any:
        """The socket, port or transport that is open now, None if there is none."""
        raise NotImplementedError

    def _framer(self) -> object:
        raise NotImplementedError

    @property
    def _decisive(self) -> bool:
        """Whether an answer names its request."""
        return not isinstance(self._framer(), FramerRTU | FramerAscii)

    def retune(self, change: LineChange) -> None:
        """Count addresses otherwise from now on; the client's speed and format stay, as those of a gateway do."""
        if change.addressing is not None:
            first_address(change.addressing)  # ValueError for another name
            self.addressing = change.addressing

    def _check(self) -> None:
        if not self._client.connected:
            message = f"{self._client} is not connected: connect it before a driver uses it"
            raise LinkLost(message)

    def _sent(self, unit: int, request: Request) -> _Sent:
        return _Sent(unit, request, request.shifted(first_address(self.addressing)), self._connection())

    def _pause(self, sent: _Sent) -> float:
        """How long to wait for a silent line, and until no late answer could be taken for this one's, in seconds."""
        now, line = time.monotonic(), self.line
        quiet = self._silent_from + (line.silence(self._gap) if line else 0.0)
        until = max(quiet, self._late.busy, self._late.until(sent.unit, sent.wire, now))
        return max(until - now, 0.0)

    def _heard(self, sent: _Sent, answer: Any) -> Reply:
        """The answer as plain data, in its own bytes."""
        self._silent_from = time.monotonic()
        if sent.silent:
            return Reply(sent.shown.function, sent.shown.words, sent.shown.address, len(sent.shown.words))
        self._late.answered(sent.unit, sent.wire, now=time.monotonic(), seconds=self.timeout)
        try:
            reply = pdu.decode_reply(sent.wire, bytes([answer.function_code]) + answer.encode())
        except (ModbusException, struct.error, ValueError, TypeError) as error:
            message = f"{sent}: {answer} is no answer to it"
            raise WrongAnswer(message) from error
        moved = sent.wire.address - sent.shown.address
        return reply if reply.exception is not None else reply._replace(address=reply.address - moved)

    def _failed(self, sent: _Sent, error: BaseException, began: float) -> NoReturn:
        """Raise what became of a request; `began` is when it went out."""
        now = self._silent_from = time.monotonic()
        if isinstance(error, ModbusIOException) and isinstance(error.__cause__, asyncio.CancelledError):
            error = error.__cause__  # pymodbus 3.13 hides that a task was cancelled
        if not self._decisive:
            over = isinstance(error, Exception)  # else the client was interrupted, and the device may be answering yet
            deadline = now if over else began + self.timeout
            self._late.owe(sent.unit, sent.wire, deadline=deadline, seconds=self.timeout)
        told = self._told(sent, error)
        if told is error:
            raise error
        raise told from error

    def _told(self, sent: _Sent, error: BaseException) -> BaseException:
        if isinstance(error, ConnectionException | OSError) and not isinstance(error, TimeoutError):
            return LinkLost(f"{sent}: the client lost its connection ({error})")
        if not isinstance(error, ModbusException | TimeoutError | _SentBefore | struct.error | ValueError):
            return error
        if sent.over is not None and sent.over is not self._connection():
            return LinkLost(f"{sent}: the client lost its connection while it waited for the answer")
        if isinstance(error, TimeoutError | _SentBefore) or SILENT in str(error):
            shown = sent.shown
            return NoAnswer(unit=sent.unit, function=shown.function, address=shown.address, seconds=self.timeout)
        return WrongAnswer(f"{sent}: {error}")


class ClientLink(_Base):
    """A `Link` over a synchronous client, for threads."""

    def __init__(self, client: Any, **settings: Unpack[ClientSettings]) -> None:
        if not isinstance(client, ModbusBaseSyncClient):
            raise TypeError(_not_one(client, "a synchronous", isinstance(client, ModbusBaseClient)))
        super().__init__(client, settings)
        self.lock = Turns()

    def _connection(self) -> Any:
        return self._client.socket

    def _framer(self) -> object:
        return self._client.framer

    def open(self) -> None:
        """LinkLost if the client is not connected; it is never opened here."""
        self._check()

    def close(self) -> None:
        """Leave the client as it is."""

    def call(self, unit: int, request: Request) -> Reply:
        """Send one request once; see `Link.call`."""
        with self.lock.line:
            sent = self._sent(unit, request)
            once = _Once(unit, pdu.encode_request(sent.wire), self._drain)
            while pause := self._pause(sent):
                time.sleep(pause)
            began = time.monotonic()
            try:
                answer = self._client.execute(sent.silent, once)
                time.sleep(request.seconds if sent.silent else 0)
            except BaseException as error:  # noqa: BLE001 (it is raised again, or told otherwise)
                self._failed(sent, error, began)
            return self._heard(sent, answer)

    def _drain(self) -> None:
        """Drop what came late over TCP, where the client would read it as the next answer; a serial client does so."""
        while not self._decisive and self.line is None and select.select([self._client.socket], [], [], 0)[0]:
            self._client.recv(None)


class AsyncClientLink(_Base):
    """An `AsyncLink` over an asyncio client, for the tasks of its event loop."""

    def __init__(self, client: Any, **settings: Unpack[ClientSettings]) -> None:
        if not isinstance(client, ModbusBaseClient):
            raise TypeError(_not_one(client, "an asyncio", isinstance(client, ModbusBaseSyncClient)))
        super().__init__(client, settings)
        self.lock = AsyncTurns()

    def _connection(self) -> Any:
        return self._client.ctx.transport

    def _framer(self) -> object:
        return self._client.ctx.framer

    async def open(self) -> None:
        """LinkLost if the client is not connected; it is never opened here."""
        self._check()

    async def close(self) -> None:
        """Leave the client as it is."""

    async def call(self, unit: int, request: Request) -> Reply:
        """Send one request once; see `Link.call`."""
        async with self.lock.line:
            sent = self._sent(unit, request)
            once = _Once(unit, pdu.encode_request(sent.wire), lambda: None)
            while pause := self._pause(sent):  # noqa: ASYNC110 (it waits for time to pass, no event)
                await asyncio.sleep(pause)
            began = time.monotonic()
            try:
                answer = await self._client.execute(sent.silent, once)
                await asyncio.sleep(request.seconds if sent.silent else 0)
            except BaseException as error:  # noqa: BLE001 (it is raised again, or told otherwise)
                self._failed(sent, error, began)
            return self._heard(sent, answer)


def _not_one(client: object, kind: str, other: bool) -> str:  # noqa: FBT001 (which of two kinds it is)
    hint = "the other kind: asyncio drivers (Async...) take asyncio clients" if other else "no client of pymodbus"
    return f"{kind} client of pymodbus is needed here, and {type(client).__name__} is {hint}"
