"""Texts, dates, addresses and raw bytes: what bytes say, as the text that maps and vectors have, and back."""

import re
from collections.abc import Iterator
from datetime import datetime, time, timedelta
from ipaddress import ip_address

from regscribe.model.register import Register
from regscribe.reference.outcome import RefusalReason, RefusedError
from regscribe_runtime.values.kinds import MOMENTS, Kind
from regscribe_runtime.values.octets import TextForm
from regscribe_runtime.values.wire_types import WireType

SIZES = {WireType.IPV4: 4, WireType.IPV6: 16, WireType.EUI48: 6, WireType.EUI64: 8}
NUMBERS = {"Y": "year", "y": "year", "M": "month", "D": "day", "h": "hour", "m": "minute", "s": "second"}
SECONDS_OF_DAY = 86400


class MeaninglessError(ValueError):
    """The bytes say nothing."""


def meaning_of(register: Register, raw: bytes) -> str | None:
    """Return what bytes (the first letter, or the most significant, first) say; None where that is nothing."""
    try:
        return _said(register, raw)
    except (ValueError, OverflowError):
        return None


def _said(register: Register, raw: bytes) -> str:
    if register.kind is Kind.STRING:
        return _text(register.text, raw)
    if register.kind is Kind.BYTES:
        return raw.hex()
    if register.kind in MOMENTS:
        return _moment(register, raw)
    size = SIZES[register.base.type]
    packed = bytes(raw[place] for place in range(1, len(raw), 2)) if len(raw) == 2 * size else raw[len(raw) - size :]
    return ":".join(f"{byte:02x}" for byte in packed) if register.kind is Kind.MAC else str(ip_address(packed))


def octets_of(register: Register, said: str, size: int) -> bytes:
    """Return the bytes, so many, that say a text; raises RefusedError where none do."""
    try:
        raw = _spelled(register, said, size)
    except (ValueError, OverflowError) as error:
        raise RefusedError(RefusalReason.TYPE, f"{said!r}: {error}") from None
    back = meaning_of(register, raw)
    if len(raw) != size or (back != said.rstrip(" ") if register.kind is Kind.STRING else back != said):
        raise RefusedError(RefusalReason.TYPE, f"{said!r} in {size} bytes would be read back as {back!r}")
    return raw


def _spelled(register: Register, said: str, size: int) -> bytes:
    if register.kind is Kind.STRING:
        return _letters(register.text, said, size)
    if register.kind is Kind.BYTES:
        return bytes.fromhex(said)
    if register.kind in MOMENTS:
        return _moment_bytes(register, said)
    packed = bytes.fromhex(said.replace(":", "")) if register.kind is Kind.MAC else ip_address(said).packed
    if size == 2 * len(packed):
        return b"".join(b"\0" + bytes([byte]) for byte in packed)
    return bytes(size - len(packed)) + packed


# -- texts ----------------------------------------------------------------------------------------------------------


def _encoding(form: TextForm) -> tuple[str, int]:
    return ("utf_16_be", 2) if form.encoding == "utf-16" else (form.encoding, 1)


def _text(form: TextForm, raw: bytes) -> str:
    letters = raw
    if form.per_register:
        letters = bytes(raw[place] for place in range(form.per_register == "low", len(raw), 2))
    encoding, width = _encoding(form)
    kept: list[bytes] = []
    for place in range(0, len(letters), width):
        letter = letters[place : place + width]
        if any(letter == bytes([end] * width) for end in form.ends):
            break
        kept.append(letter)
    while form.padding != ord(" ") and kept and kept[-1] == bytes([form.padding] * width):
        kept.pop()
    return b"".join(kept).decode(encoding).rstrip(" ")


def _letters(form: TextForm, said: str, size: int) -> bytes:
    encoding, width = _encoding(form)
    if "\0" in said:
        raise MeaninglessError(said)
    letters = said.encode(encoding)
    filling = " ".encode(encoding) if form.padding == ord(" ") else bytes([form.padding] * width)
    room = size // 2 if form.per_register else size
    while len(letters) < room:
        letters += filling
    if not form.per_register:
        return letters
    return b"".join(bytes([0, letter] if form.per_register == "low" else [letter, 0]) for letter in letters)


# -- dates and times ------------------------------------------------------------------------------------------------


def _moment(register: Register, raw: bytes) -> str:
    found = _in_layout(register.layout, raw)
    if register.kind is Kind.DATE:
        return found.date().isoformat()
    return found.time().isoformat() if register.kind is Kind.TIME else found.isoformat()


def _since(layout: str) -> tuple[datetime, int]:
    """Return the moment from which a layout counts, and the seconds of its unit (0: it does not count)."""
    name, _, epoch = layout.partition(" ")
    unit = {"unix": 1, "unix64": 1, "seconds": 1, "minutes": 60}.get(name, 0)
    return datetime.fromisoformat(epoch if unit and epoch else "1970-01-01"), unit


