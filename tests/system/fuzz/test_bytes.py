"""Bytes and texts of strangers: servers, drivers, decoders and readers of files neither crash, hang nor fill up."""

import asyncio
import contextlib
import sys
from collections import Counter
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from regscribe.draft import mapping
from regscribe.files import FileError
from regscribe.model import RegisterMap
from regscribe.simulate import Service, SimulatedDevice, SimulatorError
from regscribe.simulate.line.connection import MOST_WAITING, Connection
from regscribe.simulate.line.server_context import ServerContext
from regscribe.simulate.map_cache import find_map
from regscribe.tools.live import catalogue, config, link_names, target
from regscribe.tools.live.capture import captured
from regscribe.tools.live.decode import Decoded, Decoder
from regscribe.tools.live.errors import TargetError
from regscribe.tools.programs import program_file as programs
from regscribe.tools.settings import backup_file as backups
from regscribe.tools.settings.backup import BackupError, Side, differences
from regscribe.tools.settings.compatibility import fit
from regscribe_runtime import RegscribeError
from regscribe_runtime.link.exchange import Conversation
from regscribe_runtime.values.protocol import Protocol
from regscribe_runtime.wire.framing import FRAMINGS, LONGEST_PDU, build
from regscribe_runtime.wire.requests import Request, verify
from regscribe_runtime.wire.server_framing import framer_for

ROOT = Path(__file__).parents[3]
FAST = settings(
    max_examples=150,
    deadline=None,
    derandomize=True,
    database=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)
MODEL = "athena/series-c:16C"
MOST_KEPT = 2 * LONGEST_PDU + 16
"""Bytes of half a frame that a server may keep: of ASCII, the longest."""

numbers = st.integers(0, 0xFFFF).map(lambda number: number.to_bytes(2, "big"))
functions = st.one_of(st.sampled_from([1, 2, 3, 4, 5, 6, 7, 8, 15, 16, 22, 23]), st.integers(0, 255))
pdus = st.one_of(
    st.builds(lambda code, *rest: bytes([code]) + b"".join(rest), functions, numbers, numbers, st.binary(max_size=40)),
    st.builds(lambda code, rest: bytes([code]) + rest, functions, st.binary(max_size=260)),
)


@cache
def athena() -> RegisterMap:
    return find_map(ROOT / "maps" / "athena" / "series-c.yaml")


@cache
def device() -> SimulatedDevice:
    return SimulatedDevice(athena(), "16C", unit=1)


def built(framing: str, unit: int, pdu: bytes) -> bytes:
    return build(framing, unit, pdu, 7)


def streams(framing: str) -> st.SearchStrategy[list[bytes]]:
    """What a client sends: sound frames, broken ones and noise, in pieces."""
    sound = st.builds(lambda unit, pdu: built(framing, unit, pdu), st.integers(0, 3), pdus)
    broken = st.builds(lambda frame, at: frame[: at % (len(frame) + 1)], sound, st.integers(0, 300))
    noise = st.one_of(st.binary(max_size=300), st.text(":0123456789ABCDEF\r\n", max_size=300).map(str.encode))
    return st.lists(st.one_of(sound, broken, noise), max_size=6)


class Sink(asyncio.Transport):
    """Where a server's answers go."""

    def __init__(self) -> None:
        super().__init__()
        self.sent = bytearray()
        self.closed = False

    def write(self, data: object) -> None:
        assert isinstance(data, bytes)
        self.sent += data

    def pause_reading(self) -> None:
        pass

    def resume_reading(self) -> None:
        pass

    def close(self) -> None:
        self.closed = True

    def abort(self) -> None:
        self.closed = True


