"""Every bit, every byte, every await: what chance may miss, one after the other."""

import asyncio
import itertools
import os
import threading
import tty
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from regscribe.simulate.line.line_faults import USUAL, LineFault
from regscribe_runtime import LinkLost, NoAnswer, NotWritten, RegscribeError, Retry, WrongAnswer
from regscribe_runtime.link import connect
from regscribe_runtime.link.exchange import Conversation
from regscribe_runtime.values.protocol import Protocol
from regscribe_runtime.wire.client_framing import framing_for
from regscribe_runtime.wire.requests import Reply, Request, verify

from .machine import descriptors
from .world import FRAMINGS, SIDES, Far, Op, SyncSide

UNIT = 17
ANSWERS = {
    "a read of words": (Request(3, 28, 2), b"\x03\x04\x01\x02\xfe\xdc"),
    "a read of bits": (Request(1, 5, 9), b"\x01\x02\xa5\x01"),
    "a write of one word": (Request(6, 28, 1, (0x1234,)), b"\x06\x00\x1c\x12\x34"),
    "a write of words": (Request(16, 28, 2, (1, 2)), b"\x10\x00\x1c\x00\x02"),
    "a loopback": (Request(8, 0, 1, (0x55AA,)), b"\x08\x00\x00\x55\xaa"),
    "a refusal": (Request(3, 28, 2), b"\x83\x02"),
}
CHECKED_BY_MBAP = {"a read of words": 9, "a read of bits": 9, "a write of words": 10, "a refusal": 7}
"""Bytes from the beginning that the client compares; of the others all. TCP itself checks the rest, Modbus does not."""


class Fed:
    """A wire on which an answer stands as soon as something was sent."""

    descriptor = -1

    def __init__(self, answer: bytes) -> None:
        self.answer, self.ready = answer, b""

    def read(self) -> bytes:
        data, self.ready = self.ready, b""
        return data

    def write(self, data: bytes) -> None:  # noqa: ARG002 - a wire's signature
        self.ready = self.answer

    def waiting(self) -> bool:
        return bool(self.ready)

    def close(self) -> None:
        pass


def heard(framing: str, request: Request, answer: bytes) -> tuple[int, ...] | RegscribeError:
    """What a link makes of the bytes of an answer, without any waiting."""
    wire = Fed(answer)
    talk = Conversation(framing, addressing="modbus", line=None, gap=0.0, echo=False)
    steps = talk.exchange(wire, UNIT, request._replace(seconds=5.0))
    try:
        next(steps)
        while True:
            steps.send(wire.waiting())
    except StopIteration as done:
        reply: Reply = done.value
    except RegscribeError as error:
        return error
    try:
        return verify(request, reply, unit=UNIT, protocol=Protocol())
    except RegscribeError as error:
        return error


def framed(framing: str, answer: bytes) -> bytes:
    return framing_for(framing).build(UNIT, answer)


def same(one: tuple[int, ...] | RegscribeError, other: tuple[int, ...] | RegscribeError) -> bool:
    return one == other or (type(one) is type(other) and str(one) == str(other))


