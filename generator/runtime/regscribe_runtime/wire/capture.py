"""Frames in captured bytes, of every framing: requests, answers, and broken ones with a complaint."""

import re
from typing import NamedTuple

from regscribe_runtime.wire import framing
from regscribe_runtime.wire.framing import ASCII, RTU, TCP
from regscribe_runtime.wire.pdu import EXCEPTION_BIT

_FUNCTIONS = frozenset({*range(1, 9), 11, 12, 15, 16, 17, *range(20, 25), 43})
"""The public function codes; another one means that what looks like a header of Modbus TCP is none."""


class CapturedFrame(NamedTuple):
    """One frame: `pdu` is function code and data; `complaint` says what is wrong with the frame itself."""

    framing: str
    unit: int
    pdu: bytes
    raw: bytes
    complaint: str = ""

    @property
    def function(self) -> int:
        """The function code, without the mark of an exception."""
        return self.pdu[0] & ~EXCEPTION_BIT


def frames(raw: bytes, kind: str | None = None) -> list[CapturedFrame]:
    """The frames in bytes that were captured together; without `kind` the framing that fits is found.

    Bytes that are no frame of any kind become one frame of RTU with a complaint; none come from fewer than 2 bytes.
    """
    kind = kind or _kind(raw)
    if kind == ASCII:
        return [_ascii(line) for line in re.findall(rb":[0-9A-Fa-f]*", raw) or [raw]]
    if kind == TCP:
        return _mbap(raw) or _broken(raw, TCP, "no header of Modbus TCP that fits its length")
    return _rtu(raw) or _wrong_crc(raw)


def _kind(raw: bytes) -> str:
    if raw.startswith(framing.COLON):
        return ASCII
    # a header that fits by chance is likelier than a CRC
    return TCP if not framing.has_crc(raw) and _mbap(raw) else RTU


def _mbap(raw: bytes) -> list[CapturedFrame]:
    """Frames of TCP, if the bytes are nothing else."""
    found = []
    while len(raw) > framing.MBAP_HEAD.size:
        _, protocol, length, unit = framing.MBAP_HEAD.unpack_from(raw)
        end = framing.MBAP_HEAD.size - 1 + length
        if protocol or not framing.MBAP_HEAD.size < end <= len(raw):
            return []
        found.append(CapturedFrame(TCP, unit, raw[framing.MBAP_HEAD.size : end], raw[:end]))
        raw = raw[end:]
    return [] if raw or any(each.function not in _FUNCTIONS for each in found) else found


def _rtu(raw: bytes) -> list[CapturedFrame]:
    """A frame of RTU of any length, or several without a pause between them, if the bytes are nothing else."""
    if framing.has_crc(raw):
        return [CapturedFrame(RTU, raw[0], raw[1:-2], raw)]
    found, at = [], 0
    while at < len(raw):
        end = framing.rtu_end(raw, at, framing.REQUESTS) or framing.rtu_end(raw, at, framing.ANSWERS)
        if not end:
            return []
        found.append(CapturedFrame(RTU, raw[at], raw[at + 1 : end - 2], raw[at:end]))
        at = end
    return found


def _wrong_crc(raw: bytes) -> list[CapturedFrame]:
    if len(raw) < framing.SHORTEST_RTU:
        return _broken(raw, RTU, "too short for a frame")
    unit, pdu = raw[0], raw[1:-2]
    should = framing.build(RTU, unit, pdu)[-2:].hex(" ").upper()
    complaint = f"its CRC is {raw[-2:].hex(' ').upper()}, but {should} would be right"
    return [CapturedFrame(RTU, unit, pdu, raw, complaint)]


def _broken(raw: bytes, kind: str, complaint: str) -> list[CapturedFrame]:
    return [CapturedFrame(kind, raw[0], raw[1:], raw, complaint)] if len(raw) > 1 else []


def _ascii(line: bytes) -> CapturedFrame:
    digits = line.removeprefix(framing.COLON)
    if len(digits) % 2 or len(digits) < framing.SHORTEST_ASCII - 1 or re.search(rb"[^0-9A-Fa-f]", digits):
        complaint = "no frame of Modbus ASCII: a colon and pairs of hexadecimal digits"
        return CapturedFrame(ASCII, 0, b"\0", line, complaint)
    unit, *pdu, lrc = bytes.fromhex(digits.decode("ascii"))
    should = int(framing.build(ASCII, unit, bytes(pdu))[-4:-2], 16)
    complaint = f"its LRC is {lrc:02X}, but {should:02X} would be right" if lrc != should else ""
    return CapturedFrame(ASCII, unit, bytes(pdu), line, complaint)
