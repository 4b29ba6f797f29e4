"""Links over a user's own pymodbus client: it opens, frames and waits; its answers are verified as on other links.

Each request is encoded once: the client, which would send it again after silence, then finds nothing to send. So a
write is never sent twice, and the client's behaviour for others is unchanged.
"""

import asyncio
import select
import struct
import time
from collections.abc import Callable
from typing import Any, NoReturn

from pymodbus.client import ModbusBaseClient, ModbusBaseSyncClient
from pymodbus.exceptions import ConnectionException, ModbusException, ModbusIOException
from pymodbus.framer import FramerAscii, FramerRTU
from pymodbus.pdu import ModbusPDU

from regscribe_runtime.errors import LinkLost, NoAnswer, NotOpen, ValueRefused, WrongAnswer
from regscribe_runtime.link.links import ClientSettings, Retry
from regscribe_runtime.link.locks import AsyncTurns, Turns
from regscribe_runtime.link.pending import PendingRequest, StaleReplies
from regscribe_runtime.values.serial_line import MODBUS, LineChange, SerialLine, first_address
from regscribe_runtime.values.wire_types import Space
from regscribe_runtime.wire import pdu
from regscribe_runtime.wire.requests import WRITE_REGISTER, Reply, Request

SILENT = "No response received"
"""Text of pymodbus' error when nothing came; its other errors concern the answer."""


class _SentBefore(Exception):  # noqa: N818 (no error: how the client's second attempt ends)
    """The client wants to send a request again."""


class _Once(ModbusPDU):
    """A request that is encoded, and so sent, only once; `before` is called first, while no other request is sent."""

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


class _Base:
    """Common parts of both kinds of link; see `LinkState` for the attributes."""

    def __init__(self, client: Any, framer: object, connection: Callable[[], object], settings: ClientSettings) -> None:
        self._client, self._gap = client, settings.get("gap", 0.0)
        self._connection = connection  # the socket, port or transport that is open now, None if there is none
        self._decisive = not isinstance(framer, FramerRTU | FramerAscii)  # an answer names its request
        self.retry = settings.get("retry") or Retry()
        self.addressing = settings.get("addressing", MODBUS)
        self.retune(LineChange(addressing=self.addressing))
        self._late, self._silent_from = StaleReplies(), 0.0
        self._opened = 0
        self._last: object = None
        self._used: object = None

    @property
    def timeout(self) -> float:
        """The client's own, which does the waiting."""
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

    def retune(self, change: LineChange) -> None:
        """Count addresses otherwise from now on; the client's speed and format stay, as those of a gateway do."""
        if change.addressing is not None:
            first_address(change.addressing)  # ValueError for another name
            self.addressing = change.addressing

    def _check(self) -> None:
        if not self._client.connected:
            message = f"{self._client} is not connected: connect it before a driver uses it"
            raise NotOpen(message)

    def _begin(self, unit: int, request: Request) -> PendingRequest:
        self._used = self._connection()
        if request.function == WRITE_REGISTER and request.space is Space.ENRON:
            where = f"{request.space} {request.space.spelled(request.address)}"
            reason = "pymodbus takes no answer of function 06 with four bytes; make the driver by `tcp` or `rtu`"
            raise ValueRefused(where, reason)
        shifted = request.shifted(first_address(self.addressing))
        return PendingRequest(unit, request, shifted, pdu.encode_request(shifted), self.timeout)

    def _pause(self, pending: PendingRequest) -> float:
        """Seconds to wait for a silent line, and until no late answer could be taken for this request's."""
        now, line = time.monotonic(), self.line
        quiet = self._silent_from + (line.silence(self._gap) if line else 0.0)
        return max(max(quiet, self._late.busy, self._late.until(pending, now)) - now, 0.0)

    def _reply(self, pending: PendingRequest, answer: Any) -> Reply:
        """The answer as plain data, decoded from its own bytes."""
        self._silent_from = time.monotonic()
        shown = pending.shown
        if pending.is_broadcast:
            return Reply(shown.function, shown.words, shown.address, len(shown.words))
        self._late.answered(pending, self._silent_from)
        try:
            reply = pdu.decode_reply(pending.wire, bytes([answer.function_code]) + answer.encode())
        except (ModbusException, struct.error, ValueError, TypeError) as error:
            message = f"{pending}: {answer} is no answer to it"
            raise WrongAnswer(message) from error
        moved = pending.wire.address - shown.address
        return reply if reply.exception is not None else reply._replace(address=reply.address - moved)

    def _fail(self, pending: PendingRequest, error: BaseException, began: float) -> NoReturn:
        """Raise the error of a link for that of the client; `began` is when the request went out."""
        now = self._silent_from = time.monotonic()
        if isinstance(error, ModbusIOException) and isinstance(error.__cause__, asyncio.CancelledError):
            error = error.__cause__  # pymodbus 3.13 hides that a task was cancelled
        if not self._decisive:
            over = isinstance(error, Exception)  # else the client was interrupted, and the device may be answering yet
            self._late.owe(pending, now if over else began + self.timeout)
        own = self._link_error(pending, error)
        if own is error:
            raise error
        raise own from error

    def _link_error(self, pending: PendingRequest, error: BaseException) -> BaseException:
        if isinstance(error, ConnectionException | OSError) and not isinstance(error, TimeoutError):
            return LinkLost(f"{pending}: the client lost its connection ({error})")
        if not isinstance(error, ModbusException | TimeoutError | _SentBefore | struct.error | ValueError):
            return error
        if self._used is not None and self._used is not self._connection():
            return LinkLost(f"{pending}: the client lost its connection while it waited for the answer")
        if isinstance(error, TimeoutError | _SentBefore) or SILENT in str(error):
            shown = pending.shown
            return NoAnswer(unit=pending.unit, function=shown.function, address=shown.address, seconds=pending.seconds)
        return WrongAnswer(f"{pending}: {error}")


