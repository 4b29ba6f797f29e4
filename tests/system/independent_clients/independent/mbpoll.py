"""mbpoll, a command-line master on libmodbus: one process for each request, its output read back."""

import re
import struct
import subprocess
from typing import ClassVar, Self

from independent.answers import Answer, Partly, Question, Raw, Read, Refused, Silent, Unable, Values, Write, Written

TABLES = {1: "0", 2: "1", 3: "4", 4: "3", 5: "0", 6: "4", 15: "0", 16: "4"}
"""mbpoll's data types; it chooses the function: one value is written by 05 or 06, several by 15 or 16."""

CODES = {
    "Illegal function": 1,
    "Illegal data address": 2,
    "Illegal data value": 3,
    "Negative acknowledge": 7,
    "Gateway path unavailable": 10,
    "Target device failed to respond": 11,
}
"""libmodbus' words for exception codes."""

SHORT_ECHO = "Invalid data"
"""libmodbus' word for an answer that confirms another number of values than was sent."""

_VALUE = re.compile(r"^\[\d+\]:\s+(\S+)(?: \((-?\d+)\))?\s*$", re.MULTILINE)
_PROBLEM = re.compile(r"failed: (.+)$", re.MULTILINE)
_STUCK = 15.0


class Mbpoll:
    """mbpoll on TCP, or on a serial line (a pty)."""

    name: ClassVar[str] = "mbpoll"

    def __init__(self, target: list[str]) -> None:
        self._target = target

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        """Nothing stays open between two requests."""

    def ask(self, unit: int, question: Question, patience: float = 3.0) -> Answer:
        """Send one request; what came of it."""
        match question:
            case Read(function, address, count):
                kind = TABLES[function] + (":hex" if TABLES[function] in "34" else "")
                done = self._run(unit, address, kind, patience, count=count)
                return self._judge(done) or Values(tuple(int(shown, 0) for shown, _ in _VALUE.findall(done.stdout)))
            case Write(function, address, words):
                if function in {15, 16} and len(words) == 1:
                    return Unable("mbpoll writes a single value by function 05 or 06")
                numbers = [str(word) for word in words]
                done = self._run(unit, address, TABLES[function], patience, values=numbers)
                return self._judge(done) or Written()
            case Raw():
                return Unable("mbpoll sends functions 01 to 06, 15 and 16 only")

    def signed(self, unit: int, address: int, count: int) -> tuple[int, ...]:
        """Return `count` integers: what mbpoll puts in brackets behind a word with the highest bit set."""
        done = self._good(self._run(unit, address, "4", 3.0, count=count))
        return tuple(int(signed or plain) for plain, signed in _VALUE.findall(done))

    def floats(self, unit: int, address: int, count: int, *, swapped: bool) -> tuple[float, ...]:
        """Return `count` IEEE numbers; mbpoll shows six digits of each."""
        done = self._good(self._run(unit, address, "4:float", 3.0, count=count, options=_order(swapped=swapped)))
        return tuple(float(shown) for shown, _ in _VALUE.findall(done))

    def text(self, unit: int, address: int, words: int) -> str:
        """Return characters; this mbpoll knows no texts, so they are taken from its hexadecimal output."""
        done = self._good(self._run(unit, address, "4:hex", 3.0, count=words))
        return b"".join(struct.pack(">H", int(shown, 0)) for shown, _ in _VALUE.findall(done)).decode("latin-1")

    def write_float(self, unit: int, address: int, number: float, *, swapped: bool) -> Answer:
        """Write one IEEE number."""
        options = _order(swapped=swapped)
        return (
            self._judge(self._run(unit, address, "4:float", 3.0, values=[repr(number)], options=options)) or Written()
        )

    def _run(
        self,
        unit: int,
        address: int,
        kind: str,
        patience: float,
        *,
        count: int = 0,
        values: list[str] | None = None,
        options: tuple[str, ...] = (),
    ) -> "subprocess.CompletedProcess[str]":
        head = [
            "mbpoll",
            "-0",
            "-1",
            "-a",
            str(unit),
            "-r",
            str(address),
            "-t",
            kind,
            "-o",
            f"{patience:.2f}",
            *options,
        ]
        asked = ["-c", str(count)] if count else []
        return subprocess.run(  # noqa: S603 (a fixed program, no shell)
            [*head, *asked, *self._target, *(values or [])],
            capture_output=True,
            text=True,
            timeout=_STUCK,
            check=False,
        )

    @staticmethod
    def _judge(done: "subprocess.CompletedProcess[str]") -> Answer | None:
        """Read what went wrong; None if nothing did."""
        if done.returncode == 0:
            return None
        problem = _PROBLEM.search(done.stderr)
        said = problem[1].strip() if problem else ""
        if said in CODES:
            return Refused(CODES[said])
        if said == SHORT_ECHO:
            return Partly(None)
        if said == "Connection timed out":
            return Silent()
        if "out of range" in done.stderr or "Try -h" in done.stderr:
            return Unable(done.stderr.strip())
        message = f"mbpoll failed otherwise: {done.stderr.strip() or done.stdout.strip()}"
        raise AssertionError(message)

    def _good(self, done: "subprocess.CompletedProcess[str]") -> str:
        problem = self._judge(done)
        assert problem is None, problem
        return done.stdout


def _order(*, swapped: bool) -> tuple[str, ...]:
    return () if swapped else ("-B",)


class MbpollTcp(Mbpoll):
    """mbpoll on Modbus TCP."""

    name = "mbpoll TCP"

    def __init__(self, host: str, port: int) -> None:
        super().__init__(["-p", str(port), host])


class MbpollRtu(Mbpoll):
    """mbpoll on a serial line."""

    name = "mbpoll RTU"

    def __init__(self, path: str) -> None:
        super().__init__(["-m", "rtu", "-b", "115200", "-P", "none", path])
