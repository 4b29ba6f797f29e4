"""Requests and answers as the manuals describe them, without a line."""

import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st

from regscribe.model import RegisterMap
from regscribe.simulate import SimulatedDevice

GIVENS = {"linear_inputs": {18}}


@pytest.fixture
def device(controller: RegisterMap) -> SimulatedDevice:
    return SimulatedDevice(controller, "16C")


@pytest.fixture
def affine(affine_controller: RegisterMap) -> SimulatedDevice:
    return SimulatedDevice(affine_controller, "C21", givens=GIVENS)


@pytest.fixture
def io(bit_device: RegisterMap) -> SimulatedDevice:
    return SimulatedDevice(bit_device, "IO")


def ask(device: SimulatedDevice, *numbers: int, form: str = "HH", data: bytes = b"") -> bytes | None:
    return device.handle(struct.pack(f">B{form}", *numbers) + data)


def read(device: SimulatedDevice, address: int, count: int, function: int = 3) -> tuple[int, ...] | int | None:
    """The words of an answer, the exception code, or None for silence."""
    answer = ask(device, function, address, count)
    if answer is None or answer[0] & 0x80:
        return answer[1] if answer else None
    assert answer[:2] == bytes((function, 2 * count))
    return struct.unpack(f">{count}H", answer[2:])


def write(device: SimulatedDevice, address: int, *words: int) -> tuple[int, int] | int | None:
    """Address and count of an answer to function 16, the exception code, or None for silence."""
    data = struct.pack(f">{len(words)}H", *words)
    answer = ask(device, 16, address, len(words), len(data), form="HHB", data=data)
    if answer is None or answer[0] & 0x80:
        return answer[1] if answer else None
    return struct.unpack(">HH", answer[1:])


def test_a_read_shows_each_word_in_order(device: SimulatedDevice) -> None:
    assert read(device, 2, 3) == (77, 0x10000 - 50, 9000)


def test_writing_x10_sets_what_base_and_ieee_show(device: SimulatedDevice) -> None:
    assert ask(device, 6, 1002, 1205) == struct.pack(">BHH", 6, 1002, 1205)
    assert read(device, 2, 1) == (121,)
    assert read(device, 8004, 2) == (0x0000, 0x42F1)


def test_writing_ieee_keeps_the_decimal_that_was_meant(device: SimulatedDevice) -> None:
    assert write(device, 8004, 0x3333, 0x42F0) == (8004, 2)
    assert device.state.stored("setpoint") * 10 == 1201
    assert read(device, 1002, 1) == (1201,)
    assert read(device, 8004, 2) == (0x3333, 0x42F0)


def test_a_written_order_counts_for_the_next_write(device: SimulatedDevice) -> None:
    assert write(device, 4084, 0) == (4084, 1)
    assert write(device, 8004, 0x437A, 0) == (8004, 2)
    assert device.peek("setpoint") == 250


@pytest.mark.parametrize("count", [0, 25, 125, 126, 65535])
def test_too_many_or_no_words_are_ignored_in_silence(device: SimulatedDevice, count: int) -> None:
    assert read(device, 0, count) is None


def test_too_many_words_to_write_are_ignored_and_nothing_is_written(device: SimulatedDevice) -> None:
    assert write(device, 2, *[5] * 25) is None
    assert device.peek("setpoint") == 77


def test_where_the_map_gives_a_code_too_many_words_are_answered(affine: SimulatedDevice) -> None:
    assert read(affine, 0, 80) == 3
    assert write(affine, 0, *[0] * 80) == 3


def test_an_odd_count_of_ieee_words_is_ignored(device: SimulatedDevice) -> None:
    assert read(device, 8004, 3) is None
    assert write(device, 8004, 0, 0x437A, 0) is None
    assert device.peek("setpoint") == 77


def test_an_odd_ieee_address_is_an_invalid_address(device: SimulatedDevice) -> None:
    assert read(device, 8005, 2) == 2
    assert write(device, 8005, 0, 0) == 2


