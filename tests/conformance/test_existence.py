"""Registers that exist under a condition: driver and simulated device agree on what is there."""

import asyncio
from typing import Any

import pytest

from regscribe.export.collectd import export
from regscribe.simulate.device.device import SimulatedDevice
from regscribe.simulate.errors import SimulatorError
from regscribe.tools.live.decode import Decoder
from regscribe.tools.settings import backup, restore
from regscribe_runtime import Absent, ConditionNotMet, ExceptionAnswer, NotDecodable, NotPresent, SensorFault
from regscribe_runtime.wire.capture import CapturedFrame

from .matrix_watch import Wire
from .suite import build, diagnose, whole_map

MODES = {0: "off", 1: "range", 2: "list"}
PARTS: dict[str, Any] = {
    "conditions": {"ranging": {"mode": "range"}},
    "registers": [
        {"at": 0, "name": "Mode", "type": "uint16", "enum": MODES},
        {"at": 1, "id": "level", "name": "Level", "type": "uint16", "when": "ranging"},
        {
            "at": 1,
            "id": "level_list",
            "name": "Level",
            "type": "uint16",
            "when": {"mode": "list"},
            "enum": {0: "low", 1: "high"},
        },
        {"at": 2, "name": "Fan", "type": "uint16", "when": {"level": {"from": 2}}},
        {"at": 3, "name": "Steady", "type": "uint16"},
        {"at": 4, "name": "Bits", "type": "uint16", "flags": {3: "fine"}},
        {"at": 5, "name": "Detail", "type": "uint16", "when": {"bits.fine": 1}},
        {
            "id": "units",
            "name": "Unit",
            "repeat": "1..2",
            "stride": 10,
            "when": {"mode": {"not": "off"}},
            "registers": [
                {"at": 10, "name": "Kind", "type": "uint16"},
                {"at": 11, "name": "Speed", "type": "uint16", "when": {"kind": 1}},
            ],
        },
    ],
}
OTHERS: dict[str, list[str]] = {
    "off": ["bits", "mode", "steady"],
    "range": ["bits", "level", "mode", "steady", "units[1].kind", "units[2].kind"],
    "list": ["bits", "level_list", "mode", "steady", "units[1].kind", "units[2].kind"],
}


class Table:
    """A driver on a simulated device."""

    def __init__(self, parts: dict[str, Any] = PARTS, **state: int) -> None:
        built = build(whole_map(parts))
        self.device = SimulatedDevice(built.map, "A", unit=1)
        self.wire = Wire(self.device.handle)
        self.driver = built.module.CaseA(self.wire, unit=1)
        self.awaitable = built.module.AsyncCaseA(Awaited(self.wire), unit=1)
        for path, value in state.items():
            self.device.poke(path, value)

    def asked(self) -> set[int]:
        """The addresses that were read or written."""
        return {at for entry in self.wire.log for at in range(entry[2], entry[2] + entry[3])}  # type: ignore[index]


class Awaited:
    """The wire for an asyncio driver."""

    def __init__(self, wire: Wire) -> None:
        self._wire = wire
        self.epoch, self.timeout, self.retry = 1, 1.0, wire.retry
        self.line, self.addressing = wire.line, wire.addressing
        self.lock = Turn()

    async def call(self, unit: int, request: Any) -> Any:
        """As that of the wire."""
        return self._wire.call(unit, request)


class Turn:
    """A lock that nobody else holds."""

    def of(self, _: int) -> "Turn":
        """The lock of a unit."""
        return self

    async def __aenter__(self) -> None: ...

    async def __aexit__(self, *_: object) -> None: ...


@pytest.mark.parametrize("mode", MODES.values())
def test_a_snapshot_has_what_exists_and_says_why_the_rest_does_not(mode: str) -> None:
    table = Table(mode=list(MODES.values()).index(mode))
    snapshot = table.driver.read()
    assert sorted(snapshot.valid) == OTHERS[mode]
    assert {type(error) for error in snapshot.errors.values()} == {NotPresent}
    assert not {1, 2, 5, 11, 21}.intersection(table.asked()) - ({1} if mode != "off" else set())


