"""Registers of 32 bits at addresses among those of 16 (Enron's), over raw wires of all kinds."""

import asyncio
from collections.abc import Callable
from typing import Any

import pytest

from regscribe.emit import markdown
from regscribe.simulate import simulate
from regscribe.simulate.device.describe import tell
from regscribe.simulate.device.device import SimulatedDevice
from regscribe.simulate.line.server_context import ServerContext
from regscribe.simulate.line.service import Exchange
from regscribe.tools.live.decode import Decoder
from regscribe.tools.live.dry_run import dry
from regscribe_runtime import ExceptionAnswer, WrongAnswer
from regscribe_runtime.wire import enron, pdu
from regscribe_runtime.wire.capture import CapturedFrame
from regscribe_runtime.wire.framing import Frame
from regscribe_runtime.wire.packing import MalformedError
from regscribe_runtime.wire.requests import Reply, Request, sizes

MAP = """
format: 1
map: {id: test/flow, title: Flow, maker: Test, class_prefix: Flow}
manual: {title: Manual, number: "1"}
models: {A: {}}
protocol: {functions: [3, 6, 16], space_limits: {enron: {read: 3}}}
groups:
  - id: short
    name: Short
    source: "1"
    each: {access: rw}
    registers: [{at: 3001, name: Mode}, {at: 7004, name: Key}]
  - id: flow
    name: Flow
    source: "2"
    each: {access: rw, space: enron, type: float32}
    registers:
      - {at: 5001, name: Total, type: uint32, aliases: [5101]}
      - {at: 5002, name: Swapped, type: int32, word_order: little}
      - {at: 7001, name: Rate}
      - {at: 7002, name: Energy, type: float64}
      - id: runs
        name: Run
        repeat: 1..2
        stride: 10
        registers: [{at: 7011, name: Flow, type: uint32, write_at: 7111}]
      - {at: 7050, name: Alone, type: uint32, functions: [3, 6]}
      - {at: 7060, name: Tag, type: string, length: 4}
"""


@pytest.fixture
def device(build: Callable[[str], Any], direct: Any) -> Any:
    """A driver on a simulated device, and the requests between them."""
    built = build(MAP)
    return built.driver("A")(direct(SimulatedDevice(built.map, "A", unit=1)), unit=1)


def _sent(device: Any) -> list[bytes]:
    found = [pdu.encode_request(one) for one in device.link.log]
    device.link.log.clear()
    return found


@pytest.mark.parametrize(
    ("path", "value", "written", "asked"),
    [
        ("total", 70000, "10 1389 0001 04 00011170", "03 1389 0001"),
        ("swapped", -2, "10 138A 0001 04 FFFEFFFF", "03 138A 0001"),
        ("rate", 1.5, "10 1B59 0001 04 3FC00000", "03 1B59 0001"),
        ("energy", 1.5, "10 1B5A 0002 08 3FF8000000000000", "03 1B5A 0002"),
        ("runs[2].flow", 3, "10 1BD1 0001 04 00000003", "03 1B6D 0001"),
        ("alone", 70000, "06 1B8A 00011170", "03 1B8A 0001"),
        ("tag", "GAS", "10 1B94 0002 08 4741532020202020", "03 1B94 0002"),
        ("mode", 5, "06 0BB9 0005", "03 0BB9 0001"),
    ],
)
def test_each_register_has_four_bytes_in_its_requests(
    device: Any, path: str, value: Any, written: str, asked: str
) -> None:
    attribute = device.runs[2].flow if path.startswith("runs") else getattr(device, path)
    attribute.write(value)
    if not path.startswith("runs"):
        assert attribute.read() == value
        assert _sent(device)[-1] == bytes.fromhex(asked)
        device.link.log.clear()
        attribute.write(value, verify=False)
    assert bytes.fromhex(written) in _sent(device)
    assert device.link.device.peek(path) == value


def test_many_are_read_in_requests_of_so_many_registers_as_the_device_takes(device: Any) -> None:
    device.link.device.poke("energy", 2.5)

    assert device.read()["energy"] == 2.5
    asked = [bytes.fromhex(text) for text in ("03 1389 0002", "03 1B59 0003", "03 1B63 0001", "03 1B6D 0001")]
    assert [one for one in _sent(device) if one[1:3] > b"\x13" and one[1:3] != b"\x1b\x5c"][:4] == asked


def test_a_device_answers_registers_of_32_bits_and_refuses_requests_over_the_edge(device: Any) -> None:
    simulated = device.link.device
    simulated.poke("total", 70000)
    simulated.poke("swapped", -2)

    def ask(text: str) -> str:
        answer = simulated.handle(bytes.fromhex(text))
        return str(answer.hex()).upper()

    assert ask("03 1389 0002") == "030800011170FFFEFFFF"
    assert ask("03 13ED 0001") == "030400011170"
    assert ask("03 1389 0003") == "8302"
    assert ask("03 1389 0004") == "8303"  # 4 registers, of 3 at most
    assert ask("10 1389 0001 04 00000005") == "1013890001"
    assert ask("06 138A 00010000") == "06138A00010000"
    assert (simulated.peek("total"), simulated.peek("swapped")) == (5, 1)
    assert ask("10 1389 0001 02 0005") == "9003"  # two bytes where each register has four
    assert ask("06 1389 0005") == "8603"
    assert ask("03 1B5C 0001") == "03020000"  # 7004 has 16 bits, and stands beside energy
    assert ask("03 1B5A 0002") == "03080000000000000000"
    assert ask("03 1B5A 0003") == ask("03 1B5C 0002") == "8302"
    assert ask("10 1B5A 0003 0C 000000000000000000000000") == "9002"
    assert ask("10 1B5B 0001 04 00000000") == "9002"  # half of a value


