"""Servers on asyncio: simulated devices on a TCP port, or on a serial line."""

import asyncio
from abc import ABC, abstractmethod
from dataclasses import replace
from io import FileIO
from typing import Any, cast

from regscribe.simulate.errors import SimulatorError
from regscribe.simulate.line.connection import CHUNK, Connection
from regscribe.simulate.line.serial_ports import OpenLine
from regscribe.simulate.line.server_context import ServerContext
from regscribe.simulate.line.service import Patience, Service, Transport
from regscribe_runtime.wire.framing import ASCII, RTU, TCP
from regscribe_runtime.wire.server_framing import Framer, RtuFramer, framer_for

FRAMINGS = {
    Transport.TCP: TCP,
    Transport.RTU_OVER_TCP: RTU,
    Transport.ASCII_OVER_TCP: ASCII,
}
SERIAL_GAP = 0.1
"""Seconds of silence that end a frame on a serial line: longer than 3.5 characters, for adapters deliver in chunks."""

FAREWELL = 0.5
"""Seconds that a client has to take the last answers when its connection is closed."""

RTU_CHUNK = 512
"""As `CHUNK`, in RTU: bytes without any sound frame take long to look through, and the others wait meanwhile."""

ACCEPTING = 5
"""Rounds of the event loop, at most, from accepting a client to its first call-back."""

LOOKS = 4
"""How often in the time of an idle client it is looked for."""


class Server(ABC):
    """A started server, and where it is: `path` on a serial line, else `host` and `port`."""

    def __init__(self, path: str = "") -> None:
        self.host, self.port, self.path = "", 0, path
        self.clock: asyncio.Task[None] | None = None
        self._loss = ""
        self._ended = asyncio.Event()

    async def wait(self) -> None:
        """Return when the server was stopped; SimulatorError if its line was lost, as when an adapter is unplugged."""
        await self._ended.wait()
        if self._loss:
            raise SimulatorError(self._loss)

    async def stop(self) -> None:
        """Take no more requests and close everything."""
        if self.clock is not None:
            self.clock.cancel()
            await asyncio.gather(self.clock, return_exceptions=True)
        await self._close()
        self._ended.set()

    @abstractmethod
    async def _close(self) -> None:
        """Close the port or the line."""


class TcpServer(Server):
    """Serves many clients; each is independent of what the others send or do not read.

    When all `connections` are taken and another client comes, the one that was silent longest is disconnected.
    """

    def __init__(self, station: ServerContext, service: Service) -> None:
        super().__init__()
        self.station, self.service = station, service
        self.framing = FRAMINGS[service.transport]
        self.buffer = memoryview(bytearray(RTU_CHUNK if self.framing == RTU else CHUNK))
        self.clients: set[_TcpClient] = set()
        self._idle_check: asyncio.TimerHandle | None = None
        self._listener: asyncio.Server | None = None

    async def listen(self) -> None:
        """Bind and accept; `host` and `port` are then the bound ones. SimulatorError where that is not possible."""
        loop = asyncio.get_running_loop()
        host, port = self.service.host, self.service.port
        try:
            self._listener = await loop.create_server(lambda: _TcpClient(self), host, port)
        except (OSError, OverflowError, UnicodeError) as problem:
            message = f"cannot listen on {host} port {port}: {problem}. Choose another port, or 0 for any free one"
            raise SimulatorError(message) from problem
        self.host, self.port = self._listener.sockets[0].getsockname()[:2]
        idle = (self.service.patience or Patience()).idle
        if idle is not None:
            self._disconnect_idle(idle)

    def _disconnect_idle(self, idle: float) -> None:
        """Disconnect clients that were silent for `idle` seconds, `LOOKS` times within them."""
        loop = asyncio.get_running_loop()
        for client in [each for each in self.clients if loop.time() - each.heard > idle]:
            client.dismiss()
        self._idle_check = loop.call_later(idle / LOOKS, self._disconnect_idle, idle)

    async def _close(self) -> None:
        """Stop accepting, let in clients that were accepted a moment ago (a closed server would leak them), end all."""
        loop = asyncio.get_running_loop()
        if self._listener is not None:
            for listening in self._listener.sockets:
                loop.remove_reader(listening.fileno())
            for _ in range(ACCEPTING):
                await asyncio.sleep(0)
            self._listener.close()
        if self._idle_check is not None:
            self._idle_check.cancel()
        leaving = [client.dismiss() for client in tuple(self.clients)]
        await asyncio.gather(*(gone.wait() for gone in leaving))


