"""Streams of bytes: sockets and serial ports that never block, and waiting for bytes in a thread or in a task."""

import asyncio
import contextlib
import errno
import os
import select
import socket
import sys
import time
from collections.abc import Callable
from typing import Any, Protocol

import serial  # type: ignore[import-untyped]  # pyserial ships no types
from serial.tools import list_ports  # type: ignore[import-untyped]  # as above

from regscribe_runtime.errors import LinkLost
from regscribe_runtime.values.serial_line import SerialLine

CONNECT_SECONDS = 3.0
"""How long a host may take to accept a connection."""

CHUNK = 4096
POLL_SECONDS = 0.002
"""Between two looks at a port that the system cannot wait for (a serial port of Windows)."""
PORTS_NAMED = 5
MOST_SELECTED = 1024
"""Descriptors from here on are too high for select (FD_SETSIZE), but for that of Windows."""


class Stream(Protocol):
    """An open connection or port. `descriptor` is what the system can wait for, -1 if it cannot."""

    descriptor: int

    def read(self) -> bytes:
        """What has come, perhaps nothing; OSError (for a closed connection too) if it is broken."""
        raise NotImplementedError

    def write(self, data: bytes) -> None:
        """Send all of it; OSError if it is broken or takes no more."""

    def waiting(self) -> bool:
        """Whether bytes have come; asked only of ports that the system cannot wait for."""
        return False

    def close(self) -> None:
        """Close it; never fails."""


class _Socket(Stream):
    """A TCP connection."""

    def __init__(self, connection: socket.socket) -> None:
        connection.settimeout(0)
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._socket = connection
        self.descriptor = connection.fileno()

    def read(self) -> bytes:
        try:
            data = self._socket.recv(CHUNK)
        except (BlockingIOError, InterruptedError):
            return b""
        if not data:
            raise ConnectionResetError(errno.ECONNRESET, "the other end closed the connection")
        return data

    def write(self, data: bytes) -> None:
        if self._socket.send(data) < len(data):  # a frame always fits into the buffer of a connection that is alive
            raise BlockingIOError(errno.EAGAIN, "the other end takes no more bytes")

    def close(self) -> None:
        self._socket.close()


class _SerialPort(Stream):
    """A serial port of this machine, held by this process alone."""

    def __init__(self, port: serial.SerialBase) -> None:
        self._port: Any = port  # pyserial's base has less than each of its ports
        self.descriptor = port.fileno() if os.name == "posix" and hasattr(port, "fd") else -1

    def read(self) -> bytes:
        if self.descriptor >= 0:
            with contextlib.suppress(BlockingIOError, InterruptedError):
                return os.read(self.descriptor, CHUNK)
            return b""
        return bytes(self._port.read(self._port.in_waiting))

    def write(self, data: bytes) -> None:
        if (self._port.write(data) or 0) < len(data):
            raise BlockingIOError(errno.EAGAIN, "the port takes no more bytes")

    def waiting(self) -> bool:
        return bool(self._port.in_waiting)

    def close(self) -> None:
        with contextlib.suppress(OSError):  # an adapter that was pulled out
            self._port.close()


def open_serial(line: SerialLine) -> Stream:
    """Open a serial port for this process alone; LinkLost with advice."""
    try:
        port = serial.serial_for_url(line.port, timeout=0, write_timeout=0, exclusive=True, **line.settings())
    except (OSError, ValueError) as error:
        message = f"cannot open {line.port}: {_why_not(line, error)}"
        raise LinkLost(message) from error
    except Exception as error:  # pyserial lets the errors of termios through, which are not OSError
        message = f"cannot open {line.port} at {line.baud} baud {line.format}: {error}. Is it a serial port?"
        raise LinkLost(message) from error
    return _SerialPort(port)


def _why_not(line: SerialLine, error: OSError | ValueError) -> str:
    code = getattr(error, "errno", None)
    if code in {errno.ENOENT, errno.ENODEV, errno.ENXIO}:
        ports = sorted(one.device for one in list_ports.comports())[:PORTS_NAMED]
        return f"there is no such port. Plug the adapter in; ports here: {', '.join(ports) or 'none'}"
    if code == errno.EACCES:
        return "permission denied. Add your user to the group that owns the port (often dialout), then log in anew"
    if code in {errno.EBUSY, errno.EAGAIN}:
        return "another program has it open. Two masters on one line would garble each other: stop the other one"
    return f"{error}. Is it a serial port, and can it do {line.baud} baud {line.format}?"


