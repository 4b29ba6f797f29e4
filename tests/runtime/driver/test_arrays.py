"""What a register of an array says of its siblings is said of those in its own element, whatever depends on them."""

import copy
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from regscribe.emit import markdown
from regscribe.emit.vectors import document
from regscribe.simulate import SimulatedDevice, simulate
from regscribe.testing import DriverUnderTest, Vectors
from regscribe.testing.simulated_read import wrong_requests, wrong_values
from regscribe_runtime import ConditionNotMet, NotDecodable, ValueRefused

Talking = Callable[[str, dict[int, int]], Any]

HEAD = """\
format: 1
map: {id: test/array, title: Array, maker: Nobody, class_prefix: Array}
manual: {title: None}
models: {One: {}}
"""


def array(registers: str, *, tables: str = "", repeat: str = "1..3", stride: int = 10, more: str = "") -> str:
    """A map with the array `channels` of these registers, tables before it and registers behind it."""
    lines = "".join(f"          {line}\n" for line in registers.strip().splitlines())
    behind = "".join(f"      {line}\n" for line in more.strip().splitlines())
    return (
        f"{HEAD}{tables}groups:\n  - id: main\n    name: Main\n    source: '1'\n"
        "    each: {access: rw, type: int16, persistence: ram}\n    registers:\n"
        f"      - id: channels\n        name: Channel\n        repeat: {repeat}\n        stride: {stride}\n"
        f"        registers:\n{lines}{behind}"
    )


DECIMALS = array(
    "- {at: 0, name: Value, decimals: places}\n- {at: 1, name: Places, range: 0..3}",
    tables="decimals: {places: {register: places}}\n",
)


def test_decimals_are_those_of_the_same_element(talk: Talking) -> None:
    device = talk(DECIMALS, {0: 100, 1: 0, 10: 100, 11: 1, 20: 100, 21: 2})

    assert [device.read(f"channels[{number}].value") for number in (1, 2, 3)] == [100, 10, 1]

    device.driver.channels[3].value.write(1.25)
    device.driver.channels[2].value.write(-3.5)
    assert [device.words.holds[address] for address in (0, 10, 20)] == [100, 65536 - 35, 125]
    with pytest.raises(ValueRefused):
        device.driver.channels[2].value.write(1.25)
    with pytest.raises(ValueRefused):
        device.driver.channels[1].value.write(0.5)


def test_decimals_that_are_written_in_one_element_change_nothing_in_another(talk: Talking) -> None:
    device = talk(DECIMALS, {0: 100, 1: 0, 10: 100, 11: 1, 20: 100, 21: 2})
    assert device.read("channels[2].value") == 10

    device.driver.channels[1].places.write(2)

    assert [device.driver.channels[number].value.read() for number in (1, 2, 3)] == [1, 10, 1]
    device.driver.channels[2].places.write(2)
    assert [device.driver.channels[number].value.read() for number in (1, 2, 3)] == [1, 1, 1]


SCALE = array(
    "- {at: 0, name: Value, scale: tenths}\n- {at: 1, name: Kind, enum: {0: whole, 1: fine}}",
    tables="scales: {tenths: [{when: {kind: fine}, decimals: 1}, {decimals: 0}]}\n",
)


def test_the_case_of_a_scale_is_that_of_the_same_element(talk: Talking) -> None:
    device = talk(SCALE, {0: 123, 1: 0, 10: 123, 11: 1, 20: 123, 21: 0})

    assert [device.read(f"channels[{number}].value") for number in (1, 2, 3)] == [123, 12.3, 123]


UNIT = array(
    "- {at: 0, name: Value, unit: degrees}\n- {at: 1, name: Unit, enum: {0: celsius, 1: fahrenheit}}",
    tables="units: {degrees: [{when: {unit: celsius}, symbol: °C}, {symbol: °F}]}\n",
)


def test_the_unit_is_that_of_the_same_element(talk: Talking) -> None:
    device = talk(UNIT, {1: 0, 11: 1, 21: 0})

    assert [device.unit(f"channels[{number}].value") for number in (1, 2, 3)] == ["°C", "°F", "°C"]


