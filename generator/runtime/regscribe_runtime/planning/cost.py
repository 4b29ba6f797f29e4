"""What a read costs in time on a real line: frames, silences, and the device's own latency.

Costs are whole nanoseconds, so that plans are exact and the same on every machine; people read them in milliseconds.
"""

from types import MappingProxyType
from typing import TYPE_CHECKING, NamedTuple

from regscribe_runtime.values.wire_types import Space

if TYPE_CHECKING:
    from collections.abc import Mapping

    from regscribe_runtime.operations.session import Latency, Protocol
    from regscribe_runtime.values.serial_line import Line

BITS_IN_BYTE, BITS_IN_WORD, BYTES_IN_WORD = 8, 16, 2
NANOSECONDS = 1_000_000
"""Nanoseconds in a millisecond."""

FASTEST_BY_CHARACTERS = 19_200
LEAST_GAP = 1.75
"""Above 19,200 baud the silence of 3.5 characters is a fixed time in ms (Modbus over Serial Line V1.02, 2.5.1.1)."""

TCP_ROUND_TRIP = 1.0
"""Milliseconds that a request and its answer are assumed to travel: a local network, and the stacks at both ends."""

TCP_BYTE = 80
"""Nanoseconds of a byte at 100 Mbit/s."""


class SerialLine(NamedTuple):
    """What of a serial line costs time: speed in baud, bits of a character (start and stop ones included), framing."""

    baud: int = 9600
    bits: int = 10
    framing: str = "rtu"

    @classmethod
    def of(cls, baud: int, form: str, framing: str = "rtu") -> "SerialLine":
        """A line of the character format `form` (8N1)."""
        return cls(baud, 1 + int(form[0]) + (form[1] != "N") + int(form[2:]), framing)

    @property
    def character(self) -> float:
        """Milliseconds of one character."""
        return 1000 * self.bits / self.baud

    def silence(self, characters: float) -> float:
        """Milliseconds of the silence around a frame; ASCII needs none."""
        if self.framing == "ascii":
            return 0
        least = LEAST_GAP if self.baud > FASTEST_BY_CHARACTERS else 0
        return max(least, characters * self.character)

    def frame(self, bytes_of_pdu: int) -> int:
        """Characters of the frame around a function code and its data: with unit and CRC, or the ASCII one with LRC."""
        return 3 + 2 * (bytes_of_pdu + 2) if self.framing == "ascii" else bytes_of_pdu + 3


class Tariff(NamedTuple):
    """What reads of one space cost, in nanoseconds: a part that is fixed, and one for each step of addresses.

    A word is a step; of bits, eight make a byte on the wire and sixteen count as a word of the device's latency.
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
        """What a request costs less at least, if it carries so many addresses less."""
        if self.bits:
            return self.per_byte * (addresses // BITS_IN_BYTE) + self.per_word * (addresses // BITS_IN_WORD)
        return self.per_word * addresses

    @property
    def slack(self) -> int:
        """What two requests of any lengths may differ by when both grow alike: bits cost by whole bytes."""
        return self.per_byte + self.per_word if self.bits else 0


class Cost(NamedTuple):
    """The price list of one device behind one line: `line` is None where no serial line is known to be in between.

    `round_trip` is what a network adds to every request, in ms; `latencies` are those of the device, whose expected
    time is the mean of its shortest and longest. What the map does not state costs nothing.
    """

    line: SerialLine | None = None
    gap: float = 3.5
    round_trip: float = 0.0
    latencies: "Mapping[int, Latency]" = MappingProxyType({})

    @classmethod
    def of(cls, protocol: "Protocol", line: "Line | None") -> "Cost":
        """Of the line that a link has; over TCP without one."""
        return cls.serial(protocol, baud=line.baud, form=line.format) if line else cls.tcp(protocol)

    @classmethod
    def serial(cls, protocol: "Protocol", *, baud: int = 0, form: str = "", framing: str = "rtu") -> "Cost":
        """Over a serial line, by default with the device's own speed and format."""
        line = SerialLine.of(baud or protocol.baud, form or protocol.format, framing)
        return cls(line, protocol.gap, 0, protocol.latencies)

    @classmethod
    def tcp(cls, protocol: "Protocol", *, line: SerialLine | None = None, round_trip: float = TCP_ROUND_TRIP) -> "Cost":
        """Over TCP: a price for each request; `line` is the one behind a gateway, if it is known."""
        return cls(line, protocol.gap, round_trip, protocol.latencies)

    def tariff(self, space: Space) -> Tariff:
        """The price list of one space."""
        function, bits = space.read_function, space.is_bits
        latency = self.latencies.get(function)
        fixed, per_byte = self._frames(1 if space is Space.STATUS else 5, 2)
        per_word = 0.0
        if latency:
            character = self.line.character if self.line else 0
            fixed += (latency.minimum + latency.maximum) / 2 + latency.characters * character
            per_word = (latency.minimum_per_word + latency.maximum_per_word) / 2
        if not bits:
            per_word, per_byte = per_word + BYTES_IN_WORD * per_byte, 0
        return Tariff(_nanoseconds(fixed), _nanoseconds(per_word), _nanoseconds(per_byte), bits)

    def _frames(self, request: int, answer: int) -> tuple[float, float]:
        """Milliseconds of both frames without the values, and of a byte of values."""
        byte = TCP_BYTE / NANOSECONDS
        fixed = self.round_trip + (self._bytes(request) + self._bytes(answer)) * byte if self.round_trip else 0.0
        if self.line is None:
            return fixed, byte
        characters = self.line.frame(request) + self.line.frame(answer)
        fixed += characters * self.line.character + 2 * self.line.silence(self.gap)
        return fixed, self.line.character * (2 if self.line.framing == "ascii" else 1)

    @staticmethod
    def _bytes(pdu: int) -> int:
        return pdu + 7  # unit, length, protocol, transaction

    def frame_bytes(self, space: Space, quantity: int) -> int:
        """The characters of a request and its answer, as they pass the line (or the bytes, over TCP)."""
        request = 1 if space is Space.STATUS else 5
        values = -(-quantity // BITS_IN_BYTE) if space.is_bits else BYTES_IN_WORD * quantity
        answer = 2 + values
        frame = self.line.frame if self.line else self._bytes
        return frame(request) + frame(answer)


def milliseconds(nanoseconds: int) -> float:
    """A cost for people and for JSON."""
    return nanoseconds / NANOSECONDS


def _nanoseconds(ms: float) -> int:
    return round(ms * NANOSECONDS)
