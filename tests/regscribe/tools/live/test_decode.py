import re
from collections.abc import Sequence

import pytest
from hypothesis import given
from hypothesis import strategies as st

from regscribe.cli.commands.decode import command
from regscribe.tools.live import catalogue
from regscribe.tools.live.capture import RECEIVED, SENT, captured
from regscribe.tools.live.decode import Decoded, Decoder
from regscribe.tools.live.errors import TargetError
from regscribe.tools.live.stated_words import exchange
from regscribe_runtime.wire.capture import frames
from regscribe_runtime.wire.framing import build

OVEN = catalogue.find("16C").driver
STATE = {"input_type": 3, "display_unit_of_measure": 1, "ieee_register_ordering": 0}


def rtu(digits: str) -> bytes:
    data = bytes.fromhex(digits) or b"\0"
    return build("rtu", data[0], data[1:])


def ascii_frame(digits: str) -> str:
    data = bytes.fromhex(digits)
    return f":{(data + bytes([-sum(data) & 0xFF])).hex().upper()}"


def decoded(lines: Sequence[str], decoder: Decoder | None = None) -> list[Decoded]:
    reader = decoder or Decoder(OVEN, state=STATE)
    return [reader.feed(frame, one.direction) for one in captured(lines) for frame in one.frames]


def test_the_crc_is_that_of_the_specification() -> None:
    # Modbus over Serial Line V1.02, appendix B: the frame 02 07 has the CRC 41 12 on the line
    assert rtu("0207") == bytes.fromhex("02 07 41 12")


@pytest.mark.parametrize(
    "line",
    [
        rtu("010317A50002").hex(),
        rtu("010317A50002").hex(" "),
        rtu("010317A50002").hex(":").upper(),
        "2026-11-22 12:30:01,123 DEBUG TX " + rtu("010317A50002").hex(" "),
        "12:30:01.5 send: " + " ".join(f"0x{byte:x}" for byte in rtu("010317A50002")),
        "".join(f"[{byte:02X}]" for byte in rtu("010317A50002")),
        "00:01 " + ascii_frame("010317A50002"),
        "modbus > 00 07 00 00 00 06 01 03 17 A5 00 02",
        "000700000006010317a50002",
    ],
)
def test_a_frame_is_found_in_the_log_of_any_program(line: str) -> None:
    (one,) = captured([line])
    (frame,) = one.frames
    assert (frame.unit, frame.pdu.hex(), frame.complaint) == (1, "0317a50002", "")


def test_a_line_says_which_way_its_frame_went() -> None:
    lines = [f"{word} {rtu('0107').hex(' ')}" for word in ("TX", "recv:", "->", "<-", "")]
    assert [one.direction for one in captured(lines)] == [SENT, RECEIVED, SENT, RECEIVED, ""]


def test_an_answer_has_the_names_of_its_request() -> None:
    asked, answer = decoded([rtu("01031F440002").hex(), rtu("01030443168000").hex()])
    assert (asked.kind, [item.name for item in asked.items]) == ("request", ["setpoint_ram"])
    (item,) = answer.items
    assert (answer.kind, item.value, item.unit, item.words) == ("response", 150.5, "°F", (0x4316, 0x8000))


def test_a_value_whose_meaning_is_not_in_the_capture_is_no_value() -> None:
    _, answer = decoded([rtu("01031F440002").hex(), rtu("01030443168000").hex()], Decoder(OVEN))
    (item,) = answer.items
    assert (item.value, item.problem) == (None, "4316 8000; ieee_register_ordering decides what it means")


def test_what_the_capture_shows_of_a_unit_decides_what_its_other_registers_mean() -> None:
    order = [rtu("01030FF40001").hex(), rtu("0103020001").hex()]
    kind = [rtu("01030FD10001").hex(), rtu("0103020003").hex(), rtu("01030FE60001").hex(), rtu("0103020001").hex()]
    value = [rtu("01031F440002").hex(), rtu("01030480004316").hex()]
    assert decoded([*order, *kind, *value], Decoder(OVEN))[-1].items[0].value == 150.5
    foreign = [rtu("02031F440002").hex(), rtu("02030480004316").hex()]
    assert decoded([*order, *kind, *foreign], Decoder(OVEN))[-1].items[0].value is None


def test_a_write_shows_its_values_and_its_echo_that_they_are_written() -> None:
    request, answer = decoded([rtu("01101F4400020443168000").hex(), rtu("01101F440002").hex()])
    assert (request.what, request.items[0].value) == ("write holding 8004 to 8005", 150.5)
    assert (answer.kind, answer.what) == ("response", "written")


def test_a_refusal_is_told_in_the_words_of_the_manual() -> None:
    _, refusal = decoded([rtu("010600400001").hex(), rtu("018603").hex()])
    assert (refusal.exception, refusal.what.startswith("exception 03 (invalid data")) == (3, True)


def test_a_refusal_that_the_manual_does_not_list_has_the_name_of_the_specification() -> None:
    _, refusal = decoded([rtu("010300400001").hex(), rtu("01830B").hex()])
    assert refusal.what == "exception 11 (gateway target device failed to respond)"


def test_a_command_is_known_by_its_words() -> None:
    (request,) = decoded([rtu("01101B5E0002040055005C").hex()])
    assert request.what == "write holding 7006 to 7007 (command clear_latched_alarms)"


def test_half_a_value_is_told_as_such() -> None:
    _, answer = decoded([rtu("01031F440001").hex(), rtu("0103024316").hex()])
    assert answer.items[0].problem == "1 of 2 words: 4316"


