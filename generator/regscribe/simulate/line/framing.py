"""Frames of MBAP, RTU and ASCII: found in a stream of bytes, and built. The one module that imports pymodbus.

pymodbus' framers check and build single frames; where a frame begins and ends in a stream is decided here, because
the framers drop what follows a frame (pipelined requests) or a bad one, and wedge on a foreign protocol id.
"""

from abc import abstractmethod
from dataclasses import dataclass
from enum import StrEnum
from typing import Protocol

from pymodbus.framer import FramerAscii, FramerRTU, FramerSocket
from pymodbus.pdu import DecodePDU

LONGEST_PDU = 261
"""Longer than the standard's 253: the most that a byte count can announce, so that too long a write is understood."""

_DECODER = DecodePDU(is_server=True)


class Framing(StrEnum):
    """How requests and answers are wrapped."""

    MBAP = "mbap"
    RTU = "rtu"
    ASCII = "ascii"


@dataclass(frozen=True, slots=True)
class Request:
    """A request as it came: the unit it addresses, function code with data, and the transaction id (MBAP only)."""

    unit: int
    pdu: bytes
    transaction: int = 0


class Framer(Protocol):
    """Finds requests in the bytes of one connection; keeps at most one frame of them between calls."""

    @property
    @abstractmethod
    def pending(self) -> bool:
        """Whether bytes wait for the rest of their frame."""

    @abstractmethod
    def feed(self, data: bytes) -> list[Request]:
        """Add bytes and return every request that they complete, in order; garbage is skipped."""

    @abstractmethod
    def expire(self) -> list[Request]:
        """Give up waiting for the rest of a frame; return what could be made out behind it."""

    @abstractmethod
    def answer(self, request: Request, pdu: bytes) -> bytes:
        """Return the frame that answers `request` with `pdu`."""


def framer_for(framing: Framing) -> Framer:
    """Return a new framer, for one connection."""
    kinds: dict[Framing, type[Framer]] = {
        Framing.MBAP: MbapFramer,
        Framing.RTU: RtuFramer,
        Framing.ASCII: AsciiFramer,
    }
    return kinds[framing]()


class _Buffered:
    """Bytes that wait for the rest of their frame."""

    __slots__ = ("_buffer",)
    _buffer: bytearray

    def __init__(self) -> None:
        self._buffer = bytearray()

    @property
    def pending(self) -> bool:
        return bool(self._buffer)

    def expire(self) -> list[Request]:
        self._buffer.clear()
        return []


class MbapFramer(_Buffered):
    """Requests with an MBAP header, for Modbus/TCP.

    A frame of a foreign protocol is skipped by its length; without a possible length, byte by byte to the next
    header that is one.
    """

    __slots__ = ()
    _FRAMER = FramerSocket(_DECODER)
    _HEAD = 6
    _LENGTHS = range(2, LONGEST_PDU + 2)

    def feed(self, data: bytes) -> list[Request]:
        """Add bytes and return every request that they complete."""
        self._buffer += data
        buffer, at, found = self._buffer, 0, []
        while len(buffer) - at >= self._HEAD:
            length = buffer[at + 4] << 8 | buffer[at + 5]
            if length not in self._LENGTHS:
                at += 1
                continue
            end = at + self._HEAD + length
            if len(buffer) < end:
                break
            if not (buffer[at + 2] or buffer[at + 3]):
                _, unit, transaction, pdu = self._FRAMER.decode(bytes(buffer[at:end]))
                found.append(Request(unit, pdu, transaction))
            at = end
        del buffer[:at]
        return found

    def answer(self, request: Request, pdu: bytes) -> bytes:
        """Return the frame that answers `request`."""
        return self._FRAMER.encode(pdu, request.unit, request.transaction)