ORDER = array(
    "- {at: 0, name: Value, type: uint32, word_order: {register: order, codes: {0: big, 1: little}}}\n"
    "- {at: 2, name: Order}"
)


def test_the_word_order_is_that_of_the_same_element(talk: Talking) -> None:
    device = talk(ORDER, {0: 0x1234, 1: 0x5678, 2: 0, 10: 0x1234, 11: 0x5678, 12: 1, 20: 0x1234, 21: 0x5678, 22: 2})

    assert device.driver.channels[1].value.read() == 0x12345678
    assert device.driver.channels[2].value.read() == 0x56781234
    with pytest.raises(NotDecodable, match=r"channels\[3\]\.order is 2"):
        device.driver.channels[3].value.read()
    device.words.holds[22] = 1
    assert [device.read(f"channels[{number}].value") for number in (1, 2)] == [0x12345678, 0x56781234]
    device.driver.channels[2].value.write(0x0A0B0C0D)
    assert (device.words.holds[10], device.words.holds[11]) == (0x0C0D, 0x0A0B)


LIMIT = array(
    "- {at: 0, name: Value, range: {from: low, to: high}}\n- {at: 1, name: Low}\n- {at: 2, name: High}",
)


def test_a_limit_is_that_of_the_same_element(talk: Talking) -> None:
    device = talk(LIMIT, {1: 0, 2: 10, 11: 5, 12: 100, 21: 200, 22: 300})

    device.driver.channels[1].value.write(10)
    device.driver.channels[2].value.write(100)
    device.driver.channels[3].value.write(300)
    assert [device.words.holds[address] for address in (0, 10, 20)] == [10, 100, 300]
    for number, value in ((1, 11), (2, 4), (2, 101), (3, 199)):
        with pytest.raises(ValueRefused):
            device.driver.channels[number].value.write(value)


RANGES = array(
    "- {at: 0, name: Value, decimals: places, range: 0..1000, range_decimals: places}\n"
    "- {at: 1, name: Places, range: 0..3}\n"
    "- {at: 2, name: Kind}\n"
    "- {at: 3, name: Other, range: [{when: {kind: 0}, is: 0..9}, {is: 0..99}]}",
    tables="decimals: {places: {register: places}}\n",
)


def test_decimals_and_conditions_of_a_range_are_those_of_the_same_element(talk: Talking) -> None:
    device = talk(RANGES, {1: 0, 11: 1, 21: 2, 2: 0, 12: 1, 22: 0})

    for number, most in ((1, 1000), (2, 100), (3, 10)):
        device.driver.channels[number].value.write(most)
        with pytest.raises(ValueRefused):
            device.driver.channels[number].value.write(most + 1)
    assert [device.words.holds[address] for address in (0, 10, 20)] == [1000, 1000, 1000]
    device.driver.channels[2].other.write(99)
    for number in (1, 3):
        with pytest.raises(ValueRefused, match="0 to 9"):
            device.driver.channels[number].other.write(10)


WRITABLE = array(
    "- {at: 0, name: Value, writable: {when: {status.manual: 1}, reason: only by hand}}\n"
    "- {at: 1, name: Status, access: r, type: uint16, flags: {0: alarm, 3: manual}}\n"
    "- {at: 2, name: Other, writable: {when: {mode.kind: 2}, reason: not in this mode}}\n"
    "- {at: 3, name: Mode, access: r, type: uint16, fields: {low: {bits: 0..1, label: Low}, "
    "kind: {bits: 4..5, label: Kind}}}",
)


def test_whether_a_register_can_be_written_is_asked_of_a_bit_in_the_same_element(talk: Talking) -> None:
    device = talk(WRITABLE, {1: 0b0001, 11: 0b1000, 21: 0b0111, 3: 0x20, 13: 0x10, 23: 0x33})

    device.driver.channels[2].value.write(7)
    device.driver.channels[1].other.write(8)
    assert (device.words.holds[10], device.words.holds[2]) == (7, 8)
    for number in (1, 3):
        with pytest.raises(ConditionNotMet, match=rf"channels\[{number}\]\.status"):
            device.driver.channels[number].value.write(7)
    for number in (2, 3):
        with pytest.raises(ConditionNotMet):
            device.driver.channels[number].other.write(8)


