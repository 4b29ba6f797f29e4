"""Servers on asyncio: a station of simulated devices on a TCP port, or on a serial line."""

import asyncio
import contextlib
import os
from typing import Protocol

from regscribe.simulate.connection import Connection, Manners
from regscribe.simulate.errors import SimulatorError
from regscribe.simulate.framing import Framing, framer_for
from regscribe.simulate.lines import OpenLine
from regscribe.simulate.station import Station


class Server(Protocol):
    """A started server, and where it is: `path` on a serial line, else `host` and `port`."""

    host: str
    port: int
    path: str

    async def wait(self) -> None:
        """Return when the server was stopped; SimulatorError if its line was lost."""

    async def stop(self) -> None:
        """Take no more requests and close everything."""


class TcpServer:
    """Serves many clients; each is independent of what the others send or do not read.

    When `most` clients are there and another comes, the one that was silent longest is disconnected.
    """

    def __init__(self, station: Station, framing: Framing, manners: Manners, *, most: int) -> None:
        self.host = ""
        self.port = 0
        self.path = ""
        self._station = station
        self._framing = framing
        self._manners = manners
        self._most = most
        self._clients: dict[Connection, asyncio.Task[None]] = {}
        self._leaving: set[asyncio.Task[None]] = set()
        self._listener: asyncio.Server | None = None
        self._stopped = asyncio.Event()

    async def listen(self, host: str, port: int) -> None:
        """Bind and accept; `host` and `port` are then the bound ones. SimulatorError where that is not possible."""
        try:
            self._listener = await asyncio.start_server(self._accept, host, port)
        except (OSError, OverflowError, UnicodeError) as problem:
            message = f"cannot listen on {host} port {port}: {problem}. Choose another port, or 0 for any free one"
            raise SimulatorError(message) from problem
        self.host, self.port = self._listener.sockets[0].getsockname()[:2]

    async def wait(self) -> None:
        """Return when the server was stopped."""
        await self._stopped.wait()

    async def stop(self) -> None:
        """Stop accepting, then end the clients."""
        if self._listener is not None:
            self._listener.close()
        for client in tuple(self._clients):
            self._dismiss(client)
        await asyncio.gather(*self._leaving, return_exceptions=True)
        self._stopped.set()

    def _accept(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        if len(self._clients) >= self._most:
            self._dismiss(min(self._clients, key=lambda client: client.heard))
        client = Connection(reader, writer, framer_for(self._framing), self._station, self._manners)
        self._clients[client] = asyncio.create_task(self._attend(client))

    def _dismiss(self, client: Connection) -> None:
        task = self._clients.pop(client)
        self._leaving.add(task)
        task.add_done_callback(self._leaving.discard)
        task.cancel()

    async def _attend(self, client: Connection) -> None:
        try:
            # A client that leaves, breaks or idles is its own affair.
            with contextlib.suppress(OSError, TimeoutError):
                await client.serve()
        finally:
            self._clients.pop(client, None)
            await client.close()


class LineServer:
    """Serves the one line that it is given."""

    def __init__(self, line: OpenLine, station: Station, manners: Manners) -> None:
        self.host = ""
        self.port = 0
        self.path = line.path
        self._line = line
        self._station = station
        self._manners = manners
        self._task: asyncio.Task[None] | None = None

    async def listen(self) -> None:
        """Begin to answer."""
        reader, writer = await _streams(self._line.fd)
        client = Connection(reader, writer, framer_for(Framing.RTU), self._station, self._manners)
        self._task = asyncio.create_task(_attend_line(client))

    async def wait(self) -> None:
        """Return when the server was stopped; SimulatorError if the line broke, as when an adapter is unplugged."""
        if self._task is None:
            return
        await asyncio.wait((self._task,))
        if not self._task.cancelled():
            message = f"serial device {self.path} is gone: {self._task.exception() or 'end of data'}"
            raise SimulatorError(message)

    async def stop(self) -> None:
        """Stop answering and close the line."""
        if self._task is not None:
            self._task.cancel()
            await asyncio.gather(self._task, return_exceptions=True)
        self._line.close()


async def _attend_line(client: Connection) -> None:
    try:
        await client.serve()
    finally:
        await client.close()


async def _streams(fd: int) -> tuple[asyncio.StreamReader, asyncio.StreamWriter]:
    loop = asyncio.get_running_loop()
    reader = asyncio.StreamReader()
    await loop.connect_read_pipe(lambda: asyncio.StreamReaderProtocol(reader), os.fdopen(os.dup(fd), "rb", buffering=0))
    transport, protocol = await loop.connect_write_pipe(
        # Only the protocol's flow control is used; its reader stays empty.
        lambda: asyncio.StreamReaderProtocol(asyncio.StreamReader()),
        os.fdopen(os.dup(fd), "wb", buffering=0),
    )
    return reader, asyncio.StreamWriter(transport, protocol, reader, loop)