class RtuFramer(_Buffered):
    """Requests with a CRC, for serial lines and for RTU over TCP.

    RTU marks the end of a frame by silence, which pipes and networks do not keep; so the length follows from the
    function code, and that of a code that pymodbus does not know from the first CRC that fits. Out of step (a CRC that
    is wrong), the next sound frame anywhere behind is taken; in step, an unfinished frame is waited for, until
    `expire` says that the silence was too long.
    """

    __slots__ = ("_in_step",)
    _FRAMER = FramerRTU(_DECODER)
    _SHORTEST = 4
    _LONGEST = LONGEST_PDU + 3

    def __init__(self) -> None:
        super().__init__()
        self._in_step = True

    def feed(self, data: bytes) -> list[Request]:
        """Add bytes and return every request that they complete."""
        self._buffer += data
        return self._take(wait=True)

    def expire(self) -> list[Request]:
        """Return the sound frames behind an unfinished one, and forget the rest."""
        found = self._take(wait=False)
        self._buffer.clear()
        self._in_step = True
        return found

    def answer(self, request: Request, pdu: bytes) -> bytes:
        """Return the frame that answers `request`."""
        return self._FRAMER.encode(pdu, request.unit, 0)

    def _take(self, *, wait: bool) -> list[Request]:
        found: list[Request] = []
        while len(self._buffer) >= self._SHORTEST:
            data = bytes(self._buffer)
            if size := self._sound(data, 0) or self._sound_unknown(data):
                found.append(Request(data[0], data[1 : size - 2]))
                del self._buffer[:size]
                self._in_step = True
            elif wait and self._in_step and self._unfinished(data):
                break
            elif skip := self._next_sound(data):
                del self._buffer[:skip]
            else:
                del self._buffer[: self._first_possible(data)]
                self._in_step = False
                break
        return found

    def _size(self, data: bytes, at: int) -> int | None:
        """Return the length of the frame at `at`, 0 where it cannot be known yet; None for an unknown function."""
        head = data[at : at + self._LONGEST]
        if len(head) < self._SHORTEST:
            return 0
        kind = None if head[1] & 0x80 else _DECODER.lookupPduClass(head)
        if kind is None:
            return None
        size = int(kind.calculateRtuFrameSize(head))
        return size if size <= self._LONGEST else None

    def _sound(self, data: bytes, at: int) -> int:
        """Return the length of the frame at `at` if it is whole and its CRC right, else 0."""
        size = self._size(data, at)
        return size if size and at + size <= len(data) and _crc_fits(data[at : at + size]) else 0

    def _sound_unknown(self, data: bytes) -> int:
        """Return the length of a frame with an unknown function code, by the first CRC that fits, else 0."""
        if not self._in_step or self._size(data, 0) is not None:
            return 0
        sizes = range(self._SHORTEST, min(len(data), self._LONGEST) + 1)
        return next((size for size in sizes if _crc_fits(data[:size])), 0)

    def _unfinished(self, data: bytes) -> bool:
        size = self._size(data, 0)
        if size is None:
            return len(data) < self._LONGEST and not self._next_sound(data)
        return size == 0 or len(data) < size

    def _next_sound(self, data: bytes) -> int:
        """Return the first place behind the beginning where a sound frame stands, 0 if there is none."""
        places = range(1, len(data) - self._SHORTEST + 1)
        return next((at for at in places if self._sound(data, at)), 0)

    def _first_possible(self, data: bytes) -> int:
        """Return the first place where a frame may have begun whose rest is still to come."""
        return next((at for at in range(len(data)) if not self._is_over(data, at)), len(data))

    def _is_over(self, data: bytes, at: int) -> bool:
        size = self._size(data, at)
        return size is None or 0 < size <= len(data) - at


class SilenceFramer(RtuFramer):
    """Requests whose end is marked by silence: what is fed is one frame, and bad if it is not one request."""

    __slots__ = ()

    def feed(self, data: bytes) -> list[Request]:
        """Return the request that `data` is, if it is one."""
        found = self._take_all(data)
        return found if len(found) == 1 and len(data) == len(found[0].pdu) + 3 else []

    def _take_all(self, data: bytes) -> list[Request]:
        self._buffer[:] = data
        return self.expire()


class AsciiFramer(_Buffered):
    """Requests in hexadecimal text between a colon and a line end, with an LRC."""

    __slots__ = ()
    _FRAMER = FramerAscii(_DECODER)
    _LONGEST = 2 * (LONGEST_PDU + 2) + 3
    _SHORTEST = 7
    _END = b"\r\n"

    def feed(self, data: bytes) -> list[Request]:
        """Add bytes and return every request that they complete."""
        *lines, rest = (self._buffer + data).split(self._END)
        start = rest.rfind(b":")
        self._buffer = rest[start:] if start >= 0 and len(rest) - start <= self._LONGEST else bytearray()
        requests = (self._request(bytes(line[line.rfind(b":") :])) for line in lines if b":" in line)
        return [request for request in requests if request is not None]

    def answer(self, request: Request, pdu: bytes) -> bytes:
        """Return the frame that answers `request`."""
        return self._FRAMER.encode(pdu, request.unit, 0)

    def _request(self, line: bytes) -> Request | None:
        is_hexadecimal = not line[1:].strip(b"0123456789abcdefABCDEF")
        if not is_hexadecimal or len(line) % 2 == 0 or not self._SHORTEST <= len(line) <= self._LONGEST:
            return None
        _, unit, _, pdu = self._FRAMER.decode(line + self._END)
        return Request(unit, pdu) if pdu else None


def _crc_fits(frame: bytes) -> bool:
    return FramerRTU.check_CRC(frame[:-2], int.from_bytes(frame[-2:], "big"))
