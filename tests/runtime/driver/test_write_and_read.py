"""Registers on a page that is selected and read by one request of function 23, alone and with others."""

import asyncio
import struct
from collections.abc import Callable
from typing import Any

import pytest

from regscribe.simulate import simulate
from regscribe.simulate.device.describe import tell
from regscribe.simulate.device.device import SimulatedDevice
from regscribe.simulate.line.service import Exchange
from regscribe.tools.live.decode import Decoder
from regscribe.tools.live.dry_run import dry
from regscribe_runtime import ExceptionAnswer, NoAnswer, WrongAnswer
from regscribe_runtime.link.links import Retry
from regscribe_runtime.wire import pdu
from regscribe_runtime.wire.capture import CapturedFrame
from regscribe_runtime.wire.framing import Frame
from regscribe_runtime.wire.requests import Reply, Request, verify

MAP = """
format: 1
map: {id: test/asked, title: Asked, maker: Test, class_prefix: Asked}
manual: {title: Manual, number: "1"}
models: {A: {}}
protocol: {functions: [3, 4, 6, 16, 23]}
groups:
  - id: control
    name: Control
    source: "1"
    each: {access: rw, stays: operation}
    registers:
      - {at: 2, name: Bank}
      - {at: 3, name: Row, type: uint32}
      - {at: 5, name: Plain}
  - id: cells
    name: Cells
    source: "1"
    page: {bank: 5, row: 70000}
    each: {access: rw, functions: [16, 23]}
    registers:
      - {at: 10, name: Alpha, type: int16, decimals: 1}
      - {at: 11, name: Beta, type: uint32}
      - {at: 10, name: Seen, space: input, access: r, functions: [4]}
  - {id: others, name: Others, source: "1", page: {bank: 6}, registers: [{at: 10, name: Gamma, access: rw}]}
"""
SELECT = (5, 1, 4464)
"""The words of bank 5 and row 70000 = 1 x 65536 + 4464."""


@pytest.fixture
def device(build: Callable[[str], Any], direct: Any) -> Any:
    """A driver on a simulated device, and the requests between them."""
    built = build(MAP)
    return built.driver("A")(direct(SimulatedDevice(built.map, "A", unit=1)), unit=1)


def _sent(device: Any) -> list[bytes]:
    found = [pdu.encode_request(one) for one in device.link.log]
    device.link.log.clear()
    return found


WHOLE = bytes.fromhex("17 000A 0001 0002 0003 06 0005 0001 1170")
"""Function 23: read 1 register from 10 on, write 3 from 2 on (6 bytes)."""


def test_one_request_selects_and_reads_whatever_is_selected(device: Any) -> None:
    device.link.device.poke("alpha", 2.5)

    assert (device.alpha.read(), device.alpha.read()) == (2.5, 2.5)
    assert _sent(device) == [WHOLE, WHOLE]


def test_a_write_selects_by_requests_of_its_own_and_is_read_back_by_one(device: Any) -> None:
    device.alpha.write(2.5, verify=True)

    assert device.link.device.peek("alpha") == 2.5
    select = [bytes.fromhex("06 0002 0005"), bytes.fromhex("10 0003 0002 04 0001 1170")]
    assert _sent(device) == [*select, bytes.fromhex("10 000A 0001 02 0019"), WHOLE]


def test_all_is_read_with_the_pages_around(device: Any) -> None:
    simulated = device.link.device
    for path, value in {"beta": 70000, "gamma": 3, "seen": 4}.items():
        simulated.poke(path, value)

    found = device.read()

    assert (found["alpha"], found["beta"], found["gamma"], found["seen"]) == (0, 70000, 3, 4)
    assert [(one[0], int.from_bytes(one[1:3])) for one in _sent(device)] == [
        (3, 2),
        (23, 10),
        *[(6, 2), (16, 3), (4, 10)],  # an input register has no function 23
        *[(6, 2), (3, 10)],
    ]


