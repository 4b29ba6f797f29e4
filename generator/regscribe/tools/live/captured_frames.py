"""Frames in captured bytes: MBAP, RTU with its CRC, ASCII with its LRC; requests and answers alike."""

import re
from collections.abc import Iterator
from typing import NamedTuple

RTU, TCP, ASCII = "rtu", "tcp", "ascii"
FRAMINGS = (RTU, TCP, ASCII)
MBAP_HEAD = 6
SHORTEST_RTU = 4
EXCEPTION = 0x80
_READS, _SINGLES, _MULTIPLES = range(1, 5), (5, 6), (15, 16)
_STATUS, _LOOPBACK = 7, 8
_FUNCTIONS = frozenset({*range(1, 9), 11, 12, 15, 16, 17, *range(20, 25), 43})
"""The public function codes: in captured bytes another one says that what looks like a header is none."""


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
        return self.pdu[0] & ~EXCEPTION


def crc(data: bytes) -> int:
    """The CRC-16 of RTU (Modbus over serial line V1.02, 6.2.2), as a number whose low byte is sent first."""
    value = 0xFFFF
    for byte in data:
        value ^= byte
        for _ in range(8):
            value = value >> 1 ^ 0xA001 if value & 1 else value >> 1
    return value


def frames(raw: bytes, framing: str = "") -> list[CapturedFrame]:
    """The frames in bytes that were captured together; without `framing` the one that fits is found.

    Bytes that are no frame of any kind become one frame of RTU with a complaint; none come from fewer than 2 bytes.
    """
    if framing in ("", ASCII) and (raw.startswith(b":") or framing == ASCII):
        return list(_ascii(raw))
    if framing != TCP and _right(raw):  # first: a header that fits by chance is likelier than a CRC
        return [CapturedFrame(RTU, raw[0], raw[1:-2], raw)]
    if framing in ("", TCP):
        found = _mbap(raw)
        if found or framing == TCP:
            return found or _broken(raw, TCP, "no header of Modbus TCP that fits its length")
    found = list(_several(raw))
    return found if sum(len(one.raw) for one in found) == len(raw) else _wrong_crc(raw)


def _right(raw: bytes) -> bool:
    return len(raw) >= SHORTEST_RTU and crc(raw[:-2]) == int.from_bytes(raw[-2:], "little")


def _wrong_crc(raw: bytes) -> list[CapturedFrame]:
    if len(raw) < SHORTEST_RTU:
        return _broken(raw, RTU, "too short for a frame")
    should = crc(raw[:-2]).to_bytes(2, "little").hex(" ").upper()
    said = f"its CRC is {raw[-2:].hex(' ').upper()}, but {should} would be right"
    return [CapturedFrame(RTU, raw[0], raw[1:-2], raw, said)]


def _broken(raw: bytes, framing: str, said: str) -> list[CapturedFrame]:
    return [CapturedFrame(framing, raw[0], raw[1:], raw, said)] if len(raw) > 1 else []


def _mbap(raw: bytes) -> list[CapturedFrame]:
    found = []
    while len(raw) > MBAP_HEAD + 1:
        end = MBAP_HEAD + int.from_bytes(raw[4:6], "big")
        if raw[2] or raw[3] or not MBAP_HEAD + 1 < end <= len(raw) or raw[MBAP_HEAD + 1] & ~EXCEPTION not in _FUNCTIONS:
            return []
        found.append(CapturedFrame(TCP, raw[MBAP_HEAD], raw[MBAP_HEAD + 1 : end], raw[:end]))
        raw = raw[end:]
    return [] if raw else found


def _several(raw: bytes) -> Iterator[CapturedFrame]:
    """Frames of RTU that follow each other without a mark: a length that the function allows, and a right CRC."""
    at = 0
    while at < len(raw):
        end = next((at + size for size in _sizes(raw[at:]) if _right(raw[at : at + size])), 0)
        if not end:
            return
        yield CapturedFrame(RTU, raw[at], raw[at + 1 : end - 2], raw[at:end])
        at = end


def _sizes(raw: bytes) -> Iterator[int]:
    """The lengths that a frame at the start may have, as a request and as an answer."""
    if len(raw) < SHORTEST_RTU:
        return
    function = raw[1]
    if function & EXCEPTION or function == _STATUS:
        yield from (5, 4)
    elif function in _READS:
        yield from (8, 5 + raw[2])
    elif function in _SINGLES or function == _LOOPBACK:
        yield 8
    elif function in _MULTIPLES:
        yield from (8, *((9 + raw[6],) if len(raw) > MBAP_HEAD else ()))


def _ascii(raw: bytes) -> Iterator[CapturedFrame]:
    for line in re.findall(rb":[0-9A-Fa-f]*", raw) or [raw]:
        digits = line.removeprefix(b":")
        if len(digits) % 2 or len(digits) < 2 * 3 or re.search(rb"[^0-9A-Fa-f]", digits):
            yield CapturedFrame(
                ASCII, 0, b"\0", line, "no frame of Modbus ASCII: a colon and pairs of hexadecimal digits"
            )
            continue
        data = bytes.fromhex(digits.decode("ascii"))
        wrong = sum(data) & 0xFF
        said = f"its LRC is {data[-1]:02X}, but {data[-1] - wrong & 0xFF:02X} would be right" if wrong else ""
        yield CapturedFrame(ASCII, data[0], data[1:-1], line, said)
