"""Framing on the side of a client: the answer to a request in a stream of bytes."""

from abc import ABC, abstractmethod

from regscribe_runtime.wire import framing
from regscribe_runtime.wire.framing import ANSWERS, MBAP_HEAD, SHORTEST_RTU, Frame, ascii_frame, rtu_end
from regscribe_runtime.wire.pdu import EXCEPTION_BIT

LONGEST = framing.LONGEST_ASCII + len(framing.LINE_END)
"""Bytes of the longest frame; more without a frame are noise."""


class Framing(ABC):
    """One kind of frame. `decisive`: an answer names its request, so after one that does not fit no other is awaited.

    `transaction` is the id of the last request, and of its answer; 0 where frames have none.
    """

    decisive = False
    transaction = 0
    _NAME: str

    def build(self, unit: int, pdu: bytes) -> bytes:
        """The frame of a request."""
        return framing.build(self._NAME, unit, pdu, self.transaction)

    @abstractmethod
    def find(self, buffer: bytearray, unit: int, function: int) -> Frame | None:
        """Take the next frame that may answer a request to `unit` with `function` (or refuse it) out of the buffer.

        What stands before it goes as well. None if there is none yet. ValueError if the buffer can never become one.
        """

    @abstractmethod
    def stranger(self, buffer: bytes) -> int | None:
        """The unit of the first sound frame in bytes that are no answer, None without one."""


class _Mbap(Framing):
    """Frames of Modbus TCP: a header with a transaction id, which tells an answer from a late or repeated one."""

    decisive = True
    _NAME = framing.TCP
    _LENGTHS = range(3, 256)

    def build(self, unit: int, pdu: bytes) -> bytes:
        self.transaction = self.transaction % 0xFFFF + 1
        return super().build(unit, pdu)

    def find(self, buffer: bytearray, unit: int, function: int) -> Frame | None:  # noqa: ARG002 (the id tells more)
        if len(buffer) < MBAP_HEAD.size:
            return None
        transaction, protocol, length, sender = MBAP_HEAD.unpack_from(buffer)
        if protocol or length not in self._LENGTHS:
            message = f"{bytes(buffer[: MBAP_HEAD.size]).hex(' ')} is no header of Modbus TCP"
            raise ValueError(message)
        end = MBAP_HEAD.size - 1 + length
        if len(buffer) < end:
            return None
        raw = bytes(buffer[:end])
        del buffer[:end]
        return Frame(sender, raw[MBAP_HEAD.size :], transaction, raw)

    def stranger(self, buffer: bytes) -> int | None:  # noqa: ARG002 (as above)
        return None  # a frame of another transaction was dropped when it came


class _Rtu(Framing):
    """Frames with a CRC. They have no mark at the beginning, so a sound one of the right unit is looked for."""

    _NAME = framing.RTU

    def find(self, buffer: bytearray, unit: int, function: int) -> Frame | None:
        for at in range(len(buffer) - SHORTEST_RTU + 1):
            mine = buffer[at] == unit and buffer[at + 1] & ~EXCEPTION_BIT == function
            if mine and (end := rtu_end(buffer, at, ANSWERS)):
                raw = bytes(buffer[at:end])
                del buffer[:end]
                return Frame(unit, raw[1:-2], raw=raw)
        del buffer[:-LONGEST]
        return None

    def stranger(self, buffer: bytes) -> int | None:
        places = range(len(buffer) - SHORTEST_RTU + 1)
        return next((buffer[at] for at in places if rtu_end(buffer, at, ANSWERS)), None)


class _Ascii(Framing):
    """Frames in hexadecimal text between a colon and a line end, with an LRC."""

    _NAME = framing.ASCII

    def find(self, buffer: bytearray, unit: int, function: int) -> Frame | None:
        while (end := buffer.find(framing.LINE_END)) >= 0:
            found = ascii_frame(bytes(buffer[:end]))
            del buffer[: end + len(framing.LINE_END)]
            if found and found.unit == unit and found.pdu[0] & ~EXCEPTION_BIT == function:
                return found
        del buffer[:-LONGEST]
        return None

    def stranger(self, buffer: bytes) -> int | None:
        found = (ascii_frame(line) for line in buffer.split(framing.LINE_END))
        return next((one.unit for one in found if one), None)


def framing_for(name: str) -> Framing:
    """A new framing; ValueError for an unknown name."""
    kinds: dict[str, type[Framing]] = {framing.TCP: _Mbap, framing.RTU: _Rtu, framing.ASCII: _Ascii}
    return kinds[framing.checked_framing(name)]()
