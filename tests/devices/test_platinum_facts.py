"""Facts of the Platinum manual that once were missing, on the simulated devices and in the pages."""

from pathlib import Path

import pytest

from regscribe.emit.markdown import render
from regscribe.model import RegisterMap
from regscribe.pipeline import compile_map
from regscribe.simulate import SimulatedDevice, find_map

ATHENA = Path(__file__).parents[2] / "maps" / "athena"
NAMES = ["c10-m10", "m300", "m400", "m5000", "x100-x400", "x5000"]


def _compiled(name: str) -> RegisterMap:
    found = compile_map(ATHENA / f"platinum-{name}.yaml").map
    assert found is not None
    return found


@pytest.mark.parametrize(("name", "model"), [("x100-x400", "X100"), ("x100-x400", "X400"), ("x5000", "X5000")])
def test_the_code_of_the_maker_is_600(name: str, model: str) -> None:  # 11.6 and 12.4, address 120
    device = SimulatedDevice(find_map(f"athena/platinum-{name}"), model)
    assert device.handle(bytes.fromhex("0300780001")) == bytes.fromhex("03020258")


@pytest.mark.parametrize(("address", "first"), [(126, True), (130, False), (134, False), (138, False)])
def test_the_loop_break_alarm_is_for_the_first_alarm_alone(address: int, *, first: bool) -> None:  # 10.4 note 13
    device = SimulatedDevice(find_map("athena/platinum-m5000"), "M5000")
    for code in range(7):
        request = bytes((6, 0, address, 0, code))
        assert device.handle(request) == request
    request = bytes((6, 0, address, 0, 7))
    assert device.handle(request) == (request if first else b"\x86\x03")


def test_bits_are_called_bits_in_the_examples() -> None:  # 3.1, 3.5 and 3.8
    text = "".join(render(_compiled("c10-m10")).values())
    assert "unit 17, function 01, address 3, 12 bits" in text
    assert "unit 12, function 15, address 0, 4 bits" in text
    assert "unit 47, function 05, address 3<br>bit on" in text
    assert "unit 25, function 03, address 68, 3 registers" in text


@pytest.mark.parametrize("name", NAMES)
def test_limits_of_bits_are_those_of_modbus_and_nothing_is_said_of_them(name: str) -> None:
    text = "".join(render(_compiled(name)).values())
    usual = "(as Modbus has it; not stated here)"
    assert f"| Most bits in a request | 2000 to read {usual}, 1968 to write {usual} |" in text
    assert "| Most words in a request | 125 to read, 8 to write |" in text  # 3.3 and 3.9


@pytest.mark.parametrize(
    ("name", "facts"),
    [
        ("c10-m10", ["terminal 7 is + and 8 is - (13.1)", "(7.5, 6.1)"]),
        ("m300", ["terminal 7 is + and 8 is - (13.1)", "(8.5, 6.1)"]),
        ("m400", ["terminal 7 is + and 8 is - (13.1)", "(9.5, 6.1)"]),
        ("m5000", ["terminal 7 is +, 8 is - and 9 common (13.1)", "(10.6)"]),
        ("x100-x400", ["terminal 1 is +, 2 is - and 3 common (13.1)", "(11.7)"]),
        ("x5000", ["terminal 13 is +, 14 is - and 15 common (13.1)", "(12.6)"]),
    ],
)
def test_terminals_and_what_ends_the_line_are_told(name: str, facts: list[str]) -> None:
    notes = " ".join(_compiled(name).notes)
    assert [fact for fact in (*facts, "9600 baud and as JBUS (13.4)", "1200 m (6.1)") if fact not in notes] == []