def test_an_absent_register_is_not_asked_for_and_names_the_condition() -> None:
    table = Table(mode=0)
    with pytest.raises(NotPresent) as caught:
        table.driver.level.read()
    assert caught.value.present == {"mode": "OFF (0)"}
    assert "ranging (mode is RANGE (1)); mode is OFF (0)" in str(caught.value)
    assert table.asked() == {0}


def test_the_asyncio_driver_says_the_same() -> None:
    async def ask() -> None:
        table = Table(mode=0)
        with pytest.raises(NotPresent):
            await table.awaitable.level.read()
        with pytest.raises(NotPresent):
            await table.awaitable.level.write(1)
        table.device.poke("mode", 1)
        await table.awaitable.level.write(1)
        assert (await table.awaitable.read()).valid["level"] == 1

    asyncio.run(ask())


def test_what_asks_an_absent_register_is_absent_itself() -> None:
    table = Table(mode=2)
    table.device.poke("level_list", 1)
    with pytest.raises(NotPresent, match="level is not present"):
        table.driver.fan.read()
    table.device.poke("mode", 1)
    table.device.poke("level", 2)
    assert table.driver.fan.read() == 0


def test_a_register_comes_and_goes_with_a_single_bit() -> None:
    table = Table(bits=8, detail=7)
    assert table.driver.detail.read() == 7
    table.device.poke("bits", 0)
    with pytest.raises(NotPresent, match=r"bits.fine is 0"):
        table.driver.read()["detail"]
    table.device.poke("bits", 8)
    assert table.driver.read()["detail"] == 7
    assert table.driver.detail.read() == 7


def test_two_registers_at_one_address_are_told_apart_when_the_mode_changes() -> None:
    table = Table(mode=1, level=1)
    assert table.driver.read().valid["level"] == 1
    table.device.poke("mode", 2)
    table.device.poke("level_list", 1)
    found = table.driver.read()
    assert found["level_list"].name == "HIGH"
    with pytest.raises(NotPresent):
        found["level"]


def test_what_was_refused_under_a_changed_condition_is_no_absence() -> None:
    table = Table(mode=1, level=3)
    assert table.driver.fan.read() == 0
    table.device.poke("mode", 0)
    with pytest.raises(NotPresent):
        table.driver.fan.read()
    table.device.poke("mode", 1)
    assert table.driver.read()["fan"] == 0
    table.device.poke("mode", 0)
    assert isinstance(table.driver.read(fresh=False).errors["fan"], NotPresent)
    table.device.poke("mode", 1)
    assert not any(isinstance(error, Absent) for error in table.driver.read().errors.values())


def test_elements_of_an_array_come_with_their_condition() -> None:
    table = Table(mode=1)
    table.device.poke("units[2].kind", 1)
    assert table.driver.units[2].speed.read() == 0
    with pytest.raises(NotPresent, match=r"units\[1\].kind is 0"):
        table.driver.units[1].speed.read()
    table.device.poke("mode", 0)
    with pytest.raises(NotPresent):
        table.driver.units[2].kind.read()


def test_an_absent_register_is_not_written() -> None:
    table = Table(mode=0)
    with pytest.raises(NotPresent):
        table.driver.level.write(1)
    with pytest.raises(NotPresent):
        table.driver.level.write_raw((1,))
    with pytest.raises(ConditionNotMet, match="exists only while"):
        table.driver.configure({"level": 1})
    assert not any(entry[1] in (6, 16) for entry in table.wire.log)  # type: ignore[index]


def test_configure_writes_first_what_makes_a_register_exist() -> None:
    table = Table(mode=0)
    table.driver.configure({"level": 2, "fan": 5, "mode": 1})
    assert [table.device.peek(path) for path in ("mode", "level", "fan")] == [1, 2, 5]
    with pytest.raises(ConditionNotMet):
        table.driver.configure({"mode": 0, "level": 1})


