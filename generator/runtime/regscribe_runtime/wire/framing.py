"""Single frames of Modbus TCP (MBAP), RTU and ASCII, in both roles: built, measured and checked.

The only module beside `link.clients` that imports pymodbus: its framers make frames and their checks (CRC, LRC), its
tables have the lengths of RTU frames. `client_framing` and `server_framing` split streams into frames, because
pymodbus' framers drop what follows a frame, find wrong lengths in noise, and wait for ever on a foreign header.
"""

import struct
from typing import NamedTuple

from pymodbus.framer import FramerAscii, FramerRTU
from pymodbus.pdu import DecodePDU

from regscribe_runtime.values.serial_line import FRAMINGS
from regscribe_runtime.wire.pdu import EXCEPTION_BIT
from regscribe_runtime.wire.requests import BYTES_IN_WORD, WRITE_REGISTER

TCP, RTU, ASCII = FRAMINGS
LONGEST_PDU = 261
"""Longer than the standard's 253: the most that a byte count can announce, so that too long a write is understood."""

MBAP_HEAD = struct.Struct(">HHHB")
"""Transaction, protocol (0), length from the unit on, unit."""

SHORTEST_RTU, LONGEST_RTU = 4, LONGEST_PDU + 3
COLON, LINE_END = b":", b"\r\n"
SHORTEST_ASCII, LONGEST_ASCII = 7, 2 * (LONGEST_PDU + 2) + 1
"""Characters of a line without its end: colon, unit, function code and LRC at least."""

REQUESTS, ANSWERS = DecodePDU(is_server=True), DecodePDU(is_server=False)
"""The two sides of each function, which determine the length of an RTU frame."""

_RTU, _ASCII = FramerRTU(ANSWERS), FramerAscii(ANSWERS)


class Frame(NamedTuple):
    """A sound frame: unit, function code with data, transaction id (TCP only), and as it came where that is kept."""

    unit: int
    pdu: bytes
    transaction: int = 0
    raw: bytes = b""


def checked_framing(name: str) -> str:
    """Return the name of a framing unchanged; ValueError for another name."""
    if name not in FRAMINGS:
        message = f"framing {name!r} is none of {', '.join(FRAMINGS)}"
        raise ValueError(message)
    return name


def build(framing: str, unit: int, pdu: bytes, transaction: int = 0) -> bytes:
    """The frame of a request or an answer; `transaction` is of TCP."""
    if framing == TCP:
        return MBAP_HEAD.pack(transaction, 0, len(pdu) + 1, unit) + pdu
    return (_RTU if framing == RTU else _ASCII).encode(pdu, unit, 0)


def rtu_size(data: bytes | bytearray, at: int, side: DecodePDU) -> int | None:
    """The length of the RTU frame that begins at `at`, 0 where that is not known yet; None for an unknown function."""
    head = bytes(data[at : at + LONGEST_RTU])
    if len(head) < SHORTEST_RTU:
        return 0
    answer = side is REQUESTS and head[1] & EXCEPTION_BIT
    kind = None if answer else side.lookupPduClass(head)
    if kind is None:
        return None
    size = int(kind.calculateRtuFrameSize(head))
    return size if size <= LONGEST_RTU else None


def rtu_end(data: bytes | bytearray, at: int, side: DecodePDU) -> int:
    """Where the RTU frame at `at` ends if it is whole and its CRC right, else 0.

    Function 06 writes two words where a register has 32 bits, as Enron's have.
    """
    size = rtu_size(data, at, side) or 0
    sizes = (size, size + BYTES_IN_WORD) if size and data[at + 1] == WRITE_REGISTER else (size,)
    ends = (at + each for each in sizes if each and at + each <= len(data))
    return next((end for end in ends if has_crc(data[at:end])), 0)


def has_crc(frame: bytes | bytearray) -> bool:
    """Whether bytes are enough for an RTU frame and end with their CRC."""
    return len(frame) >= SHORTEST_RTU and FramerRTU.check_CRC(bytes(frame[:-2]), int.from_bytes(frame[-2:], "big"))


def ascii_frame(line: bytes) -> Frame | None:
    """The ASCII frame behind the last colon of a line without its end; None if it is none, or its LRC is wrong."""
    start = line.rfind(COLON)
    text = line[start:] if start >= 0 else b""
    whole = SHORTEST_ASCII <= len(text) <= LONGEST_ASCII and len(text) % 2
    if not whole or text[1:].strip(b"0123456789ABCDEFabcdef"):
        return None
    _, unit, _, pdu = _ASCII.decode(text + LINE_END)
    return Frame(unit, pdu, raw=text + LINE_END) if pdu else None
