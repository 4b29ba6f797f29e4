"""Nothing of a late, repeated, foreign or garbled answer is taken for the answer to another request."""

import asyncio
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pytest

from regscribe.simulate import simulate
from regscribe_runtime import NoAnswer, Retry, WrongAnswer, tcp
from regscribe_runtime.link import connect
from regscribe_runtime.link.links import Link
from regscribe_runtime.link.pending import LATE_SECONDS, PendingRequest, StaleReplies
from regscribe_runtime.values.protocol import Protocol
from regscribe_runtime.wire.requests import Request, verify

from .conftest import FarEnd, frame, words

NOW = 100.0
READ, OTHER, WRITE = Request(3, 28), Request(3, 29), Request(6, 28, 1, (7,))


def pending(request: Request, unit: int = 1) -> PendingRequest:
    return PendingRequest(unit, request, request, b"", 0.5)


def owing(request: Request = READ) -> StaleReplies:
    late = StaleReplies()
    late.owe(pending(request), NOW)
    return late


def test_another_read_of_the_same_unit_waits_for_an_answer_that_is_owed() -> None:
    assert owing().until(pending(OTHER), NOW) == NOW + LATE_SECONDS


def test_the_same_read_may_be_sent_again_at_once() -> None:
    assert owing().until(pending(READ), NOW) == 0


@pytest.mark.parametrize(("unit", "request_"), [(2, OTHER), (1, Request(4, 29)), (1, WRITE)])
def test_whose_answer_cannot_be_mistaken_does_not_wait(unit: int, request_: Request) -> None:
    assert owing().until(pending(request_, unit), NOW) == 0


def test_the_same_write_waits_since_it_is_another_one() -> None:
    assert owing(WRITE).until(pending(WRITE), NOW) > NOW


def test_after_the_answer_to_a_repeated_read_the_other_answer_is_still_owed() -> None:
    late = owing()
    late.answered(pending(READ), NOW + 0.9)
    assert late.until(pending(OTHER), NOW + 1.0) == NOW + 0.9 + LATE_SECONDS


def test_an_answer_is_not_waited_for_for_ever() -> None:
    assert owing().until(pending(OTHER), NOW + LATE_SECONDS + 0.1) == 0


def serial(far: FarEnd, **more: Any) -> Link:
    link = connect.serial(far.path, baud=115200, **{"timeout": 2.0, "retry": Retry(0), "echo": False, **more})
    link.open()
    return link


def value_of(request: bytes) -> bytes:
    """An answer that carries the address asked for, so that a mistaken one shows."""
    return words(request[0], *[int.from_bytes(request[2:4], "big")] * int.from_bytes(request[4:6], "big"))


def test_a_late_answer_on_a_serial_line_is_dropped_before_the_next_request(far: FarEnd) -> None:
    far.plan = lambda request: [(0.8 if len(far.heard) == 1 else 0.0, value_of(request))]
    link = serial(far, timeout=0.5)
    with pytest.raises(NoAnswer):
        link.call(1, READ)
    assert link.call(1, OTHER).words == (29,)
    assert link.call(1, READ).words == (28,)
    link.close()


