"""Serial lines: a serial device with its speed and format, or a pseudo terminal made here."""

import os
import termios
import tty
from dataclasses import dataclass

import serial  # type: ignore[import-untyped]  # pyserial ships no types

from regscribe.simulate.errors import SimulatorError

_FORMAT_LENGTH = 3
LOCAL_FLAGS = 3
"""Where they stand in what `termios.tcgetattr` gives."""


@dataclass(frozen=True, slots=True)
class Line:
    """Speed in baud, and data bits, parity and stop bits as one text: 8N1, 8E1, 7E2."""

    baud: int = 9600
    format: str = "8N1"

    @property
    def character(self) -> float:
        """Seconds that one character takes: a start bit, the data bits, perhaps a parity bit, the stop bits."""
        data, parity, stop = _characters(self.format)
        return (1 + data + (parity != "N") + stop) / self.baud


class OpenLine:
    """An open serial line: `fd` to read and write raw bytes (not blocking), `path` for the other side to open."""

    __slots__ = ("_held", "_port", "fd", "path")

    def __init__(self, path: str, fd: int, *, port: serial.Serial | None = None, held: int | None = None) -> None:
        self.path = path
        self.fd = fd
        self._port = port
        self._held = held

    def heard(self) -> None:
        """Let the next client set the line up, too: to be called when the present one has sent something.

        A pseudo terminal has no parity. The kernel ignores the wish, and the C library of Linux calls that an error if
        no other flag changed, as for the second client with the same settings. So a flag is put back that every client
        clears and that means nothing on a raw line: how erased characters are echoed.
        """
        if self._held is None:
            return
        settings = termios.tcgetattr(self._held)
        if not settings[LOCAL_FLAGS] & termios.ECHOE:
            settings[LOCAL_FLAGS] |= termios.ECHOE
            termios.tcsetattr(self._held, termios.TCSANOW, settings)

    def close(self) -> None:
        """Close all that was opened."""
        if self._port is not None:
            self._port.close()
            return
        os.close(self.fd)
        if self._held is not None:
            os.close(self._held)


def open_serial(path: str, line: Line) -> OpenLine:
    """Open a serial device; SimulatorError if it is absent, busy, not ours, or cannot be set to `line`."""
    bits, parity, stop_bits = _characters(line.format)
    try:
        port = serial.Serial(path, line.baud, bits, parity, stop_bits, timeout=0, write_timeout=0, exclusive=True)
    except (OSError, ValueError) as problem:
        message = f"cannot open serial device {path!r} with {line.baud} baud {line.format}: {problem}"
        raise SimulatorError(message) from problem
    return OpenLine(path, port.fileno(), port=port)


def open_pseudo_terminal() -> OpenLine:
    """Make a pseudo terminal; `path` is the end that a client opens. Closed clients may come back: it stays open."""
    ours, theirs = os.openpty()
    tty.setraw(theirs)
    os.set_blocking(ours, False)
    return OpenLine(os.ttyname(theirs), ours, held=theirs)


def _characters(text: str) -> tuple[int, str, int]:
    """Return data bits, parity and stop bits of a character format."""
    form = text.upper()
    if len(form) != _FORMAT_LENGTH or form[0] not in "5678" or form[1] not in "NEOMS" or form[2] not in "12":
        message = f"character format is data bits, parity and stop bits such as 8N1, 8E1 or 7O2, not {text!r}"
        raise SimulatorError(message)
    return int(form[0]), form[1], int(form[2])