def test_a_simulated_device_refuses_the_address_of_what_does_not_exist() -> None:
    table = Table(mode=0)
    for function in (3, 6):
        answer = table.device.handle(bytes([function, 0, 1, 0, 1]))
        assert answer == bytes([function | 0x80, 2])
    table.device.poke("mode", 1)
    assert table.device.handle(bytes([3, 0, 1, 0, 1])) == bytes([3, 2, 0, 0])


def test_decode_and_encode_want_the_state() -> None:
    table = Table()
    level = type(table.driver).level
    assert level.decode((3,), state={"mode": 1}) == 3
    with pytest.raises(NotPresent):
        level.decode((3,), state={"mode": 2})
    with pytest.raises(NotPresent):
        level.encode(3, state={"mode": 2})


def test_an_address_that_the_unit_lacks_though_the_condition_holds_is_an_absence() -> None:
    table = Table(mode=1)
    answer = table.wire.answer

    def without_level(pdu: bytes) -> bytes | None:
        first, last = pdu[2], pdu[2] + pdu[4] - 1
        return bytes([pdu[0] | 0x80, 2]) if first <= 1 <= last else answer(pdu)

    table.wire.answer = without_level
    assert isinstance(table.driver.read().errors["level"], Absent)
    with pytest.raises(ExceptionAnswer):
        table.driver.level.read()


REFUSED = {
    "both may exist": ("RS0401", [{"when": {"mode": 1}}, {"when": {"mode": [1, 2]}}]),
    "one always exists": ("RS0401", [{"when": {"mode": 1}}, {}]),
    "never": ("RS0470", [{"when": {"mode": 7}}, {"at": 2}]),
    "in a circle": ("RS0462", [{"when": {"other": 1}}, {"at": 2, "id": "other", "when": {"one": 1}}]),
}


@pytest.mark.parametrize("name", REFUSED)
def test_conditions_that_cannot_be_right_are_refused(name: str) -> None:
    rule, (one, other) = REFUSED[name]
    plain = {"at": 1, "name": "Level", "type": "uint16"}
    registers = [PARTS["registers"][0], {"id": "one", **plain, **one}, {"id": "two", **plain, **other}]
    _, found = diagnose(whole_map({"registers": registers}))
    assert rule in {one.rule for one in found}


def test_what_can_only_be_written_tells_nothing() -> None:
    registers = [
        {"at": 0, "name": "Mode", "type": "uint16", "access": "w"},
        {"at": 1, "name": "Level", "type": "uint16", "when": {"mode": 1}},
    ]
    _, found = diagnose(whole_map({"registers": registers}))
    assert "RS0463" in {one.rule for one in found}


EVERYWHERE = """
format: 1
map: {id: test/case, title: Case, maker: Test, class_prefix: Case}
manual: {title: Manual, number: "1"}
models: {A: {}, B: {}}
protocol: {functions: [3, 6, 16]}
sets:
  sensor:
    - {at: 0, name: Value, when: {valid: 1}}
    - {at: 1, name: Valid, when: {mode: 3}}
groups:
  - {id: first, name: First, source: "1", each: {access: rw, type: uint16}, registers: [{at: 0, name: Mode}]}
  - id: second
    name: Second
    source: "1"
    when: {mode: {from: 1}}
    each: {access: rw, type: uint16, when: {mode: {to: 8}}, variants: [{models: [B], when: {mode: {to: 6}}}]}
    registers:
      - {at: 1, name: Plain}
      - {at: 2, name: Own, when: {plain: 2}, variants: [{models: [B], when: {plain: 4}}]}
      - {set: sensor, shift: 10, when: {mode: 5}, set_each: {when: {own: 6}}}
      - {id: many, name: Many, repeat: 1..2, stride: 10, when: {own: 7}, registers: [{at: 20, name: Count}]}
"""


@pytest.mark.parametrize("model", ["A", "B"])
def test_conditions_of_the_surroundings_are_added_and_a_variant_takes_the_place_of_its_own(model: str) -> None:
    register_map, found = diagnose(EVERYWHERE)
    assert register_map is not None, found
    words = {one.path: one.when.words for one in register_map.model(model).registers}
    most, plain = (8, 2) if model == "A" else (6, 4)
    around = f"mode is at least 1 and mode is at most {most}"
    inside = f"mode is at least 1 and mode is 5 and mode is at most {most}"
    assert words == {
        "mode": "",
        "plain": around,
        "own": f"{around} and plain is {plain}",
        "value": f"{inside} and valid is 1 and own is 6",
        "valid": f"{inside} and mode is 3 and own is 6",
        "many[1].count": f"mode is at least 1 and own is 7 and mode is at most {most}",
        "many[2].count": f"mode is at least 1 and own is 7 and mode is at most {most}",
    }