def test_a_late_answer_is_no_answer_to_a_write_either(far: FarEnd, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("regscribe_runtime.link.pending.LATE_SECONDS", 3600.0)  # waiting ends when the answer comes
    far.plan = lambda request: [(0.8 if len(far.heard) == 1 else 0.0, request)]
    link = serial(far, timeout=0.5)
    with pytest.raises(NoAnswer):
        link.call(1, WRITE)
    assert link.call(1, Request(6, 11, 1, (8,))).address == 11
    link.close()


def test_the_answer_of_another_unit_is_not_taken_and_its_owner_is_named(far: FarEnd) -> None:
    far.plan = lambda _: [(0.0, words(7, 99))]
    link = serial(far, timeout=0.25)
    with pytest.raises(WrongAnswer, match="unit 1, function 03, address 28: unit 7 answered in its place"):
        link.call(1, READ)
    link.close()


def test_an_answer_behind_noise_and_behind_a_foreign_one_is_found(far: FarEnd) -> None:
    far.plan = lambda request: [
        (0.0, b"\x00\x01\x03" + words(7, 99)),
        (0.01, value_of(request)[:4]),
        (0.02, value_of(request)[4:]),
    ]
    link = serial(far)
    assert link.call(1, READ).words == (28,)
    link.close()


def test_a_garbled_answer_shows_its_bytes_and_says_what_to_check(far: FarEnd) -> None:
    far.plan = lambda _: [(0.0, b"\x01\x03\x02\x00\x05\xff\xff")]
    link = serial(far, timeout=0.25)
    with pytest.raises(
        WrongAnswer, match=r"7 bytes came that are no answer \(01 03 02 00 05 ff ff\). Check speed, parity"
    ):
        link.call(1, READ)
    link.close()


def test_an_answer_that_is_repeated_is_used_once(far: FarEnd) -> None:
    far.plan = lambda request: [(0.0, value_of(request) * 2)]
    link = serial(far)
    assert [link.call(1, Request(3, address)).words for address in (5, 6, 7)] == [(5,), (6,), (7,)]
    link.close()


@pytest.mark.parametrize("function", [1, 2, 4, 7])
def test_every_read_has_its_own_answer(far: FarEnd, function: int) -> None:
    answers = {1: b"\x01\x01\x05", 2: b"\x02\x01\x05", 4: b"\x04\x02\x00\x05", 7: b"\x07\x05"}
    far.plan = lambda request: [(0.0, frame(1, answers[request[1]]))]
    link = serial(far)
    found = link.call(1, Request(function, 0, {1: 3, 2: 3}.get(function, 1))).words
    assert found == ((1, 0, 1) if function in {1, 2} else (5,))
    link.close()


def test_more_bits_than_asked_for_are_not_cut_to_fit(far: FarEnd) -> None:
    far.plan = lambda _: [(0.0, frame(1, b"\x01\x02\x05\x05"))]
    link = serial(far)
    assert len(link.call(1, Request(1, 0, 3)).words) == 16
    link.close()


@pytest.mark.parametrize("transport", ["tcp", "rtu-tcp", "ascii-tcp"])
@pytest.mark.parametrize("kind", ["sync", "async"])
def test_a_late_answer_over_tcp_is_not_taken(athena: Any, transport: str, kind: str) -> None:
    slow = iter([0.4])

    async def deliver(exchange: Any) -> bytes:
        await asyncio.sleep(next(slow, 0.0))
        return bytes(exchange.frame)

    with simulate(athena, "16C", unit=1, transport=transport, delivery=deliver) as running:
        framing = transport.removesuffix("-tcp")
        found = _two_reads(kind, running.host, port=running.port, framing=framing, timeout=0.25, retry=Retry(0))
        assert found == running.device.peek_words("setpoint_high_limit", "base")


@pytest.mark.parametrize("kind", ["sync", "async"])
def test_a_late_answer_that_a_gateway_passes_on_to_the_next_connection_is_not_taken(kind: str) -> None:
    """The gateway sends what comes from its serial side to whoever is connected then."""
    with gateway() as port:
        assert _two_reads(kind, "127.0.0.1", port=port, framing="rtu", timeout=0.25, retry=Retry(0)) == (29,)


@pytest.mark.parametrize("kind", ["sync", "async"])
def test_an_answer_with_another_transaction_id_is_not_taken(athena: Any, kind: str) -> None:
    async def deliver(exchange: Any) -> bytes:
        frame = bytes(exchange.frame)
        return bytes([frame[0] ^ 0x40]) + frame[1:-2] + b"\x03\x09" + frame

    with simulate(athena, "16C", unit=1, delivery=deliver) as running:
        high = running.device.peek_words("setpoint_high_limit", "base")
        low = running.device.peek_words("setpoint_low_limit", "base")
        link = tcp(running.host, port=running.port, timeout=2.0)
        if kind == "sync":
            link.open()
            assert [link.call(1, READ).words, link.call(1, OTHER).words] == [low, high]
            link.close()
        else:
            asyncio.run(_both(running, [low, high]))


async def _both(running: Any, expected: list[tuple[int, ...]]) -> None:
    link = connect.async_tcp(running.host, port=running.port, timeout=2.0)
    await link.open()
    assert [(await link.call(1, READ)).words, (await link.call(1, OTHER)).words] == expected
    await link.close()


def test_an_answer_of_another_length_is_passed_over(far: FarEnd) -> None:
    far.plan = lambda request: [(0.0, words(1, 9, 9, 9)), (0.03, value_of(request))]
    link = serial(far)
    assert link.call(1, READ).words == (28,)
    link.close()


def test_an_answer_of_another_length_that_stays_alone_is_a_wrong_answer(far: FarEnd) -> None:
    far.plan = lambda _: [(0.0, words(1, 9, 9, 9))]
    link = serial(far, timeout=0.25)
    reply = link.call(1, READ)
    with pytest.raises(WrongAnswer, match="3 values came where 1 were asked for"):
        verify(READ, reply, unit=1, protocol=Protocol())
    link.close()


def test_another_unit_that_answers_with_the_right_transaction_id_is_named_at_once(athena: Any) -> None:
    async def deliver(exchange: Any) -> bytes:
        return bytes(exchange.frame[:6]) + b"\x07" + bytes(exchange.frame[7:])

    with simulate(athena, "16C", unit=1, delivery=deliver) as running:
        link = tcp(running.host, port=running.port, timeout=20.0)
        link.open()
        with pytest.raises(WrongAnswer, match="unit 7 answered in its place"):
            link.call(1, READ)
        link.close()


def test_a_connection_with_more_bytes_than_asked_for_is_not_trusted_again() -> None:
    with gateway(noise=True) as port:
        link = tcp("127.0.0.1", port=port, framing="rtu", timeout=2.0)
        link.open()
        assert [link.call(1, READ).words, link.call(1, OTHER).words] == [(28,), (29,)]
        link.close()


def _two_reads(kind: str, host: str, **where: Any) -> tuple[int, ...]:
    """The words of the second read, after a first one that got no answer in time."""

    async def talk() -> tuple[int, ...]:
        link = connect.async_tcp(host, **where)
        await link.open()
        with pytest.raises(NoAnswer):
            await link.call(1, READ)
        found = (await link.call(1, OTHER)).words
        await link.close()
        return found

    if kind == "async":
        return asyncio.run(talk())
    link = tcp(host, **where)
    link.open()
    with pytest.raises(NoAnswer):
        link.call(1, READ)
    found = link.call(1, OTHER).words
    link.close()
    return found


@contextmanager
def gateway(*, noise: bool = False) -> Iterator[int]:
    """A transparent gateway: the first answer comes after 0.4 s, to the newest connection.

    With `noise` it comes at once with a byte too many, then once more, and the second answer later.
    """
    loop = asyncio.new_event_loop()
    newest: list[asyncio.StreamWriter] = []
    plans = iter([[(0.0, b"\0"), (0.1, b"")], [(0.2, b"")]] if noise else [[(0.4, b"")]])

    def send(own: asyncio.StreamWriter, answer: bytes) -> None:
        (own if noise else newest[0]).write(answer)

    async def attend(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        newest[:] = [writer]
        while request := await reader.read(100):
            for delay, more in next(plans, [(0.0, b"")]):
                loop.call_later(delay, send, writer, value_of(request) + more)
        writer.close()

    server = loop.run_until_complete(asyncio.start_server(attend, "127.0.0.1", 0))
    thread = threading.Thread(target=loop.run_forever, daemon=True)
    thread.start()
    try:
        yield server.sockets[0].getsockname()[1]
    finally:
        loop.call_soon_threadsafe(server.close)
        loop.call_soon_threadsafe(loop.call_later, 0.3, loop.stop)
        thread.join()
        loop.close()
