"""Finds frames and their direction in lines of logs, whatever program wrote them."""

import re
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from regscribe_runtime.wire.capture import CapturedFrame, frames

SENT, RECEIVED = "sent", "received"
MOST = 100_000
"""Characters of a line that are searched."""

_BRACKETS = re.compile(r"(?:[\[<][0-9A-Fa-f]{2}[\]>]\s*)+")
_PREFIXED = re.compile(r"(?:0x[0-9A-Fa-f]{1,2}[\s,]*)+")
_PAIRS = re.compile(r"(?<![0-9A-Za-z:.])[0-9A-Fa-f]{2}(?:[ :,\-\t]+[0-9A-Fa-f]{2})+(?![0-9A-Za-z])")
_SOLID = re.compile(r"(?<![0-9A-Za-z])(?:[0-9A-Fa-f]{2}){4,}(?![0-9A-Za-z])")
_BYTE = re.compile(r"(?:0x)?([0-9A-Fa-f]{1,2})")
_ASCII = re.compile(r":(?:[0-9A-Fa-f]{2}){3,}")
_DIRECTIONS = (
    (SENT, re.compile(r"\b(?:tx|sent|sending|send|request|query|out|write)\b|(?<![-=])[-=]+>|>>>?|→", re.IGNORECASE)),
    (RECEIVED, re.compile(r"\b(?:rx|received|receiving|recv|response|answer|reply|in)\b|<[-=]+|<<<?|←", re.IGNORECASE)),
)


class Captured(NamedTuple):
    """The frames of one line: its number (from 1), `direction` sent, received or "" where it does not say."""

    line: int
    direction: str
    frames: tuple[CapturedFrame, ...]


def captured(lines: Iterable[str], framing: str | None = None) -> Iterator[Captured]:
    """Yield the lines that may hold frames; sound frames are preferred to mere bytes."""
    for number, line in enumerate(lines, start=1):
        text = line[:MOST].strip()
        candidates = [found for raw in _candidates(text) if (found := frames(raw, framing))]
        if candidates:
            directions = [name for name, pattern in _DIRECTIONS if pattern.search(text)]
            best = min(
                candidates,
                key=lambda one: (any(frame.complaint for frame in one), -sum(len(frame.raw) for frame in one)),
            )
            yield Captured(number, directions[0] if len(directions) == 1 else "", tuple(best))


def _candidates(text: str) -> Iterator[bytes]:
    """Runs of bytes in a line, in every notation."""
    for found in _ASCII.findall(text):
        yield found.encode("ascii")
    for pattern in (_BRACKETS, _PREFIXED, _PAIRS, _SOLID):
        for found in pattern.findall(text):
            yield bytes(int(digits, 16) for digits in _BYTE.findall(found))
