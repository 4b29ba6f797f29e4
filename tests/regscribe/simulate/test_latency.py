"""Time: latencies by function and word, characters at the speed of the line, and silence between frames."""

import asyncio
import os
import select
import socket
import struct
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from fractions import Fraction

import pytest

from regscribe.model import Latency, RegisterMap, SerialDefaults
from regscribe.simulate import Running, SerialLine, SimulatedDevice, SimulatorError, find_map, simulate
from regscribe.simulate.line.server_context import ServerContext, factor_of
from regscribe_runtime.wire.framing import Frame, build

READ_ONE = struct.pack(">BHH", 3, 2, 1)
READ_FOUR = struct.pack(">BHH", 3, 2, 4)
SLOW = SerialLine.of("", 1200, "8N1")


def timed(found: RegisterMap, *latencies: Latency, gap: Fraction = Fraction(7, 2)) -> RegisterMap:
    return replace(found, protocol=found.protocol._replace(latencies=latencies, serial=SerialDefaults(gap=gap)))


def thought(found: RegisterMap, pdu: bytes, line: SerialLine = SLOW, *, factor: float = 1.0, seed: int = 0) -> float:
    device = SimulatedDevice(found, "16C", seed=seed)
    return ServerContext([device], line=line, factor=factor).delay(Frame(1, pdu))


def fixed(**parts: int) -> Latency:
    low = {name: Fraction(value) for name, value in parts.items()}
    return Latency(
        3, minimum=low["each"], maximum=low["each"], minimum_per_word=low["word"], maximum_per_word=low["word"]
    )


@pytest.mark.parametrize(("pdu", "seconds"), [(READ_ONE, 0.015), (READ_FOUR, 0.030)])
def test_a_latency_has_a_part_for_each_word(controller: RegisterMap, pdu: bytes, seconds: float) -> None:
    assert thought(timed(controller, fixed(each=10, word=5)), pdu) == pytest.approx(seconds)


def test_characters_take_their_time_at_the_speed_of_the_line(controller: RegisterMap) -> None:
    found = timed(controller, Latency(3, characters=Fraction(3)))
    assert thought(found, READ_ONE, SerialLine.of("", 1200, "8N1")) == pytest.approx(3 * 10 / 1200)
    assert thought(found, READ_ONE, SerialLine.of("", 9600, "8E1")) == pytest.approx(3 * 11 / 9600)


def test_a_factor_scales_and_functions_without_latency_take_none(controller: RegisterMap) -> None:
    found = timed(controller, fixed(each=10, word=0))
    assert thought(found, READ_ONE, factor=0.1) == pytest.approx(0.001)
    assert thought(found, struct.pack(">BHH", 6, 2, 50)) == 0


def test_latencies_lie_between_the_limits_and_a_seed_repeats_them(controller: RegisterMap) -> None:
    found = timed(controller, Latency(3, minimum=Fraction(5), maximum=Fraction(100)))
    devices = [SimulatedDevice(found, "16C", seed=seed) for seed in (1, 1, 2)]
    contexts = [ServerContext([device], line=SLOW, factor=1.0) for device in devices]
    series = [[context.delay(Frame(1, READ_ONE)) for _ in range(20)] for context in contexts]
    assert series[0] == series[1] != series[2]
    assert all(0.005 <= seconds <= 0.1 for seconds in series[0])
    assert len(set(series[0])) > 1


def test_a_device_under_another_address_takes_as_long() -> None:
    device = SimulatedDevice(find_map("athena/series-c"), "16C")
    context = ServerContext([device], line=SLOW, factor=1.0)
    device.handle(struct.pack(">BHH", 6, 4081, 5))
    assert (context.delay(Frame(5, READ_ONE)) >= 0.005, context.delay(Frame(1, READ_ONE))) == (True, 0)


@pytest.mark.parametrize(("given", "factor"), [("off", 0), ("real", 1), (0.5, 0.5), ("0.25", 0.25), (0, 0)])
def test_a_latency_is_off_real_or_a_factor(given: float | str, factor: float) -> None:
    assert factor_of(given) == factor


