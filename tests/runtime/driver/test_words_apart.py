"""Words of a number that stand apart are read by one request, with what stands between them."""

from collections.abc import Callable
from typing import Any

MAP = """\
format: 1
map: {id: test/apart, title: Apart, maker: Nobody, class_prefix: Apart}
manual: {title: None}
models: {One: {}}
protocol: {functions: [3, 6, 16]}
groups:
  - id: main
    name: Main
    source: "1"
    each: {access: r}
    registers:
      - {at: [2, 0], name: Energy, type: uint32}
      - {at: 1, name: Speed}
      - {at: 3, name: Level}
"""
HOLDS = {0: 2, 1: 7, 2: 1, 3: 9}


def test_one_request_carries_all_words(talk: Callable[[str, dict[int, int]], Any]) -> None:
    talking = talk(MAP, HOLDS)
    assert talking.driver.energy.read() == 0x0001_0002
    assert talking.sent == [(3, 0, 3)]


def test_what_stands_between_comes_along(talk: Callable[[str, dict[int, int]], Any]) -> None:
    talking = talk(MAP, HOLDS)
    found = talking.driver.read(talking.driver.energy, talking.driver.speed, talking.driver.level)
    assert [found[name] for name in ("energy", "speed", "level")] == [65538, 7, 9]
    assert talking.sent == [(3, 0, 4)]


def test_a_unit_that_lacks_one_of_the_words_has_what_stands_between(
    build: Callable[[str], Any], direct: Callable[..., Any], words: Callable[[dict[int, int]], Any]
) -> None:
    class Lacking:
        """A device without the word at 0."""

        unit = 1

        def handle(self, pdu: bytes) -> bytes:
            first = int.from_bytes(pdu[1:3], "big")
            return bytes([0x80 | pdu[0], 2]) if first == 0 else bytes(words(HOLDS).handle(pdu))

    driver = build(MAP).driver("One")(direct(Lacking()), unit=1)
    found = driver.read(driver.energy, driver.speed, driver.level)
    assert list(found.errors) == ["energy"]
    assert [found[name] for name in ("speed", "level")] == [7, 9]
    assert driver.read(driver.energy, driver.speed)["speed"] == 7