REPEATED: dict[str, Any] = {
    "givens": {
        "inputs": {"type": "number", "range": "0..3", "default": 2, "description": "inputs", "reason": "by the plant"}
    },
    "registers": [
        {"at": 0, "id": "n", "name": "Number of Modules", "type": "uint16", "sentinels": {65535: "not known"}},
        {
            "id": "modules",
            "name": "Module",
            "repeat": {"from": 1, "to": "n", "most": 4},
            "stride": 20,
            "registers": [
                {"at": 10, "name": "Points", "type": "uint16"},
                {
                    "id": "curve",
                    "name": "Point",
                    "repeat": {"from": 0, "to": "points", "most": 2},
                    "stride": 2,
                    "registers": [{"at": 12, "name": "X", "type": "uint16"}],
                },
            ],
        },
        {
            "id": "inputs",
            "name": "Input",
            "repeat": {"from": 1, "to": {"given": "inputs"}, "most": 3},
            "stride": 1,
            "registers": [{"at": 200, "name": "Level", "type": "uint16"}],
        },
    ],
}


def test_an_array_is_as_long_as_a_register_says() -> None:
    table = Table(REPEATED, n=2)
    table.device.poke("modules[2].points", 1)
    assert len(table.driver.modules) == 2
    assert [len(module.curve) for module in table.driver.modules] == [0, 1]
    assert [input_.level.read() for input_ in table.driver.inputs] == [0, 0]
    found = table.driver.read()
    there = [
        "inputs[1].level",
        "inputs[2].level",
        "modules[1].points",
        "modules[2].curve[0].x",
        "modules[2].points",
        "n",
    ]
    assert sorted(found.valid) == there
    assert table.asked() == {0, 10, 30, 32, 200, 201}


def test_an_element_that_the_device_does_not_have_raises_when_it_is_used() -> None:
    table = Table(REPEATED, n=2)
    with pytest.raises(NotPresent, match=r"n is at least 3; n is 2"):
        table.driver.modules[3].points.read()
    with pytest.raises(NotPresent, match=r"modules\[1\].points is at least 2; n is 2, modules\[1\].points is 0"):
        table.driver.modules[1].curve[1].x.read()
    with pytest.raises(NotPresent, match=r"given.inputs is 2"):
        table.driver.inputs[3].level.read()
    with pytest.raises(IndexError):
        table.driver.modules[5]


def test_a_count_beyond_the_most_elements_counts_as_the_most() -> None:
    table = Table(REPEATED, n=9)
    assert len(table.driver.modules) == 4
    assert table.driver.modules[4].points.read() == 0


def test_a_count_that_is_a_fault_says_so() -> None:
    table = Table(REPEATED, n=65535)
    with pytest.raises(SensorFault, match="not known"):
        len(table.driver.modules)
    with pytest.raises(NotDecodable, match=r"whether it exists depends on n: .*not known"):
        table.driver.modules[1].points.read()


def test_an_asyncio_driver_counts_the_elements() -> None:
    async def ask() -> None:
        table = Table(REPEATED, n=3)
        assert await table.awaitable.modules.count() == 3

    asyncio.run(ask())


COMMANDS: dict[str, Any] = {
    "registers": [{"at": 0, "name": "Mode", "type": "uint16"}, {"at": 1, "name": "Lock", "type": "uint16"}],
    "commands": {
        "reset": {"name": "Reset", "when": {"mode": 1}, "steps": [{"at": 100, "words": [7]}]},
        "start": {
            "name": "Start",
            "steps": [
                {"at": 1, "words": [0], "when": {"lock": {"not": 0}}},
                {"at": 101, "words": [8]},
                {"at": 102, "words": [9], "when": {"mode": 1}},
            ],
        },
    },
}


