"""Framing on the side of a server: requests in a stream of bytes, pipelined, halved, garbled or foreign ones."""

from abc import ABC, abstractmethod

from regscribe_runtime.wire import framing
from regscribe_runtime.wire.framing import MBAP_HEAD, REQUESTS, SHORTEST_RTU, Frame
from regscribe_runtime.wire.requests import BYTES_IN_WORD, WRITE_REGISTER


class Framer(ABC):
    """Finds requests in the bytes of one connection; keeps at most one frame of them between calls."""

    __slots__ = ("_buffer",)
    _NAME: str

    def __init__(self) -> None:
        self._buffer = bytearray()

    @property
    def pending(self) -> bool:
        """Whether bytes wait for the rest of their frame."""
        return bool(self._buffer)

    @abstractmethod
    def feed(self, data: bytes) -> list[Frame]:
        """Add bytes and return every request that they complete, in order; garbage is skipped."""

    def expire(self) -> list[Frame]:
        """Give up waiting for the rest of a frame; return the requests behind it."""
        self._buffer.clear()
        return []

    def answer(self, request: Frame, pdu: bytes) -> bytes:
        """Return the frame that answers `request` with `pdu`."""
        return framing.build(self._NAME, request.unit, pdu, request.transaction)


class MbapFramer(Framer):
    """Requests with an MBAP header, for Modbus TCP.

    A frame of a foreign protocol is skipped by its length; without a possible length, byte by byte to the next
    header that is one.
    """

    __slots__ = ()
    _NAME = framing.TCP
    _LENGTHS = range(2, framing.LONGEST_PDU + 2)

    def feed(self, data: bytes) -> list[Frame]:
        """Add bytes and return every request that they complete."""
        self._buffer += data
        buffer, at, found = self._buffer, 0, []
        while len(buffer) - at >= MBAP_HEAD.size:
            transaction, protocol, length, unit = MBAP_HEAD.unpack_from(buffer, at)
            if length not in self._LENGTHS:
                at += 1
                continue
            start, end = at + MBAP_HEAD.size, at + MBAP_HEAD.size - 1 + length
            if len(buffer) < end:
                break
            if not protocol:
                found.append(Frame(unit, bytes(buffer[start:end]), transaction))
            at = end
        del buffer[:at]
        return found


class RtuFramer(Framer):
    """Requests with a CRC, for serial lines and for RTU over TCP.

    RTU marks the end of a frame by silence, which pipes and networks do not keep; so the length follows from the
    function code, and that of a code that pymodbus does not know from the first CRC that fits. Out of step (a CRC that
    is wrong), the next sound frame anywhere behind is taken; in step, an unfinished frame is waited for, until
    `expire` says that the silence was too long.
    """

    __slots__ = ("_in_step",)
    _NAME = framing.RTU

    def __init__(self) -> None:
        super().__init__()
        self._in_step = True

    def feed(self, data: bytes) -> list[Frame]:
        """Add bytes and return every request that they complete."""
        self._buffer += data
        return self._take(wait=True)

    def expire(self) -> list[Frame]:
        """Return the sound frames behind an unfinished one, and forget the rest."""
        found = self._take(wait=False)
        del self._buffer[:]
        self._in_step = True
        return found

    def _take(self, *, wait: bool) -> list[Frame]:
        found: list[Frame] = []
        while len(self._buffer) >= SHORTEST_RTU:
            data = bytes(self._buffer)
            if end := framing.rtu_end(data, 0, REQUESTS) or self._end_of_unknown(data):
                found.append(Frame(data[0], data[1 : end - 2]))
                del self._buffer[:end]
                self._in_step = True
            elif wait and self._in_step and _is_unfinished(data):
                break
            elif skip := _next_sound(data):
                del self._buffer[:skip]
            else:
                del self._buffer[: _first_possible(data)]
                self._in_step = False
                break
        return found

    def _end_of_unknown(self, data: bytes) -> int:
        """Where a frame with an unknown function code ends, by the first CRC that fits; else 0."""
        if not self._in_step or framing.rtu_size(data, 0, REQUESTS) is not None:
            return 0
        ends = range(SHORTEST_RTU, min(len(data), framing.LONGEST_RTU) + 1)
        return next((end for end in ends if framing.has_crc(data[:end])), 0)


def _is_unfinished(data: bytes) -> bool:
    size = framing.rtu_size(data, 0, REQUESTS)
    if size is None:
        return len(data) < framing.LONGEST_RTU and not _next_sound(data)
    may_be_longer = data[1] == WRITE_REGISTER and len(data) < (size or 0) + BYTES_IN_WORD and not _next_sound(data)
    return size == 0 or len(data) < size or may_be_longer


def _next_sound(data: bytes) -> int:
    """Return the first place behind the beginning where a sound frame stands, 0 if there is none."""
    places = range(1, len(data) - SHORTEST_RTU + 1)
    return next((at for at in places if framing.rtu_end(data, at, REQUESTS)), 0)


def _first_possible(data: bytes) -> int:
    """Return the first place where a frame may have begun whose rest is still to come."""
    for at in range(len(data)):
        size = framing.rtu_size(data, at, REQUESTS)
        if size is not None and not 0 < size <= len(data) - at:
            return at
    return len(data)


class SilenceFramer(RtuFramer):
    """Requests whose end is marked by silence: the bytes of each call must be exactly one request."""

    __slots__ = ()

    def feed(self, data: bytes) -> list[Frame]:
        """Return the request that `data` is, if it is one."""
        self._buffer[:] = data
        found = self.expire()
        return found if found and len(data) == len(found[0].pdu) + 3 else []


class AsciiFramer(Framer):
    """Requests in hexadecimal text between a colon and a line end, with an LRC."""

    __slots__ = ()
    _NAME = framing.ASCII

    def feed(self, data: bytes) -> list[Frame]:
        """Add bytes and return every request that they complete."""
        *lines, rest = (self._buffer + data).split(framing.LINE_END)
        start = rest.rfind(framing.COLON)
        kept = start >= 0 and len(rest) - start <= framing.LONGEST_ASCII + len(framing.LINE_END)
        self._buffer = rest[start:] if kept else bytearray()
        return [Frame(found.unit, found.pdu) for line in lines if (found := framing.ascii_frame(bytes(line)))]


def framer_for(name: str) -> Framer:
    """Return a new framer, for one connection; ValueError for an unknown name."""
    kinds: dict[str, type[Framer]] = {framing.TCP: MbapFramer, framing.RTU: RtuFramer, framing.ASCII: AsciiFramer}
    return kinds[framing.checked_framing(name)]()
