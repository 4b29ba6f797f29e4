"""Timeouts follow from what the manuals say, and from the line."""

import pytest

from regscribe_devices.athena.platinum_m5000 import AthenaM5000
from regscribe_devices.athena.series_c import Athena16C
from regscribe_runtime import Line
from regscribe_runtime.link.timing import (
    GATEWAY_SECONDS,
    MARGIN_SECONDS,
    characters,
    more_in_ascii,
    on_line,
    response_seconds,
    silence,
)
from regscribe_runtime.wire.requests import LOOPBACK, Request

AT_9600 = Line("", 9600)
SERIES_C, PLATINUM = Athena16C.protocol, AthenaM5000.protocol
CHARACTER = 10 / 9600


def test_four_characters_of_silence_at_9600_baud_take_what_the_manual_calculates() -> None:
    assert silence(AT_9600, SERIES_C.gap) == pytest.approx(0.00417, abs=5e-6)  # Series C, 1.2.8.4


def test_a_parity_bit_makes_a_character_longer() -> None:
    assert Line("", 9600, parity="E").character == 11 / 9600  # Series C, 1.2.8.3: CharBits is 11 with parity


def test_two_registers_of_series_c_begin_to_come_within_the_204_milliseconds_of_its_manual() -> None:
    frames = sum(characters(Request(3, 0, 2))) * CHARACTER
    assert on_line(SERIES_C, Request(3, 0, 2), AT_9600) - frames == pytest.approx(0.20417, abs=5e-6)


def test_platinum_takes_three_characters_and_ten_milliseconds_to_a_read_and_fifty_more_to_each_word_written() -> None:
    read, write = Request(3, 0, 4), Request(16, 0, 4, (0,) * 4)
    frames = {one: sum(characters(one)) * CHARACTER + silence(AT_9600, PLATINUM.gap) for one in (read, write)}
    assert on_line(PLATINUM, read, AT_9600) - frames[read] == pytest.approx(3 * CHARACTER + 0.010)
    assert on_line(PLATINUM, write, AT_9600) - frames[write] == pytest.approx(3 * CHARACTER + 0.010 + 4 * 0.050)


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


def test_above_19200_baud_the_silence_is_a_fixed_time() -> None:
    assert silence(Line("", 115200), 3.5) == 0.00175
    assert silence(Line("", 115200), 0) == 0
    assert silence(Line("", 19200), 3.5) == pytest.approx(3.5 * 10 / 19200)


def test_over_tcp_the_slowest_line_of_the_manual_may_lie_behind_a_gateway() -> None:
    slowest = response_seconds(SERIES_C, Request(3, 0, 2), Line("", 300))
    assert response_seconds(SERIES_C, Request(3, 0, 2), None) == pytest.approx(slowest + GATEWAY_SECONDS)
    assert slowest - on_line(SERIES_C, Request(3, 0, 2), Line("", 300)) == pytest.approx(MARGIN_SECONDS)


@pytest.mark.parametrize("wrong", [{"baud": 0}, {"baud": 9600, "parity": "X"}, {"baud": 9600, "data_bits": 9}])
def test_a_line_that_no_port_can_be_set_to_is_refused(wrong: dict[str, object]) -> None:
    with pytest.raises(ValueError, match=r"baud|character format"):
        Line("", **wrong).checked()  # type: ignore[arg-type] # wrong on purpose
