"""Links: what carries requests to a unit and answers back. The drivers know these protocols, not pymodbus."""

import asyncio
import threading
from typing import Protocol

from regscribe.runtime.request import Reply, Request

MODBUS_TCP_PORT = 502


class Link(Protocol):
    """A synchronous link. `epoch` counts how often it was opened; `lock` is held for a whole operation."""

    epoch: int
    lock: threading.RLock

    def open(self) -> None:
        """Open it; LinkLost if that fails."""

    def close(self) -> None:
        """Close it; harmless if it is closed."""

    def call(self, unit: int, request: Request) -> Reply:
        """Send one request once and wait for its answer; NoAnswer or LinkLost."""
        raise NotImplementedError


class AsyncLink(Protocol):
    """An asyncio link; otherwise as `Link`."""

    epoch: int
    lock: asyncio.Lock

    async def open(self) -> None:
        """Open it; LinkLost if that fails."""

    async def close(self) -> None:
        """Close it; harmless if it is closed."""

    async def call(self, unit: int, request: Request) -> Reply:
        """Send one request once and wait for its answer; NoAnswer or LinkLost."""
        raise NotImplementedError


def tcp(
    host: str, *, port: int = MODBUS_TCP_PORT, framing: str = "tcp", timeout: float = 1.0, addressing: str = "modbus"
) -> Link:
    """A TCP link; `framing`: tcp (MBAP), rtu, ascii; `timeout` in seconds; `addressing`: modbus, jbus (one higher)."""
    from regscribe.runtime import transport  # noqa: PLC0415 (pymodbus loads slowly; a driver's import must not wait)

    return transport.SyncTransport.tcp(host, port=port, framing=framing, timeout=timeout, addressing=addressing)


def serial(
    port: str,
    *,
    baud: int,
    data_bits: int = 8,
    parity: str = "N",
    stop_bits: int = 1,
    framing: str = "rtu",
    timeout: float,
    addressing: str = "modbus",
) -> Link:
    """A serial link; `parity` is N, E or O; `framing` rtu or ascii; `timeout` in seconds."""
    from regscribe.runtime import transport  # noqa: PLC0415 (as above)

    line = transport.Line(port, baud, data_bits, parity, stop_bits)
    return transport.SyncTransport.serial(line, framing=framing, timeout=timeout, addressing=addressing)


def async_tcp(
    host: str, *, port: int = MODBUS_TCP_PORT, framing: str = "tcp", timeout: float = 1.0, addressing: str = "modbus"
) -> AsyncLink:
    """As `tcp`, for asyncio."""
    from regscribe.runtime import transport  # noqa: PLC0415 (as above)

    return transport.AsyncTransport.tcp(host, port=port, framing=framing, timeout=timeout, addressing=addressing)


def async_serial(
    port: str,
    *,
    baud: int,
    data_bits: int = 8,
    parity: str = "N",
    stop_bits: int = 1,
    framing: str = "rtu",
    timeout: float,
    addressing: str = "modbus",
) -> AsyncLink:
    """As `serial`, for asyncio."""
    from regscribe.runtime import transport  # noqa: PLC0415 (as above)

    line = transport.Line(port, baud, data_bits, parity, stop_bits)
    return transport.AsyncTransport.serial(line, framing=framing, timeout=timeout, addressing=addressing)
