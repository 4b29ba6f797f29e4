"""Logs of what was watched, by the ending of the file: CSV, JSON lines, SQLite. What is in a log is whole.

A round is written at once; where that fails (a full disk) the file is cut back to the last whole round. A log that
exists is continued if it is one of the same kind, and left alone otherwise.
"""

import csv
import io
import os
import sqlite3
from abc import abstractmethod
from contextlib import suppress
from pathlib import Path
from typing import Any, Protocol

from regscribe.tools.live.errors import TargetError, meant
from regscribe.tools.live.watch import Round
from regscribe.visible import cell, json_text

COLUMNS = ("time", "device", "register", "value", "unit", "error")
TABLE = "readings"
READ_AT_ONCE = 1 << 16


class LogError(Exception):
    """A round could not be written; the log holds every round before it."""


class Log(Protocol):
    """Takes rounds until it is closed."""

    @abstractmethod
    def write(self, one: Round) -> None:
        """Add a round; LogError if it cannot be kept whole."""

    @abstractmethod
    def close(self) -> None:
        """End the log; harmless twice."""


def open_log(path: Path, device: str) -> Log:
    """A log at `path`, new or continued; TargetError for another ending, a file of another kind, or no access."""
    makers: dict[str, Any] = {
        ".csv": _Csv,
        **dict.fromkeys((".jsonl", ".ndjson"), _JsonLines),
        **dict.fromkeys((".sqlite", ".sqlite3", ".db"), _Sqlite),
    }
    ending = path.suffix.lower()
    if ending not in makers:
        message = f"{path}: a log ends in .csv, .jsonl or .sqlite{meant(ending, makers) if ending else ''}"
        raise TargetError(message)
    try:
        log: Log = makers[ending](path, device)
    except (OSError, sqlite3.Error) as error:
        message = f"{path} cannot be written: {_said(error)}"
        raise TargetError(message) from None
    return log


class _Text:
    """A log of lines: each round is one write, and the file is cut back to `whole` bytes if it fails."""

    head = b""

    def __init__(self, path: Path, device: str) -> None:
        self.path, self.device = path, device
        self.file = os.open(path, os.O_RDWR | os.O_CREAT | os.O_APPEND, 0o666)
        try:
            self.whole = self._begin()
        except BaseException:
            os.close(self.file)
            raise

    def write(self, one: Round) -> None:
        """Add the lines of a round."""
        self._append(self.lines(one), f"the round of {one.time.isoformat()}")

    def close(self) -> None:
        """Close the file."""
        if self.file >= 0:
            os.close(self.file)
            self.file = -1

    def lines(self, one: Round) -> bytes:
        """A round as lines."""
        raise NotImplementedError

    def _begin(self) -> int:
        size = os.fstat(self.file).st_size
        if not size:
            self.whole = 0
            self._append(self.head, "the first line")
            return len(self.head)
        start = os.pread(self.file, max(len(self.head), 1), 0)
        if start != (self.head or b"{"):
            message = f"{self.path} exists and is no log of this kind: name another file"
            raise TargetError(message)
        whole = self._end_of_last_line(size)
        os.ftruncate(self.file, whole)  # a line that ends in the middle was cut off when its writer was
        return whole

    def _end_of_last_line(self, size: int) -> int:
        end = size
        while end > 0:
            start = max(end - READ_AT_ONCE, 0)
            found = os.pread(self.file, end - start, start).rfind(b"\n")
            if found >= 0:
                return start + found + 1
            end = start
        return 0

    def _append(self, data: bytes, what: str) -> None:
        left = memoryview(data)
        try:
            while left:
                left = left[os.write(self.file, left) :]
        except OSError as error:
            with suppress(OSError):
                os.ftruncate(self.file, self.whole)
            raise _unwritten(self.path, what, error) from None
        self.whole += len(data)


class _Csv(_Text):
    head = (",".join(COLUMNS) + "\n").encode()

    def lines(self, one: Round) -> bytes:
        text = io.StringIO()
        csv.writer(text, lineterminator="\n").writerows(map(_shown, row) for row in _rows(one, self.device))
        return text.getvalue().encode()


class _JsonLines(_Text):
    def lines(self, one: Round) -> bytes:
        return (json_text(plain(one, self.device)) + "\n").encode()


class _Sqlite:
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
        places = ", ".join("?" for _ in COLUMNS)
        try:
            with self.base:
                self.base.executemany(f"INSERT INTO {TABLE} VALUES ({places})", _rows(one, self.device))  # noqa: S608 - our own names
        except sqlite3.Error as error:
            raise _unwritten(self.path, f"the round of {one.time.isoformat()}", error) from None

    def close(self) -> None:
        self.base.close()


def plain(one: Round, device: str) -> dict[str, Any]:
    """A round as JSON has it: `registers` by name, each with value and unit, or with an error."""
    registers: dict[str, Any] = {}
    for each in one.readings:
        good = {"value": each.value, "unit": each.unit}
        registers[each.name] = good if each.error is None else {"error": str(each.error)}
    error = None if one.error is None else str(one.error)
    return {"time": one.moment, "device": device, "registers": registers, "error": error}


def _rows(one: Round, device: str) -> list[tuple[Any, ...]]:
    if one.error is not None:
        return [(one.moment, device, "", None, "", str(one.error))]
    return [
        (
            one.moment,
            device,
            each.name,
            each.text if isinstance(each.value, list) else each.value,
            each.unit,
            "" if each.error is None else str(each.error),
        )
        for each in one.readings
    ]


def _shown(value: Any) -> Any:  # noqa: ANN401 - as above
    """A cell of a spreadsheet."""
    return cell(value) if isinstance(value, str) else value


def _unwritten(path: Path, what: str, error: Exception) -> LogError:
    return LogError(f"{path}: {what} could not be written ({_said(error)}); the log is whole up to there")


def _said(error: Exception) -> str:
    return (getattr(error, "strerror", None) or str(error)).lower()