def test_an_answer_of_two_bytes_a_register_says_what_is_wrong(build: Callable[[str], Any], direct: Any) -> None:
    built = build(MAP)
    bare = SimulatedDevice(built.map, "A", unit=1)
    bare.handle = lambda _, **__: bytes.fromhex("03 02 0001")  # type: ignore[method-assign]
    device = built.driver("A")(direct(bare), unit=1)

    with pytest.raises(WrongAnswer, match=r"address 5001: 1 values .* space enron each register is two words"):
        device.total.read()
    bare.handle = lambda _, **__: bytes.fromhex("83 02")  # type: ignore[method-assign]
    with pytest.raises(ExceptionAnswer, match="5001"):
        device.total.read()


def test_bytes_and_requests_are_each_others_meaning() -> None:
    at = (1 << 40) + 2 * 5001
    cases = {
        "03 1389 0002": Request(3, at, 4),
        "06 1389 00011170": Request(6, at, 2, (1, 4464)),
        "10 1389 0001 04 00011170": Request(16, at, 2, (1, 4464)),
    }
    for text, request in cases.items():
        assert pdu.encode_request(request) == bytes.fromhex(text)
        assert enron.decode_request(bytes.fromhex(text)) == request
        assert sizes(request)[0] == len(bytes.fromhex(text))
        assert pdu.encode_request(request.shifted(1))[1:3] == bytes.fromhex("138A")
    assert pdu.encode_reply(Reply(16, (1, 4464), at, 2)) == bytes.fromhex("10 1389 0001")
    assert pdu.encode_reply(Reply(3, (1, 4464), at)) == bytes.fromhex("03 04 00011170")
    for text in ("03 1389", "06 1389 0001", "10 1389 0002 04 00000001", "10 1389 0001 02 0001", "03 1389 0002 00"):
        with pytest.raises(MalformedError):
            enron.decode_request(bytes.fromhex(text))


@pytest.mark.parametrize(
    ("asked", "words"),
    [("03 1389 0002", 4), ("10 1389 0001 04 00000005", 2), ("06 138A 00010000", 2), ("03 0BB9 0001", 1)],
)
def test_each_counts_as_two_words_of_the_time_that_a_device_takes(
    build: Callable[[str], Any], asked: str, words: int
) -> None:
    times = ", ".join(f"{function}: {{fixed: 10..10, per_word: 5..5}}" for function in (3, 6, 16))
    built = build(MAP.replace("space_limits", f"latency: {{{times}}}, space_limits"))
    context = ServerContext([SimulatedDevice(built.map, "A", unit=1)], factor=1.0)

    assert context.delay(Frame(1, bytes.fromhex(asked))) == pytest.approx((10 + 5 * words) / 1000)


FRAMES = """
examples:
  - {source: "3", frame: 01 03 13 89 00 02, crc: false, address: 5001, count: 2}
  - {source: "3", frame: 01 10 13 89 00 01 04 00 01 11 70, crc: false, writes: {total: 70000}}
"""


def test_the_docs_count_them_as_the_manual_does_in_frames(build: Callable[[str], Any]) -> None:
    ((_, page),) = markdown.render(build(MAP + FRAMES).map).items()

    assert "function 03, address 5001, 2 registers" in page
    assert "words" not in page.partition("01 03 13 89")[2].partition("\n")[0]


def test_dry_runs_captures_and_the_simulator_understand_them(device: Any) -> None:
    asked, answer = bytes.fromhex("03 1389 0001"), bytes.fromhex("03 04 00011170")
    decoder = Decoder(type(device))
    first = decoder.feed(CapturedFrame("rtu", 1, asked, asked), "sent")
    told = decoder.feed(CapturedFrame("rtu", 1, answer, answer), "received")
    simulated = device.link.device
    simulated.poke("total", 70000)

    assert first.what == "read enron 5001"
    assert [(item.name, item.text) for item in told.items] == [("total", "70000")]
    assert tell([simulated], Exchange(Frame(1, asked), simulated.handle(asked), b"")).what == "total = 70000"
    link = dry(device)
    device.total.write(9)
    assert (device.total.read(), simulated.peek("total"), len(link.written)) == (9, 70000, 1)


@pytest.mark.parametrize(
    ("framing", "transport"), [("tcp", "tcp"), ("rtu", "rtu-tcp"), ("ascii", "ascii-tcp")], ids=str
)
def test_they_go_over_every_framing_in_both_kinds_of_driver(
    build: Callable[[str], Any], framing: str, transport: str
) -> None:
    built = build(MAP)
    with simulate(built.map, "A", unit=1, transport=transport) as running:
        with built.driver("A").tcp(running.host, port=running.port, unit=1, framing=framing) as device:
            device.alone.write(70000)
            device.energy.write(1.5)
            assert (device.alone.read(), device.read()["energy"]) == (70000, 1.5)

        async def read() -> Any:
            async with built.module.AsyncFlowA.tcp(running.host, port=running.port, unit=1, framing=framing) as device:
                await device.total.write(7)
                return await device.total.read()

        assert asyncio.run(read()) == 7