def sent(table: Table) -> list[tuple[int, tuple[int, ...]]]:
    """The addresses and words that were written."""
    return [(entry[2], entry[4]) for entry in table.wire.log if entry[1] == 6]  # type: ignore[index]


def test_a_command_that_does_not_exist_is_not_sent_and_the_device_refuses_it() -> None:
    table = Table(COMMANDS, mode=0)
    with pytest.raises(NotPresent, match="reset: it exists only while mode is 1; mode is 0"):
        table.driver.commands.reset()
    assert sent(table) == []
    assert table.device.handle(bytes([6, 0, 100, 0, 7]))[0] == 0x86
    table.device.poke("mode", 1)
    table.driver.commands.reset()
    assert sent(table) == [(100, (7,))]


@pytest.mark.parametrize(
    ("state", "addresses"), [({}, [101]), ({"lock": 5}, [1, 101]), ({"lock": 5, "mode": 1}, [1, 101, 102])]
)
def test_a_step_is_sent_only_while_its_condition_holds(state: dict[str, int], addresses: list[int]) -> None:
    table = Table(COMMANDS, **state)
    table.driver.commands.start()
    assert [address for address, _ in sent(table)] == addresses


def test_a_poll_leaves_out_what_does_not_exist() -> None:
    built = build(whole_map(PARTS))
    options = {"model": "A", "at": "h:502", "name": "", "unit": "1", "every": "1", "given": "", "base": ""}
    texts = [export([built.map], {**options, "with": f"mode={mode}"}).texts[""] for mode in (0, 1)]
    assert ["left out: level - it exists only while" in text for text in texts] == [True, False]


def test_a_text_counts_no_elements() -> None:
    registers = [{"at": 90, "id": "n", "name": "N", "type": "string", "length": 2}, REPEATED["registers"][1]]
    _, found = diagnose(whole_map({"registers": registers}))
    assert "RS0330" in {one.rule for one in found}


def test_a_simulated_device_asks_for_a_given_that_decides_what_exists() -> None:
    given = {"cooled": {"type": "boolean", "description": "whether it cools", "reason": "an option"}}
    registers = [{"at": 0, "name": "Level", "type": "uint16", "when": {"given": "cooled"}}]
    register_map, found = diagnose(whole_map({"givens": given, "registers": registers}))
    assert register_map is not None, found
    with pytest.raises(SimulatorError, match="cooled"):
        SimulatedDevice(register_map, "A", unit=1)
    answers = [
        SimulatedDevice(register_map, "A", unit=1, givens={"cooled": cooled}).handle(bytes([3, 0, 0, 0, 1]))
        for cooled in (True, False)
    ]
    assert answers == [bytes([3, 2, 0, 0]), bytes([0x83, 2])]


def test_of_two_registers_at_one_address_the_one_that_exists_is_decoded() -> None:
    driver = build(whole_map(PARTS)).module.CaseA
    for mode, names in ((1, ["level"]), (2, ["level_list"])):
        decoder = Decoder(driver, state={"mode": mode})
        request, answer = bytes([3, 0, 1, 0, 1]), bytes([3, 2, 0, 1])
        decoder.feed(CapturedFrame("tcp", 1, request, request), "sent")
        found = decoder.feed(CapturedFrame("tcp", 1, answer, answer), "received")
        assert [item.name for item in found.items] == names


def test_a_value_that_needs_a_register_which_is_gone_is_not_decoded_by_what_was_remembered() -> None:
    parts = {
        "decimals": {"digits": {"register": "places"}},
        "registers": [
            {"at": 0, "name": "Mode", "type": "uint16"},
            {"at": 1, "name": "Places", "type": "uint16", "range": "0..3", "when": {"mode": 1}},
            {"at": 2, "name": "Value", "type": "uint16", "decimals": "digits"},
            {"at": 3, "name": "Other", "type": "uint16", "when": {"mode": 2}},
        ],
    }
    table = Table(parts, mode=1, places=1)
    table.device.poke("value", 12.5)
    assert table.driver.value.read() == 12.5
    table.device.poke("mode", 2)
    assert table.driver.other.read() == 0
    with pytest.raises(NotPresent, match="places"):
        table.driver.value.write(1.5)
    with pytest.raises(NotDecodable, match="depends on places"):
        table.driver.value.read()
    assert isinstance(table.driver.read().errors["value"], NotDecodable)