NESTED = f"""\
{HEAD}
decimals:
  own: {{register: places}}
  above: {{register: digits}}
groups:
  - id: main
    name: Main
    source: '1'
    each: {{access: rw, type: int16, persistence: ram}}
    registers:
      - id: programs
        name: Program
        repeat: 0..2
        stride: 100
        registers:
          - {{at: 0, name: Digits, range: 0..3}}
          - {{at: 1, name: Limit}}
          - id: segments
            name: Segment
            repeat: 5..7
            stride: 10
            registers:
              - {{at: 10, name: Level, decimals: own, range: {{from: 0, to: 'programs[1].limit'}}}}
              - {{at: 11, name: Places, range: 0..3}}
              - {{at: 12, name: Time, decimals: above}}
              - {{at: 13, name: Same, decimals: first}}
"""
NESTED = NESTED.replace("  above:", "  first: {register: 'segments[5].places'}\n  above:")


def test_in_nested_arrays_each_index_is_that_of_the_register_itself(talk: Talking) -> None:
    device = talk(NESTED, {})
    holds = device.words.holds
    for program in (0, 1, 2):
        holds[100 * program] = program
        for segment in (5, 6, 7):
            first = 100 * program + 10 + 10 * (segment - 5)
            holds |= {first: 1000, first + 1: (program + segment) % 3, first + 2: 1000, first + 3: 1000}
    device.words.holds.update(holds)

    for program in (0, 1, 2):
        for segment in (5, 6, 7):
            path = f"programs[{program}].segments[{segment}]"
            assert device.read(f"{path}.level") == 1000 / 10 ** ((program + segment) % 3)
            assert device.read(f"{path}.time") == 1000 / 10**program
            assert device.read(f"{path}.same") == 1000 / 10 ** ((program + 5) % 3)


def test_an_element_that_is_named_outright_stays_that_one(talk: Talking) -> None:
    device = talk(NESTED, {1: 3, 101: 20, 201: 3})

    for program in (0, 1, 2):
        device.driver.programs[program].segments[6].level.write(20)
        with pytest.raises(ValueRefused, match="0 to 20"):
            device.driver.programs[program].segments[6].level.write(21)


OUTRIGHT = DECIMALS.replace("{register: places}", "{register: 'channels[1].places'}")


def test_the_first_element_named_outright_counts_for_all(talk: Talking) -> None:
    device = talk(OUTRIGHT, {0: 100, 1: 2, 10: 100, 11: 0, 20: 100, 21: 1})

    assert [device.read(f"channels[{number}].value") for number in (1, 2, 3)] == [1, 1, 1]


@pytest.mark.parametrize(
    ("repeat", "first", "count"), [("0..2", 0, 3), ("7..7", 7, 1), ("0..0", 0, 1), ("98..100", 98, 3)]
)
def test_elements_may_be_numbered_from_anything(talk: Talking, repeat: str, first: int, count: int) -> None:
    text = DECIMALS.replace("repeat: 1..3", f"repeat: {repeat}")
    device = talk(text, {10 * step + word: (100, step)[word] for step in range(count) for word in (0, 1)})

    for step in range(count):
        assert device.read(f"channels[{first + step}].value") == 100 / 10**step


BESIDE = DECIMALS + "      - {at: 90, name: Places, range: 0..3}\n      - {at: 91, name: Value, decimals: places}\n"


def test_a_name_means_the_sibling_inside_and_the_other_register_outside(talk: Talking) -> None:
    device = talk(BESIDE, {0: 100, 1: 0, 10: 100, 11: 1, 20: 100, 21: 2, 90: 3, 91: 1000})

    assert [device.read(f"channels[{number}].value") for number in (1, 2, 3)] == [100, 10, 1]
    assert device.read("value") == 1


VIEWS = array(
    "- {at: 0, name: Value, views: both, decimals: places, aliases: [900]}\n- {at: 500, name: Places, range: 0..3}",
    tables="decimals: {places: {register: places}}\n"
    "views: {both: {base: {type: int16, stride: 3}, ieee: {type: float32, stride: 2, offset: 2000, "
    "preferred: true}}}\n",
    stride=2,
)