@pytest.mark.parametrize("framing", FRAMINGS)
@settings(FAST, max_examples=100)
@given(data=st.data())
def test_a_server_takes_any_bytes_keeps_few_and_answers_the_next_good_request(framing: str, data: Any) -> None:
    async def serve() -> None:
        sink = Sink()
        connection = Connection(framer_for(framing), ServerContext([device()]), Service())
        connection.connection_made(sink)
        for piece in data.draw(streams(framing)):
            connection.data_received(piece)
            assert len(connection._framer._buffer) <= MOST_KEPT  # type: ignore[attr-defined] # of each framer
        connection._expire()
        sink.sent.clear()
        connection.data_received(built(framing, 1, b"\x08\x00\x00\x12\x34"))
        assert sink.sent == built(framing, 1, b"\x08\x00\x00\x12\x34")
        assert len(connection._waiting) <= MOST_WAITING
        connection.connection_lost(None)

    asyncio.run(serve())


@FAST
@given(pdu=pdus, broadcast=st.booleans())
def test_a_device_answers_any_request_with_a_frame_that_fits_or_not_at_all(pdu: bytes, *, broadcast: bool) -> None:
    answer = device().handle(pdu, broadcast=broadcast)
    assert answer is None or (not broadcast and answer[0] & 0x7F == pdu[0] & 0x7F and len(answer) <= LONGEST_PDU)


@pytest.mark.parametrize("framing", FRAMINGS)
@pytest.mark.parametrize(
    "pattern", [b"\x01\x10\x00\x00\x00\x7b\xff", b"\x01\x10", b"\x01\x03", b":", b"\0", b"\xff", b":01"]
)
def test_the_worst_flood_costs_a_server_little(framing: str, pattern: bytes) -> None:
    """A chunk of what makes it look for frames everywhere: some calls of functions a byte, and no more."""
    framer = framer_for(framing)
    chunk = (pattern * 4096)[:4096]
    calls = Counter[str]()
    sys.setprofile(lambda _frame, event, _argument: calls.update((event,)))
    try:
        for _ in range(3):
            framer.feed(chunk)
            assert len(framer._buffer) <= MOST_KEPT  # type: ignore[attr-defined] # of each framer
    finally:
        sys.setprofile(None)
    assert calls.total() < 3 * len(chunk) * 100


class Fed:
    """A wire with an answer on it."""

    descriptor = -1

    def __init__(self, answer: bytes) -> None:
        self.answer = answer

    def read(self) -> bytes:
        data, self.answer = self.answer[:100], self.answer[100:]
        return data

    def write(self, data: bytes) -> None:
        pass

    def waiting(self) -> bool:
        return bool(self.answer)

    def close(self) -> None:
        pass


asked = st.sampled_from(
    [
        Request(3, 28, 2),
        Request(1, 5, 9),
        Request(6, 28, 1, (7,)),
        Request(16, 28, 2, (1, 2)),
        Request(7, 0),
        Request(8, 0, 1, (9,)),
    ]
)


@pytest.mark.parametrize("framing", FRAMINGS)
@FAST
@given(request_=asked, data=st.data())
def test_a_driver_takes_any_bytes_for_an_answer_and_says_what_is_wrong(
    framing: str, request_: Request, data: Any
) -> None:
    answer = b"".join(data.draw(streams(framing)))
    wire = Fed(b"")
    talk = Conversation(framing, addressing="modbus", line=None, gap=0.0, echo=False)
    steps = talk.exchange(wire, 1, request_._replace(seconds=5.0))
    next(steps)
    wire.answer = answer
    try:
        while True:
            steps.send(wire.waiting())
    except StopIteration as done:
        reply = done.value
    except RegscribeError:
        return
    try:
        verify(request_, reply, unit=1, protocol=Protocol())
    except RegscribeError:
        return


@FAST
@given(
    lines=st.lists(
        st.one_of(
            st.text(max_size=80),
            st.builds(lambda unit, pdu: built("rtu", unit, pdu).hex(" "), st.integers(0, 255), pdus),
            st.builds(lambda unit, pdu: f"<- {built('tcp', unit, pdu).hex()}", st.integers(0, 255), pdus),
            st.builds(lambda unit, pdu: built("ascii", unit, pdu).decode(), st.integers(0, 255), pdus),
            st.binary(max_size=60).map(lambda data: f"tx {data.hex(' ')}"),
        ),
        max_size=8,
    ),
    framing=st.sampled_from(["", "rtu", "tcp", "ascii"]),
)
def test_any_capture_is_decoded_or_called_strange(lines: list[str], framing: str) -> None:
    decoder = Decoder(catalogue.find(MODEL).driver)
    for line in captured(lines, framing):
        for frame in line.frames:
            assert isinstance(decoder.feed(frame, line.direction), Decoded)


