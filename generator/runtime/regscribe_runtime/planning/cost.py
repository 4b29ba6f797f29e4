"""Time that a read takes on a real line: frames, silences, and the device's own latency.

Costs are whole nanoseconds, so that plans are exact and the same on every machine.
"""

from typing import NamedTuple

from regscribe_runtime.values.numbers import Number
from regscribe_runtime.values.protocol import Latency, Protocol, SerialDefaults
from regscribe_runtime.values.serial_line import SerialLine
from regscribe_runtime.values.wire_types import WRITE_AND_READ, Space

BITS_IN_BYTE, BITS_IN_WORD, BYTES_IN_WORD = 8, 16, 2
NANOSECONDS = 1_000_000
"""Nanoseconds in a millisecond."""

TCP_ROUND_TRIP = 1.0
"""Milliseconds assumed for a request and its answer on a local network, with the stacks at both ends."""

MBAP_BYTES = 7
"""Transaction, protocol, length and unit before a PDU over TCP."""

REQUEST_BYTES = {Space.STATUS: 1, Space.FILE: 9, Space.QUEUE: 3, Space.IDENTIFICATION: 4}
"""Bytes of a request to read, where they are not 5: function code, address, quantity."""
ANSWER_BYTES = {Space.FILE: 4, Space.QUEUE: 5, Space.IDENTIFICATION: 9}
"""Bytes of an answer before the values, where they are not 2: function code, byte count."""

BIT_WRITES, SINGLE_WRITES = Space.COIL.write_functions, frozenset({5, 6})
WRITE_HEAD = 5
"""Bytes of a write of one value, and of any answer to a write; a write of several has a byte count and the values."""

TCP_BYTE = 80
"""Nanoseconds of a byte at 100 Mbit/s."""


