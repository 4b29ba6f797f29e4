"""Protocol properties of a device: function codes, limits of requests, exceptions, latencies, serial line."""

from fractions import Fraction
from typing import NamedTuple

from regscribe_runtime.values.numbers import Number
from regscribe_runtime.values.serial_line import SerialLine
from regscribe_runtime.values.wire_types import Space

SHORTEST_TIMEOUT, MARGIN = 1.0, 0.5
"""In seconds: the least timeout, and the time of the frames, which is added to the longest latency."""


class ExceptionCode(NamedTuple):
    """An exception code of this device: its name and meaning in its manual, empty if there are none."""

    code: int
    name: str
    meaning: str


class Latency(NamedTuple):
    """Milliseconds from the end of a request to the start of its answer: a fixed part, and one for each word.

    `characters` character times at the speed of the line come on top.
    """

    function: int
    minimum: Number = 0
    maximum: Number = 0
    minimum_per_word: Number = 0
    maximum_per_word: Number = 0
    characters: Number = 0

    def longest(self, words: int) -> Number:
        """Milliseconds for so many words at most, without the characters."""
        return self.maximum + self.maximum_per_word * words


class SerialDefaults(NamedTuple):
    """The serial line: possible speeds in baud and character formats (8N1), and the settings as delivered.

    `modes` are the framings rtu and ascii, `gap` is the silence between frames in characters.
    """

    modes: tuple[str, ...] = ("rtu",)
    bauds: tuple[int, ...] = ()
    formats: tuple[str, ...] = ()
    baud: int = SerialLine().baud
    format: str = SerialLine().format
    gap: Number = Fraction(7, 2)

    @property
    def line(self) -> SerialLine:
        """The line as it is delivered."""
        return SerialLine.of("", self.baud, self.format)


class SpaceLimits(NamedTuple):
    """The most registers or bits of one space that one request reads or writes; 0: as in other spaces."""

    space: Space
    read: int = 0
    write: int = 0


class Protocol(NamedTuple):
    """What a device accepts: function codes, unit ids, words or bits in a request; its exceptions and latencies.

    `read_holes`: whether a read may run over addresses of no register (a planner may then bridge gaps). `broadcast` are
    the functions that may be sent to all units at once. `absent` is the exception code by which the device refuses an
    address that it does not have; 0: it keeps silent. `spaces` are the limits of single spaces, `pause` is what the
    device needs from an answer to the next request, in milliseconds.
    """

    functions: tuple[int, ...] = (3, 6, 16)
    unit_ids: tuple[int, int] = (1, 247)
    read_words: int = 125
    write_words: int = 123
    read_bits: int = 2000
    write_bits: int = 1968
    read_holes: bool = False
    broadcast: tuple[int, ...] = ()
    exceptions: tuple[ExceptionCode, ...] = ()
    latencies: tuple[Latency, ...] = ()
    serial: SerialDefaults = SerialDefaults()
    absent: int = 2
    spaces: tuple[SpaceLimits, ...] = ()
    pause: Number = 0

    def most_read(self, space: Space) -> int:
        """The most addresses of a space in one read."""
        own = next((one.read for one in self.spaces if one.space is space), 0)
        usual = self.read_bits if space.is_bits else self.read_words
        return space.most if space.is_whole else _whole(space, min(space.most, space.each * own or usual))

    def most_written(self, space: Space) -> int:
        """The most addresses of a space in one write."""
        own = next((one.write for one in self.spaces if one.space is space), 0)
        usual = self.write_bits if space.is_bits else self.write_words
        return _whole(space, min(space.most, space.each * own or usual))

    def most(self, function: int, space: Space) -> int:
        """The most addresses in one request of a function that reads or writes a space."""
        return self.most_read(space) if function == space.read_function else self.most_written(space)

    @property
    def timeout(self) -> float:
        """Seconds after which no good answer can come: the longest latency of a full request and a margin."""
        words = max(self.read_words, self.write_words)
        longest = max((float(one.longest(words)) for one in self.latencies), default=0.0)
        return max(SHORTEST_TIMEOUT, longest / 1000 + MARGIN)

    def exception(self, code: int) -> ExceptionCode:
        """The name and meaning of an exception code of this device."""
        return next((one for one in self.exceptions if one.code == code), ExceptionCode(code, "", ""))

    def latency(self, function: int) -> Latency | None:
        """The latency of a function; None where the manual does not say."""
        return next((one for one in self.latencies if one.function == function), None)


def _whole(space: Space, words: int) -> int:
    """As many of so many words as are whole registers."""
    return words - words % space.each