def test_views_and_aliases_of_an_element_stand_as_far_on_as_their_stride_says(talk: Talking) -> None:
    device = talk(VIEWS, {})
    registers = device.driver.registers

    # at: 0, 2, 4 in elements 1, 2, 3; base at 3 * at, ieee at 2000 + 2 * at; the alias repeats the base view
    for number, at in ((1, 0), (2, 2), (3, 4)):
        value = registers[f"channels[{number}].value"]
        assert [view.address(value.at) for view in value.views] == [3 * at, 2000 + 2 * at]
        assert value.aliases == (900 + 3 * at,)
    device.words.holds |= {2000: 0x42C8, 2004: 0x42C8, 2008: 0x42C8, 500: 0, 502: 1, 504: 2}  # 100 as float32
    assert [device.read(f"channels[{number}].value") for number in (1, 2, 3)] == [100, 10, 1]


def test_a_configuration_is_checked_and_ordered_by_the_siblings_of_each_element(talk: Talking) -> None:
    device = talk(RANGES, {1: 0, 11: 0, 21: 0})

    device.driver.configure(
        {"channels[3].value": 1.25, "channels[3].places": 2, "channels[2].value": 12.5, "channels[2].places": 1}
    )

    assert [device.words.holds[address] for address in (11, 21, 10, 20)] == [1, 2, 125, 125]
    written = [one[1] for one in device.sent if one[0] in {6, 16}]
    assert written.index(11) < written.index(10)
    assert written.index(21) < written.index(20)
    with pytest.raises(ValueRefused, match=r"channels\[2\]"):
        device.driver.configure({"channels[2].value": 1.25})


def test_a_register_of_an_array_without_its_element_is_refused(talk: Talking) -> None:
    device = talk(BESIDE, {91: 7})
    element = type(device.driver).channels.element

    with pytest.raises(ValueError, match="element"):
        device.driver.read(element.value)
    with pytest.raises(ValueRefused):
        device.driver.configure({element.value: 3})
    assert device.sent == []


def test_reading_an_attribute_of_an_element_makes_no_register(talk: Talking, monkeypatch: pytest.MonkeyPatch) -> None:
    device = talk(NESTED, {})
    made: list[str] = []
    kind = type(type(device.driver).registers["programs[2].segments[7].level"])

    def copied(register: Any) -> Any:
        made.append(register.path)
        return copy.copy(register)

    monkeypatch.setattr(kind, "_copy", copied)

    bound = device.driver.programs[2].segments[7].level

    assert bound.register is device.driver.registers["programs[2].segments[7].level"]
    assert made == []


ALIKE = f"""\
{HEAD}
decimals: {{own: {{register: places}}}}
groups:
  - id: main
    name: Main
    source: '1'
    each: {{access: rw, type: int16, persistence: ram}}
    registers:
      - id: left
        name: Left
        repeat: 1..2
        stride: 100
        registers:
          - id: cells
            name: Cell
            repeat: 1..2
            stride: 10
            registers:
              - {{at: 0, name: Level, decimals: own}}
              - {{at: 1, name: Places, range: 0..3}}
      - id: right
        name: Right
        repeat: 1..2
        stride: 100
        registers:
          - id: cells
            name: Cell
            repeat: 1..2
            stride: 10
            registers:
              - {{at: 500, name: Level, decimals: own}}
              - {{at: 501, name: Places, range: 0..3}}
"""


def test_arrays_of_one_id_in_two_arrays_are_two(talk: Talking) -> None:
    device = talk(ALIKE, {100: 100, 101: 1, 610: 100, 611: 2})

    assert device.read("left[2].cells[1].level") == 10
    assert device.read("right[2].cells[2].level") == 1


EVERY = [DECIMALS, SCALE, UNIT, ORDER, LIMIT, RANGES, WRITABLE, NESTED, OUTRIGHT, BESIDE, VIEWS, ALIKE]


