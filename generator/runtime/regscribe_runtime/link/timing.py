"""Response timeouts from the manual's latencies and the line: pure figures, no clock.

On a serial line an answer is complete after the request's characters, the silence that ends it, the device's latency
and the answer's characters. Over TCP the line behind a gateway is unknown: the slowest of the manual is assumed.
"""

from regscribe_runtime.values.protocol import Protocol
from regscribe_runtime.values.serial_line import SerialLine
from regscribe_runtime.wire.requests import Request, sizes

MARGIN_SECONDS = 0.3
"""For the operating system and the buffers of a USB adapter (16 ms each way), on a busy machine."""

GATEWAY_SECONDS = 0.5
"""For a gateway and the network before it."""

ASCII_MARKS = 2
"""An ASCII frame has twice the characters of RTU and one more (colon and line end, a check of one byte): two frames."""

RTU_FRAME = 3
"""Unit and CRC."""


def characters(request: Request) -> tuple[int, int]:
    """Characters of an RTU request and of its longest good answer."""
    asked, answered = sizes(request)
    return asked + RTU_FRAME, answered + RTU_FRAME


def on_line(protocol: Protocol, request: Request, line: SerialLine) -> float:
    """Seconds from the first character of a request to the last of its answer, at most; without a margin.

    For a function whose latency the manual does not give, the protocol's `timeout` stands in.
    """
    latency = protocol.latency(request.function)
    if latency is None:
        device = protocol.timeout
    else:
        device = float(latency.longest(request.quantity)) / 1000 + float(latency.characters) * line.character
    return sum(characters(request)) * line.character + line.silence(float(protocol.serial.gap)) + device


def slowest(protocol: Protocol) -> SerialLine:
    """The slowest line that the manual allows."""
    return protocol.serial.line._replace(baud=min((*protocol.serial.bauds, protocol.serial.baud)))


def response_seconds(
    protocol: Protocol, request: Request, line: SerialLine | None, *, behind: SerialLine | None = None
) -> float:
    """The response timeout of a request: in RTU frames on `line`, or over TCP without one.

    `behind` is the line that a gateway is assumed to have, the slowest that the manual allows.
    """
    if line is None:
        return on_line(protocol, request, behind or slowest(protocol)) + MARGIN_SECONDS + GATEWAY_SECONDS
    return on_line(protocol, request, line) + MARGIN_SECONDS


def more_in_ascii(request: Request, line: SerialLine) -> float:
    """Seconds that ASCII frames take longer than RTU ones: two characters for each, colon and line end."""
    return (sum(characters(request)) + ASCII_MARKS) * line.character


def broadcast_seconds(protocol: Protocol, request: Request, line: SerialLine | None) -> float:
    """Seconds that all units need for a broadcast from its first character: as for an answer, at most."""
    return on_line(protocol, request, line or slowest(protocol))