@pytest.mark.parametrize(
    "text", ["01 03 " * 40_000, "ab" * 90_000, ":" * 90_000, ":01" * 40_000, "[01]" * 30_000, "0x1," * 30_000]
)
def test_a_line_of_a_capture_that_is_very_long_comes_to_an_end(text: str) -> None:
    decoder = Decoder(catalogue.find(MODEL).driver)
    for line in captured([text]):
        for frame in line.frames:
            decoder.feed(frame, line.direction)


# --- files and names

BACKUP = """\
format: 1
backup:
  {map: athena/series-c, map_sha256: 0123456789abcdef, model: 16C, unit: 1, link: "tcp:h", taken: "2026-01-01T00:00Z"}
settings:
  setpoints:
    setpoint_eeprom_and_ram: {value: 150.5, unit: "°F", raw: [1505]}
    holdback: {value: 3}
"""
CONFIG = """\
format: 1
devices:
  kiln: {link: "tcp:10.0.0.7:502", unit: 3, model: 16C, timeout: 1.5, given: {linear_inputs: [1, 2]}, note: the old one}
  oven: tcp:10.0.0.8?unit=2
"""
PROGRAM = """\
format: 1
program:
  name: Anneal
  segments:
    - {to: 500 °C, ramp: 1:30, soak: 2:00}
  final: {to: 20 °C}
"""
STATE = """\
format: 1
state: {map: athena/series-c, model: 16C}
values: {setpoint_ram: 150.5, operating_mode: MANUAL, "segments[1].ramp_time": 3}
wear: {setpoint_eeprom_and_ram: 3}
in_effect: {holdback: 2}
"""

MAPPING = """\
format: 1
importer: table
source: list.xlsx
options: {sheet: Modbus, columns: [at=Register, unit=-], base: modicon}
skip: [{name: Reserved, reason: later}]
fixes: [{at: 12, space: input, set: {decimals: 1, enum: {0: "off", 1: "on"}}}]
imported:
  - {group: Drive, register: {at: 1, name: Speed, access: r}}
  - {group: Fan, unit_id: 2, register: {at: 1, name: Speed, access: r}}
"""


def into_a_device(path: Path) -> SimulatedDevice:
    """A simulated device in the state of a file."""
    found = SimulatedDevice(athena(), "16C", unit=1)
    found.load(path)
    assert found.handle(b"\x03\x00\x00\x00\x05")
    found.snapshot()
    return found


LOADERS: dict[str, tuple[str, Callable[[Path], Any], type[Exception]]] = {
    "backup": (BACKUP, backups.load, BackupError),
    "configuration": (CONFIG, config.load, TargetError),
    "state": (STATE, into_a_device, SimulatorError),
    "state from a backup": (BACKUP, into_a_device, SimulatorError),
    "program": (PROGRAM, programs.load, TargetError),
    "mapping of an import": (MAPPING, mapping.load, FileError),
}
SPOILERS = [
    *(
        "&a [*a, *a]",
        "*nowhere",
        "!!python/object:os.system x",
        "- ",
        "{",
        "[",
        "'",
        '"',
        ": ",
        "? ",
        "\t",
        "\0",
        "---\n",
    ),
    *(
        "1e999999999",
        "9" * 5000,
        "-0",
        ".nan",
        "1_0",
        "null",
        "true",
        "{}",
        "[]",
        "[" * 2000,
        "{a: " * 2000,
        "\x1b[31m",
    ),
    *("\u202e", "\ufeff", "\ud800", "2001-01-01", "-1", "1e400", "65536", "99999999999999999999", "\n", "  ", "|", ">"),
]


