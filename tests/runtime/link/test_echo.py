"""Two-wire adapters give back what is sent: the echo is told from the answer, also where both are alike."""

from typing import Any

import pytest

from regscribe_runtime import NoAnswer, Retry, WrongAnswer
from regscribe_runtime.link import connect
from regscribe_runtime.link.links import Link
from regscribe_runtime.wire.requests import Request

from .conftest import FarEnd
from .test_late import value_of

READ, WRITE, LOOPBACK = Request(3, 28), Request(6, 28, 1, (7,)), Request(8, 0, 1, (0x55AA,))


def opened(far: FarEnd, **more: Any) -> Link:
    link = connect.serial(far.path, baud=115200, **{"timeout": 2.0, "retry": Retry(0), **more})
    link.open()
    return link


def echoing(data: bytes) -> bytes:
    return data


def answering(request: bytes) -> list[tuple[float, bytes]]:
    return [(0.01, value_of(request) if request[1] == 3 else request)]


@pytest.mark.parametrize("echo", [True, None])
@pytest.mark.parametrize("order", [(READ, WRITE, LOOPBACK), (WRITE, READ), (LOOPBACK, WRITE)])
def test_the_echo_is_dropped_and_the_answer_is_used(
    far: FarEnd, *, echo: bool | None, order: tuple[Request, ...]
) -> None:
    far.echo, far.plan = echoing, answering
    link = opened(far, echo=echo)
    for request in order:
        assert link.call(1, request).words == (request.words or (28,))
    link.close()


@pytest.mark.parametrize("echo", [True, None])
@pytest.mark.parametrize("request_", [READ, WRITE, LOOPBACK])
def test_an_echo_without_a_device_is_no_answer(far: FarEnd, *, echo: bool | None, request_: Request) -> None:
    far.echo = echoing
    link = opened(far, echo=echo, timeout=0.2)
    with pytest.raises(NoAnswer):
        link.call(1, request_)
    link.close()


@pytest.mark.parametrize("echo", [False, None])
@pytest.mark.parametrize("order", [(READ, WRITE), (WRITE, READ), (LOOPBACK,)])
def test_a_line_without_echo_is_taken_as_it_is(far: FarEnd, *, echo: bool | None, order: tuple[Request, ...]) -> None:
    far.plan = answering
    link = opened(far, echo=echo)
    for request in order:
        assert link.call(1, request).words == (request.words or (28,))
    link.close()


def test_another_echo_is_a_collision(far: FarEnd) -> None:
    far.echo = lambda data: bytes([data[0] ^ 0x10]) + data[1:]
    link = opened(far, echo=True)
    with pytest.raises(WrongAnswer, match=r"collision on the line, 01 03 .* was sent and 11 03 .* heard"):
        link.call(1, READ)
    link.close()


def test_a_missing_echo_asks_whether_there_is_one(far: FarEnd) -> None:
    link = opened(far, echo=True, timeout=0.1)
    with pytest.raises(WrongAnswer, match=r"0 of 8 bytes were echoed. Without echo, open it with echo=False"):
        link.call(1, READ)
    link.close()