def test_function_06_does_not_reach_the_ieee_region(device: SimulatedDevice) -> None:
    assert ask(device, 6, 8004, 0) == b"\x86\x02"
    assert ask(device, 6, 9000, 0) == b"\x86\x02"


@pytest.mark.parametrize("address", [1, 999, 2000, 4070, 8012, 65535])
def test_an_invalid_first_address_is_refused(device: SimulatedDevice, address: int) -> None:
    assert read(device, address, 2 if address >= 8000 else 1) == 2
    assert write(device, address, *([0, 0] if address >= 8000 else [0])) == 2


def test_later_invalid_addresses_read_as_garbage_that_the_seed_repeats(controller: RegisterMap) -> None:
    reads = [read(SimulatedDevice(controller, "16C", seed=seed), 4, 3) for seed in (0, 0, 1)]
    assert reads[0] == reads[1] != reads[2]
    assert reads[0] is not None
    assert [words[0] for words in reads if isinstance(words, tuple)] == [9000] * 3


def test_a_read_runs_off_the_last_address_as_garbage_too(device: SimulatedDevice) -> None:
    assert isinstance(read(device, 4091 - 1, 24), tuple)


def test_a_write_stops_at_the_first_bad_address_and_counts_what_it_wrote(device: SimulatedDevice) -> None:
    assert write(device, 2, 100, 0, 500, 1, 1) == (2, 3)
    assert [device.peek(path) for path in ("setpoint", "low_limit", "high_limit")] == [100, 0, 500]


def test_a_write_stops_at_the_first_bad_value(device: SimulatedDevice) -> None:
    assert write(device, 4072, 2, 3) == (4072, 1)
    assert device.peek("alarm_1_action") == 2


def test_without_partial_writes_a_refused_request_changes_nothing(io: SimulatedDevice) -> None:
    assert write(io, 40, 7, 7) == 2
    assert io.peek("plain") == 0


def test_a_write_to_a_read_only_register_is_refused(device: SimulatedDevice) -> None:
    assert ask(device, 6, 0, 5) == b"\x86\x03"
    assert ask(device, 6, 4011, 5) == b"\x86\x03"


@pytest.mark.parametrize(("address", "word"), [(4072, 3), (4072, 9), (4049, 23), (4084, 2), (11, 2401), (11, 0xFFFF)])
def test_a_value_outside_enum_or_range_is_refused(device: SimulatedDevice, address: int, word: int) -> None:
    assert ask(device, 6, address, word) == b"\x86\x03"


def test_a_special_value_is_accepted_beside_the_range(device: SimulatedDevice) -> None:
    assert ask(device, 6, 11, 9999) == struct.pack(">BHH", 6, 11, 9999)


def test_limits_that_are_registers_move_with_them(device: SimulatedDevice) -> None:
    assert ask(device, 6, 2, 9001) == b"\x86\x03"
    assert ask(device, 6, 4, 9001) == struct.pack(">BHH", 6, 4, 9001)
    assert ask(device, 6, 2, 9001) == struct.pack(">BHH", 6, 2, 9001)


def test_limits_may_be_reduced_by_the_decimals(device: SimulatedDevice) -> None:
    device.poke("decimal_position", 1)
    assert ask(device, 6, 12, 901) == b"\x86\x03"
    assert ask(device, 6, 12, 900) == struct.pack(">BHH", 6, 12, 900)


def test_an_open_limit_is_not_checked(device: SimulatedDevice) -> None:
    assert ask(device, 6, 4, 32767) == struct.pack(">BHH", 6, 4, 32767)
    assert ask(device, 6, 4, 0x10000 - 1000) == b"\x86\x03"


def test_not_a_number_is_refused(device: SimulatedDevice) -> None:
    assert write(device, 8004, 0, 0x7FC0) == 3


def test_a_condition_opens_and_closes_a_register(device: SimulatedDevice) -> None:
    assert ask(device, 6, 4009, 50) == b"\x86\x03"
    device.poke("controller_mode", 1)
    assert ask(device, 6, 4009, 50) == struct.pack(">BHH", 6, 4009, 50)


