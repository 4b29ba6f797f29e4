"""Functions that do the same, and addresses that the manual lists as unused."""

import struct
from dataclasses import replace

import pytest

from regscribe.model import Faults, RegisterMap, Space
from regscribe.simulate import SimulatedDevice


def changed(found: RegisterMap, *, code: int = 2) -> SimulatedDevice:
    """The device with 01 and 02, 03 and 04 alike, no registers in their own spaces, and 50 to 59 unused."""
    own = {Space.DISCRETE, Space.INPUT}
    model = found.model("IO")
    registers = tuple(register for register in model.registers if register.base.space not in own)
    unused = ((Space.HOLDING, 50, 59), (Space.COIL, 90, 91))
    model = replace(model, registers=registers, members=registers, unused=unused, by_path={})
    return SimulatedDevice(
        replace(found, models=(model,), alike=((1, 2), (3, 4)), faults=Faults(unused_write=code)), "IO"
    )


@pytest.fixture
def device(bit_device: RegisterMap) -> SimulatedDevice:
    return changed(bit_device)


def ask(device: SimulatedDevice, function: int, address: int, number: int) -> bytes:
    answer = device.handle(struct.pack(">BHH", function, address, number))
    assert answer is not None
    return answer


def test_both_functions_of_a_pair_read_the_same_registers(device: SimulatedDevice) -> None:
    device.poke("plain", 77)
    assert ask(device, 3, 40, 1)[1:] == ask(device, 4, 40, 1)[1:] == b"\x02\x00\x4d"


def test_both_functions_of_a_pair_read_the_same_bits(device: SimulatedDevice) -> None:
    device.poke("relay_3", 1)
    assert ask(device, 1, 0, 8)[1:] == ask(device, 2, 0, 8)[1:] == b"\x01\x08"


def test_an_answer_names_the_function_that_was_asked(device: SimulatedDevice) -> None:
    assert [ask(device, function, 40, 1)[0] for function in (3, 4)] == [3, 4]


def test_without_a_pair_an_input_register_is_none_of_the_holding_registers(bit_device: RegisterMap) -> None:
    alone = SimulatedDevice(bit_device, "IO")
    assert ask(alone, 4, 40, 1) == b"\x84\x02"


def test_a_space_of_its_own_comes_before_that_of_its_pair(bit_device: RegisterMap) -> None:
    device = SimulatedDevice(replace(bit_device, alike=((3, 4),)), "IO")
    device.poke("measured", 5)
    device.poke("plain", 6)
    assert (ask(device, 4, 0, 1)[2:], ask(device, 4, 40, 1)[2:]) == (b"\x00\x05", b"\x00\x06")


def test_an_address_that_neither_of_a_pair_has_is_refused(device: SimulatedDevice) -> None:
    assert [ask(device, function, 1000, 1) for function in (3, 4)] == [b"\x83\x02", b"\x84\x02"]


@pytest.mark.parametrize(("function", "address"), [(3, 50), (4, 59), (1, 90), (2, 91)])
def test_an_unused_address_reads_as_zero(device: SimulatedDevice, function: int, address: int) -> None:
    assert set(ask(device, function, address, 1)[2:]) == {0}


@pytest.mark.parametrize("code", [1, 2, 3])
def test_an_unused_address_refuses_writes_with_the_code_of_the_map(bit_device: RegisterMap, code: int) -> None:
    device = changed(bit_device, code=code)
    assert ask(device, 6, 55, 1) == bytes((0x86, code))
    assert ask(device, 5, 90, 0xFF00) == bytes((0x85, code))
    assert ask(device, 3, 55, 1)[2:] == b"\x00\x00"


def test_an_address_after_the_unused_ones_is_no_address(device: SimulatedDevice) -> None:
    assert ask(device, 3, 60, 1) == b"\x83\x02"
