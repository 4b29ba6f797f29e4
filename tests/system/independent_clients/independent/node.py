"""modbus-serial of Node, driven through a process that takes one JSON line a request."""

import json
import os
import subprocess
from pathlib import Path
from typing import Any, ClassVar, Self

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

HERE = Path(__file__).parents[1] / "node"
MODULES = Path(__file__).parents[4] / ".cache" / "wire" / "node_modules"


class Node:
    """modbus-serial on TCP (MBAP or RTU), or on a serial line (a pty; RTU or ASCII)."""

    name: ClassVar[str] = "modbus-serial"
    transport: ClassVar[str] = ""

    def __init__(self, *target: str) -> None:
        self._target = target

    def __enter__(self) -> Self:
        self._process = subprocess.Popen(  # noqa: S603 (a fixed program, no shell)
            ["node", str(HERE / "talk.js"), self.transport, *self._target],  # noqa: S607 (as installed)
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            env={**os.environ, "NODE_PATH": str(MODULES)},
        )
        return self

    def __exit__(self, *_: object) -> None:
        self._process.kill()
        self._process.communicate()

    def ask(self, unit: int, question: Question, patience: float = 3.0) -> Answer:
        """Send one request; what came of it."""
        match question:
            case Read(function, address, count):
                said = self._say(unit, patience, do="read", function=function, address=address, count=count)
                return self._judge(said) or Values(tuple(map(int, said["values"])))
            case Write(function, address, words):
                said = self._say(unit, patience, do="write", function=function, address=address, words=words)
                if (problem := self._judge(said)) is not None:
                    return problem
                return Written() if said["written"] == len(words) else Partly(said["written"])
            case Raw(function, data):
                if function not in range(65, 73) or self.transport != "tcp":
                    return Unable("modbus-serial sends of other functions only 65 to 72 and 100 to 110, and over TCP")
                said = self._say(unit, patience, do="custom", function=function, data=list(data))
                return self._judge(said) or Payload(bytes(said["data"]))

    def signed(self, unit: int, address: int, count: int) -> tuple[int, ...]:
        """Return `count` integers."""
        return tuple(self._good(unit, do="signed", address=address, count=count)["values"])

    def floats(self, unit: int, address: int, count: int, *, swapped: bool) -> tuple[float, ...]:
        """Return `count` IEEE numbers."""
        return tuple(self._good(unit, do="floats", address=address, count=count, swapped=swapped)["values"])

    def text(self, unit: int, address: int, words: int) -> str:
        """Return characters."""
        return str(self._good(unit, do="text", address=address, count=words)["text"])

    def write_float(self, unit: int, address: int, number: float, *, swapped: bool) -> Answer:
        """Write one IEEE number."""
        said = self._say(unit, 3.0, do="write_float", address=address, number=number, swapped=swapped)
        return self._judge(said) or Written()

    def _say(self, unit: int, patience: float, **request: Any) -> dict[str, Any]:
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._process.stdin.write(json.dumps({"unit": unit, "patience": round(1000 * patience), **request}) + "\n")
        self._process.stdin.flush()
        line = self._process.stdout.readline()
        assert line, f"node ended with {self._process.poll()}"
        said: dict[str, Any] = json.loads(line)
        return said

    @staticmethod
    def _judge(said: dict[str, Any]) -> Answer | None:
        """Read what went wrong; None if nothing did."""
        if said.get("exception"):
            return Refused(said["exception"])
        if said.get("silent"):
            return Silent()
        assert "problem" not in said, said["problem"]
        return None

    def _good(self, unit: int, **request: Any) -> dict[str, Any]:
        said = self._say(unit, 3.0, **request)
        assert self._judge(said) is None, said
        return said


class NodeTcp(Node):
    """modbus-serial on Modbus TCP."""

    name = "modbus-serial TCP"
    transport = "tcp"

    def __init__(self, host: str, port: int) -> None:
        super().__init__(host, str(port))


class NodeRtuTcp(NodeTcp):
    """modbus-serial on RTU over TCP."""

    name = "modbus-serial RTU/TCP"
    transport = "rtu-tcp"


class NodeRtu(Node):
    """modbus-serial on a serial line."""

    name = "modbus-serial RTU"
    transport = "rtu"


class NodeAscii(Node):
    """modbus-serial on a serial line, ASCII."""

    name = "modbus-serial ASCII"
    transport = "ascii"