def test_a_condition_on_a_field_counts_too(affine: SimulatedDevice) -> None:
    assert ask(affine, 6, 66, 1) == b"\x86\x03"
    affine.poke("mode.operation", "MANUAL")
    assert ask(affine, 6, 66, 1) == struct.pack(">BHH", 6, 66, 1)


def test_a_wrong_byte_count_is_ignored(device: SimulatedDevice) -> None:
    assert ask(device, 16, 2, 1, 4, form="HHB", data=b"\0\5\0\5") is None
    assert ask(device, 16, 2, 1, 2, form="HHB", data=b"\0\5\0\5") is None
    assert device.peek("setpoint") == 77


@pytest.mark.parametrize("function", [0, 1, 2, 4, 5, 7, 22, 65, 127])
def test_an_unsupported_function_is_ignored_or_refused_as_the_map_says(
    device: SimulatedDevice, affine: SimulatedDevice, function: int
) -> None:
    assert ask(device, function, 0, 1) is None
    assert ask(affine, function, 0, 1) == bytes((function | 0x80, 1))


def test_an_exception_answer_of_another_unit_is_no_request(affine: SimulatedDevice) -> None:
    assert affine.handle(b"\x83\x02") is None


def test_the_loopback_echoes_subfunction_0_only(device: SimulatedDevice) -> None:
    assert device.handle(b"\x08\0\0\xaa\xbb") == b"\x08\0\0\xaa\xbb"
    assert device.handle(b"\x08\0\1\xaa\xbb") is None


def test_a_broadcast_acts_without_an_answer_where_the_function_allows_it(device: SimulatedDevice) -> None:
    assert device.handle(struct.pack(">BHH", 6, 2, 5), broadcast=True) is None
    assert device.peek("setpoint") == 5
    assert device.handle(struct.pack(">BHH", 6, 0, 5), broadcast=True) is None
    assert device.handle(struct.pack(">BHH", 3, 0, 1), broadcast=True) is None


def test_a_broadcast_is_not_acted_on_where_the_map_does_not_list_it(affine: SimulatedDevice) -> None:
    assert affine.handle(struct.pack(">BHH", 6, 4, 9), broadcast=True) is None
    assert affine.peek("inpt") == 1


def test_a_command_is_accepted_at_addresses_that_are_no_registers(device: SimulatedDevice) -> None:
    assert write(device, 7000, 85, 92) == (7000, 2)
    assert device.commands_run == ("load_defaults",)
    assert read(device, 7000, 2) == 2


@pytest.mark.parametrize("words", [(85, 91), (85,), (92, 85), (85, 92, 0)])
def test_other_words_at_the_address_of_a_command_are_bad_values(device: SimulatedDevice, words: tuple[int]) -> None:
    assert write(device, 7000, *words) == 3
    assert device.commands_run == ()


def test_a_command_is_run_when_all_its_steps_came_in_order_by_their_function(device: SimulatedDevice) -> None:
    assert write(device, 7100, 1) == 3
    for address, word in ((7101, 2), (7100, 1), (7100, 1), (7101, 2)):
        assert ask(device, 6, address, word) == struct.pack(">BHH", 6, address, word)
    assert device.commands_run == ("restart",)


def test_the_words_of_a_command_are_taken_outside_the_range_of_their_register(device: SimulatedDevice) -> None:
    assert ask(device, 6, 4092, 0xFFFF & -1998) == b"\x86\x03"
    assert ask(device, 6, 4092, 0xFFFF & -1999) == struct.pack(">BHh", 6, 4092, -1999)
    assert device.commands_run == ("reset_highest",)


def test_a_locked_register_refuses_until_its_command_was_run(device: SimulatedDevice) -> None:
    assert ask(device, 6, 4090, 9) == b"\x86\x03"
    assert ask(device, 6, 4091, 26669) == struct.pack(">BHH", 6, 4091, 26669)
    assert device.commands_run == ("unlock",)
    assert device.peek("key") == 26669
    assert ask(device, 6, 4090, 9) == struct.pack(">BHH", 6, 4090, 9)


