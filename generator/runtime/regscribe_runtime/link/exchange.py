"""One request and its answer over an open wire, step by step: the waits are yielded, for threads and tasks alike."""

import time

from regscribe_runtime.errors import NoAnswer, WrongAnswer
from regscribe_runtime.link.line_discipline import LineDiscipline, taken
from regscribe_runtime.link.pending import CHECK, PendingRequest, Steps
from regscribe_runtime.link.streams import Stream
from regscribe_runtime.link.trace import RECEIVED, SENT, Trace, Tracer
from regscribe_runtime.values.serial_line import SerialLine, first_address
from regscribe_runtime.wire import pdu
from regscribe_runtime.wire.client_framing import framing_for
from regscribe_runtime.wire.framing import Frame
from regscribe_runtime.wire.requests import Reply, Request, fits

BROADCAST = 0
"""A write to this unit is for all, and nobody answers."""
USUAL_SECONDS = 1.0
"""The response timeout of a request that brings none."""
SHOWN_BYTES = 24


class Conversation:
    """Sends one request at a time and finds its answer, over a serial line or over a TCP connection (`line` None).

    What concerns late answers outlives port and connection: a gateway may pass them on to the next connection.

    `tainted` tells that more came than was asked for: a connection is better opened anew then.
    """

    def __init__(
        self, framing: str, *, addressing: str, line: SerialLine | None, gap: float, echo: bool | None
    ) -> None:
        self.framing = framing_for(framing)
        self.number_from(addressing)
        self.trace: Tracer | None = None
        self.tainted = False
        self.manners: LineDiscipline | None = None
        if not self.framing.decisive:
            known = bool(echo) if line is None else echo
            self.manners = LineDiscipline(line, gap, echo=known, framing=self.framing, told=self._heard)

    def number_from(self, addressing: str) -> None:
        """Count addresses as the units do: modbus from 0, jbus from 1; ValueError for another name."""
        self.first = first_address(addressing)

    def exchange(self, wire: Stream, unit: int, request: Request) -> Steps[Reply]:
        """Send `request` once and return its answer; NoAnswer, WrongAnswer, or OSError for a broken wire."""
        sent = request.shifted(self.first)
        frame = self.framing.build(unit, pdu.encode_request(sent))
        asked = PendingRequest(unit, request, sent, frame, request.seconds or USUAL_SECONDS)
        manners = self.manners
        if manners is not None:
            yield from manners.before(wire, asked)
        deadline = time.monotonic() + asked.seconds
        try:
            self._send(wire, asked)
            if unit == BROADCAST and not request.reads:
                yield from self._all_done(wire, deadline)
                return Reply(request.function, request.words, request.address, len(request.words))
            received = bytearray()
            if manners is not None and manners.echo:
                received = yield from manners.echoed(wire, asked, deadline)
            reply = yield from self._answer(wire, asked, deadline, received)
        except BaseException:  # a timeout, a cancelled task, Ctrl-C: the answer may still come
            if manners is not None:
                manners.owe(asked, deadline)
            raise
        return _moved(reply, request.address - sent.address)

    def _send(self, wire: Stream, asked: PendingRequest) -> None:
        wire.write(asked.frame)
        if self.manners is not None:
            self.manners.sent(len(asked.frame))
        if self.trace is not None:
            self.trace(Trace(time.time(), SENT, asked.unit, asked.frame))

    def _heard(self, unit: int, frame: bytes) -> None:
        if self.trace is not None and frame:
            self.trace(Trace(time.time(), RECEIVED, unit, frame))

    def _take(self, wire: Stream) -> bytes:
        if self.manners is None:
            return wire.read()
        self.manners.heard()
        return taken(wire)

    def _all_done(self, wire: Stream, deadline: float) -> Steps[None]:
        while (left := deadline - time.monotonic()) > 0:
            if (yield left):
                self._heard(BROADCAST, self._take(wire))  # an echo, or a gateway that cannot broadcast

    def _answer(self, wire: Stream, asked: PendingRequest, deadline: float, received: bytearray) -> Steps[Reply]:
        wrong = None
        while True:
            while received and (found := self._found(received, asked)):
                reply = self._reply(found, asked)
                if reply is not None and self._fits(asked, reply):
                    self._finished(received, asked)
                    return reply
                wrong = reply or wrong
            left = deadline - time.monotonic()
            if left <= 0 or not (yield left):
                return self._unanswered(bytes(received), wrong, asked, deadline)
            received += self._take(wire)
            if self.manners is not None:
                self.manners.notice(received, asked)

    def _fits(self, asked: PendingRequest, reply: Reply) -> bool:
        return self.framing.decisive or fits(asked.wire, reply)

    def _unanswered(self, received: bytes, wrong: Reply | None, asked: PendingRequest, deadline: float) -> Reply:
        """The reply that did not fit, if there was one: what it lacks is told later."""
        self._heard(asked.unit, received)
        if wrong is None:
            raise self._missing(received, asked)
        if self.manners is not None:
            self.manners.owe(asked, deadline)
        return wrong

    def _found(self, received: bytearray, asked: PendingRequest) -> Frame | None:
        try:
            found = self.framing.find(received, asked.unit, asked.wire.function)
        except ValueError as error:
            self._heard(asked.unit, bytes(received))
            message = f"{asked}: {error}. Check the port and the framing (tcp, rtu, ascii)"
            raise WrongAnswer(message) from None
        if found is not None and self.trace is not None:
            self._heard(found.unit, found.raw)
        return found

    def _reply(self, found: Frame, asked: PendingRequest) -> Reply | None:
        if found.transaction != self.framing.transaction:
            return None
        if found.unit != asked.unit:
            raise _foreign(asked, found.unit)
        reply = pdu.decode_reply(asked.wire, found.pdu)
        # a server that cannot name the function of a bad request answers 80h
        return (
            reply._replace(function=asked.wire.function)
            if reply.exception is not None and not reply.function
            else reply
        )

    def _finished(self, received: bytearray, asked: PendingRequest) -> None:
        if self.manners is not None:
            self.manners.answered(asked)
        if received:
            self.tainted = True
            self._heard(asked.unit, bytes(received))

    def _missing(self, received: bytes, asked: PendingRequest) -> Exception:
        stranger = self.framing.stranger(received)
        if stranger is not None and stranger != asked.unit:
            return _foreign(asked, stranger)
        if received:
            more = " ..." if len(received) > SHOWN_BYTES else ""
            came = f"{received[:SHOWN_BYTES].hex(' ')}{more}"
            return WrongAnswer(f"{asked}: {len(received)} bytes came that are no answer ({came}). {CHECK}")
        shown = asked.shown
        return NoAnswer(unit=asked.unit, function=shown.function, address=shown.address, seconds=asked.seconds)


def _moved(reply: Reply, steps: int) -> Reply:
    return reply._replace(address=reply.address + steps) if steps and reply.exception is None else reply


def _foreign(asked: PendingRequest, unit: int) -> WrongAnswer:
    return WrongAnswer(
        f"{asked}: unit {unit} answered in its place. Check the unit id, and that no two units share one"
    )
