"""Serial ports: a serial device with its speed and format, or a pseudo terminal made here."""

import io
import os
import sys

import serial  # type: ignore[import-untyped]  # pyserial ships no types

from regscribe.simulate.errors import SimulatorError
from regscribe_runtime.values.serial_line import SerialLine

if sys.platform != "win32":
    import termios
    import tty

LOCAL_FLAGS = 3
"""Their index in the list of `termios.tcgetattr`."""


INSTEAD = "serve TCP, with RTU frames if the client wants them: --tcp 127.0.0.1:5020 --framing rtu"


class OpenLine:
    """An open serial line: `fd` for raw bytes (not blocking), `path` for the other side to open."""

    def __init__(self, path: str, fd: int, *, port: serial.Serial | None = None, held: int | None = None) -> None:
        self.path = path
        self.fd = fd
        self._port = port
        self._held = held

    def heard(self) -> None:
        """Let the next client set the line up as well; to be called when the present one has sent something.

        A pseudo terminal has no parity. The kernel ignores the wish, and the C library of Linux calls that an error if
        no other flag changed, as for the second client with the same settings. So a flag is put back that every client
        clears and that means nothing on a raw line: how erased characters are echoed.
        """
        if sys.platform != "win32" and self._held is not None:
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


def open_serial(path: str, line: SerialLine) -> OpenLine:
    """Open a serial device; SimulatorError if it is not named, absent, busy, not ours, or cannot be set to `line`."""
    if not path:
        message = "no serial device is named: give its path, such as /dev/ttyUSB0"
        raise SimulatorError(message)
    try:
        port = serial.Serial(path, timeout=0, write_timeout=0, exclusive=True, **line.checked().settings())
    except (OSError, ValueError) as problem:
        message = f"cannot open serial device {path!r} with {line.baud} baud {line.format}: {problem}"
        raise SimulatorError(message) from problem
    try:
        return OpenLine(path, port.fileno(), port=port)
    except io.UnsupportedOperation:
        port.close()
        message = f"{path}: on Windows no serial device can be served; {INSTEAD}"
        raise SimulatorError(message) from None


def open_pseudo_terminal() -> OpenLine:
    """Make a pseudo terminal; `path` is the end that a client opens. Closed clients may come back: it stays open.

    SimulatorError on Windows, which has none.
    """
    path, ours, theirs = _terminal()
    return OpenLine(path, ours, held=theirs)


if sys.platform == "win32":

    def _terminal() -> tuple[str, int, int]:
        message = f"Windows has no pseudo terminals; {INSTEAD}"
        raise SimulatorError(message)
else:

    def _terminal() -> tuple[str, int, int]:
        ours, theirs = os.openpty()
        tty.setraw(theirs)
        os.set_blocking(ours, False)
        return os.ttyname(theirs), ours, theirs
