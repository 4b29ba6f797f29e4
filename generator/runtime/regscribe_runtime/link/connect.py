"""Factories of links: over TCP, serial lines, and pymodbus clients of the user's own; the first one loads pymodbus."""

import re
from typing import Unpack

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
from regscribe_runtime.values.serial_line import PARITY_NONE, SerialLine


def _serial(port: str, baud: int, settings: LineSettings) -> tuple[SerialLine, LinkSettings]:
    """The serial line of these settings, and the settings of its link; ValueError for framing tcp."""
    framing = settings.get("framing", "rtu")
    if framing == "tcp":
        message = "framing 'tcp' is not for a serial line: rtu or ascii"
        raise ValueError(message)
    data_bits, stop_bits = settings.get("data_bits", 8), settings.get("stop_bits", 1)
    line = SerialLine(port, baud, data_bits, settings.get("parity", PARITY_NONE), stop_bits)
    kept = {key: value for key, value in settings.items() if key in LinkSettings.__annotations__}
    return line, {**kept, "framing": framing}  # type: ignore[typeddict-item] # the keys are those of LinkSettings


def _host(text: str) -> str:
    """A host without the brackets of an IPv6 address; ValueError for one with a port or the word of a link."""
    host = text[1:-1] if text.startswith("[") and text.endswith("]") else text
    if ":" not in host or re.fullmatch(r"[0-9A-Fa-f.]*:[0-9A-Fa-f:.]*:[0-9A-Fa-f.]*(%.+)?", host):
        return host
    message = f"{text!r} is no host: give the port apart, as in tcp('10.0.0.7', port=502)"
    raise ValueError(message)


def tcp(host: str, *, port: int = MODBUS_TCP_PORT, **settings: Unpack[LinkSettings]) -> Link:
    """A TCP link; see `LinkSettings`."""
    from regscribe_runtime.link import transports  # noqa: PLC0415 (pymodbus loads slowly; a driver's import must not wait)

    return transports.SyncTransport((_host(host), port), settings)


def serial(port: str, *, baud: int, **settings: Unpack[LineSettings]) -> Link:
    """A serial link, 8N1 unless said otherwise; see `LineSettings`."""
    from regscribe_runtime.link import transports  # noqa: PLC0415 (as above)

    return transports.SyncTransport(*_serial(port, baud, settings))


def async_tcp(host: str, *, port: int = MODBUS_TCP_PORT, **settings: Unpack[LinkSettings]) -> AsyncLink:
    """As `tcp`, for asyncio."""
    from regscribe_runtime.link import transports  # noqa: PLC0415 (as above)

    return transports.AsyncTransport((_host(host), port), settings)


def async_serial(port: str, *, baud: int, **settings: Unpack[LineSettings]) -> AsyncLink:
    """As `serial`, for asyncio."""
    from regscribe_runtime.link import transports  # noqa: PLC0415 (as above)

    return transports.AsyncTransport(*_serial(port, baud, settings))


def over(client: SyncClient, **settings: Unpack[ClientSettings]) -> Link:
    """A link over a client of one's own; see `ClientSettings`. TypeError for another kind of client."""
    from regscribe_runtime.link import clients  # noqa: PLC0415 (as above)

    return clients.ClientLink(client, settings)


def async_over(client: AsyncClient, **settings: Unpack[ClientSettings]) -> AsyncLink:
    """As `over`, for asyncio."""
    from regscribe_runtime.link import clients  # noqa: PLC0415 (as above)

    return clients.AsyncClientLink(client, settings)