def mutated(text: str) -> st.SearchStrategy[str]:
    """The text with some stretches cut out or replaced by what YAML treats in a special way."""

    def put(cuts: list[tuple[int, int, str]]) -> str:
        found = text
        for at, length, new in cuts:
            place = at % (len(found) + 1)
            found = found[:place] + new + found[place + length :]
        return found

    cut = st.tuples(st.integers(0, 1000), st.integers(0, 12), st.one_of(st.sampled_from(SPOILERS), st.text(max_size=4)))
    return st.lists(cut, min_size=1, max_size=4).map(put)


@pytest.mark.parametrize("kind", LOADERS)
def test_the_files_that_are_spoilt_are_sound_before(kind: str, tmp_path: Path) -> None:
    text, load, _ = LOADERS[kind]
    path = tmp_path / "file.yaml"
    path.write_text(text, encoding="utf-8")
    load(path)


def read(kind: str, content: str | bytes, folder: Path) -> Any:
    """What a file holds; None if the reader refuses it with a message that a terminal may show."""
    _, load, refusal = LOADERS[kind]
    path = folder / "file.yaml"
    path.write_bytes(content if isinstance(content, bytes) else content.encode("utf-8", "surrogatepass"))
    try:
        return load(path)
    except refusal as error:
        said = str(error)
    assert said.strip()
    assert "Traceback" not in said
    return None


@pytest.mark.parametrize("kind", LOADERS)
@FAST
@given(data=st.data())
def test_any_file_is_read_or_refused(kind: str, data: Any, tmp_path: Path) -> None:
    content = data.draw(st.one_of(mutated(LOADERS[kind][0]), st.text(max_size=200), st.binary(max_size=200)))
    found = read(kind, content, tmp_path)
    if kind == "backup" and found is not None:
        driver = catalogue.find(MODEL).driver
        fit(found, driver, state={}, givens={})
        assert list(differences(Side.of(found, "a"), Side.of(found, "b"))) == []
        backups.to_text(found)


@pytest.mark.parametrize("kind", LOADERS)
def test_a_file_of_a_gigantic_form_is_refused_at_once(kind: str, tmp_path: Path) -> None:
    bomb = "a: &a [x, x, x, x, x, x, x, x, x]\n" + "".join(
        f"{name}: &{name} [*{last}, *{last}, *{last}, *{last}, *{last}, *{last}, *{last}, *{last}]\n"
        for last, name in zip("abcdefgh", "bcdefghi", strict=True)
    )
    for content in (bomb, "x: " + "y" * 30_000_000, "[" * 100_000, "a:\n" * 100_000, "{" * 10_000 + "}" * 10_000):
        assert read(kind, content, tmp_path) is None


words = st.sampled_from(
    [
        *(
            "tcp:",
            "rtu:",
            "ascii:",
            "?",
            "&",
            "=",
            "unit=",
            "baud=",
            "parity=",
            "timeout=",
            "model=",
            "given.",
            "framing=rtu",
        )
    ],
)
pieces = st.one_of(
    words,
    st.text(max_size=5),
    st.sampled_from(["1", "502", "::1", "[", "]", "%", "/dev/x", "-1", "1e9", "²", "0" * 5000]),
)


def names() -> Iterator[Callable[[str], Any]]:
    yield link_names.split
    yield target.parse


@FAST
@given(text=st.lists(pieces, max_size=8).map("".join))
@example(text="tcp:host?unit=" + "0" * 5000)
@example(text="tcp:host:" + "0" * 5000)
@example(text="rtu:/dev/x?baud=" + "9" * 5000)
@example(text="tcp:host?timeout=" + "9" * 5000)
def test_any_text_names_a_device_or_is_refused(text: str) -> None:
    for parse in names():
        with contextlib.suppress(TargetError):
            assert parse(text) is not None


@FAST
@given(text=st.lists(pieces, max_size=6).map("".join), unit=st.integers(-5, 300))
def test_any_target_that_is_understood_gives_a_driver_or_is_refused(text: str, unit: int) -> None:
    with contextlib.suppress(TargetError):
        target.connect(target.override(target.parse(f"tcp:{text}"), unit=unit, model=MODEL))
