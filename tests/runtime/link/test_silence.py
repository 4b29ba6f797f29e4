"""The silence between frames on a serial line, by a clock that goes on with what the line does and no further."""

from typing import Any

import pytest

from regscribe_runtime.link.exchange import Conversation
from regscribe_runtime.link.streams import Stream
from regscribe_runtime.values.serial_line import SerialLine
from regscribe_runtime.wire.requests import Request

from .conftest import frame

ANSWER = frame(1, b"\x03\x02\x00\x05")
LINE = SerialLine(baud=1200)


class Line(Stream):
    """A line with its own time, on which a device answers at once: when characters went out, and came in."""

    def __init__(self) -> None:
        self.now, self.coming = 1000.0, b""
        self.asked: list[float] = []
        self.answered: list[float] = []
        self.descriptor = -1

    def close(self) -> None:
        """Nothing to close."""

    def monotonic(self) -> float:
        return self.now

    def write(self, data: bytes) -> None:
        self.asked.append(self.now)
        self.now += len(data) * LINE.character
        self.coming = ANSWER

    def read(self) -> bytes:
        data, self.coming = self.coming, b""
        return data

    def wait(self, seconds: float) -> bool:
        """Let time pass until the answer is there, or until the seconds are over."""
        if not self.coming:
            self.now += seconds
            return False
        self.now += len(self.coming) * LINE.character
        self.answered.append(self.now)
        return True


@pytest.fixture
def line(monkeypatch: pytest.MonkeyPatch) -> Line:
    made = Line()
    for module in ("exchange", "line_discipline"):
        monkeypatch.setattr(f"regscribe_runtime.link.{module}.time", made)
    return made


def call(talk: Conversation, line: Line) -> Any:
    steps = talk.exchange(line, 1, Request(3, 0))
    try:
        seconds = next(steps)
        while True:
            seconds = steps.send(line.wait(seconds))
    except StopIteration as done:
        return done.value.words


@pytest.mark.parametrize("gap", [3.5, 4, 20])
def test_a_silence_separates_an_answer_from_the_next_request(line: Line, gap: float) -> None:
    talk = Conversation("rtu", addressing="modbus", line=LINE, gap=gap, echo=False)
    assert [call(talk, line) for _ in range(4)] == [(5,)] * 4
    silences = [after - before for before, after in zip(line.answered[:-1], line.asked[1:], strict=True)]
    assert silences == pytest.approx([gap * LINE.character] * 3)