def _in_layout(layout: str, raw: bytes) -> datetime:
    start, unit = _since(layout)
    number = int.from_bytes(raw, "big")
    if unit:
        if layout in {"minutes", "seconds"} and number * unit >= SECONDS_OF_DAY:
            raise MeaninglessError(layout)
        return start + timedelta(seconds=number * unit)
    if layout == "iec870":
        return _iec870(raw)
    parts = {"year": 2000, "month": 1, "day": 1}
    for letter, part in _parts(layout, raw):
        if letter == "y" and part > 99:  # noqa: PLR2004 (two digits)
            raise MeaninglessError(layout)
        if letter in NUMBERS:
            parts[NUMBERS[letter]] = part + 2000 * (letter == "y")
    return datetime(**parts)  # type: ignore[arg-type] # noqa: DTZ001 (a device tells no zone)


def _tokens(layout: str) -> tuple[str, list[str]]:
    """Return how the digits stand (bcd, ascii, or nothing special), and what is in the words."""
    words = layout.split(" ")
    return (words[0], words[1:]) if words[0] in {"bcd", "ascii"} else ("", words)


def _parts(layout: str, raw: bytes) -> Iterator[tuple[str, int]]:
    """Yield the letters of a layout with the numbers that stand for them."""
    form, tokens = _tokens(layout)
    if form == "ascii":
        yield from _characters("".join(tokens), raw)
        return
    bcd, rest = form == "bcd", list(raw)
    for token in tokens:
        size = 4 if len(token) > 4 else 2  # noqa: PLR2004 (digits that fit a word)
        cells, rest = rest[:size], rest[size:]
        if len(token) == 1:
            yield token, _whole(cells, bcd=bcd)
        elif len(token) == 2 and token[0] != token[1]:  # noqa: PLR2004 (a byte each)
            yield from ((letter, _whole([cell], bcd=bcd)) for letter, cell in zip(token, cells, strict=True))
        else:
            digits = str(_whole(cells, bcd=False)).zfill(len(token))
            if len(digits) > len(token):
                raise MeaninglessError(layout)
            yield from ((run[0][0], int(digits[run.start() : run.end()])) for run in re.finditer(r"(.)\1*", token))


def _characters(letters: str, raw: bytes) -> Iterator[tuple[str, int]]:
    for run in re.finditer(r"(.)\1*", letters):
        text = raw[run.start() : run.end()]
        if run[1] != "_" and any(cell not in b"0123456789" for cell in text):
            raise MeaninglessError(text)
        yield run[1], int(text) if run[1] != "_" else 0


def _whole(cells: list[int], *, bcd: bool) -> int:
    if bcd:
        return int("".join(f"{cell:02x}" for cell in cells))
    return sum(cell << 8 * place for place, cell in enumerate(reversed(cells)))


def _moment_bytes(register: Register, said: str) -> bytes:
    start, unit = _since(register.layout)
    if register.kind is Kind.TIME:
        value = datetime.combine(start.date(), time.fromisoformat(said))
    else:
        value = datetime.fromisoformat(said)  # of a date alone its first moment
    words = {"unix": 2, "unix64": 4, "seconds": 2, "minutes": 1}.get(register.layout.split(" ")[0], 0)
    if unit:
        return ((value - start) // timedelta(seconds=unit)).to_bytes(2 * words, "big")
    if register.layout == "iec870":
        return _iec870_bytes(value)
    return _layout_bytes(register.layout, value)


def _layout_bytes(layout: str, value: datetime) -> bytes:
    numbers = {letter: getattr(value, name) for letter, name in NUMBERS.items()}
    numbers |= {"y": value.year - 2000, "w": value.weekday() + 1, "_": 0}
    form, tokens = _tokens(layout)
    bcd, raw = form == "bcd", b""
    if form == "ascii":
        found = re.finditer(r"(.)\1*", "".join(tokens))
        return "".join(str(numbers[run[1]]).zfill(len(run[0])) for run in found).encode()
    for token in tokens:
        runs = [(run[0][0], len(run[0])) for run in re.finditer(r"(.)\1*", token)]
        if len(token) <= len(runs) <= 2:  # noqa: PLR2004 (one letter, or a byte each)
            size = 2 // len(runs)
            for letter, _ in runs:
                number = int(str(numbers[letter]), 16) if bcd else numbers[letter]
                raw += number.to_bytes(size, "big")
        else:
            digits = "".join(str(numbers[letter]).zfill(width) for letter, width in runs)
            raw += int(digits).to_bytes(4 if len(token) > 4 else 2, "big")  # noqa: PLR2004 (digits that fit a word)
    return raw


def _iec870(raw: bytes) -> datetime:
    if raw[5] // 128 or raw[1] % 128 > 99:  # noqa: PLR2004 (two digits)
        raise MeaninglessError(raw)
    thousandths = raw[6] * 256 + raw[7]
    at_minute = datetime(2000 + raw[1] % 128, raw[2] % 16, raw[3] % 32, raw[4] % 32, raw[5] % 64)  # noqa: DTZ001 (no zone)
    if thousandths >= 60_000:  # noqa: PLR2004 (a minute)
        raise MeaninglessError(thousandths)
    return at_minute + timedelta(milliseconds=thousandths)


def _iec870_bytes(value: datetime) -> bytes:
    thousandths = value.second * 1000 + value.microsecond // 1000
    day = 32 * (value.weekday() + 1) + value.day
    return bytes([0, value.year - 2000, value.month, day, value.hour, value.minute, *divmod(thousandths, 256)])
