"""Facts of the Series 100 manual that once were missing, on the simulated device and in the page."""

import re
import struct

import pytest

from regscribe.emit.markdown import render
from regscribe.model import FrameExample, RegisterMap
from regscribe.simulate import SimulatedDevice, find_map

MODELS = ["BTC-9100", "BTC-8100", "BTC-4100", "BTC-7100", "C21", "C91"]
DEFAULTS = bytes.fromhex(
    "4F194E834E83 0000 0001 0000 0001 4D6D51C4 4D6D63214E1F0002 0000 0064 0064 00FA 0000 0000 4E1F0001 00B400FA 0000"
    "0000 0002 4E1F 0000 4E1F0001 00B40064 4E1F 0002 5207 0000 0001 0000 0001 0001 0002 0001 0000 0000 0002 0003 0004"
    "0006 0007 0008 000A 0011"
)
"""The words of 7-5 example 1, from SP1 (0) to SEL8 (51)."""


def _device(model: str) -> SimulatedDevice:
    return SimulatedDevice(find_map("fdc/series-100"), model, givens={"linear_inputs": {16}})


@pytest.mark.parametrize("model", MODELS)
def test_the_default_values_of_example_1_go_to_any_model_in_one_block(model: str) -> None:
    device = _device(model)
    assert device.handle(bytes.fromhex("1000000034 68") + DEFAULTS) == bytes.fromhex("1000000034")
    assert device.handle(bytes.fromhex("0300000034")) == bytes.fromhex("0368") + DEFAULTS


@pytest.mark.parametrize("model", MODELS)
def test_example_6_reads_all_80_parameters_and_81_are_too_many(model: str) -> None:
    device = _device(model)
    answer = device.handle(bytes.fromhex("0300000050"))
    assert answer is not None
    assert (answer[:2], len(answer), answer[-6:]) == (bytes.fromhex("03A0"), 162, bytes(6))  # 77 to 79 are reserved
    assert device.handle(bytes.fromhex("0300000051")) == bytes.fromhex("8303")


@pytest.mark.parametrize("model", MODELS)
def test_no_request_that_the_manual_prints_is_refused(fdc: RegisterMap, model: str) -> None:
    device = _device(model)
    frames = [one.frame for one in fdc.examples if isinstance(one, FrameExample)]
    answers = [device.handle(frame[1:]) for frame in frames]
    assert len(frames) == 8
    assert [answer[:1] if answer else b"" for answer in answers] == [frame[1:2] for frame in frames]


def test_a_driver_asks_for_79_words_at_most_as_7_1_says(fdc: RegisterMap) -> None:
    assert (fdc.protocol.read_words, fdc.protocol.write_words) == (79, 79)
    assert fdc.accepted("write_words") == 79
    assert _device("C91").handle(struct.pack(">BHHB", 16, 0, 80, 160) + bytes(160)) == bytes.fromhex("9003")


def test_a_display_form_is_written_on_a_model_that_shows_none() -> None:  # 7-1: 0 to 79 on all; 7-3 row 13
    assert _device("BTC-9100").handle(bytes.fromhex("06000D0002")) == bytes.fromhex("06000D0002")


def test_the_page_takes_nothing_for_the_manual_s_that_the_manual_does_not_say(fdc: RegisterMap) -> None:
    text = "".join(render(fdc).values())
    assert set(re.findall(r"(\w+) 40001", text)) == {"Modicon"}  # a notation of everybody, not one of the manual
    assert "| Broadcast (unit 0) | not stated |" in text
    assert "| Most words in a request | 79 to read (a device also answers 80), 79 to write |" in text
    assert "| Silence between messages | 3.5 characters (as Modbus has it; not stated here) |" in text
    assert "| address of no register | exception 02 (illegal data address) |" in text
    usual = " (as Modbus has it; not stated here) |"
    assert f"| write of several words with a bad one after good ones | refused as a whole, as above{usual}" in text
    assert f"| more words than a request may have | exception 03 (illegal data value){usual}" in text