class _TcpClient(Connection, asyncio.BufferedProtocol):
    """One client of a TCP server; all clients of a server share the buffer of one chunk."""

    def __init__(self, server: TcpServer) -> None:
        super().__init__(framer_for(server.framing), server.station, server.service)
        self._server = server
        self._gone = asyncio.Event()

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        super().connection_made(transport)
        clients = self._server.clients
        if len(clients) >= self._server.service.connections:
            min(clients, key=lambda each: each.heard).dismiss()
        clients.add(self)

    def get_buffer(self, sizehint: int) -> memoryview:  # noqa: ARG002 - asyncio's signature
        """Where its bytes go; they are out of it before the next client's come."""
        return self._server.buffer

    def buffer_updated(self, nbytes: int) -> None:
        self.data_received(bytes(self._server.buffer[:nbytes]))

    def connection_lost(self, exc: Exception | None) -> None:
        super().connection_lost(exc)
        self._server.clients.discard(self)
        self._gone.set()

    def dismiss(self) -> asyncio.Event:
        """Let it take its last answers for a moment, and disconnect it; the event is set when it is gone."""
        self._server.clients.discard(self)
        self._writer.close()
        self._loop.call_later(FAREWELL, self._writer.abort)
        return self._gone


def _log_all_but_lost_lines(loop: asyncio.AbstractEventLoop, context: dict[str, Any]) -> None:
    """The loop's own handler, without the traceback for a line whose loss its server reports."""
    if not (isinstance(context.get("protocol"), LineServer) and isinstance(context.get("exception"), OSError)):
        loop.default_exception_handler(context)


class LineServer(Server, Connection):
    """Serves one serial line, on two pipes of asyncio upon its file descriptor."""

    def __init__(self, line: OpenLine, station: ServerContext, service: Service, framer: Framer | None = None) -> None:
        Server.__init__(self, line.path)
        patience = service.patience or Patience(idle=None, gap=SERIAL_GAP)
        Connection.__init__(self, framer or RtuFramer(), station, replace(service, patience=patience))
        self._line = line

    async def listen(self) -> None:
        """Start to read and write."""
        if self._loop.get_exception_handler() is None:
            self._loop.set_exception_handler(_log_all_but_lost_lines)
        pipe = FileIO(self._line.fd, "r+", closefd=False)
        await self._loop.connect_write_pipe(lambda: self, pipe)
        await self._loop.connect_read_pipe(lambda: self, pipe)

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Take one of the two pipes."""
        if isinstance(transport, asyncio.WriteTransport):
            self._writer = transport
        else:
            self._reader = cast("asyncio.ReadTransport", transport)

    def data_received(self, data: bytes) -> None:
        """Act on bytes of the line."""
        self._line.heard()
        super().data_received(data)

    def eof_received(self) -> bool:
        """End with an error: a line has no end."""
        self.connection_lost(EOFError("end of data"))
        return False

    def connection_lost(self, exc: Exception | None) -> None:
        """End with the error of the line, if it was one."""
        super().connection_lost(exc)
        if exc is not None:
            self._loss = f"serial device {self.path} is gone: {exc}"
            self._ended.set()

    async def _close(self) -> None:
        self._abort()
        self._reader.close()
        await asyncio.sleep(0)  # the pipes report their ends
        self._line.close()
