"""Bits of a word are changed by function 22 where the device has it, so that its other bits stay what they are."""

from collections.abc import Callable
from typing import Any

import pytest

from regscribe.simulate.device.device import SimulatedDevice
from regscribe.tools.live.decode import Decoder
from regscribe.tools.live.dry_run import dry
from regscribe_runtime.wire.capture import CapturedFrame
from regscribe_runtime.wire.framing import ANSWERS, build, rtu_end

MAP = """
format: 1
map: {id: test/bits, title: Bits, maker: Test, class_prefix: Bits}
manual: {title: Manual, number: "1"}
models: {A: {}}
protocol: {functions: [3, 6, 16, 22]}
groups:
  - id: all
    name: All
    source: "1"
    each: {access: rw}
    registers:
      - {at: 5, name: Word, flags: {0: run, 3: heat}}
      - {at: 6, name: Swapped, fields: {part: {bits: 0..3}, one: {bit: 7}}, byte_order: little}
      - {at: 7, name: Level}
      - {at: 8, name: Apart, flags: {0: run}, write_at: 9}
      - {at: 10, name: Single, flags: {0: run, 1: heat}, functions: [3, 6]}
"""


@pytest.fixture
def device(build: Callable[[str], Any], direct: Any) -> Any:
    """A driver on a simulated device, and the requests between them."""
    built = build(MAP)
    return built.driver("A")(direct(SimulatedDevice(built.map, "A", unit=1)), unit=1)


def _written(device: Any) -> list[tuple[int, int, tuple[int, ...]]]:
    return [(one.function, one.address, one.words) for one in device.link.log if not one.reads]


def test_only_the_bits_that_change_are_written(device: Any) -> None:
    device.link.device.poke("word", 0x0101)

    device.word.change(lambda word: (word | 8) & ~1)

    # V1.1b3, 6.16: result = (present AND and_mask) OR (or_mask AND NOT and_mask); bits 0 and 3 change
    assert _written(device) == [(22, 5, (0xFFF6, 0x0008))]
    assert device.link.device.peek("word") == 0x0108


def test_what_another_one_changes_meanwhile_stays(device: Any) -> None:
    def how(word: Any) -> Any:
        device.link.device.poke("word", 0x0100)
        return word | 1

    device.word.change(how)

    assert device.link.device.peek("word") == 0x0101


def test_masks_stand_in_the_order_of_the_bytes(device: Any) -> None:
    device.swapped.change(lambda word: word.replace(part=5))

    assert _written(device) == [(22, 6, (0xFAFF, 0x0500))]
    assert device.swapped.read().part == 5


def test_numbers_and_words_that_a_mask_cannot_reach_are_written_whole(device: Any) -> None:
    device.level.change(lambda level: level + 3)
    device.apart.change(lambda word: word | 1)
    device.single.change(lambda word: word | 2)
    device.word.write(device.word.read() | 1)

    assert _written(device) == [(6, 7, (3,)), (6, 9, (1,)), (6, 10, (2,)), (6, 5, (1,))]


def test_a_mask_is_not_sent_where_nothing_is_to_be_written(device: Any) -> None:
    link = dry(device)

    device.word.change(lambda word: word | 8)

    assert [one.function for one in link.written] == [22]
    assert (device.word.read(), device.link._link.device.peek("word")) == (8, 0)


def test_a_mask_is_told_in_a_capture(device: Any) -> None:
    decoder = Decoder(type(device))
    frame = bytes([22, 0, 5, 0xFF, 0xF6, 0, 8])

    asked = decoder.feed(CapturedFrame("rtu", 1, frame, frame), "sent")
    answered = decoder.feed(CapturedFrame("rtu", 1, frame, frame), "received")

    assert (asked.what, answered.what) == ("write bits 0009 of holding 5 as 0008", "written")
    whole = build("rtu", 1, frame)
    assert rtu_end(bytearray(whole), 0, ANSWERS) == len(whole)