def _unreachable(host: str, port: int, error: Exception) -> LinkLost:
    """The error for a host without address, or one that takes no connection."""
    if isinstance(error, socket.gaierror | UnicodeError):
        why = f"the host {host!r} is unknown ({error}). Check its name"
    elif isinstance(error, ConnectionRefusedError):
        why = "it refuses the connection, nobody answers there. Check the port, and that Modbus TCP is switched on"
    elif isinstance(error, TimeoutError):
        why = f"it did not answer within {CONNECT_SECONDS:g} s. Check power, cable, address and firewall"
    else:
        why = f"{error}. Check address, port and network"
    return LinkLost(f"cannot open tcp://{host}:{port}: {why}")


def open_tcp(host: str, port: int) -> Stream:
    """Connect; LinkLost with advice."""
    try:
        found = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)
    except (OSError, UnicodeError) as error:
        raise _unreachable(host, port, error) from error
    failure: Exception = OSError("it has no address")
    for family, kind, number, _, address in found:
        try:
            with contextlib.ExitStack() as unless_open:
                connection = unless_open.enter_context(socket.socket(family, kind, number))
                connection.settimeout(CONNECT_SECONDS)
                connection.connect(address)
                wire = _Socket(connection)
                unless_open.pop_all()
                return wire
        except OSError as error:  # TimeoutError is one
            failure = error
    raise _unreachable(host, port, failure) from failure


async def open_tcp_async(host: str, port: int) -> Stream:
    """As `open_tcp`, for asyncio."""
    loop = asyncio.get_running_loop()
    try:
        found = await loop.getaddrinfo(host, port, type=socket.SOCK_STREAM)
    except (OSError, UnicodeError) as error:
        raise _unreachable(host, port, error) from error
    failure: Exception = OSError("it has no address")
    for family, kind, number, _, address in found:
        try:
            with contextlib.ExitStack() as unless_open:
                connection = unless_open.enter_context(socket.socket(family, kind, number))
                connection.settimeout(0)
                async with asyncio.timeout(CONNECT_SECONDS):
                    await loop.sock_connect(connection, address)
                wire = _Socket(connection)
                unless_open.pop_all()
                return wire
        except OSError as error:  # as above
            failure = error
    raise _unreachable(host, port, failure) from failure


def wait(wire: Stream, seconds: float) -> bool:
    """Wait in this thread until bytes are there (True), for `seconds` at most."""
    if wire.descriptor < 0:
        deadline = time.monotonic() + seconds
        while not (there := wire.waiting()) and time.monotonic() < deadline:
            time.sleep(POLL_SECONDS)
        return there
    if sys.platform != "win32" and wire.descriptor >= MOST_SELECTED:  # select counts to the microsecond, poll to 1 ms
        poller = select.poll()
        poller.register(wire.descriptor, select.POLLIN)
        return bool(poller.poll(max(seconds, 0.0) * 1000))
    return bool(select.select([wire.descriptor], [], [], max(seconds, 0.0))[0])


async def _polled(waiting: Callable[[], bool], deadline: float) -> bool:
    """Ask again and again whether bytes are there, until a time of the loop."""
    while not (there := waiting()) and asyncio.get_running_loop().time() < deadline:  # noqa: ASYNC110 (nothing tells of bytes there)
        await asyncio.sleep(POLL_SECONDS)
    return there


async def wait_async(wire: Stream, seconds: float) -> bool:
    """Wait in this task until bytes are there (True), for `seconds` at most."""
    loop = asyncio.get_running_loop()
    if wire.descriptor < 0:
        return await _polled(wire.waiting, loop.time() + seconds)
    there_or_late: asyncio.Future[bool] = loop.create_future()
    try:
        loop.add_reader(wire.descriptor, _settle, there_or_late, True)  # noqa: FBT003 (the result)
    except NotImplementedError:  # the usual loop on Windows
        return await _polled(lambda: wait(wire, 0), loop.time() + seconds)
    timer = loop.call_later(max(seconds, 0), _settle, there_or_late, False)  # noqa: FBT003 (as above)
    try:
        return await there_or_late
    finally:
        timer.cancel()
        loop.remove_reader(wire.descriptor)


def _settle(future: asyncio.Future[bool], result: bool) -> None:  # noqa: FBT001 (as above)
    if not future.done():
        future.set_result(result)
