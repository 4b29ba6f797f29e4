"""One request and its answer over an open wire, step by step: the waits are yielded, for threads and tasks alike."""

import time

from regscribe_runtime.errors import NoAnswer, WrongAnswer
from regscribe_runtime.link.line_discipline import LineDiscipline, read_waiting
from regscribe_runtime.link.links import RECEIVED, SENT, Trace, Tracer
from regscribe_runtime.link.pending import BROADCAST, PendingRequest, Steps
from regscribe_runtime.link.streams import Stream
from regscribe_runtime.values.serial_line import SerialLine, first_address
from regscribe_runtime.wire import pdu
from regscribe_runtime.wire.client_framing import framing_for
from regscribe_runtime.wire.framing import Frame
from regscribe_runtime.wire.requests import Reply, Request, fits

USUAL_SECONDS = 1.0
"""The response timeout of a request that brings none."""
SHOWN_BYTES = 24
CHECK = "Check speed, parity, wiring and termination, and that no two units have one id and no second master talks"


class Conversation:
    """Sends one request at a time and finds its answer, over a serial line or over a TCP connection (`line` None).

    The record of late answers outlives port and connection: a gateway may pass them on to the next connection.
    `tainted`: bytes came that nobody asked for, so a connection is better opened anew.
    """

    def __init__(
        self, framing: str, *, addressing: str, line: SerialLine | None, gap: float, echo: bool | None
    ) -> None:
        self.framing = framing_for(framing)
        self.set_addressing(addressing)
        self.trace: Tracer | None = None
        self.tainted = False
        self.discipline: LineDiscipline | None = None
        if not self.framing.decisive:
            known = bool(echo) if line is None else echo
            self.discipline = LineDiscipline(line, gap, echo=known, framing=self.framing, trace=self._trace_received)

    def set_addressing(self, addressing: str) -> None:
        """Count addresses as the units do: modbus from 0, jbus from 1; ValueError for another name."""
        self.first = first_address(addressing)

    def exchange(self, wire: Stream, unit: int, request: Request) -> Steps[Reply]:
        """Send `request` once and return its answer; NoAnswer, WrongAnswer, or OSError for a broken wire."""
        sent = request.shifted(self.first)
        frame = self.framing.build(unit, pdu.encode_request(sent))
        pending = PendingRequest(unit, request, sent, frame, request.seconds or USUAL_SECONDS)
        discipline = self.discipline
        if discipline is not None:
            yield from discipline.before(wire, pending)
        deadline = time.monotonic() + pending.seconds
        try:
            self._send(wire, pending)
            if pending.is_broadcast:
                yield from self._wait_out(wire, deadline)
                return Reply(request.function, request.words, request.address, len(request.words))
            received = bytearray()
            if discipline is not None and discipline.echo:
                received = yield from discipline.echoed(wire, pending, deadline)
            reply = yield from self._answer(wire, pending, deadline, received)
        except BaseException:  # a timeout, a cancelled task, Ctrl-C: the answer may still come
            if discipline is not None:
                discipline.late.owe(pending, deadline)
            raise
        steps = request.address - sent.address
        return reply._replace(address=reply.address + steps) if steps and reply.exception is None else reply

    def _send(self, wire: Stream, pending: PendingRequest) -> None:
        wire.write(pending.frame)
        if self.discipline is not None:
            self.discipline.sent(len(pending.frame))
        if self.trace is not None:
            self.trace(Trace(time.time(), SENT, pending.unit, pending.frame))

    def _trace_received(self, unit: int, frame: bytes) -> None:
        if self.trace is not None and frame:
            self.trace(Trace(time.time(), RECEIVED, unit, frame))

    def _read(self, wire: Stream) -> bytes:
        if self.discipline is None:
            return wire.read()
        self.discipline.heard()
        return read_waiting(wire)

    def _wait_out(self, wire: Stream, deadline: float) -> Steps[None]:
        while (left := deadline - time.monotonic()) > 0:
            if (yield left):
                self._trace_received(BROADCAST, self._read(wire))  # an echo, or a gateway that cannot broadcast

    def _answer(self, wire: Stream, pending: PendingRequest, deadline: float, received: bytearray) -> Steps[Reply]:
        wrong = None
        while True:
            while found := self._next_frame(received, pending):
                reply = self._decode(found, pending)
                if reply is not None and (self.framing.decisive or fits(pending.wire, reply)):
                    self._finish(received, pending)
                    return reply
                wrong = reply or wrong
            left = deadline - time.monotonic()
            if left <= 0 or not (yield left):
                return self._without_answer(bytes(received), wrong, pending, deadline)
            received += self._read(wire)
            if self.discipline is not None:
                self.discipline.notice(received, pending)

    def _next_frame(self, received: bytearray, pending: PendingRequest) -> Frame | None:
        try:
            found = self.framing.find(received, pending.unit, pending.wire.function)
        except ValueError as error:
            self._trace_received(pending.unit, bytes(received))
            message = f"{pending}: {error}. Check the port and the framing (tcp, rtu, ascii)"
            raise WrongAnswer(message) from None
        if found is not None and self.trace is not None:
            self._trace_received(found.unit, found.raw)
        return found

    def _decode(self, found: Frame, pending: PendingRequest) -> Reply | None:
        """The reply in a frame; None for that of another transaction."""
        if found.transaction != self.framing.transaction:
            return None
        if found.unit != pending.unit:
            raise _foreign(pending, found.unit)
        reply = pdu.decode_reply(pending.wire, found.pdu)
        if reply.exception is not None and not reply.function:
            # a server that cannot name the function of a bad request answers 80h
            return reply._replace(function=pending.wire.function)
        return reply

    def _finish(self, received: bytearray, pending: PendingRequest) -> None:
        if self.discipline is not None:
            self.discipline.answered(pending)
        if received:
            self.tainted = True
            self._trace_received(pending.unit, bytes(received))

    def _without_answer(self, received: bytes, wrong: Reply | None, pending: PendingRequest, deadline: float) -> Reply:
        """The reply that did not fit, if there was one (the caller verifies it); raises NoAnswer or WrongAnswer."""
        self._trace_received(pending.unit, received)
        if wrong is not None:
            if self.discipline is not None:
                self.discipline.late.owe(pending, deadline)
            return wrong
        stranger = self.framing.stranger(received)
        if stranger is not None and stranger != pending.unit:
            raise _foreign(pending, stranger)
        if received:
            came = received[:SHOWN_BYTES].hex(" ") + (" ..." if len(received) > SHOWN_BYTES else "")
            message = f"{pending}: {len(received)} bytes came that are no answer ({came}). {CHECK}"
            raise WrongAnswer(message)
        shown = pending.shown
        raise NoAnswer(unit=pending.unit, function=shown.function, address=shown.address, seconds=pending.seconds)


def _foreign(pending: PendingRequest, unit: int) -> WrongAnswer:
    advice = "Check the unit id, and that no two units share one"
    return WrongAnswer(f"{pending}: unit {unit} answered in its place. {advice}")
