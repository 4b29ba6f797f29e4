"""Serial lines: port, speed, character format and the times that follow from them; changes of them; addressing."""

from itertools import product
from typing import Any, NamedTuple, Self

PARITY_NONE = "N"
PARITIES = (PARITY_NONE, "E", "O")
DATA_BITS = (7, 8)
STOP_BITS = (1, 2)
FORMATS = tuple(f"{data}{parity}{stop}" for data, parity, stop in product(DATA_BITS, PARITIES, STOP_BITS))
"""Every character format as one text: 8N1, 7E2."""

FRAMINGS = ("tcp", "rtu", "ascii")
"""Framings: with the header of Modbus TCP (MBAP), and those of serial lines."""

MODBUS, JBUS = "modbus", "jbus"
ADDRESSINGS = {MODBUS: 0, JBUS: 1}
"""The number of a device's first address: JBUS counts from 1 what Modbus counts from 0."""

FAST_BAUD, FAST_SILENCE = 19200, 0.00175
"""Above this speed the silence between frames is a fixed time (Modbus over Serial Line V1.02, 2.5.1.1)."""


def first_address(addressing: str) -> int:
    """The number of the first address; ValueError for an unknown addressing."""
    if addressing not in ADDRESSINGS:
        message = f"addressing {addressing!r} is none of {', '.join(ADDRESSINGS)}"
        raise ValueError(message)
    return ADDRESSINGS[addressing]


class SerialLine(NamedTuple):
    """A serial line: device, speed in baud, character format (`parity` is N, E or O). Without `port`, a bare format."""

    port: str = ""
    baud: int = 9600
    data_bits: int = 8
    parity: str = PARITY_NONE
    stop_bits: int = 1

    @classmethod
    def of(cls, port: str, baud: int, character: str) -> Self:
        """A line whose character format is one text: 8N1, 8E1, 7O2."""
        form = character.upper()
        if form not in FORMATS:
            message = f"character format {character!r} is none: write data bits, parity and stop bits such as 8N1"
            raise ValueError(message)
        return cls(port, baud, int(form[0]), form[1], int(form[2])).checked()

    @property
    def format(self) -> str:
        """The character format as one text: 8N1."""
        return f"{self.data_bits}{self.parity}{self.stop_bits}"

    @property
    def bits(self) -> int:
        """Bits of a character: start bit, data bits, parity bit if there is one, stop bits."""
        return 1 + self.data_bits + (self.parity != PARITY_NONE) + self.stop_bits

    @property
    def character(self) -> float:
        """Seconds that one character takes."""
        return self.bits / self.baud

    def silence(self, characters: float) -> float:
        """Seconds of silence between frames: above 19200 baud at least the fixed 1.75 ms; none for 0 characters."""
        spaced = characters * self.character
        return max(spaced, FAST_SILENCE) if spaced and self.baud > FAST_BAUD else spaced

    def checked(self) -> Self:
        """Return the line unchanged; ValueError if no serial port has such settings."""
        if self.baud <= 0:
            message = f"{self.baud} baud is no speed of a serial line"
            raise ValueError(message)
        if self.format not in FORMATS:
            message = f"character format {self.format} is none: 7 or 8 data bits, parity N, E or O, 1 or 2 stop bits"
            raise ValueError(message)
        return self

    def settings(self) -> dict[str, Any]:
        """The keyword arguments of pyserial."""
        return {"baudrate": self.baud, "bytesize": self.data_bits, "parity": self.parity, "stopbits": self.stop_bits}


class LineChange(NamedTuple):
    """Changed communication settings of a device, for its session and link; None: unchanged.

    Over TCP speed and format are those of a gateway, which a link cannot set: they stay as they are.
    """

    unit: int | None = None
    baud: int | None = None
    data_bits: int | None = None
    parity: str | None = None
    stop_bits: int | None = None
    addressing: str | None = None

    @property
    def line(self) -> dict[str, Any]:
        """The changed fields of the serial line."""
        found = {"baud": self.baud, "data_bits": self.data_bits, "parity": self.parity, "stop_bits": self.stop_bits}
        return {name: value for name, value in found.items() if value is not None}