def test_a_write_only_register_has_no_address_to_read(device: SimulatedDevice) -> None:
    assert read(device, 4091, 1) == 2


def test_reserved_addresses_read_zero_and_refuse_writes(affine: SimulatedDevice) -> None:
    assert read(affine, 77, 3) == (0, 0, 0)
    assert write(affine, 78, 1) == 3


def test_a_hole_is_refused_as_a_whole_where_the_map_has_no_other_behaviour(affine: SimulatedDevice) -> None:
    assert read(affine, 0, 2) == 2
    assert read(affine, 64, 1) == read(affine, 128, 1)


def test_coils_are_read_and_written_alone_and_together(io: SimulatedDevice) -> None:
    assert ask(io, 5, 3, 0xFF00) == struct.pack(">BHH", 5, 3, 0xFF00)
    assert ask(io, 15, 0, 9, 2, form="HHB", data=b"\x0d\x01") == struct.pack(">BHH", 15, 0, 9)
    assert ask(io, 1, 0, 10) == b"\x01\x02\x0d\x01"
    assert ask(io, 2, 0, 3) == b"\x02\x01\x00"


def test_a_coil_takes_on_or_off_only(io: SimulatedDevice) -> None:
    assert ask(io, 5, 3, 0x1234) == b"\x85\x03"
    assert ask(io, 5, 10, 0xFF00) == b"\x85\x02"


def test_input_registers_and_the_status_byte_are_spaces_of_their_own(io: SimulatedDevice) -> None:
    io.poke("measured", 7)
    io.poke("status", 0x5A)
    assert read(io, 0, 1, function=4) == (7,)
    assert read(io, 0, 1) == 2
    assert io.handle(b"\x07") == b"\x07\x5a"


def test_half_a_value_is_never_written(io: SimulatedDevice) -> None:
    assert write(io, 30, 1) == 3
    assert write(io, 31, 1) == 2
    assert ask(io, 6, 30, 1) == b"\x86\x02"
    assert write(io, 30, 0x5678, 0x1234, 0, 0, 0, 9) == (30, 6)
    assert io.peek("counter") == 0x12345678
    assert io.peek("energy") == 9


def test_a_mask_write_changes_the_masked_bits(io: SimulatedDevice) -> None:
    io.poke("plain", 0x12)
    assert ask(io, 22, 40, 0xF2, 0x25, form="HHH") == struct.pack(">BHHH", 22, 40, 0xF2, 0x25)
    assert io.peek("plain") == 0x17


def test_write_and_read_writes_first(io: SimulatedDevice) -> None:
    assert ask(io, 23, 40, 1, 40, 1, 2, form="HHHHB", data=b"\0\x2a") == b"\x17\x02\0\x2a"


def test_a_jbus_device_counts_every_address_of_a_request_from_one(bit_device: RegisterMap) -> None:
    jbus = SimulatedDevice(bit_device, "IO", addressing="jbus")
    assert write(jbus, 41, 0x12) == (41, 1)
    assert jbus.peek("plain") == 0x12
    assert ask(jbus, 22, 41, 0xF2, 0x25, form="HHH") == struct.pack(">BHHH", 22, 41, 0xF2, 0x25)
    assert ask(jbus, 23, 41, 1, 41, 1, 2, form="HHHHB", data=b"\0\x2a") == b"\x17\x02\0\x2a"
    assert read(jbus, 0, 1) == 2
    assert jbus.handle(b"\x08\0\0\xaa\xbb") == b"\x08\0\0\xaa\xbb"
    assert jbus.handle(b"\x07") is not None


def test_an_empty_or_short_request_gets_no_answer(device: SimulatedDevice) -> None:
    assert device.handle(b"") is None
    assert device.handle(b"\x03") is None


@given(pdu=st.binary(max_size=40))
def test_no_request_breaks_a_device(bit_device: RegisterMap, pdu: bytes) -> None:
    device = SimulatedDevice(bit_device, "IO")
    answer = device.handle(pdu)
    assert answer is None or answer[0] & 0x7F == pdu[0]
    assert device.handle(pdu, broadcast=True) is None
