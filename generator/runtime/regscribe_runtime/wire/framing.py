"""Where an answer begins and ends in the bytes that come. The only module of the runtime that imports pymodbus.

Its framers build RTU and ASCII frames and check single ones (CRC, LRC). Which of the bytes are a frame is decided here:
the framers drop what follows a bad frame and find the wrong length in noise. That of TCP waits for ever on a foreign
header, so that header of seven bytes is read and written here.
"""

import struct
from abc import abstractmethod
from typing import NamedTuple, Protocol

from pymodbus.framer import FramerAscii, FramerRTU
from pymodbus.pdu import DecodePDU

from regscribe_runtime.values.serial_line import FRAMINGS

EXCEPTION_BIT = 0x80
LONGEST = 520
"""No frame is longer (ASCII: 2 x 255 characters, colon, line end); what does not become one by then is noise."""
_DECODER = DecodePDU(is_server=False)


class FoundFrame(NamedTuple):
    """A sound frame: as it came, its unit, function code with data, and whether its transaction id is the request's."""

    raw: bytes
    unit: int
    pdu: bytes
    ours: bool = True


class Framing(Protocol):
    """One kind of frame. `decisive`: an answer names its request, so one that does not fit needs no waiting."""

    decisive: bool

    @abstractmethod
    def build(self, unit: int, pdu: bytes) -> bytes:
        """The frame of a request."""

    @abstractmethod
    def find(self, buffer: bytearray, unit: int, function: int) -> FoundFrame | None:
        """Take the next frame that may answer a request to `unit` out of the buffer, and what stands before it.

        None if there is none yet. ValueError if what stands there can never become one.
        """

    @abstractmethod
    def stranger(self, buffer: bytes) -> int | None:
        """The unit of a sound frame anywhere in bytes that are no answer."""


class Mbap:
    """Frames of Modbus TCP: a header with a transaction id, which tells an answer from a late or repeated one."""

    decisive = True
    _HEAD = struct.Struct(">HHHB")
    _LENGTHS = range(3, 256)

    def __init__(self) -> None:
        self._transaction = 0

    def build(self, unit: int, pdu: bytes) -> bytes:
        """The frame of a request, with the next transaction id."""
        self._transaction = self._transaction % 0xFFFF + 1
        return self._HEAD.pack(self._transaction, 0, len(pdu) + 1, unit) + pdu

    def find(self, buffer: bytearray, unit: int, function: int) -> FoundFrame | None:  # noqa: ARG002 (the id tells more)
        """The next frame, whosever it is; ValueError for a header that is none."""
        if len(buffer) < self._HEAD.size:
            return None
        transaction, protocol, length, sender = self._HEAD.unpack_from(buffer)
        if protocol or length not in self._LENGTHS:
            message = f"{bytes(buffer[: self._HEAD.size]).hex(' ')} is no header of Modbus TCP"
            raise ValueError(message)
        end = self._HEAD.size - 1 + length
        if len(buffer) < end:
            return None
        raw = bytes(buffer[:end])
        del buffer[:end]
        return FoundFrame(raw, sender, raw[self._HEAD.size :], transaction == self._transaction)

    def stranger(self, buffer: bytes) -> int | None:  # noqa: ARG002 (as above)
        """None: a frame of another transaction was dropped when it came."""
        return None


class Rtu:
    """Frames with a CRC. They have no mark at the beginning, so a sound one of the right unit is looked for."""

    decisive = False
    _FRAMER = FramerRTU(_DECODER)
    _SHORTEST = 4

    def build(self, unit: int, pdu: bytes) -> bytes:
        """The frame of a request."""
        return self._FRAMER.encode(pdu, unit, 0)

    def find(self, buffer: bytearray, unit: int, function: int) -> FoundFrame | None:
        """The first sound frame of `unit` with `function`, or with its exception."""
        for at in range(len(buffer) - self._SHORTEST + 1):
            if buffer[at] == unit and buffer[at + 1] & ~EXCEPTION_BIT == function and (end := _sound(buffer, at)):
                raw = bytes(buffer[at:end])
                del buffer[:end]
                return FoundFrame(raw, unit, raw[1:-2])
        del buffer[:-LONGEST]
        return None

    def stranger(self, buffer: bytes) -> int | None:
        """The unit of the first sound frame."""
        places = range(len(buffer) - self._SHORTEST + 1)
        return next((buffer[at] for at in places if _sound(buffer, at)), None)


def _sound(buffer: bytes | bytearray, at: int) -> int:
    """The end of the frame at `at` if it is whole and its CRC right, else 0."""
    kind = _DECODER.lookupPduClass(bytes(buffer[at : at + 8]))
    size = int(kind.calculateRtuFrameSize(bytes(buffer[at : at + 8]))) if kind else 0
    end = at + size
    if not size or end > len(buffer):
        return 0
    return end if FramerRTU.check_CRC(bytes(buffer[at : end - 2]), int.from_bytes(buffer[end - 2 : end], "big")) else 0


class Ascii:
    """Frames in hexadecimal text between a colon and a line end, with an LRC."""

    decisive = False
    _FRAMER = FramerAscii(_DECODER)
    _START, _END = b":", b"\r\n"
    _SHORTEST = 9

    def build(self, unit: int, pdu: bytes) -> bytes:
        """The frame of a request."""
        return self._FRAMER.encode(pdu, unit, 0)

    def find(self, buffer: bytearray, unit: int, function: int) -> FoundFrame | None:
        """The first sound frame of `unit` with `function`, or with its exception."""
        while (end := buffer.find(self._END)) >= 0:
            line = bytes(buffer[: end + len(self._END)])
            del buffer[: end + len(self._END)]
            found = self._sound(line[max(line.rfind(self._START), 0) :])
            if found and found.unit == unit and found.pdu[0] & ~EXCEPTION_BIT == function:
                return found
        del buffer[:-LONGEST]
        return None

    def stranger(self, buffer: bytes) -> int | None:
        """The unit of the first sound frame."""
        lines = buffer.split(self._END)
        found = (self._sound(line[max(line.rfind(self._START), 0) :] + self._END) for line in lines)
        return next((one.unit for one in found if one), None)

    def _sound(self, line: bytes) -> FoundFrame | None:
        digits = line[1:-2]
        if line[:1] != self._START or len(line) < self._SHORTEST or digits.strip(b"0123456789ABCDEFabcdef"):
            return None
        if len(digits) % 2:
            return None
        _, unit, _, pdu = self._FRAMER.decode(line)
        return FoundFrame(line, unit, pdu) if pdu else None


_FRAMERS: dict[str, type[Mbap] | type[Rtu] | type[Ascii]] = dict(zip(FRAMINGS, (Mbap, Rtu, Ascii), strict=True))


def framing_for(name: str) -> Framing:
    """A new framing; ValueError for an unknown name."""
    if name not in FRAMINGS:
        message = f"framing {name!r} is none of {', '.join(FRAMINGS)}"
        raise ValueError(message)
    return _FRAMERS[name]()
