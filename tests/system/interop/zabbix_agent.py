"""Zabbix agent 2 as a process of its own on loopback, asked as a server asks it; and steps of items, run by node."""

import json
import os
import shutil
import socket
import struct
import subprocess
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

HEAD = struct.Struct("<4sBII")
NOT_SUPPORTED = b"ZBX_NOTSUPPORTED\0"
PATIENCE = 30
LAST_PORT = 0x7FFF

STEPS = """
const asked = JSON.parse(require('fs').readFileSync(0, 'utf8'));
const run = (script, value) => {
  try { return ['value', String(new Function('value', script)(value))]; }
  catch (error) { return ['error', String(error)]; }
};
const told = asked.map(([script, value]) => run(script, value));
console.log(JSON.stringify(told));
"""


@dataclass(frozen=True, slots=True)
class Agent:
    """An agent that answers passive checks at this port."""

    port: int

    def ask(self, key: str) -> str:
        """Return what the agent tells of a key; an AssertionError if it supports none such."""
        with socket.create_connection(("127.0.0.1", self.port), timeout=PATIENCE) as line:
            data = key.encode()
            line.sendall(HEAD.pack(b"ZBXD", 1, len(data), 0) + data)
            answer = b"".join(iter(lambda: line.recv(4096), b""))
        said = answer[HEAD.size :]
        assert not said.startswith(NOT_SUPPORTED), (key, said.removeprefix(NOT_SUPPORTED))
        return said.decode()


@contextmanager
def agent(folder: Path) -> Iterator[Agent]:
    """Run an agent while the block runs; its files lie in the folder."""
    program = shutil.which("zabbix_agent2", path="/usr/sbin:/usr/bin")
    assert program is not None
    port = _free_port()
    settings = {
        "Server": "127.0.0.1",
        "ListenIP": "127.0.0.1",
        "ListenPort": port,
        "Hostname": "interop",
        "ControlSocket": folder / "agent.sock",
        "PidFile": folder / "agent.pid",
        "LogType": "file",
        "LogFile": folder / "agent.log",
        "Timeout": 10,
    }
    configuration = folder / "agent.conf"
    configuration.write_text("".join(f"{key}={value}\n" for key, value in settings.items()), encoding="utf-8")
    process = subprocess.Popen([program, "-c", str(configuration), "-f"], stdout=subprocess.DEVNULL)  # noqa: S603 (a fixed program)
    try:
        found = Agent(port)
        _wait(found, process)
        yield found
    finally:
        process.terminate()
        process.wait(PATIENCE)


def _free_port() -> int:
    """A port that nobody listens at; an agent takes none above 32767."""
    for port in range(20000 + os.getpid() % 10000, LAST_PORT):
        with socket.socket() as free, suppress(OSError):
            free.bind(("127.0.0.1", port))
            return port
    message = "no port is free for the agent"
    raise AssertionError(message)


def _wait(found: Agent, process: "subprocess.Popen[bytes]") -> None:
    end = time.monotonic() + PATIENCE
    while process.poll() is None and time.monotonic() < end:
        try:
            found.ask("agent.ping")
        except OSError:
            time.sleep(0.1)
        else:
            return
    message = f"the agent does not answer ({process.poll()})"
    raise AssertionError(message)


def run_scripts(asked: Sequence[tuple[str, str]]) -> list[tuple[str, str]]:
    """Return what scripts of items make of values: `value` or `error`, and its text."""
    node = shutil.which("node")
    assert node is not None
    done = subprocess.run(  # noqa: S603 (a fixed program)
        [node, "-e", STEPS], input=json.dumps(asked), capture_output=True, text=True, timeout=PATIENCE, check=True
    )
    return [(kind, text) for kind, text in json.loads(done.stdout)]