def test_a_backup_says_what_did_not_exist_and_is_restored_without_it() -> None:
    saved = Table(mode=1, level=3, fan=9)
    taken = saved.driver.run(backup(type(saved.driver)))
    errors = {path for path, one in taken.settings() if one.error}
    assert errors == {"level_list", "detail", "units[1].speed", "units[2].speed"}
    other = Table(mode=0)
    other.driver.run(restore(type(other.driver), taken))
    assert [other.device.peek(path) for path in ("mode", "level", "fan")] == [1, 3, 9]


CARDS: dict[str, Any] = {
    "registers": [
        {"at": 0, "name": "Card", "type": "uint16", "enum": {0: "none", 1: "relay"}},
        {"at": 1, "name": "Relay", "type": "uint16", "when": {"card": "relay"}},
        {"at": 1, "name": "Other", "type": "uint16", "when": {"card": "none"}},
        {"at": 5, "name": "Count", "type": "uint16", "range": "0..3"},
        {
            "id": "units",
            "name": "Unit",
            "repeat": {"from": 1, "to": "count", "most": 3},
            "stride": 1,
            "registers": [{"at": 10, "name": "Speed", "type": "uint16"}],
        },
    ],
    "commands": {
        "value": {"name": "Value", "steps": [{"at": 7, "words": [1]}, {"register": "relay", "value": 3}]},
        "words": {"name": "Words", "steps": [{"register": "relay", "words": [3]}]},
        "given": {
            "name": "Given",
            "arguments": {"number": {}},
            "steps": [{"register": "relay", "value": {"argument": "number"}}],
        },
        "element": {"name": "Element", "steps": [{"register": "units[2].speed", "words": [3]}]},
    },
}


@pytest.mark.parametrize(
    ("command", "arguments"), [("value", {}), ("words", {}), ("given", {"number": 3}), ("element", {})]
)
def test_a_command_sends_nothing_while_a_register_that_it_writes_does_not_exist(
    command: str, arguments: dict[str, int]
) -> None:
    table = Table(CARDS, card=0, count=1)
    with pytest.raises(NotPresent):
        getattr(table.driver.commands, command)(**arguments)
    assert {entry[1] for entry in table.wire.log} == {3}  # reads alone
    table = Table(CARDS, card=1, count=2)
    getattr(table.driver.commands, command)(**arguments)
    assert table.device.peek("units[2].speed" if command == "element" else "relay") == 3


STATES: dict[str, Any] = {
    "registers": [
        {"at": 0, "name": "State", "access": "r", "type": "uint16", "enum": {0: "heat", 1: "cool"}},
        {"at": 20, "name": "T", "type": "uint16", "multiply": [{"when": {"state": "heat"}, "is": 0.1}, {"is": 1}]},
        {"at": 30, "name": "Limit", "type": "uint16", "multiply": [{"when": {"state": "heat"}, "is": 0.1}, {"is": 1}]},
        {"at": 40, "name": "Level", "type": "uint16", "valid": {"from": 0, "to": "limit"}},
    ]
}


@pytest.mark.parametrize("how", ["read", "read_raw"])
def test_what_a_driver_has_read_itself_takes_the_place_of_what_it_remembers(how: str) -> None:
    table = Table(STATES, state=0)
    table.device.poke("t", 7)
    table.device.poke("limit", 5)
    table.device.poke("level", 5)
    assert (table.driver.t.read(), table.driver.level.read()) == (7, 5)
    table.device.poke("state", 1)  # the word 70 is 70, and no longer 7.0; the limit of the level is 50 in place of 5
    getattr(table.driver.state, how)()
    table.device.poke("level", 50)
    assert (table.driver.t.read(), table.driver.level.read()) == (70, 50)