class ClientLink(_Base):
    """A `Link` over a synchronous client, for threads."""

    def __init__(self, client: Any, settings: ClientSettings) -> None:
        if not isinstance(client, ModbusBaseSyncClient):
            raise TypeError(_not_one(client, "a synchronous", isinstance(client, ModbusBaseClient)))
        super().__init__(client, client.framer, lambda: self._client.socket, settings)
        self.lock = Turns()

    def open(self) -> None:
        """LinkLost if the client is not connected; it is never opened here."""
        self._check()

    def close(self) -> None:
        """Leave the client as it is."""

    def call(self, unit: int, request: Request) -> Reply:
        """Send one request once; see `Link.call`."""
        with self.lock.line:
            pending = self._begin(unit, request)
            once = _Once(unit, pending.frame, self._drain)
            while pause := self._pause(pending):
                time.sleep(pause)
            began = time.monotonic()
            try:
                answer = self._client.execute(pending.is_broadcast, once)
                time.sleep(request.seconds if pending.is_broadcast else 0)
            except BaseException as error:  # noqa: BLE001 (it is raised again, or as the link error that it is)
                self._fail(pending, error, began)
            return self._reply(pending, answer)

    def _drain(self) -> None:
        """Drop late bytes of a TCP connection, which would pass for the next answer; a serial client does so itself."""
        while not self._decisive and self.line is None and select.select([self._client.socket], [], [], 0)[0]:
            self._client.recv(None)


class AsyncClientLink(_Base):
    """An `AsyncLink` over an asyncio client, for the tasks of its event loop."""

    def __init__(self, client: Any, settings: ClientSettings) -> None:
        if not isinstance(client, ModbusBaseClient):
            raise TypeError(_not_one(client, "an asyncio", isinstance(client, ModbusBaseSyncClient)))
        super().__init__(client, client.ctx.framer, lambda: self._client.ctx.transport, settings)
        self.lock = AsyncTurns()

    async def open(self) -> None:
        """LinkLost if the client is not connected; it is never opened here."""
        self._check()

    async def close(self) -> None:
        """Leave the client as it is."""

    async def call(self, unit: int, request: Request) -> Reply:
        """Send one request once; see `Link.call`."""
        async with self.lock.line:
            pending = self._begin(unit, request)
            once = _Once(unit, pending.frame, lambda: None)
            while pause := self._pause(pending):  # noqa: ASYNC110 (it waits for time to pass, no event)
                await asyncio.sleep(pause)
            began = time.monotonic()
            try:
                answer = await self._client.execute(pending.is_broadcast, once)
                await asyncio.sleep(request.seconds if pending.is_broadcast else 0)
            except BaseException as error:  # noqa: BLE001 (it is raised again, or as the link error that it is)
                self._fail(pending, error, began)
            return self._reply(pending, answer)


def _not_one(client: object, kind: str, other: bool) -> str:  # noqa: FBT001 (which of two kinds it is)
    hint = "the other kind: asyncio drivers (Async...) take asyncio clients" if other else "no client of pymodbus"
    return f"{kind} client of pymodbus is needed here, and {type(client).__name__} is {hint}"