def test_a_repeated_request_is_no_answer() -> None:
    ask = rtu("01031F440002").hex()
    assert [one.kind for one in decoded([ask, ask, rtu("01030443168000").hex()])] == ["request", "request", "response"]


def test_what_another_unit_or_function_sends_is_no_answer() -> None:
    ask = rtu("01031F440002").hex()
    for foreign in (rtu("02030443168000"), rtu("01040443168000")):
        _, second = decoded([ask, foreign.hex()])
        assert (second.address, second.items, "to a request that is not in the capture" in second.what) == (
            None,
            (),
            True,
        )


def test_an_answer_without_its_request_is_told_as_such() -> None:
    (answer,) = decoded([f"RX {rtu('01030443168000').hex()}"])
    assert answer.what == "function 03, to a request that is not in the capture"


def test_addresses_counted_from_one_are_those_of_the_map() -> None:
    asked = decoded([rtu("01031F450002").hex()], Decoder(OVEN, first=1))
    assert [item.name for item in asked[0].items] == ["setpoint_ram"]


def test_bits_are_decoded_too() -> None:
    timer = catalogue.find("M300").driver
    flag = next(one for one in timer.registers.values() if one.views[0].space in {"coil", "discrete"})
    function = {"coil": "01", "discrete": "02"}[flag.views[0].space]
    ask, answer = rtu(f"01{function}{flag.at:04X}0001"), rtu(f"01{function}0101")
    assert decoded([ask.hex(), answer.hex()], Decoder(timer))[1].items[0].words == (1,)


@given(st.lists(st.binary(max_size=40), max_size=6), st.sampled_from(["", SENT, RECEIVED]))
def test_any_bytes_are_decoded_without_an_error(parts: list[bytes], direction: str) -> None:
    decoder = Decoder(OVEN)
    for part in parts:
        for frame in [*frames(part), *frames(rtu(part.hex()))]:
            decoder.feed(frame, direction)


@given(st.lists(st.text(), max_size=4))
def test_any_text_can_be_searched_for_frames(lines: list[str]) -> None:
    decoded(lines)


@pytest.mark.parametrize(
    ("frame", "told"),
    [
        ("018302", "exception 02"),
        ("0103020002", "function 03, to a request that is not in the capture"),
        ("01030400004316", "function 03, to a request that is not in the capture"),
        ("01101F440002", "function 16, to a request that is not in the capture"),
        ("010722", "function 07, to a request that is not in the capture"),
    ],
)
def test_an_answer_alone_is_not_taken_for_a_request(frame: str, told: str) -> None:
    (one,) = decoded([rtu(frame).hex(" ")])
    assert (one.kind, one.what[: len(told)], one.address, one.complaint) == ("response", told, None, "")


def test_the_frame_in_the_help_is_sound() -> None:
    (frame,) = re.findall(r"decode 16C ([0-9A-F ]+)\n", command.epilog or "")
    assert [(one.address, one.complaint) for one in decoded([frame])] == [(4000, "")]


def test_the_id_of_a_map_names_its_only_model() -> None:
    assert catalogue.find("athena/platinum-m5000").model == "M5000"
    with pytest.raises(TargetError, match="fdc/series-100 has several models: write fdc/series-100:B"):
        catalogue.find("fdc/series-100")


def stated(text: str, decoder: Decoder) -> str:
    asked, answered = exchange(decoder.driver, text)
    decoder.feed(asked)
    return " ".join(item.spelled for item in decoder.feed(answered).items)


@pytest.mark.parametrize("where", ["4049", "0xFD1", "44050", "holding:4049", "input_type"])
def test_a_word_read_elsewhere_is_decoded_by_its_address_in_any_notation_and_by_its_register(where: str) -> None:
    assert stated(f"{where}=3", Decoder(OVEN)) == "input_type = J_THERMOCOUPLE"


def test_words_before_decide_what_later_ones_mean() -> None:
    decoder = Decoder(OVEN, state={"ieee_register_ordering": 0})
    assert "decides what it means" in stated("8004=0x4316,0x8000", decoder)
    stated("input_type=3", decoder)
    stated("display_unit_of_measure=1", decoder)
    assert stated("8004=0x4316,0x8000", decoder) == "setpoint_ram = 150.5 °F"  # 2^7 times 1 + 0x168000/2^23


def test_signed_words_are_taken_as_well() -> None:
    decoder = Decoder(OVEN, state=STATE)
    assert stated("4004=-5", decoder) == stated("4004=0xFFFB", decoder) != stated("4004=5", decoder)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("8005=1", "is word 2 of 2 of setpoint_ram, which begins at 8004: write 8004=0x0,0x0"),
        ("8004=1", "8004 has 2 words: write 8004=0x0,0x0, the first one first"),
        ("4049=65536", "`65536` is no word"),
        ("4049=", "`` is no word"),
        ("60000=1", "no register of 16C has the address 60000"),
        ("setpont=1", "did you mean `setpoint_ram`"),
    ],
)
def test_words_that_cannot_be_placed_are_refused_with_what_to_write(text: str, said: str) -> None:
    with pytest.raises(TargetError, match=re.escape(said)):
        exchange(OVEN, text)


def test_an_address_of_a_word_is_that_of_the_map_where_a_line_counts_from_1_too() -> None:
    decoder = Decoder(OVEN, first=1)
    asked, answered = exchange(OVEN, "4049=3", decoder.first)
    decoder.feed(asked)
    assert [item.spelled for item in decoder.feed(answered).items] == ["input_type = J_THERMOCOUPLE"]