def test_the_device_writes_before_it_reads_and_refuses_what_it_does_not_have(device: Any) -> None:
    handle, simulated = device.link.device.handle, device.link.device
    simulated.poke("alpha", 1)
    simulated.poke("gamma", 7)
    six = bytes.fromhex("17 000A 0001 0002 0001 02 0006")

    assert handle(WHOLE) == bytes.fromhex("17 02 000A")
    assert handle(six) == bytes.fromhex("17 02 0007")
    assert simulated.peek("bank") == 6
    assert handle(bytes.fromhex("17 000A 0002 0002 0001 02 0006")) == bytes([0x97, 2])  # nothing at 11 of that page
    assert handle(bytes.fromhex("17 000A 0001 0030 0001 02 0006")) == bytes([0x97, 2])  # nothing at 48 to write
    assert handle(bytes.fromhex("17 000A 0000 0002 0001 02 0006")) == bytes([0x97, 3])  # nothing to read
    assert handle(bytes.fromhex("17 000A 0001 0002 0001 04 0006")) == bytes([0x97, 3])  # of 4 bytes 2 came
    assert handle(bytes.fromhex("17 000A 0001 0002 0002 02 0006")) == bytes([0x97, 3])  # 2 words in 2 bytes


def test_it_is_not_sent_again_when_its_answer_is_lost(device: Any) -> None:
    device.link.retry, device.link.fate = Retry(reads=2, pause=0), {1: "lost"}

    with pytest.raises(NoAnswer) as raised:
        device.alpha.read()

    assert (raised.value.function, raised.value.address, _sent(device)) == (23, 10, [WHOLE])


def test_a_refusal_names_function_23(build: Callable[[str], Any], direct: Any) -> None:
    built = build(MAP.replace("decimals: 1", "decimals: 1, writable: {when: {plain: 1}, reason: later}"))
    bare = SimulatedDevice(built.map, "A", unit=1)
    bare.handle = lambda _, **__: bytes([0x97, 4])  # type: ignore[method-assign]
    device = built.driver("A")(direct(bare), unit=1)

    with pytest.raises(ExceptionAnswer, match="function 23") as raised:
        device.alpha.read()
    assert (raised.value.function, raised.value.code) == (23, 4)


@pytest.mark.parametrize("answer", ["17 04 0001 0002", "17 02 00", "17 01 0001", "17"])
def test_an_answer_of_another_length_is_no_answer(answer: str) -> None:
    asked = Request(23, 10, 1, SELECT, into=2)
    reply = pdu.decode_reply(asked, bytes.fromhex(answer))
    with pytest.raises(WrongAnswer, match="function 23, address 10"):
        verify(asked, reply, unit=1, protocol=None)  # type: ignore[arg-type] # not asked for what is no exception


def test_a_request_and_its_answer_are_the_bytes_of_the_standard() -> None:
    asked = Request(23, 10, 1, SELECT, into=2)
    assert pdu.encode_request(asked) == WHOLE
    assert pdu.decode_request(WHOLE) == asked
    assert pdu.encode_request(asked.shifted(1)) == bytes.fromhex("17 000B 0001 0003 0003 06 0005 0001 1170")
    assert pdu.encode_reply(Reply(23, (10,))) == bytes.fromhex("17 02 000A")


def test_a_dry_run_sends_it_and_shows_what_would_have_been_written(device: Any) -> None:
    device.link.device.poke("beta", 70000)
    link = dry(device)

    device.alpha.write(2.5)

    assert (device.beta.read(), device.alpha.read(), link._link.device.peek("alpha")) == (70000, 2.5, 0)
    assert [one.function for one in link.written] == [16]


def test_a_capture_and_the_simulator_name_what_it_read(device: Any) -> None:
    answer = bytes.fromhex("17 02 000A")
    decoder = Decoder(type(device))
    asked = decoder.feed(CapturedFrame("rtu", 1, WHOLE, WHOLE), "sent")
    told = decoder.feed(CapturedFrame("rtu", 1, answer, answer), "received")
    simulated = device.link.device
    simulated.poke("alpha", 1)

    assert asked.what == "write 0005 0001 1170 to holding 2 and read holding 10"
    assert [(item.name, item.text) for item in told.items] == [("alpha", "1")]
    assert tell([simulated], Exchange(Frame(1, WHOLE), simulated.handle(WHOLE), b"")).what == "alpha = 1"


def test_it_goes_over_a_wire_in_both_kinds_of_driver(build: Callable[[str], Any]) -> None:
    built = build(MAP)
    with simulate(built.map, "A", unit=1) as running:
        running.device.poke("beta", 70000)
        with built.driver("A").tcp(running.host, port=running.port, unit=1) as device:
            assert device.beta.read() == 70000

        async def read() -> Any:
            async with built.module.AsyncAskedA.tcp(running.host, port=running.port, unit=1) as device:
                return await device.beta.read()

        assert asyncio.run(read()) == 70000
        head = struct.pack(">BHHHHB", 23, 11, 2, 2, 3, 6)
        assert [bytes(one[:10]) for one in running.requests] == [head, head]
