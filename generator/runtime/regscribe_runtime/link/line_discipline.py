"""Line discipline of RTU and ASCII, whose answers name no request: silence, late answers, echo of adapters."""

import time
from collections.abc import Callable

from regscribe_runtime.errors import WrongAnswer
from regscribe_runtime.link.pending import PendingRequest, StaleReplies, Steps
from regscribe_runtime.link.streams import Stream
from regscribe_runtime.values.serial_line import SerialLine
from regscribe_runtime.wire.client_framing import Framing

NOISE_SECONDS = 2.0
"""A line that is not silent for so long has another master on it, or no termination."""
ECHO_SECONDS = 0.1
"""How long an adapter may take to give back the byte that probes its echo."""
ECHO_BYTE = b"\xff"
"""Sent to learn whether the line echoes: alone between silences it is no frame, so every device drops it."""

ReceivedTracer = Callable[[int, bytes], None]
"""Called with the unit of a request and bytes that are no answer to it."""


class LineDiscipline:
    """The state of a serial line between requests; `echo` is whether it gives back what is sent (None: not known yet).

    `line` is None behind a gateway that passes bytes on: it sees to the silence, but late answers come through it.
    """

    def __init__(
        self, line: SerialLine | None, gap: float, *, echo: bool | None, framing: Framing, trace: ReceivedTracer
    ) -> None:
        self.line, self.gap, self.echo = line, gap, echo
        self.late = StaleReplies()
        self._framing, self._trace = framing, trace
        self._silent_from = 0.0

    def tune(self, line: SerialLine, *, echo: bool | None) -> None:
        """Start anew on a port that was opened, perhaps with another speed or format."""
        self.line, self.echo = line, echo
        self.heard()

    def sent(self, count: int) -> None:
        """Note that `count` characters go out from now on."""
        self._silent_from = time.monotonic() + (count * self.line.character if self.line else 0.0)

    def heard(self) -> None:
        """Note that characters came in."""
        self._silent_from = time.monotonic()

    def before(self, wire: Stream, pending: PendingRequest) -> Steps[None]:
        """Wait until the line is free for this request, and probe its echo if an echo could pass for the answer."""
        yield from self._silence(wire, pending.unit)
        yield from self._await_late_answer(wire, pending)
        if self.echo is None and pending.resembles_its_answer:
            wire.write(ECHO_BYTE)
            self.sent(len(ECHO_BYTE))
            back = read_waiting(wire) if (yield ECHO_SECONDS) else b""
            self._trace(pending.unit, back)
            self.echo = back == ECHO_BYTE
            yield from self._silence(wire, pending.unit)

    def _silence(self, wire: Stream, unit: int) -> Steps[None]:
        gap = self.line.silence(self.gap) if self.line else 0.0
        until = max(self._silent_from + gap, self.late.busy)
        patience = max(until, time.monotonic()) + NOISE_SECONDS
        stray = wire.read()
        while stray or until > time.monotonic():
            if stray:
                self._trace(unit, stray)
                self.heard()
                self.late.busy, until = 0.0, self._silent_from + gap
            if time.monotonic() > patience:
                message = "the line is never silent: another master talks on it, or it is not terminated"
                raise WrongAnswer(message)
            stray = read_waiting(wire) if (yield max(until - time.monotonic(), 0.0)) else b""

    def _await_late_answer(self, wire: Stream, pending: PendingRequest) -> Steps[None]:
        until = self.late.until(pending, time.monotonic())
        if not until:
            return
        received = bytearray()
        while (left := until - time.monotonic()) > 0:
            if (yield left):
                data = read_waiting(wire)
                self._trace(pending.unit, data)
                self.heard()
                received += data
                if self._framing.find(received, pending.unit, pending.wire.function):
                    break
        self.late.came(pending)
        yield from self._silence(wire, pending.unit)

    def echoed(self, wire: Stream, pending: PendingRequest, deadline: float) -> Steps[bytearray]:
        """Read the echo of a request and return the bytes behind it; WrongAnswer if it differs (a collision)."""
        received, frame = bytearray(), pending.frame
        while len(received) < len(frame) and frame.startswith(received):
            left = deadline - time.monotonic()
            if left <= 0 or not (yield left):
                break
            received += read_waiting(wire)
            self.heard()
        echo = bytes(received[: len(frame)])
        self._trace(pending.unit, echo)
        if echo == frame:
            return received[len(frame) :]
        if frame.startswith(echo):
            message = f"{pending}: {len(echo)} of {len(frame)} bytes were echoed. Without echo, open it with echo=False"
            raise WrongAnswer(message)
        message = f"{pending}: collision on the line, {frame.hex(' ')} was sent and {echo.hex(' ')} heard"
        raise WrongAnswer(message)

    def notice(self, received: bytearray, pending: PendingRequest) -> None:
        """Learn from the first bytes behind a request whether the line echoes, and drop the echo."""
        if self.echo is None and received.startswith(pending.frame) and not pending.resembles_its_answer:
            self.echo = True
            self._trace(pending.unit, pending.frame)
            del received[: len(pending.frame)]

    def answered(self, pending: PendingRequest) -> None:
        """Note a good answer."""
        self.late.answered(pending, time.monotonic())
        if self.echo is None:
            self.echo = False


def read_waiting(wire: Stream) -> bytes:
    """Read bytes that are reported to wait; OSError if there are none, as on a port that was pulled out."""
    data = wire.read()
    if not data:
        message = "the port is gone"
        raise OSError(message)
    return data