@pytest.mark.parametrize("text", EVERY, ids=range(len(EVERY)))
def test_the_vectors_of_a_map_hold_for_its_driver_in_every_element(talk: Talking, text: str) -> None:
    device = talk(text, {})
    written = document(device.built.map)
    vectors = Vectors(
        map_id=written["map"],
        models=tuple(written["models"]),
        sets=tuple(written["sets"]),
        protocol=written["protocol"],
        commands=tuple(written["commands"]),
    )
    driver = type(device.driver)
    bench = DriverUnderTest(driver, vectors)

    bench.check_registers()
    bench.check_decoding()
    bench.check_encoding()
    bench.check_refusals()
    bench.check_conditions_of_writing()
    readable = [register for register in driver.registers.values() if register.access != "w"]
    for code in (0, 1):
        assert wrong_requests(driver, readable) == wrong_values(driver, readable, seed=7, code=code) == []


def test_the_simulator_and_the_driver_agree_in_every_element(talk: Talking) -> None:
    built = talk(RANGES, {}).built
    with (
        simulate(built.map, "One", unit=1) as server,
        built.driver("One").tcp(server.host, port=server.port, unit=1) as driver,
    ):
        for number in (1, 2, 3):
            server.device.poke(f"channels[{number}].places", number - 1)
            server.device.poke(f"channels[{number}].value", 5)
            server.device.poke(f"channels[{number}].kind", number % 2)

        assert [element.value.read() for element in driver.channels] == [5, 5, 5]
        assert [element.value.read_raw() for element in driver.channels] == [(5,), (50,), (500,)]
        driver.channels[3].value.write(9.99)
        assert server.device.peek("channels[3].value") == Fraction("9.99")
        driver.channels[2].other.write(9)
        with pytest.raises(ValueRefused):
            driver.channels[2].other.write(99)


FOLLOWING = array(
    "- {at: 0, name: Shown, access: r, follows: [{when: {source: 1}, is: one}, {is: two}]}\n"
    "- {at: 1, name: Source}\n- {at: 2, name: One, persistence: eeprom}\n- {at: 3, name: Two}\n"
    "- {at: 4, name: Working, shadows: one}\n"
    "- {at: 5, name: Status, access: r, type: uint16, flags: {0: {label: chosen, follows: {source: 1}}}}"
)


def test_what_follows_or_shadows_in_the_simulator_is_in_the_same_element(talk: Talking) -> None:
    device = SimulatedDevice(talk(FOLLOWING, {}).built.map, "One", unit=1)
    for number in (1, 2, 3):
        for name, value in (("source", number % 2), ("one", 10 * number), ("two", 10 * number + 1)):
            device.poke(f"channels[{number}].{name}", value)

    assert [device.peek(f"channels[{number}].shown") for number in (1, 2, 3)] == [10, 21, 30]
    assert [device.peek(f"channels[{number}].status") for number in (1, 2, 3)] == [1, 0, 1]
    device.power_cycle()
    assert [device.peek(f"channels[{number}].working") for number in (1, 2, 3)] == [10, 20, 30]


def test_the_docs_and_docstrings_spell_a_sibling_with_the_letter_of_its_element(talk: Talking) -> None:
    limits = talk(LIMIT, {}).built
    nested = talk(NESTED, {}).built

    assert "channels[i].low to channels[i].high" in Path(limits.module.__file__).read_text(encoding="utf-8")
    page = markdown.render(limits.map)["docs/test/array.md"]
    assert "`channels[i].low`" in page
    assert "channels[1].low`" not in page.partition("Address of every element")[0]
    page = markdown.render(nested.map)["docs/test/array.md"]
    for path in ("programs[i].segments[j].places", "programs[i].digits", "programs[i].segments[5].places"):
        assert path in page
    assert "programs[1].limit" in page


def test_the_docs_say_where_the_aliases_of_all_elements_stand(talk: Talking) -> None:
    page = markdown.render(talk(VIEWS, {}).built.map)["docs/test/array.md"]

    # the base view moves by 3 a step, and an element is 2 steps behind the one before
    assert "also at `900 + 6*(i - 1)`" in page
    assert "| 900 to 912 (0x384 to 0x390) |" in page
