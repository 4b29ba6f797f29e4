"""Servers on asyncio: a station of simulated devices on a TCP port, or on a serial line."""

import asyncio
from collections.abc import Callable, Coroutine
from typing import Any, Protocol, cast

from regscribe.simulate.errors import SimulatorError
from regscribe.simulate.line.connection import CHUNK, Connection, ConnectionPolicy
from regscribe.simulate.line.paced_line import Events, LineTransport
from regscribe.simulate.line.serial_ports import OpenLine
from regscribe.simulate.line.server_context import ServerContext
from regscribe_runtime.wire.framing import RTU
from regscribe_runtime.wire.server_framing import Framer, framer_for

FAREWELL = 0.5
"""Seconds that a client has to take the last answers when its connection is closed."""

RTU_CHUNK = 512
"""As `CHUNK`, in RTU: bytes without any sound frame take long to look through, and the others wait meanwhile."""

ACCEPTING = 5
"""Rounds of the event loop, at most, from accepting a client to its first call-back."""

LOOKS = 4
"""How often in the time of an idle client it is looked for."""


class Server(Protocol):
    """A started server, and where it is: `path` on a serial line, else `host` and `port`."""

    host: str
    port: int
    path: str

    async def wait(self) -> None:
        """Return when the server was stopped; SimulatorError if its line was lost."""

    async def stop(self) -> None:
        """Take no more requests and close everything."""


class _Accompanied:
    """A server, where it is, and tasks that last as long as it does."""

    def __init__(self, path: str = "") -> None:
        self.host, self.port, self.path = "", 0, path
        self._companions: list[asyncio.Task[None]] = []

    def accompany(self, work: Coroutine[Any, Any, None]) -> None:
        """Let `work` go on until the server is stopped."""
        self._companions.append(asyncio.get_running_loop().create_task(work))

    async def _part(self) -> None:
        for companion in self._companions:
            companion.cancel()
        await asyncio.gather(*self._companions, return_exceptions=True)


class TcpServer(_Accompanied):
    """Serves many clients; each is independent of what the others send or do not read.

    When `most` clients are there and another comes, the one that was silent longest is disconnected.
    """

    def __init__(self, station: ServerContext, framing: str, manners: ConnectionPolicy, *, most: int) -> None:
        super().__init__()
        self.manners = manners
        self.buffer = memoryview(bytearray(RTU_CHUNK if framing == RTU else CHUNK))
        self._station = station
        self._framing = framing
        self._most = most
        self._clients: set[TcpClient] = set()
        self._looking: asyncio.TimerHandle | None = None
        self._listener: asyncio.Server | None = None
        self._stopped = asyncio.Event()

    async def listen(self, host: str, port: int) -> None:
        """Bind and accept; `host` and `port` are then the bound ones. SimulatorError where that is not possible."""
        loop = asyncio.get_running_loop()
        try:
            self._listener = await loop.create_server(lambda: TcpClient(self), host, port)
        except (OSError, OverflowError, UnicodeError) as problem:
            message = f"cannot listen on {host} port {port}: {problem}. Choose another port, or 0 for any free one"
            raise SimulatorError(message) from problem
        self.host, self.port = self._listener.sockets[0].getsockname()[:2]
        self._look()

    async def wait(self) -> None:
        """Return when the server was stopped."""
        await self._stopped.wait()

    async def stop(self) -> None:
        """Stop accepting, then end the clients."""
        await self._part()
        if self._listener is not None:
            await _close(self._listener)
        if self._looking is not None:
            self._looking.cancel()
        leaving = [client.dismiss() for client in tuple(self._clients)]
        await asyncio.gather(*(gone.wait() for gone in leaving))
        self._stopped.set()

    def admit(self, client: "TcpClient", transport: asyncio.Transport) -> Connection:
        """Take a client in, at the cost of the most silent one if there are too many."""
        if len(self._clients) >= self._most:
            self.dismiss(min(self._clients, key=lambda each: each.heard))
        self._clients.add(client)
        return Connection(framer_for(self._framing), self._station, self.manners, transport)

    def dismiss(self, client: "TcpClient") -> None:
        """Disconnect a client."""
        self._clients.discard(client)
        client.dismiss()

    def left(self, client: "TcpClient") -> None:
        """A client is gone."""
        self._clients.discard(client)

    def _look(self) -> None:
        """Disconnect who was silent too long, now and then."""
        idle = self.manners.patience.idle
        if idle is None:
            return
        loop = asyncio.get_running_loop()
        for client in [each for each in self._clients if loop.time() - each.heard > idle]:
            self.dismiss(client)
        self._looking = loop.call_later(idle / LOOKS, self._look)