def spoilt(kind: str, framing: str) -> Iterator[bytes]:
    """All frames with one bit flipped, cut, doubled, or with bytes before or behind."""
    _, answer = ANSWERS[kind]
    frame = framed(framing, answer)
    checked = CHECKED_BY_MBAP.get(kind, len(frame)) if framing == "tcp" else len(frame)
    for bit in range(8 * checked):
        changed = bytearray(frame)
        changed[bit // 8] ^= 1 << bit % 8
        yield bytes(changed)
    for at in range(len(frame)):
        yield frame[:at]
        if framing != "tcp":  # TCP loses nothing in the middle: the bytes behind would be the rest of the answer
            yield frame[:at] + frame
        yield frame + frame[:at]
        yield frame[at:]
        yield frame[:at] + frame[at + 1 :]


@pytest.mark.parametrize("framing", ["tcp", "rtu", "ascii"])
@pytest.mark.parametrize("kind", ANSWERS)
def test_no_broken_frame_is_taken_for_another_answer(kind: str, framing: str) -> None:
    request, answer = ANSWERS[kind]
    right = heard(framing, request, framed(framing, answer))
    assert isinstance(right, tuple) or kind == "a refusal"
    for frame in spoilt(kind, framing):
        found = heard(framing, request, frame)
        fine = same(found, right) or (isinstance(found, RegscribeError) and type(found).__name__ != "ExceptionAnswer")
        assert fine, (frame.hex(" "), found)


def repaired(answer: bytes) -> Iterator[bytes]:
    for bit in range(8 * len(answer)):
        changed = bytearray(answer)
        changed[bit // 8] ^= 1 << bit % 8
        yield bytes(changed)


@pytest.mark.parametrize("framing", ["tcp", "rtu", "ascii"])
@pytest.mark.parametrize("kind", [kind for kind in ANSWERS if kind != "a refusal"])
def test_with_the_check_repaired_only_values_can_be_forged(kind: str, framing: str) -> None:
    """Function, byte count, address and echo are compared; values, and the count of words written, nobody can."""
    request, answer = ANSWERS[kind]
    for forged in repaired(answer):
        found = heard(framing, request, framed(framing, forged))
        behind = {1: 2, 3: 2, 16: 3}.get(request.function, len(answer))
        if forged[behind:] == answer[behind:]:
            assert isinstance(found, RegscribeError), (forged.hex(" "), found)
            assert type(found).__name__ in {"WrongAnswer", "NoAnswer"}, (forged.hex(" "), found)


@contextmanager
def line(transport: str, kind: str, *, retry: int = 1) -> Iterator[tuple[Far, SyncSide]]:
    far = Far(transport, seed=1, rate=0.0)
    side = SIDES[kind](far, transport)
    side.bus.link.retry = Retry(retry, 0.001)
    try:
        yield far, side
    finally:
        side.close()
        far.close()


def good(side: SyncSide, far: Far, path: str = "setpoint", unit: int = 1) -> None:
    """The line works, and tells the truth."""
    found = side.perform(Op("read", unit, ((path, None),)))
    assert found.error is None, found
    register = type(side.bus[unit]).registers[path]
    state = {"places": far.words(unit, "places")[0]}
    assert found.value == register.decode(far.words(unit, path), state=state)


SHORTEST = {"tcp": 11, "rtu-tcp": 7, "ascii-tcp": 15}
"""Bytes of an answer of one word."""


@pytest.mark.parametrize("kind", ["sync", "async"])
@pytest.mark.parametrize("transport", SHORTEST)
def test_a_disconnection_at_every_byte_of_an_answer(transport: str, kind: str) -> None:
    with line(transport, kind) as (far, side):
        places = range(0, SHORTEST[transport] + 1, 1 if kind == "sync" else 5)
        for at in places:
            far.faults.plan(LineFault.HANGUP, at=at)
            good(side, far)
            far.faults.plan(LineFault.HANGUP, at=at)
            found = side.perform(Op("write", 1, (("setpoint", 200 + at),)))
            # a connection that ended behind a whole answer is noticed at the next request only, which never arrived
            arrived = int(found.error is None or not isinstance(found.error, NotWritten))
            assert arrived or at >= SHORTEST[transport], found
            assert found.error is None or isinstance(found.error, NotWritten)
            assert far.executed[1, "holding", 0, 200 + at] == arrived
        assert far.faults.injected[LineFault.HANGUP] > len(places)


@pytest.mark.parametrize("transport", ["tcp", "rtu-tcp", "ascii-tcp"])
def test_every_fault_alone_gives_the_value_or_an_error_and_passes(transport: str) -> None:
    with line(transport, "sync", retry=0) as (far, side):
        for number, fault in enumerate(USUAL):
            far.faults.plan(fault, None, None)
            found = side.perform(Op("read", 1, (("setpoint", None),)))
            assert found.value == 70 if found.error is None else isinstance(found.error, RegscribeError), (fault, found)
            far.faults.plan(fault)
            side.perform(Op("write", 2, (("rate", number + 1),)))
            assert far.executed[2, "holding", 2, number + 1] <= 1
            far.faults.calm()
            good(side, far)
        missing = {LineFault.FOREIGN_TRANSACTION} if transport != "tcp" else set()
        assert set(USUAL) - set(far.faults.injected) <= missing


OPERATIONS = {
    "read": Op("read", 1, (("heat", None),)),
    "read_many": Op("read_many", 1, (("heat", None), ("band", None), ("fan", None), ("inside", None))),
    "write": Op("write", 1, (("band", 77),)),
    "configure": Op("configure", 1, (("places", 2), ("span_low", 5), ("cycle", 9))),
    "broadcast": Op("broadcast", 0, (("places", 0),)),
}


@pytest.mark.parametrize("transport", FRAMINGS)
@pytest.mark.parametrize("name", OPERATIONS)
def test_a_task_that_is_cancelled_at_any_of_its_awaits_leaves_the_bus_usable(name: str, transport: str) -> None:
    with line(transport, "async") as (far, side):
        for at in itertools.count(1):
            good(side, far, "heat")  # what it depends on is remembered now
            found = side.perform(OPERATIONS[name]._replace(cancel=at))
            if not found.cancelled:
                break
            for path in ("heat", "band", "span_low"):
                good(side, far, path)
            good(side, far, "heat", unit=2)
        assert found.error is None, found
        assert at > 1
        assert max(far.executed.values(), default=0) <= 2 * at


@pytest.mark.parametrize("transport", ["tcp", "pty"])
def test_a_task_that_is_cancelled_while_others_wait_lets_them_go_on(transport: str) -> None:
    with line(transport, "async") as (far, side):
        for at in range(1, 6):
            ops = [Op("read", 1, (("setpoint", None),), at), *(Op("read", unit, (("band", None),)) for unit in (1, 2))]
            first, *others = side.together(ops)
            assert [one.error for one in others] == [None, None]
            assert first.cancelled or first.error is None
        good(side, far)


@pytest.mark.parametrize("framing", ["tcp", "rtu", "ascii"])
@pytest.mark.parametrize("kind", ANSWERS)
def test_the_sound_answer_of_another_unit_is_never_taken(kind: str, framing: str) -> None:
    request, answer = ANSWERS[kind]
    for unit in (0, 1, UNIT - 1, UNIT + 1, 247, 255):
        found = heard(framing, request, framing_for(framing).build(unit, answer))
        assert isinstance(found, (WrongAnswer, NoAnswer)), (unit, found)


@pytest.mark.parametrize("kind", ANSWERS)
def test_the_sound_answer_to_another_transaction_is_never_taken(kind: str) -> None:
    request, answer = ANSWERS[kind]
    other = framing_for("tcp")
    for _ in range(20):
        frame = other.build(UNIT, answer)
        found = heard("tcp", request, frame)
        assert int.from_bytes(frame[:2], "big") == 1 or isinstance(found, NoAnswer), found


@pytest.mark.parametrize("transport", ["tcp", "rtu-tcp", "pty"])
def test_the_answer_to_an_earlier_request_is_never_taken(transport: str) -> None:
    with line(transport, "sync") as (far, side):
        for unit, path in itertools.product((1, 2), ("setpoint", "inside", "second_setpoint", "rate", "cycle")):
            good(side, far, path, unit)
            far.devices[unit].poke(path, 100 * unit + len(path))
            far.faults.plan(LineFault.STALE)
            good(side, far, path, unit)
        assert far.faults.injected[LineFault.STALE] > 5


def unplugged(request: bytes, answer: bytes, at: int, path: Path) -> threading.Thread:
    """A serial adapter at `path` that is pulled out behind byte `at` of its answer, and put in again at once."""

    def plug() -> int:
        ours, theirs = os.openpty()
        tty.setraw(theirs)
        path.unlink(missing_ok=True)
        path.symlink_to(os.ttyname(theirs))
        kept.append(theirs)
        return ours

    def take(adapter: int) -> None:
        received = b""
        while len(received) < len(request):
            received += os.read(adapter, 100)

    def serve() -> None:
        take(first)
        os.write(first, answer[:at])
        second = plug()
        os.close(kept.pop(0))
        os.close(first)
        take(second)
        os.write(second, answer)
        done.wait(5)
        os.close(second)
        os.close(kept.pop())

    kept: list[int] = []
    done = threading.Event()
    first = plug()
    thread = threading.Thread(target=serve, daemon=True)
    thread.done = done  # type: ignore[attr-defined] # whoever waits for it says when
    thread.start()
    return thread


@pytest.mark.parametrize("kind", ["sync", "async"])
def test_an_adapter_that_is_pulled_out_at_every_byte_of_an_answer_is_opened_again(kind: str, tmp_path: Path) -> None:
    request, answer = framed("rtu", b"\x03\x00\x1c\x00\x01"), framed("rtu", b"\x03\x02\x12\x34")
    before = descriptors()
    for at in range(len(answer)):
        path = tmp_path / f"adapter{at}"
        far = unplugged(request, answer, at, path)
        assert asked_twice(kind, str(path)) == (0x1234,)
        far.done.set()  # type: ignore[attr-defined] # as above
        far.join(5)
    assert descriptors() == before


def asked_twice(kind: str, path: str) -> tuple[int, ...]:
    """The words of a read that is tried again after the link was lost."""
    how: dict[str, Any] = {"baud": 115200, "timeout": 0.2, "echo": False}

    async def talk() -> tuple[int, ...]:
        made = connect.async_serial(path, **how)
        await made.open()
        with pytest.raises(LinkLost):
            await made.call(UNIT, Request(3, 28))
        found = (await made.call(UNIT, Request(3, 28))).words
        await made.close()
        return found

    if kind == "async":
        return asyncio.run(talk())
    made = connect.serial(path, **how)
    made.open()
    with pytest.raises(LinkLost):
        made.call(UNIT, Request(3, 28))
    found = made.call(UNIT, Request(3, 28)).words
    made.close()
    return found