@pytest.mark.parametrize("given", ["fast", -1, "-0.1", float("nan"), float("inf"), "nan", ""])
def test_an_impossible_latency_is_one_clear_message(given: float | str) -> None:
    with pytest.raises(SimulatorError, match="neither off, real, nor a factor"):
        factor_of(given)


def test_a_served_device_takes_its_time(controller: RegisterMap, monkeypatch: pytest.MonkeyPatch) -> None:
    waited: list[float] = []
    sleep = asyncio.sleep

    async def counted(seconds: float) -> None:
        waited.append(seconds)
        await sleep(0)

    monkeypatch.setattr(asyncio, "sleep", counted)
    found = timed(controller, fixed(each=60, word=0))
    with simulate(found, "16C", transport="rtu-tcp", latency="real") as running:
        _read_once(running)
    assert 0.06 in [round(seconds, 3) for seconds in waited]
    waited.clear()
    with simulate(found, "16C", transport="rtu-tcp") as running:
        _read_once(running)
    assert not [seconds for seconds in waited if seconds >= 0.06]


def _read_once(running: Running) -> None:
    with socket.create_connection((running.host, running.port), timeout=60) as link:
        link.sendall(_rtu(READ_ONE))
        assert link.recv(100)


def _rtu(pdu: bytes) -> bytes:
    return build("rtu", 1, pdu)


@contextmanager
def _opened(path: str) -> Iterator[int]:
    fd = os.open(path, os.O_RDWR | os.O_NOCTTY)
    try:
        yield fd
    finally:
        os.close(fd)


def _read(fd: int, size: int, timeout: float) -> bytes:
    data, until = b"", time.monotonic() + timeout
    while len(data) < size and select.select([fd], [], [], max(0.0, until - time.monotonic()))[0]:
        data += os.read(fd, size - len(data))
    return data


def test_bytes_on_a_paced_pty_take_their_time(controller: RegisterMap) -> None:
    frame, answer = _rtu(READ_FOUR), 5 + 8
    found = timed(controller, gap=Fraction(4))
    with simulate(found, "16C", transport="pty", paced=True, line=SLOW) as running, _opened(running.path) as fd:
        begun = time.monotonic()
        os.write(fd, frame)
        assert len(_read(fd, answer, 5)) == answer
        took = time.monotonic() - begun
    assert (len(frame) + 4 + answer) * SLOW.character <= took


def test_requests_without_silence_between_them_are_lost_on_a_paced_pty(controller: RegisterMap) -> None:
    line = SerialLine(baud=19200)
    with simulate(controller, "16C", transport="pty", paced=True, line=line) as running, _opened(running.path) as fd:
        os.write(fd, _rtu(READ_ONE) * 2)
        assert _read(fd, 1, 0.1) == b""
        os.write(fd, _rtu(READ_ONE))
        assert len(_read(fd, 7, 2)) == 7


@pytest.mark.parametrize("strict", [False, True])
def test_a_request_too_soon_after_an_answer_is_lost_with_strict_gaps(controller: RegisterMap, *, strict: bool) -> None:
    found = timed(controller, gap=Fraction(100))
    options = {"transport": "pty", "paced": True, "line": SerialLine(baud=9600), "strict_gaps": strict}
    with simulate(found, "16C", **options) as running, _opened(running.path) as fd:  # type: ignore[arg-type]  # keywords
        os.write(fd, _rtu(READ_ONE))
        assert len(_read(fd, 7, 2)) == 7
        os.write(fd, _rtu(READ_ONE))
        assert len(_read(fd, 7, 0.4)) == (0 if strict else 7)


def test_only_a_pty_can_be_paced(controller: RegisterMap) -> None:
    with (
        pytest.raises(SimulatorError, match="only a pty can be paced, not tcp"),
        simulate(controller, "16C", paced=True),
    ):
        pass


def test_a_client_that_sends_and_hangs_up_gets_its_slow_answer(controller: RegisterMap) -> None:
    found = timed(controller, fixed(each=50, word=0))
    with (
        simulate(found, "16C", transport="rtu-tcp", latency="real") as running,
        socket.create_connection((running.host, running.port), timeout=5) as link,
    ):
        link.sendall(_rtu(READ_ONE))
        link.shutdown(socket.SHUT_WR)
        assert len(link.recv(100)) == 7
        assert link.recv(100) == b""
