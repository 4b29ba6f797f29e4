"""A serial line: its device, speed and character format, and how long a character takes on it."""

from typing import Any, NamedTuple, Self

PARITIES = "NEO"
PARITY_NONE = "N"
DATA_BITS = (7, 8)
STOP_BITS = (1, 2)
FORMAT_LENGTH = 3


class Line(NamedTuple):
    """A serial line: device, speed in baud, character format (`parity` is N, E or O)."""

    port: str
    baud: int
    data_bits: int = 8
    parity: str = PARITY_NONE
    stop_bits: int = 1

    @classmethod
    def of(cls, port: str, baud: int, character: str) -> Self:
        """A line whose character format is one text: 8N1, 8E1, 7O2."""
        if len(character) != FORMAT_LENGTH or not (character[0] + character[2]).isdigit():
            message = f"character format {character!r} is none: write data bits, parity and stop bits such as 8N1"
            raise ValueError(message)
        return cls(port, baud, int(character[0]), character[1].upper(), int(character[2])).checked()

    @property
    def format(self) -> str:
        """The character format as one text: 8N1."""
        return f"{self.data_bits}{self.parity}{self.stop_bits}"

    @property
    def character(self) -> float:
        """Seconds that one character takes: start bit, data bits, parity bit if there is one, stop bits."""
        return (1 + self.data_bits + (self.parity != PARITY_NONE) + self.stop_bits) / self.baud

    def checked(self) -> Self:
        """The line itself; ValueError if no serial port can be set so."""
        if self.baud <= 0:
            message = f"{self.baud} baud is no speed of a serial line"
            raise ValueError(message)
        if self.data_bits not in DATA_BITS or self.stop_bits not in STOP_BITS or self.parity not in tuple(PARITIES):
            message = f"character format {self.format} is none: 7 or 8 data bits, parity N, E or O, 1 or 2 stop bits"
            raise ValueError(message)
        return self

    def settings(self) -> dict[str, Any]:
        """The keyword arguments of pyserial."""
        return {"baudrate": self.baud, "bytesize": self.data_bits, "parity": self.parity, "stopbits": self.stop_bits}
