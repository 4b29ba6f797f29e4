"""Timeouts follow from what the manuals say, and from the line."""

from fractions import Fraction

import pytest

from regscribe_devices.athena.platinum_m5000 import AthenaM5000
from regscribe_devices.athena.series_c import Athena16C
from regscribe_runtime import SerialLine
from regscribe_runtime.link.timing import (
    GATEWAY_SECONDS,
    MARGIN_SECONDS,
    characters,
    more_in_ascii,
    on_line,
    response_seconds,
)
from regscribe_runtime.values.protocol import Latency, Protocol
from regscribe_runtime.wire.requests import LOOPBACK, Request

AT_9600 = SerialLine("", 9600)
SERIES_C, PLATINUM = Athena16C.protocol, AthenaM5000.protocol
CHARACTER = 10 / 9600


def test_two_registers_of_series_c_begin_to_come_within_the_204_milliseconds_of_its_manual() -> None:
    frames = sum(characters(Request(3, 0, 2))) * CHARACTER
    assert on_line(SERIES_C, Request(3, 0, 2), AT_9600) - frames == pytest.approx(0.20417, abs=5e-6)


def test_platinum_takes_three_characters_and_ten_milliseconds_to_a_read_and_fifty_more_to_each_word_written() -> None:
    read, write = Request(3, 0, 4), Request(16, 0, 4, (0,) * 4)
    frames = {
        one: sum(characters(one)) * CHARACTER + AT_9600.silence(float(PLATINUM.serial.gap)) for one in (read, write)
    }
    assert on_line(PLATINUM, read, AT_9600) - frames[read] == pytest.approx(3 * CHARACTER + 0.010)
    assert on_line(PLATINUM, write, AT_9600) - frames[write] == pytest.approx(3 * CHARACTER + 0.010 + 4 * 0.050)


@pytest.mark.parametrize(
    ("latencies", "seconds"),
    [
        ((), 1.0),  # the manual says nothing at all
        ((Latency(3, maximum=400),), 1.0),
        ((Latency(3, maximum=600), Latency(16, 0, 20, 0, Fraction("97.5"))), (20 + 10 * 97.5) / 1000 + 0.5),
    ],
)
def test_a_function_of_unknown_latency_may_take_as_long_as_a_full_request_of_the_slowest_and_a_margin(
    latencies: tuple[Latency, ...], seconds: float
) -> None:
    protocol = Protocol(read_words=8, write_words=10, latencies=latencies)
    assert protocol.timeout == pytest.approx(seconds)
    assert on_line(protocol, Request(4, 0), AT_9600) - sum(characters(Request(4, 0))) * CHARACTER == pytest.approx(
        protocol.timeout + 3.5 * CHARACTER
    )


@pytest.mark.parametrize(
    ("request_", "sent", "answered"),
    [
        (Request(3, 0, 2), 8, 9),
        (Request(1, 0, 9), 8, 7),
        (Request(6, 0, 1, (5,)), 8, 8),
        (Request(5, 0, 1, (1,)), 8, 8),
        (Request(7, 0), 4, 5),
        (Request(LOOPBACK, 0, 1, (5,)), 8, 8),
        (Request(16, 0, 2, (1, 2)), 13, 8),
        (Request(15, 0, 9, (1,) * 9), 11, 8),
    ],
)
def test_frames_are_as_long_as_the_protocol_makes_them(request_: Request, sent: int, answered: int) -> None:
    assert characters(request_) == (sent, answered)


def test_an_ascii_frame_has_two_characters_a_byte_a_colon_a_check_and_a_line_end() -> None:
    rtu, ascii_ = 8 + 9, (1 + 2 * 6 + 2 + 2) + (1 + 2 * 7 + 2 + 2)
    assert more_in_ascii(Request(3, 0, 2), AT_9600) == pytest.approx((ascii_ - rtu) * CHARACTER)


def test_over_tcp_the_slowest_line_of_the_manual_may_lie_behind_a_gateway() -> None:
    slowest = response_seconds(SERIES_C, Request(3, 0, 2), SerialLine("", 300))
    assert response_seconds(SERIES_C, Request(3, 0, 2), None) == pytest.approx(slowest + GATEWAY_SECONDS)
    assert slowest - on_line(SERIES_C, Request(3, 0, 2), SerialLine("", 300)) == pytest.approx(MARGIN_SECONDS)
