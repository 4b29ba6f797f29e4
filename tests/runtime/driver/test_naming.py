"""Names that a driver's module uses itself, and arrays inside arrays: an engineer's map may have them."""

from collections.abc import Callable
from typing import Any

import pytest

from regscribe.simulate import simulate

HEAD = """
format: 1
map: {id: test/names, title: Names, maker: Nobody, class_prefix: Test}
manual: {title: A manual, number: "1"}
models: {A: {}, B: {}}
groups:
  - id: main
    name: Main
    source: "1"
    each: {access: rw}
    registers:
"""
CLASHES = """
      - {at: 0, name: Command, enum: {0: stop, 1: go}, default: 1}
      - {at: 1, name: Flags, flags: {0: low, 1: high}, default: 2}
      - {at: 2, name: More Flags, flags: {0: low, 1: high}, default: 1}
      - {at: 3, name: Word, fields: {part: {bits: 0..3}}, default: 3}
      - {at: 4, name: More Words, fields: {part: {bits: 4..7}}, default: 48}
      - {at: 5, name: Number, type: int16, decimals: 1, default: 2.5}
      - {at: 6, name: Second Number, type: int16, decimals: 1, default: 3.5}
      - {at: 7, name: Integer, default: 5}
      - {at: 8, name: Version, version: n.n.n, default: "1.2.3"}
      - {at: 9, name: Within, range: 0..9, default: 9}
      - {at: 10, name: Choice, enum: {0: none, 1: all}}
      - {at: 11, name: Nothing, id: none, enum: {0: off}}
      - {at: 12, name: Self, enum: {0: off}}
      - {id: rows, name: Part, repeat: 1..2, stride: 1, registers: [{at: 20, name: Text, default: 7}]}
      - {id: thirds, name: "3", repeat: 1..2, stride: 1, registers: [{at: 30, name: Raw, default: 8}]}
commands: {go: {name: Go, source: "1", steps: [{at: 100, words: [1]}]}}
"""
NESTED = """
      - id: programs
        name: Program
        repeat: 1..4
        stride: 100
        registers:
          - {at: 90, name: Loops, default: 7}
          - id: segments
            name: Segment
            repeat: 0..14
            stride: 5
            registers:
              - {at: 1, name: Level, type: int16, decimals: 1, default: 1.5}
              - {at: 2, name: Extra, models: [B]}
"""


def test_registers_may_have_the_names_of_what_the_module_imports(build: Callable[[str], Any]) -> None:
    built = build(HEAD + CLASHES)
    with simulate(built.map, "A", unit=1) as running:
        device = built.driver("A").tcp("127.0.0.1", port=running.port, unit=1)
        with device:
            device.commands.go()
            assert (device.command.read().label, device.flags.read().name, device.more_flags.read().name) == (
                "go",
                "HIGH",
                "LOW",
            )
            assert (device.word.read().part, device.more_words.read().part, device.version.read()) == (3, 3, "1.2.3")
            assert (device.number.read(), device.second_number.read(), device.within.read()) == (2.5, 3.5, 9)
            assert (device.none.read().label, device.self.read().label, device.choice.read().label) == (
                "off",
                "off",
                "none",
            )
            assert (device.rows[2].text.read(), device.thirds[1].raw.read()) == (7, 8)


def test_an_array_may_stand_inside_an_array(build: Callable[[str], Any]) -> None:
    built = build(HEAD + NESTED)
    with (
        simulate(built.map, "B", unit=1) as running,
        built.driver("B").tcp("127.0.0.1", port=running.port, unit=1) as device,
    ):
        device.programs[3].segments[14].level.write(2.5)
        levels = [device.programs[number].segments[14].level.read() for number in (2, 3)]
        assert (levels, device.programs[4].loops.read()) == ([1.5, 2.5], 7)
        assert (200 + 70 + 1).to_bytes(2, "big") in running.requests[0]
    segments = [one for one in built.map.model("A").registers if one.path.startswith("programs[4].segments[0]")]
    assert [one.address for one in segments] == [301]


@pytest.mark.parametrize(
    ("text", "place"),
    [
        (
            "      - {at: 0, name: Go}\ncommands: {run: {name: Run, source: '1', steps: [{at: 9, words: [1]}]}}\n",
            "command `run`",
        ),
        ("      - {at: 0, name: State, fields: {parts: {bits: 0..3}}}\n", "bit field `parts`"),
        ("      - {at: 0, name: Read}\n", "register `read`"),
    ],
)
def test_what_would_hide_a_name_of_the_driver_is_refused(text: str, place: str, build: Callable[[str], Any]) -> None:
    with pytest.raises(AssertionError, match=f"{place} would hide"):
        build(HEAD + text)
