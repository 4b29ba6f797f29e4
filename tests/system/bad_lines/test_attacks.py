"""Clients that flood, stall, never read or come in hordes: the others are served, and memory stays bounded."""

import asyncio
import contextlib
import socket
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from regscribe.simulate import Patience, Service, SimulatedDevice, Transport, simulate, start
from regscribe_runtime import Retry
from regscribe_runtime.link import connect
from regscribe_runtime.wire.framing import build
from regscribe_runtime.wire.requests import Request

from .world import FRAMINGS, LINE_FRAMINGS, furnace

READ = b"\x03\x00\x00\x00\x05"
PATIENCE = 60.0
"""Seconds after which an honest client would give up: only who is shut out for good waits so long."""
OVER_TCP = ("tcp", "rtu-tcp", "ascii-tcp")
WORST = {
    "tcp": b"\x00\x01\x00\x00\x00\xff\x01\x10",
    "rtu-tcp": b"\x10\x10\x10\x10\x10\x10\xff",
    "ascii-tcp": b":0103000000" + b"0" * 400,
}
"""What costs a server most to look through."""


@contextmanager
def served(**service: Any) -> Iterator[Any]:
    """A furnace on loopback, in a thread of its own."""
    register_map, _ = furnace()
    loop = asyncio.new_event_loop()
    thread = threading.Thread(target=loop.run_forever, daemon=True)
    thread.start()
    made = start([SimulatedDevice(register_map, "One", unit=1)], Service(**service))
    server: Any = asyncio.run_coroutine_threadsafe(made, loop).result(5)
    try:
        yield server
    finally:
        asyncio.run_coroutine_threadsafe(server.stop(), loop).result(10)
        loop.call_soon_threadsafe(loop.stop)
        thread.join(5)
        loop.close()


@contextmanager
def clients(server: Any, count: int) -> Iterator[list[socket.socket]]:
    made = [socket.create_connection((server.host, server.port), timeout=2) for _ in range(count)]
    try:
        yield made
    finally:
        for one in made:
            one.close()


def framed(transport: str, pdu: bytes) -> bytes:
    return build(FRAMINGS[transport], 1, pdu, 9)


@contextmanager
def honest(server: Any, transport: str) -> Iterator[Any]:
    """A link of our own, without any retry."""
    made = connect.tcp(
        server.host, port=server.port, framing=LINE_FRAMINGS[transport], timeout=PATIENCE, retry=Retry(0)
    )
    made.open()
    try:
        yield made
    finally:
        made.close()


def served_well(made: Any, times: int = 10) -> int:
    """How many of some honest reads were answered; each is right."""
    return sum(made.call(1, Request(3, 0, 5)).words == (70, 71, 72, 1, 4000) for _ in range(times))


def flood(sockets: Sequence[socket.socket], data: bytes, stop: threading.Event) -> None:
    """Send as fast as the server takes it, and never read."""
    for one in sockets:
        one.settimeout(0)
    while not stop.is_set():
        for one in sockets:
            with contextlib.suppress(OSError):
                one.send(data)
        time.sleep(0.0005)


@pytest.mark.parametrize("transport", OVER_TCP)
@pytest.mark.parametrize("what", ["noise", "requests"])
def test_clients_that_flood_and_never_read_do_not_keep_others_waiting(transport: str, what: str) -> None:
    data = WORST[transport] * 40 if what == "noise" else framed(transport, READ) * 100
    with served(transport=Transport(transport)) as server, honest(server, transport) as made:
        with clients(server, 6) as attackers:
            stop = threading.Event()
            attack = threading.Thread(target=flood, args=(attackers, data, stop))
            attack.start()
            try:
                assert served_well(made) == 10
            finally:
                stop.set()
                attack.join()
        for client in tuple(server.clients):
            assert client._writer.get_write_buffer_size() < 1 << 20
        assert served_well(made, 2) == 2


@pytest.mark.parametrize("transport", OVER_TCP)
def test_hordes_of_clients_that_stall_in_half_a_frame_neither_fill_the_server_nor_shut_others_out(
    transport: str,
) -> None:
    half = framed(transport, READ)[:5]
    with served(transport=Transport(transport), connections=16) as server, honest(server, transport) as earlier:
        before = len(list(Path("/proc/self/fd").iterdir()))
        with clients(server, 120) as stalling:
            for one in stalling:
                with contextlib.suppress(OSError):
                    one.sendall(half)
            with honest(server, transport) as made:
                assert served_well(made) == 10
                assert served_well(earlier) == 10  # it lost its place, and takes another one
                assert len(server.clients) <= 16
        assert len(list(Path("/proc/self/fd").iterdir())) <= before + 20


def test_silent_clients_are_disconnected_after_a_while() -> None:
    with served(patience=Patience(idle=0.1, gap=0.05)) as server, clients(server, 3) as silent:
        for one in silent:
            assert one.recv(10) == b""


def test_a_simulator_can_be_reached_from_this_machine_alone_unless_told_otherwise() -> None:
    with simulate(furnace()[0], "One", unit=1) as running:
        assert running.host == "127.0.0.1"
        with contextlib.closing(socket.socket()) as other:
            other.bind(("127.0.0.2", running.port))  # taken, if the server listened on every address