async def _close(listener: asyncio.Server) -> None:
    """Accept nobody any more, and let those in who were accepted a moment ago: a closed server would leak them."""
    loop = asyncio.get_running_loop()
    for listening in listener.sockets:
        loop.remove_reader(listening.fileno())
    for _ in range(ACCEPTING):
        await asyncio.sleep(0)
    listener.close()


class TcpClient(asyncio.BufferedProtocol):
    """One client of a TCP server, as asyncio sees it; all clients of a server share the buffer of one chunk."""

    def __init__(self, server: TcpServer) -> None:
        self._server = server
        self._gone = asyncio.Event()

    @property
    def heard(self) -> float:
        """When it sent something last, on the clock of the loop."""
        return self._connection.heard

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """The client is there."""
        self._transport = cast("asyncio.Transport", transport)
        self._connection = self._server.admit(self, self._transport)

    def get_buffer(self, sizehint: int) -> memoryview:  # noqa: ARG002 - asyncio's signature
        """Where its bytes go; they are out of it before the next client's come."""
        return self._server.buffer

    def buffer_updated(self, nbytes: int) -> None:
        """Its bytes are there."""
        self._connection.received(bytes(self._server.buffer[:nbytes]))

    def eof_received(self) -> bool:
        """It sends no more, but still gets its answers."""
        self._connection.finish()
        return True

    def pause_writing(self) -> None:
        """It does not read."""
        self._connection.paused()

    def resume_writing(self) -> None:
        """It reads."""
        self._connection.resumed()

    def connection_lost(self, exc: Exception | None) -> None:  # noqa: ARG002 - how a client ends is its own affair
        """It is gone."""
        self._connection.end()
        self._server.left(self)
        self._gone.set()

    def dismiss(self) -> asyncio.Event:
        """Let it take its last answers for a moment, and disconnect it; the event is set when it is gone."""
        self._transport.close()
        asyncio.get_running_loop().call_later(FAREWELL, self._transport.abort)
        return self._gone


Wiring = Callable[[int, Events], LineTransport]
"""Makes the transport of an open line: as it is, or at the pace of a speed."""


class LineServer(_Accompanied):
    """Serves the one line that it is given."""

    def __init__(
        self, line: OpenLine, station: ServerContext, manners: ConnectionPolicy, wiring: Wiring, framer: Framer
    ) -> None:
        super().__init__(line.path)
        self._line = line
        self._ended = asyncio.Event()
        self._loss = ""
        self._transport = wiring(line.fd, Events(self._received, self._lost, self._paused, self._resumed))
        self._connection = Connection(framer, station, manners, self._transport)

    async def wait(self) -> None:
        """Return when the server was stopped; SimulatorError if the line broke, as when an adapter is unplugged."""
        await self._ended.wait()
        if self._loss:
            raise SimulatorError(self._loss)

    async def stop(self) -> None:
        """Stop answering and close the line."""
        await self._part()
        self._connection.end()
        self._transport.abort()
        self._line.close()
        self._ended.set()

    def _received(self, data: bytes) -> None:
        self._line.heard()
        self._connection.received(data)

    def _lost(self, problem: OSError | None) -> None:
        self._loss = f"serial device {self.path} is gone: {problem or 'end of data'}"
        self._ended.set()

    def _paused(self) -> None:
        self._connection.paused()

    def _resumed(self) -> None:
        self._connection.resumed()
