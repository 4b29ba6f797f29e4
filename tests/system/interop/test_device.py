"""Before others are asked: the device holds the words that were written by hand, and our driver reads their values."""

import re
import socket
import struct
from fractions import Fraction
from pathlib import Path

import pytest

from regscribe.model import Space
from regscribe_runtime import SensorFault

from .install import CONSUMERS
from .stage import UNIT, Held, Stage

FUNCTIONS = {Space.COIL: 1, Space.DISCRETE: 2, Space.HOLDING: 3, Space.INPUT: 4}


def test_every_register_of_the_map_holds_something(stage: Stage) -> None:
    assert {one.path for one in stage.running.device.model.registers} == set(stage.held)


def test_the_words_on_the_wire_are_those_written_by_hand(stage: Stage) -> None:
    registers = stage.running.device.model.registers
    with socket.create_connection((stage.host, stage.port), timeout=10) as line:
        found = {one.path: asked(line, one.base.space, one.base.address(one.at), one.base.words) for one in registers}
    assert found == {path: one.words for path, one in stage.held.items()}


def asked(line: socket.socket, space: Space, address: int, count: int) -> tuple[int, ...]:
    """The words (or the bit) that the device answers, by a request made here."""
    line.sendall(struct.pack(">HHHBBHH", 1, 0, 6, UNIT, FUNCTIONS[space], address, count))
    answer = line.recv(300)
    assert answer[7] == FUNCTIONS[space], answer.hex(" ")
    return (answer[9] & 1,) if space.is_bits else struct.unpack(f">{count}H", answer[9:])


def test_our_driver_reads_the_values_worked_out_by_hand(stage: Stage) -> None:
    wrong = {path: (one, stage.driver[path]) for path, one in stage.held.items() if not agree(one, stage.driver[path])}
    assert wrong == {}


def agree(held: Held, read: object) -> bool:
    """Whether a value of the driver is the one by hand; a number with no finite decimal is the nearest float."""
    if held.fault:
        return isinstance(read, SensorFault) and read.fault.lower() == held.fault
    if held.special:
        return read.name.lower() == held.special  # type: ignore[attr-defined]  # of a special value
    if isinstance(held.value, Fraction):
        return Fraction(read) == held.value or read == float(held.value)  # type: ignore[arg-type]  # a number
    said = read.hex() if isinstance(read, bytes) else getattr(read, "isoformat", read.__str__)()
    return read is held.value or said == held.value


@pytest.mark.parametrize("form", ["csv", "json", "collectd", "telegraf", "home-assistant", "esphome", "wiren-board"])
def test_the_device_can_be_exported(stage: Stage, form: str) -> None:
    assert stage.text(form)


def test_every_program_that_a_test_is_marked_with_can_be_installed() -> None:
    files = sorted(Path(__file__).parent.glob("test_*.py"))
    marked = {
        name for file in files for name in re.findall(r'mark\.interop\("(.+?)"\)', file.read_text(encoding="utf-8"))
    }
    assert marked == {one.name for one in CONSUMERS}