class Tariff(NamedTuple):
    """Cost of reads of one space in nanoseconds: a fixed part, and one for each word.

    Of bits, eight make a byte on the wire and sixteen count as a word of the device's latency.
    """

    fixed: int
    per_word: int = 0
    per_byte: int = 0
    bits: bool = False

    def of(self, quantity: int) -> int:
        """The cost of one request for `quantity` addresses."""
        if self.bits:
            return (
                self.fixed - self.per_byte * (-quantity // BITS_IN_BYTE) - self.per_word * (-quantity // BITS_IN_WORD)
            )
        return self.fixed + self.per_word * quantity

    def saved(self, addresses: int) -> int:
        """The least that a request costs less with so many addresses less."""
        if self.bits:
            return self.per_byte * (addresses // BITS_IN_BYTE) + self.per_word * (addresses // BITS_IN_WORD)
        return self.per_word * addresses


class Cost(NamedTuple):
    """Cost of requests to one device: `line` is the serial line (None: none is known), `framing` rtu or ascii.

    `round_trip` is what a network adds to every request, in ms. Of the device's `latencies` the expected time is the
    mean of the shortest and the longest; `pause` is the ms that it needs between requests. What the map does not state
    costs nothing.
    """

    line: SerialLine | None = None
    gap: Number = SerialDefaults().gap
    round_trip: float = 0.0
    latencies: tuple[Latency, ...] = ()
    framing: str = "rtu"
    pause: Number = 0

    @classmethod
    def of(cls, protocol: Protocol, line: SerialLine | None) -> "Cost":
        """Over the line of a link; over TCP without one."""
        return (
            cls(line, protocol.serial.gap, 0, protocol.latencies, pause=protocol.pause) if line else cls.tcp(protocol)
        )

    @classmethod
    def serial(cls, protocol: Protocol, *, baud: int = 0, form: str = "", framing: str = "rtu") -> "Cost":
        """Over a serial line, by default with the device's own speed and format."""
        line = SerialLine.of("", baud or protocol.serial.baud, form or protocol.serial.format)
        return cls(line, protocol.serial.gap, 0, protocol.latencies, framing, protocol.pause)

    @classmethod
    def tcp(cls, protocol: Protocol, *, line: SerialLine | None = None, framing: str = "rtu") -> "Cost":
        """Over TCP; `line` is the one behind a gateway, if it is known."""
        return cls(line, protocol.serial.gap, TCP_ROUND_TRIP, protocol.latencies, framing, protocol.pause)

    def tariff(self, space: Space, written: int = 0) -> Tariff:
        """The cost of reads of one space; of those that write so many words first, by function 23."""
        bits = space.is_bits
        fixed, per_byte = self._frames(_read_size(space, written), ANSWER_BYTES.get(space, 2))
        device, per_word = self._latency(WRITE_AND_READ if written else space.read_function)
        fixed += device
        if not bits:
            per_word, per_byte = per_word + BYTES_IN_WORD * per_byte, 0
        return Tariff(round(fixed * NANOSECONDS), round(per_word * NANOSECONDS), round(per_byte * NANOSECONDS), bits)

    def of_write(self, function: int, count: int) -> int:
        """The cost of a write of so many words or bits, in nanoseconds."""
        frames, _ = self._frames(_write_size(function, count), WRITE_HEAD)
        fixed, per_word = self._latency(function)
        words = -(-count // BITS_IN_WORD) if function in BIT_WRITES else count
        return round((frames + fixed + per_word * words) * NANOSECONDS)

    def _latency(self, function: int) -> tuple[float, float]:
        """Milliseconds that the device takes for a request, and for each word of it."""
        latency = next((one for one in self.latencies if one.function == function), None)
        if latency is None:
            return float(self.pause), 0.0
        character = 1000 * self.line.character if self.line else 0
        fixed = float(latency.minimum + latency.maximum) / 2 + float(latency.characters) * character
        return fixed + float(self.pause), float(latency.minimum_per_word + latency.maximum_per_word) / 2

    def _frames(self, request: int, answer: int) -> tuple[float, float]:
        """Milliseconds of both frames without the values, and of a byte of values; `request`, `answer`: PDU bytes."""
        byte = TCP_BYTE / NANOSECONDS
        fixed = self.round_trip + (request + answer + 2 * MBAP_BYTES) * byte if self.round_trip else 0.0
        if self.line is None:
            return fixed, byte
        ascii_frames = self.framing == "ascii"
        silences = 0 if ascii_frames else 2 * self.line.silence(float(self.gap))
        fixed += 1000 * ((self._characters(request) + self._characters(answer)) * self.line.character + silences)
        return fixed, 1000 * self.line.character * (2 if ascii_frames else 1)

    def _characters(self, pdu: int) -> int:
        """Of the frame around a function code and its data: with unit and CRC, or the ASCII one with LRC."""
        return 3 + 2 * (pdu + 2) if self.framing == "ascii" else pdu + 3

    def frame_bytes(self, space: Space, quantity: int, written: int = 0) -> int:
        """The characters on the line (bytes over TCP) of a request (see `tariff`) and its answer."""
        values = -(-quantity // BITS_IN_BYTE) if space.is_bits else BYTES_IN_WORD * quantity
        return self._bytes(_read_size(space, written), ANSWER_BYTES.get(space, 2) + values)

    def write_bytes(self, function: int, count: int) -> int:
        """As `frame_bytes`, of a write of so many words or bits."""
        return self._bytes(_write_size(function, count), WRITE_HEAD)

    def _bytes(self, *pdus: int) -> int:
        return sum(map(self._characters, pdus)) if self.line else sum(pdus) + 2 * MBAP_BYTES


def _read_size(space: Space, written: int) -> int:
    """Bytes of a PDU that reads, or that writes so many words before."""
    return REQUEST_BYTES.get(space, 5) + (WRITE_HEAD + BYTES_IN_WORD * written if written else 0)


def _write_size(function: int, count: int) -> int:
    """Bytes of a PDU that writes."""
    if function in SINGLE_WRITES:
        return WRITE_HEAD
    return WRITE_HEAD + 1 + (-(-count // BITS_IN_BYTE) if function in BIT_WRITES else BYTES_IN_WORD * count)


def milliseconds(nanoseconds: int) -> float:
    """A cost in milliseconds."""
    return nanoseconds / NANOSECONDS
