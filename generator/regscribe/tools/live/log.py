"""Logs of watched registers, by the ending of the file: CSV, JSON lines, SQLite. Each holds whole rounds only.

A round is written at once; where that fails (a full disk) the file is cut back to the last whole round. A log that
exists is continued if it is one of the same kind, and left alone otherwise.
"""

import csv
import io
import os
import sqlite3
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

from regscribe.tools.live.errors import TargetError, meant
from regscribe.tools.live.watch import Round
from regscribe.visible import cell, json_text

COLUMNS = ("time", "device", "register", "value", "unit", "error")
ENDINGS = (".csv", ".jsonl", ".ndjson", ".sqlite", ".sqlite3", ".db")
TABLE = "readings"
READ_AT_ONCE = 1 << 16


class LogError(Exception):
    """The log cannot be written; it holds every round before."""


class TextLog:
    """A log of lines after a `head`: each round is one write, and the file is cut back to `whole` bytes if it fails."""

    def __init__(self, path: Path, device: str, lines: Callable[[Round, str], bytes], head: bytes = b"") -> None:
        self.path, self.device, self.lines, self.head = path, device, lines, head
        self.file = io.FileIO(path, "a+")
        try:
            self.whole = self._begin()
        except BaseException:
            self.file.close()
            raise

    def write(self, one: Round) -> None:
        """Add a round; LogError if it cannot be kept whole."""
        self._append(self.lines(one, self.device), f"the round of {one.time.isoformat()}")

    def close(self) -> None:
        """End the log; harmless twice."""
        self.file.close()

    def _begin(self) -> int:
        end = os.fstat(self.file.fileno()).st_size
        if not end:
            self.whole = 0
            self._append(self.head, "the first line")
            return len(self.head)
        start = self._read(max(len(self.head), 1), 0)
        if start != (self.head or b"{"):
            message = f"{self.path} exists and is no log of this kind: name another file"
            raise TargetError(message)
        found = -1
        while found < 0 < end:  # a line that ends in the middle was cut off when its writer was
            start_of_block = max(end - READ_AT_ONCE, 0)
            found = self._read(end - start_of_block, start_of_block).rfind(b"\n")
            end = start_of_block
        self.file.truncate(end + found + 1)
        return end + found + 1

    def _read(self, count: int, place: int) -> bytes:
        self.file.seek(place)  # what is written goes to the end all the same
        return self.file.read(count)

    def _append(self, data: bytes, what: str) -> None:
        left = memoryview(data)
        try:
            while left:
                left = left[self.file.write(left) :]
        except OSError as error:
            with suppress(OSError):
                self.file.truncate(self.whole)
            raise _unwritten(self.path, what, error) from None
        self.whole += len(data)


def _csv_lines(one: Round, device: str) -> bytes:
    text = io.StringIO()
    rows = _rows(one, device)
    cells = [[cell(value) if isinstance(value, str) else value for value in row] for row in rows]
    csv.writer(text, lineterminator="\n").writerows(cells)
    return text.getvalue().encode()


def _json_line(one: Round, device: str) -> bytes:
    return (json_text(plain(one, device)) + "\n").encode()


class SqliteLog:
    """A log in a table of SQLite: each round is one transaction."""

    def __init__(self, path: Path, device: str) -> None:
        self.path, self.device = path, device
        self.base = sqlite3.connect(path)
        columns = [row[1] for row in self.base.execute(f"PRAGMA table_info({TABLE})")]
        if columns and columns != list(COLUMNS):
            self.base.close()
            message = f"{path} has a table `{TABLE}` of another kind: name another file"
            raise TargetError(message)
        with self.base:
            self.base.execute(f"CREATE TABLE IF NOT EXISTS {TABLE} ({', '.join(COLUMNS)})")

    def write(self, one: Round) -> None:
        """Add a round; LogError if it cannot be kept whole."""
        places = ", ".join("?" for _ in COLUMNS)
        try:
            with self.base:
                self.base.executemany(f"INSERT INTO {TABLE} VALUES ({places})", _rows(one, self.device))  # noqa: S608 - our own names
        except sqlite3.Error as error:
            raise _unwritten(self.path, f"the round of {one.time.isoformat()}", error) from None

    def close(self) -> None:
        """End the log; harmless twice."""
        self.base.close()


def open_log(path: Path, device: str) -> TextLog | SqliteLog:
    """A log at `path`, new or continued; TargetError for another ending or kind of file, LogError for no access."""
    ending = path.suffix.lower()
    if ending not in ENDINGS:
        message = f"{path}: a log ends in .csv, .jsonl or .sqlite{meant(ending, ENDINGS) if ending else ''}"
        raise TargetError(message)
    try:
        if ending == ".csv":
            return TextLog(path, device, _csv_lines, (",".join(COLUMNS) + "\n").encode())
        if ending in {".jsonl", ".ndjson"}:
            return TextLog(path, device, _json_line)
        return SqliteLog(path, device)
    except (OSError, sqlite3.OperationalError) as error:
        message = f"{path} cannot be written: {_reason(error)}"
        raise LogError(message) from None
    except sqlite3.Error as error:
        message = f"{path} is no log: {_reason(error)}"
        raise TargetError(message) from None


def plain(one: Round, device: str) -> dict[str, Any]:
    """A round as JSON has it: `registers` by name, each with value and unit, or with an error."""
    registers: dict[str, Any] = {}
    for each in one.readings:
        good = {"value": each.value, "unit": each.unit}
        registers[each.name] = good if each.error is None else {"error": str(each.error)}
    error = None if one.error is None else str(one.error)
    return {"time": one.moment, "device": device, "registers": registers, "error": error}


def _rows(one: Round, device: str) -> list[tuple[Any, ...]]:
    """A round as rows of `COLUMNS`."""
    if one.error is not None:
        return [(one.moment, device, "", None, "", str(one.error))]
    rows = []
    for each in one.readings:
        value = each.text if isinstance(each.value, list) else each.value
        error = "" if each.error is None else str(each.error)
        rows.append((one.moment, device, each.name, value, each.unit, error))
    return rows


def _unwritten(path: Path, what: str, error: Exception) -> LogError:
    return LogError(f"{path}: {what} could not be written ({_reason(error)}); the log is whole up to there")


def _reason(error: Exception) -> str:
    return (getattr(error, "strerror", None) or str(error)).lower()
