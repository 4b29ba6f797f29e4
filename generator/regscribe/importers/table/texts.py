"""Bytes to text: which encoding they are in, told by byte order marks and by what decodes."""

import codecs
import re

from regscribe.importers.table.grid import TableError

MARKS = ((codecs.BOM_UTF8, "utf-8"), (codecs.BOM_UTF16_LE, "utf-16-le"), (codecs.BOM_UTF16_BE, "utf-16-be"))
"""Byte order marks, with the encoding that each tells."""

WESTERN = "cp1252"
"""What spreadsheets in the west write if they do not write UTF-8."""

ENCODING = re.compile(r"[A-Za-z0-9_.:-]{1,40}")


def decode(data: bytes, name: str, encoding: str = "") -> tuple[str, str]:
    """Return the text and a sentence on its encoding; `encoding` is what the user says. Raises TableError."""
    for mark, marked in MARKS:
        if data.startswith(mark):
            return _decoded(data.removeprefix(mark), name, marked), f"{name} is {marked.upper()} by its byte order mark"
    if encoding:
        return _decoded(data, name, encoding), f"{name} is read as {encoding}, as you said"
    if b"\0" in data:
        return _without_mark(data, name)
    try:
        return data.decode(), f"{name} is UTF-8"
    except UnicodeDecodeError as error:
        found = f"{name} is no UTF-8 (byte 0x{data[error.start]:02X} in line {_line(data, error.start)})"
    try:
        return data.decode(WESTERN), f"{found}: it is read as Windows-1252; another is chosen with --encoding"
    except UnicodeDecodeError:
        return data.decode("latin-1"), f"{found}: it is read as Latin-1; another is chosen with --encoding"


def _without_mark(data: bytes, name: str) -> tuple[str, str]:
    """Text of two bytes a character, told by where its zeros are. Raises TableError for what is no text."""
    even, odd = data[::2].count(0), data[1::2].count(0)
    for most, least, encoding in ((odd, even, "utf-16-le"), (even, odd, "utf-16-be")):
        if most > len(data) * 0.3 and least < len(data) * 0.05 and len(data) % 2 == 0:
            return _decoded(data, name, encoding), f"{name} is {encoding.upper()} by its zero bytes"
    line = _line(data, data.index(0))
    message = f"{name}:{line}: this line holds a NUL byte, so this is no text: save the table as CSV or XLSX"
    raise TableError(message, line)


def _decoded(data: bytes, name: str, encoding: str) -> str:
    try:
        text = data.decode(encoding)
    except UnicodeDecodeError as error:
        line = _line(data, error.start)
        message = f"{name}:{line}: the byte 0x{data[error.start]:02X} is no {encoding.upper()}: choose with --encoding"
        raise TableError(message, line) from None
    except (LookupError, ValueError):
        message = f"--encoding {encoding}: there is no such encoding; utf-8, cp1252, latin-1, cp1250 and gbk are some"
        raise TableError(message) from None
    if "\0" in text:
        line = text.count("\n", 0, text.index("\0")) + 1
        message = f"{name}:{line}: this line holds a NUL character, so this is no text: save the table anew"
        raise TableError(message, line)
    return text


def _line(data: bytes, start: int) -> int:
    return data.count(b"\n", 0, start) + 1
