"""The first read of a register asks for what its value depends on by itself: no plan of the device is made for it."""

import sys
from collections.abc import Callable
from types import FrameType
from typing import Any

import pytest

from regscribe_devices.athena.series_c import Athena16C
from regscribe_runtime.operations.session import Session

MAP = """\
format: 1
map: {id: test/first, title: First, maker: Nobody, class_prefix: First}
manual: {title: None}
models: {One: {}}
protocol: {functions: [3, 6, 16], limits: {read_words: 20, write_words: 20}}
conditions: {linear: {mode: 1, range_code: 2}}
decimals: {digits: {register: places, when: linear}}
groups:
  - id: main
    name: Main
    source: "1"
    each: {access: rw, type: int16}
    registers:
      - {at: 0, name: Value, decimals: digits}
      - {at: 100, name: Mode, range: 0..1}
      - {at: MIDDLE, name: Range code, range: 0..9}
      - {at: 102, name: Places, range: 0..3}
"""
HOLDS = {0: 1234, 100: 1, 101: 2, 102: 2, 110: 2}


def test_neighbours_are_asked_for_in_one_request(talk: Callable[[str, dict[int, int]], Any]) -> None:
    talking = talk(MAP.replace("MIDDLE", "101"), HOLDS)
    assert talking.driver.value.read() == 12.34
    assert talking.sent == [(3, 100, 3), (3, 0, 1)]


def test_what_stands_apart_is_asked_for_alone(talk: Callable[[str, dict[int, int]], Any]) -> None:
    talking = talk(MAP.replace("MIDDLE", "110"), HOLDS)
    assert talking.driver.value.read() == 12.34
    assert talking.sent == [(3, 100, 1), (3, 102, 1), (3, 110, 1), (3, 0, 1)]


def test_no_request_is_longer_than_the_device_allows(talk: Callable[[str, dict[int, int]], Any]) -> None:
    talking = talk(MAP.replace("MIDDLE", "101").replace("read_words: 20", "read_words: 2"), HOLDS)
    assert talking.driver.value.read() == 12.34
    assert talking.sent == [(3, 100, 2), (3, 102, 1), (3, 0, 1)]


def test_the_second_read_is_one_request(talk: Callable[[str, dict[int, int]], Any]) -> None:
    talking = talk(MAP.replace("MIDDLE", "101"), HOLDS)
    talking.driver.value.read()
    talking.driver.value.read()
    assert talking.sent[2:] == [(3, 0, 1)]


def test_the_device_is_not_planned_for_it(
    talk: Callable[[str, dict[int, int]], Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    def planned(_: Session) -> object:
        pytest.fail("the whole device was planned")

    monkeypatch.setattr(Session, "terms", planned)
    assert talk(MAP.replace("MIDDLE", "101"), HOLDS).driver.value.read() == 12.34


def test_more_than_a_few_are_read_in_the_cheapest_requests(talk: Callable[[str, dict[int, int]], Any]) -> None:
    more = "conditions: {linear: {mode: 1, range_code: 2, a: 0, b: 0}}"
    text = MAP.replace("conditions: {linear: {mode: 1, range_code: 2}}", more).replace("MIDDLE", "110")
    text = text.replace("limits: {", "read_holes: true, limits: {")
    text += "      - {at: 104, name: A, range: 0..1}\n      - {at: 106, name: B, range: 0..1}\n"
    talking = talk(text, HOLDS)
    assert talking.driver.value.read() == 12.34
    assert talking.sent == [(3, 100, 11), (3, 0, 1)]


MOST_CALLS = 395
"""Of functions of the runtime, over a link without a line: what the first read of a conditional value may take."""


def test_the_first_read_of_a_conditional_value_takes_few_calls(direct: Callable[..., Any], words: type) -> None:
    driver = Athena16C(direct(words({4049: 3, 4084: 0, 8000: 0x4316, 8001: 0x2000})), unit=1)
    calls = 0

    def count(frame: FrameType, event: str, _: object) -> None:
        nonlocal calls
        calls += event == "call" and "regscribe_runtime" in frame.f_code.co_filename

    before = sys.getprofile()
    sys.setprofile(count)
    try:
        value = driver.process_value.read()
    finally:
        sys.setprofile(before)
    assert value == 150.125  # the IEEE view, most significant word first: 43162000
    assert calls <= MOST_CALLS
