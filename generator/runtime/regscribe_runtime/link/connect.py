"""Links as they are made: TCP, serial lines, and pymodbus clients of the user's own. pymodbus loads with the first."""

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


def _tcp_settings(settings: LinkSettings) -> LinkSettings:
    return {"framing": "tcp", **settings}


def _serial_settings(settings: LineSettings) -> LinkSettings:
    framing = settings.get("framing", "rtu")
    if framing == "tcp":
        message = "framing 'tcp' is not for a serial line: rtu or ascii"
        raise ValueError(message)
    kept = {key: value for key, value in settings.items() if key in LinkSettings.__annotations__}
    return {**kept, "framing": framing}  # type: ignore[typeddict-item] # the keys are those of LinkSettings


def _line(port: str, baud: int, settings: LineSettings) -> SerialLine:
    data_bits, stop_bits = settings.get("data_bits", 8), settings.get("stop_bits", 1)
    return SerialLine(port, baud, data_bits, settings.get("parity", PARITY_NONE), stop_bits)


def tcp(host: str, *, port: int = MODBUS_TCP_PORT, **settings: Unpack[LinkSettings]) -> Link:
    """A TCP link; see `LinkSettings`."""
    from regscribe_runtime.link import transports  # noqa: PLC0415 (pymodbus loads slowly; a driver's import must not wait)

    return transports.SyncTransport((host, port), **_tcp_settings(settings))


def serial(port: str, *, baud: int, **settings: Unpack[LineSettings]) -> Link:
    """A serial link, 8N1 unless said otherwise; see `LineSettings`."""
    from regscribe_runtime.link import transports  # noqa: PLC0415 (as above)

    return transports.SyncTransport(_line(port, baud, settings), **_serial_settings(settings))


def async_tcp(host: str, *, port: int = MODBUS_TCP_PORT, **settings: Unpack[LinkSettings]) -> AsyncLink:
    """As `tcp`, for asyncio."""
    from regscribe_runtime.link import transports  # noqa: PLC0415 (as above)

    return transports.AsyncTransport((host, port), **_tcp_settings(settings))


def async_serial(port: str, *, baud: int, **settings: Unpack[LineSettings]) -> AsyncLink:
    """As `serial`, for asyncio."""
    from regscribe_runtime.link import transports  # noqa: PLC0415 (as above)

    return transports.AsyncTransport(_line(port, baud, settings), **_serial_settings(settings))


def over(client: SyncClient, **settings: Unpack[ClientSettings]) -> Link:
    """A link over a client of one's own; see `ClientSettings`. TypeError for another kind of client."""
    from regscribe_runtime.link import clients  # noqa: PLC0415 (as above)

    return clients.ClientLink(client, **settings)


def async_over(client: AsyncClient, **settings: Unpack[ClientSettings]) -> AsyncLink:
    """As `over`, for asyncio."""
    from regscribe_runtime.link import clients  # noqa: PLC0415 (as above)

    return clients.AsyncClientLink(client, **settings)
