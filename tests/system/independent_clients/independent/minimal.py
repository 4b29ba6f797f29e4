"""minimalmodbus, a Python master for serial lines with framing and numbers of its own."""

from collections.abc import Callable
from typing import ClassVar, Self

import minimalmodbus

from independent.answers import (
    Answer,
    Partly,
    Payload,
    Question,
    Raw,
    Read,
    Refused,
    Silent,
    Unable,
    Values,
    Write,
    Written,
)

CODES = {
    "Slave reported illegal function": 1,
    "Slave reported illegal data address": 2,
    "Slave reported illegal data value": 3,
    "Slave reported negative acknowledge": 7,
}
"""minimalmodbus' words for exception codes."""

MOST_WORDS = 125
BITS_IN_BYTE = 8


class Minimal:
    """minimalmodbus on a serial line (a pty), RTU or ASCII."""

    name: ClassVar[str] = "minimalmodbus"
    mode: ClassVar[str] = minimalmodbus.MODE_RTU

    def __init__(self, path: str) -> None:
        self._path = path

    def __enter__(self) -> Self:
        self._instrument = minimalmodbus.Instrument(self._path, 1, mode=self.mode)
        self._instrument.serial.baudrate = 115200
        return self

    def __exit__(self, *_: object) -> None:
        self._instrument.serial.close()

    def ask(self, unit: int, question: Question, patience: float = 3.0) -> Answer:
        """Send one request; what came of it."""
        match question:
            case Read(function, address, count):
                return self._judge(unit, patience, lambda: Values(self._read(function, address, count)))
            case Write(function, address, words):
                return self._judge(unit, patience, lambda: self._write(function, address, words))
            case Raw(function, data):
                # The length of an answer to a function that it does not know is not known, so it waits to the end.
                return self._judge(
                    unit, min(patience, 0.3), lambda: Payload(self._instrument._perform_command(function, data))
                )

    def signed(self, unit: int, address: int, count: int) -> tuple[int, ...]:
        """Return `count` integers, one request each: minimalmodbus reads signed ones singly only."""
        instrument = self._to(unit)
        return tuple(int(instrument.read_register(address + place, signed=True)) for place in range(count))

    def floats(self, unit: int, address: int, count: int, *, swapped: bool) -> tuple[float, ...]:
        """Return `count` IEEE numbers, one request each."""
        instrument, order = self._to(unit), _order(swapped=swapped)
        return tuple(instrument.read_float(address + 2 * place, byteorder=order) for place in range(count))

    def text(self, unit: int, address: int, words: int) -> str:
        """Return characters."""
        return self._to(unit).read_string(address, words)

    def write_float(self, unit: int, address: int, number: float, *, swapped: bool) -> Answer:
        """Write one IEEE number."""

        def write() -> Answer:
            self._instrument.write_float(address, number, byteorder=_order(swapped=swapped))
            return Written()

        return self._judge(unit, 3.0, write)

    def send(self, data: bytes, patience: float = 0.3) -> bytes:
        """Put bytes on the line as they are; what came back."""
        port = self._instrument.serial
        port.timeout = patience
        port.write(data)
        received: bytes = port.read(256)
        return received

    def _to(self, unit: int, patience: float = 3.0) -> minimalmodbus.Instrument:
        self._instrument.address = unit
        self._instrument.serial.timeout = patience
        return self._instrument

    def _judge(self, unit: int, patience: float, act: Callable[[], Answer]) -> Answer:
        self._to(unit, patience)
        try:
            done = act()
        except ValueError as refused:
            return Unable(str(refused))
        except minimalmodbus.NoResponseError:
            return Silent()
        except minimalmodbus.SlaveReportedException as refusal:
            return Refused(CODES.get(str(refusal)))
        except minimalmodbus.InvalidResponseError as wrong:
            if "number of registers" in str(wrong).lower():
                return Partly(None)
            raise
        return done if unit else self._after_broadcast()

    def _after_broadcast(self) -> Answer:
        """Wait for an answer all the same: minimalmodbus itself expects none."""
        stray = self._instrument.serial.read(1)
        return Payload(stray) if stray else Silent()

    def _read(self, function: int, address: int, count: int) -> tuple[int, ...]:
        if function in {1, 2}:
            return tuple(self._instrument.read_bits(address, count, functioncode=function))
        if count <= MOST_WORDS:
            return tuple(self._instrument.read_registers(address, count, functioncode=function))
        data = address.to_bytes(2, "big") + count.to_bytes(2, "big")  # more than it would ask for itself
        answer = self._instrument._perform_command(function, data)
        return tuple(int.from_bytes(answer[at : at + 2], "big") for at in range(1, len(answer), 2))

    def _write(self, function: int, address: int, words: tuple[int, ...]) -> Answer:
        match function:
            case 5:
                self._instrument.write_bit(address, words[0])
            case 6:
                self._instrument.write_register(address, words[0], functioncode=6)
            case 15:
                self._instrument.write_bits(address, list(words))
            case _:
                self._instrument.write_registers(address, list(words))
        return Written()


def _order(*, swapped: bool) -> int:
    return minimalmodbus.BYTEORDER_LITTLE_SWAP if swapped else minimalmodbus.BYTEORDER_BIG


class MinimalRtu(Minimal):
    """minimalmodbus in RTU mode."""

    name = "minimalmodbus RTU"


class MinimalAscii(Minimal):
    """minimalmodbus in ASCII mode."""

    name = "minimalmodbus ASCII"
    mode = minimalmodbus.MODE_ASCII
