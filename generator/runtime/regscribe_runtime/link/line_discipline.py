"""How to behave where answers name no request (RTU, ASCII): silence, patience with late answers, echo of adapters."""

import time
from collections.abc import Callable

from regscribe_runtime.errors import WrongAnswer
from regscribe_runtime.link.pending import PendingRequest, Steps
from regscribe_runtime.link.stale_replies import StaleReplies
from regscribe_runtime.link.streams import Stream
from regscribe_runtime.values.serial_line import SerialLine
from regscribe_runtime.wire.client_framing import Framing

NOISE_SECONDS = 2.0
"""A line that is not silent for so long has another master on it, or no termination."""
ECHO_SECONDS = 0.1
"""How long an adapter may take to give back the byte that it is asked for its echo with."""
ECHO_BYTE = b"\xff"
"""Sent to learn whether the line echoes: alone between silences it is no frame, so every device drops it."""


class LineDiscipline:
    """What is known of a serial line between requests. `echo`: whether it gives back what is sent, None: not known yet.

    Behind a gateway that passes bytes on, `line` is None: it sees to the silence, but late answers come through it.
    `told` is called with the unit that is asked and with bytes that came unasked.
    """

    def __init__(
        self,
        line: SerialLine | None,
        gap: float,
        *,
        echo: bool | None,
        framing: Framing,
        told: Callable[[int, bytes], None],
    ) -> None:
        self.line, self.gap, self.echo = line, gap, echo
        self.late = StaleReplies()
        self._framing, self._told = framing, told
        self._silent_from = 0.0

    def tune(self, line: SerialLine, *, echo: bool | None) -> None:
        """The port was opened, perhaps with another speed or format."""
        self.line, self.echo = line, echo
        self.heard()

    def sent(self, count: int) -> None:
        """`count` characters go out from now on."""
        self._silent_from = time.monotonic() + (count * self.line.character if self.line else 0.0)

    def heard(self) -> None:
        """Characters came in."""
        self._silent_from = time.monotonic()

    def owe(self, asked: PendingRequest, deadline: float) -> None:
        """The answer is missing, and may still come."""
        self.late.owe(asked.unit, asked.wire, deadline=deadline, seconds=asked.seconds)

    def before(self, wire: Stream, asked: PendingRequest) -> Steps[None]:
        """Wait until the line is free for this request."""
        yield from self._silence(wire, asked.unit)
        yield from self._late_answer(wire, asked)
        if self.echo is None and asked.resembles_its_answer:
            yield from self._ask_echo(wire, asked.unit)

    def _silence(self, wire: Stream, unit: int) -> Steps[None]:
        gap = self.line.silence(self.gap) if self.line else 0.0
        until = max(self._silent_from + gap, self.late.busy)
        patience = max(until, time.monotonic()) + NOISE_SECONDS
        stray = wire.read()
        while stray or until > time.monotonic():
            if stray:
                self._told(unit, stray)
                self.heard()
                self.late.busy, until = 0.0, self._silent_from + gap
            if time.monotonic() > patience:
                message = "the line is never silent: another master talks on it, or it is not terminated"
                raise WrongAnswer(message)
            stray = taken(wire) if (yield max(until - time.monotonic(), 0.0)) else b""

    def _late_answer(self, wire: Stream, asked: PendingRequest) -> Steps[None]:
        until = self.late.until(asked.unit, asked.wire, time.monotonic())
        if not until:
            return
        received = bytearray()
        while (left := until - time.monotonic()) > 0:
            if (yield left):
                data = taken(wire)
                self._told(asked.unit, data)
                self.heard()
                received += data
                if self._framing.find(received, asked.unit, asked.wire.function):
                    break
        self.late.came(asked.unit, asked.wire)
        yield from self._silence(wire, asked.unit)

    def _ask_echo(self, wire: Stream, unit: int) -> Steps[None]:
        wire.write(ECHO_BYTE)
        self.sent(len(ECHO_BYTE))
        back = taken(wire) if (yield ECHO_SECONDS) else b""
        self._told(unit, back)
        self.echo = back == ECHO_BYTE
        yield from self._silence(wire, unit)

    def echoed(self, wire: Stream, asked: PendingRequest, deadline: float) -> Steps[bytearray]:
        """Take the echo of a request and return what came behind it; WrongAnswer if it is another one (a collision)."""
        received, frame = bytearray(), asked.frame
        while len(received) < len(frame) and frame.startswith(received):
            left = deadline - time.monotonic()
            if left <= 0 or not (yield left):
                break
            received += taken(wire)
            self.heard()
        echo = bytes(received[: len(frame)])
        self._told(asked.unit, echo)
        if echo == frame:
            return received[len(frame) :]
        if frame.startswith(echo):
            message = f"{asked}: {len(echo)} of {len(frame)} bytes were echoed. Without echo, open it with echo=False"
            raise WrongAnswer(message)
        message = f"{asked}: collision on the line, {frame.hex(' ')} was sent and {echo.hex(' ')} heard"
        raise WrongAnswer(message)

    def notice(self, received: bytearray, asked: PendingRequest) -> None:
        """Learn from the first bytes behind a request whether the line echoes, and drop the echo."""
        if self.echo is None and received.startswith(asked.frame) and not asked.resembles_its_answer:
            self.echo = True
            self._told(asked.unit, asked.frame)
            del received[: len(asked.frame)]

    def answered(self, asked: PendingRequest) -> None:
        """A good answer came."""
        self.late.answered(asked.unit, asked.wire, now=time.monotonic(), seconds=asked.seconds)
        if self.echo is None:
            self.echo = False


def taken(wire: Stream) -> bytes:
    """Read where bytes are said to be; OSError if there are none, which is how a port ends that was pulled out."""
    data = wire.read()
    if not data:
        message = "the port is gone"
        raise OSError(message)
    return data
