"""Traffic between a client and a device: passed on, kept, and read by tshark's Modbus dissector.

The bytes are those of a real connection; the headers below them are made by text2pcap, so no privilege is needed.
"""

import socket
import subprocess
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

PORT = 502
ELSEWHERE = 5020
"""A port of which there is no traffic: by its port the dissector tells requests from answers, and MBAP from RTU."""

PATIENCE = 60
FIELDS = (
    *("tcp.dstport", "modbus.func_code", "mbtcp.unit_id", "mbrtu.unit_id", "modbus.reference_num"),
    *("modbus.word_cnt", "modbus.bit_cnt", "modbus.exception_code", "modbus.regnum16", "modbus.regval_uint16"),
    *("modbus.regval_float", "modbus.bitval", "_ws.expert", "mbrtu.crc16.status"),
)


class Chunk(NamedTuple):
    """Bytes as one side sent them."""

    by_client: bool
    data: bytes


@dataclass(frozen=True, slots=True)
class Packet:
    """What the dissector says of one frame; None and empty where it says nothing."""

    by_client: bool
    function: int
    unit: int
    address: int | None
    count: int | None
    exception: int | None
    numbers: tuple[int, ...]
    words: tuple[int, ...]
    floats: tuple[float, ...]
    bits: tuple[int, ...]
    complaint: str
    checksum: str


class _Relay:
    """Passes on what comes, one connection after the other, and keeps it."""

    def __init__(self, host: str, port: int) -> None:
        self._target = host, port
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.chunks: list[Chunk] = []
        self.host, self.port = self._listener.getsockname()
        threading.Thread(target=self._serve, daemon=True).start()

    def close(self) -> None:
        self._listener.shutdown(socket.SHUT_RDWR)
        self._listener.close()

    def _serve(self) -> None:
        with suppress(OSError):
            while True:
                client = self._listener.accept()[0]
                device = socket.create_connection(self._target)
                ways = ((client, device, True), (device, client, False))
                for threads in [[threading.Thread(target=self._pass_on, args=way, daemon=True) for way in ways]]:
                    for thread in threads:
                        thread.start()

    def _pass_on(self, source: socket.socket, target: socket.socket, by_client: bool) -> None:  # noqa: FBT001 (a thread's arguments)
        with suppress(OSError):
            while data := source.recv(4096):
                self.chunks.append(Chunk(by_client, data))
                target.sendall(data)
        for end in (source, target):
            with suppress(OSError):
                end.shutdown(socket.SHUT_RDWR)
            end.close()


@contextmanager
def relayed(host: str, port: int) -> Iterator[tuple[str, int, list[Chunk]]]:
    """Stand before a port: another address to connect to, and what passes there."""
    relay = _Relay(host, port)
    try:
        yield relay.host, relay.port, relay.chunks
    finally:
        relay.close()


def dissected(chunks: Sequence[Chunk], folder: Path, *, rtu: bool = False, floats: str = "") -> list[Packet]:
    """Return what tshark makes of the traffic; `floats` is its name for a format of IEEE numbers in two registers."""
    text, capture = folder / "traffic.txt", folder / "traffic.pcap"
    text.write_text("".join(map(_dump, chunks)), encoding="ascii")
    _run("text2pcap", "-q", "-D", "-T", f"40000,{PORT}", str(text), str(capture))
    ours, others = ("mbrtu", "mbtcp") if rtu else ("mbtcp", "mbrtu")
    ports = ["-o", f"{ours}.tcp.port:{PORT}", "-o", f"{others}.tcp.port:{ELSEWHERE}"]
    options = ["-o", "mbrtu.crc_verification:TRUE", *ports]
    options += ["-o", f"modbus.mbus_register_format:{floats}"] if floats else []
    wanted = [part for field in FIELDS for part in ("-e", field)]
    found = _run("tshark", "-r", str(capture), *options, "-T", "fields", *wanted)
    return [_packet(line.split("\t")) for line in found.splitlines()]


def _dump(chunk: Chunk) -> str:
    return f"{'I' if chunk.by_client else 'O'}\n000000 {chunk.data.hex(' ')}\n"


def _run(*command: str) -> str:
    done = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE, check=False)  # noqa: S603 (fixed, no shell)
    assert done.returncode == 0, done.stderr
    return done.stdout


def _packet(cells: list[str]) -> Packet:
    port, function, mbap, rtu, address, words, bits, exception, numbers, values, floats, flags, expert, crc = cells
    return Packet(
        by_client=int(port) == PORT,
        function=int(function),
        unit=int(mbap or rtu),
        address=_one(address),
        count=_one(words or bits),
        exception=_one(exception),
        numbers=_whole(numbers),
        words=_whole(values),
        floats=tuple(float(each) for each in floats.split(",") if each),
        bits=_whole(flags.replace("True", "1").replace("False", "0")),
        complaint=expert,
        checksum=crc,
    )


def _one(cell: str) -> int | None:
    return int(cell) if cell else None


def _whole(cell: str) -> tuple[int, ...]:
    return tuple(int(each) for each in cell.split(",") if each)
