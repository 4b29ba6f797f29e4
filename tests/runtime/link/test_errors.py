"""One clear message for what can be wrong with a port or a host, with what to do."""

import asyncio
import errno
import os
import socket
import subprocess
import sys
import tty
from pathlib import Path
from typing import Any

import pytest
import serial  # type: ignore[import-untyped] # pyserial ships no types

from regscribe_runtime import LinkLost, Retry, WrongAnswer
from regscribe_runtime.link import connect
from regscribe_runtime.wire.requests import Request

HOLD = "import serial, sys; p = serial.Serial(sys.argv[1], exclusive=True); print('open', flush=True); sys.stdin.read()"


def opened(kind: str, *arguments: Any, **settings: Any) -> None:
    """Open and close a link."""
    if kind in {"tcp", "serial"}:
        getattr(connect, kind)(*arguments, **settings).open()
    else:
        asyncio.run(getattr(connect, kind)(*arguments, **settings).open())


@pytest.mark.parametrize("kind", ["serial", "async_serial"])
def test_a_port_that_another_process_has_open(kind: str) -> None:
    ours, theirs = os.openpty()
    tty.setraw(theirs)
    path = os.ttyname(theirs)
    with subprocess.Popen([sys.executable, "-c", HOLD, path], stdin=-1, stdout=-1, text=True) as other:  # noqa: S603 - ours
        assert other.stdout is not None
        other.stdout.readline()
        with pytest.raises(LinkLost, match="another program has it open"):
            opened(kind, path, baud=9600)
        other.communicate("")
    os.close(ours)
    os.close(theirs)


@pytest.mark.parametrize("kind", ["serial", "async_serial"])
def test_a_port_that_is_not_there(kind: str) -> None:
    with pytest.raises(LinkLost, match=r"cannot open /dev/ttyNONE: there is no such port. Plug .* ports here: "):
        opened(kind, "/dev/ttyNONE", baud=9600)


def test_a_port_that_is_not_ours(monkeypatch: pytest.MonkeyPatch) -> None:
    def denied(*_: Any, **__: Any) -> None:
        raise serial.SerialException(errno.EACCES, "could not open port")

    monkeypatch.setattr("regscribe_runtime.link.streams.serial.serial_for_url", denied)
    with pytest.raises(LinkLost, match=r"permission denied. Add your user to the group"):
        opened("serial", "/dev/ttyS0", baud=9600)


def test_a_file_that_is_no_port(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(LinkLost, match="Is it a serial port"):
        opened("serial", str(tmp_path / "file"), baud=9600)


@pytest.mark.parametrize("kind", ["tcp", "async_tcp"])
@pytest.mark.parametrize(
    ("host", "said"),
    [("host.invalid", "the host 'host.invalid' is unknown"), ("127.0.0.1", "refuses the connection, nobody answers")],
)
def test_a_host_that_is_not_there(kind: str, host: str, said: str) -> None:
    with pytest.raises(LinkLost, match=f"cannot open tcp://{host}:9: .*{said}"):
        opened(kind, host, port=9)


@pytest.mark.parametrize("host", ["a" * 300, ".."])
def test_a_host_name_that_is_none(host: str) -> None:
    with pytest.raises(LinkLost, match="is unknown"):
        opened("tcp", host)


def test_an_address_with_half_of_its_brackets_is_no_host() -> None:
    with pytest.raises(ValueError, match="is no host"):
        opened("tcp", "[::1")


def test_a_server_of_something_else_is_told_from_a_modbus_server() -> None:
    async def talk() -> None:
        async def attend(reader: Any, writer: Any) -> None:
            await reader.read(100)
            writer.write(b"HTTP/1.1 400 Bad Request\r\n\r\n")
            writer.close()

        server = await asyncio.start_server(attend, "127.0.0.1", 0)
        async with server:
            link = connect.async_tcp("127.0.0.1", port=server.sockets[0].getsockname()[1], retry=Retry(0))
            await link.open()
            with pytest.raises(WrongAnswer, match=r"is no header of Modbus TCP. Check the port and the framing"):
                await link.call(1, Request(3, 0))
            await link.close()

    asyncio.run(talk())


def test_no_descriptor_is_left_of_what_could_not_be_opened(open_descriptors: Any) -> None:
    before = open_descriptors()
    for kind, place in (("tcp", "127.0.0.1"), ("serial", "/dev/null")):
        with pytest.raises(LinkLost):
            opened(kind, place, **({"port": 9} if kind == "tcp" else {"baud": 9600}))
    assert open_descriptors() == before


@pytest.mark.parametrize("kind", ["tcp", "async_tcp"])
def test_a_connection_that_is_broken_off_leaves_no_socket_open(kind: str, monkeypatch: pytest.MonkeyPatch) -> None:
    made: list[socket.socket] = []

    class Interrupted(socket.socket):
        def __init__(self, *arguments: Any) -> None:
            super().__init__(*arguments)
            made.append(self)

        def setsockopt(self, *_: Any) -> None:
            raise KeyboardInterrupt

    with socket.create_server(("127.0.0.1", 0)) as server:
        monkeypatch.setattr(socket, "socket", Interrupted)
        with pytest.raises(KeyboardInterrupt):
            opened(kind, "127.0.0.1", port=server.getsockname()[1])
    assert [one.fileno() for one in made if isinstance(one, Interrupted)][:1] == [-1]
