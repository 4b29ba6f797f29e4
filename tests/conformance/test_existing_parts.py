"""What of a value exists under a condition: driver, simulated device, backup and tools agree on it."""

import asyncio
from typing import Any

import pytest

from regscribe.cli.shared.live_report import plain
from regscribe.simulate.device.device import SimulatedDevice
from regscribe.tools.live.reading import readings
from regscribe.tools.live.value_text import as_text, choices, parse
from regscribe.tools.settings import backup, restore
from regscribe.tools.settings.backup_file import to_text
from regscribe_runtime import ConditionNotMet, NotPresent, OutOfRange, ValueRefused

from .matrix_watch import Wire
from .suite import build, whole_map
from .test_existence import Awaited

HEATING, COOLING, OFF = 0, 1, 2
MODES = [
    {"when": {"function": "heating"}, "is": {0: "off", 1: "eco", 2: "auto"}},
    {"when": {"function": "cooling"}, "is": {0: "off", 1: "auto"}},
]
CARD = {"card": 1}
PARTS: dict[str, Any] = {
    "protocol": {"functions": [3, 6, 16, 22]},
    "registers": [
        {"at": 0, "name": "Function", "type": "uint16", "enum": {0: "heating", 1: "cooling", 2: "off"}},
        {"at": 1, "name": "Card", "type": "uint16"},
        {"at": 2, "name": "Mode", "type": "uint16", "enum": MODES},
        {"at": 3, "name": "Output", "type": "uint16", "enum": {0: "off", 1: {"label": "relay", "when": CARD}}},
        {"at": 4, "name": "Bits", "type": "uint16", "flags": {0: "run", 1: {"label": "hot", "when": CARD}}},
        {
            "at": 5,
            "name": "Parts",
            "type": "uint16",
            "fields": {"mode": {"bits": "0..3"}, "speed": {"bits": "4..7", "when": CARD}, "go": {"bit": 8}},
        },
        {"at": 6, "name": "Level", "type": "uint16", "fields": {"of": {"bits": "0..7", "valid": "10..90"}}},
    ],
}


class Bench:
    """A driver on a simulated device."""

    def __init__(self, **state: int) -> None:
        self.built = build(whole_map(PARTS))
        self.module = self.built.module
        self.device = SimulatedDevice(self.built.map, "A", unit=1)
        for path, value in state.items():
            self.device.poke(path, value)
        self.wire = Wire(self.device.handle)
        self.driver = self.built.module.CaseA(self.wire, unit=1)


def test_the_member_read_is_of_the_enum_of_the_case_that_holds() -> None:
    bench = Bench(function=COOLING, mode=1)
    assert bench.driver.mode.read() is bench.module.Mode2.AUTO
    bench.driver.function.write(bench.module.Function.HEATING)
    assert bench.driver.mode.read() is bench.module.Mode1.ECO


def test_a_batch_and_an_async_driver_read_the_same_member() -> None:
    bench = Bench(function=COOLING, mode=1)
    assert bench.driver.read()["mode"] is bench.module.Mode2.AUTO
    awaitable = bench.module.AsyncCaseA(Awaited(bench.wire), unit=1)
    assert asyncio.run(_read(awaitable.mode)) is bench.module.Mode2.AUTO


async def _read(bound: Any) -> Any:
    return await bound.read()


def test_a_member_of_the_enum_of_another_case_is_refused_with_what_was_seen() -> None:
    bench = Bench(function=COOLING)
    with pytest.raises(ConditionNotMet) as refused:
        bench.driver.mode.write(bench.module.Mode1.AUTO)
    assert str(refused.value) == "mode: Mode1.AUTO exists only while function is HEATING (0); function is COOLING (1)"
    assert refused.value.present == {"function": "COOLING (1)"}
    bench.driver.mode.write(bench.module.Mode2.AUTO)
    assert bench.device.peek_words("mode") == (1,)


def test_a_code_is_that_of_the_case_that_holds_and_one_of_another_case_is_refused() -> None:
    bench = Bench(function=COOLING)
    bench.driver.mode.write(1)
    with pytest.raises(ConditionNotMet, match=r"Mode1.AUTO exists only while function is HEATING \(0\)"):
        bench.driver.mode.write(2)
    with pytest.raises(ValueRefused, match="code 7 is none of 0 off, 1 auto"):
        bench.driver.mode.write(7)


def test_where_no_case_holds_no_code_is_known_and_none_can_be_written() -> None:
    bench = Bench(function=OFF, mode=1)
    read = bench.driver.mode.read()
    assert (read.known, read.name, int(read)) == (False, "UNKNOWN_1", 1)
    with pytest.raises(ConditionNotMet):
        bench.driver.mode.write(0)


def test_a_code_that_is_not_known_equals_no_member_that_has_it() -> None:
    bench = Bench(function=OFF, mode=1)
    read, members = bench.driver.mode.read(), bench.module.Mode1
    assert read != members.ECO
    assert members.ECO != bench.module.Mode2.AUTO
    assert read == 1
    assert read == members.unknown(1)
    assert members.ECO == members(1) == 1


def test_a_member_that_does_not_exist_reads_as_not_known_and_is_refused() -> None:
    bench = Bench(card=0, output=1)
    assert bench.driver.output.read().known is False
    with pytest.raises(ConditionNotMet, match=r"Output.RELAY exists only while card is 1; card is 0"):
        bench.driver.output.write(bench.module.Output.RELAY)
    bench.driver.card.write(1)
    bench.driver.output.write(bench.module.Output.RELAY)
    assert bench.driver.output.read() is bench.module.Output.RELAY


def test_a_flag_that_does_not_exist_is_not_set_and_stays_as_it_is_while_others_change() -> None:
    bench = Bench(card=0, bits=0b1010)
    flags = bench.module.Bits
    with pytest.raises(ConditionNotMet, match="HOT exists only while card is 1"):
        bench.driver.bits.write(flags.HOT)
    bench.driver.bits.change(lambda now: now | flags.RUN)
    assert bench.device.peek_words("bits") == (0b1011,)
    bench.driver.bits.change(lambda now: now & ~flags.HOT & ~flags.RUN)
    assert bench.device.peek_words("bits") == (0b1010,)


def test_a_flag_cannot_be_set_by_a_change_while_it_does_not_exist() -> None:
    bench = Bench(card=0, bits=1)
    with pytest.raises(ConditionNotMet):
        bench.driver.bits.change(lambda now: now | bench.module.Bits.HOT)
    bench.driver.card.write(1)
    bench.driver.bits.change(lambda now: now | bench.module.Bits.HOT)
    assert bench.device.peek_words("bits") == (3,)


def test_a_part_that_does_not_exist_is_neither_read_nor_replaced_and_keeps_its_bits() -> None:
    bench = Bench(card=0, parts=0x0035)
    word = bench.driver.parts.read()
    assert (word.mode, word.go) == (5, 0)
    with pytest.raises(NotPresent, match=r"parts.speed: it exists only while card is 1; card is 0"):
        _ = word.speed
    with pytest.raises(ConditionNotMet, match="exists only while card is 1"):
        word.replace(speed=1)
    bench.driver.parts.change(lambda now: now.replace(mode=1, go=True))
    assert bench.device.peek_words("parts") == (0x0131,)
    with pytest.raises(ConditionNotMet, match="speed exists only while card is 1"):
        bench.driver.parts.write(0x0010)


def test_a_part_outside_what_is_valid_is_no_value_and_is_not_written() -> None:
    bench = Bench(level=95)
    word = bench.driver.level.read()
    with pytest.raises(OutOfRange, match=r"Level.of: 95 lies outside 10 to 90"):
        _ = word.of
    with pytest.raises(ValueError, match="lies in 10 to 90"):
        word.replace(of=9)
    assert as_text(bench.driver.registers["level"], word) == "rest=0x005F"
    assert word.replace(of=90).of == 90


def test_a_snapshot_shows_the_parts_that_exist_and_what_the_others_hold() -> None:
    bench = Bench(card=0, parts=0x0035)
    register = bench.driver.registers["parts"]
    assert as_text(register, bench.driver.read()["parts"]) == "mode=5, go=false, rest=0x0030"
    bench.driver.card.write(1)
    assert as_text(register, bench.driver.read()["parts"]) == "mode=5, speed=3, go=false"


LEFT_OUT = "it exists only while card is 1; card is 0"


def test_a_reading_says_which_parts_and_flags_it_leaves_out_and_why() -> None:
    bench = Bench(card=0, parts=0x0035, bits=3, level=95)
    wanted = [bench.driver.registers[path] for path in ("parts", "bits", "level", "card")]
    parts, bits, level, card = bench.driver.run(readings(wanted))
    assert parts.spelled == f"mode=5, go=false, rest=0x0030 (without speed: {LEFT_OUT})"
    assert plain(parts)["absent"] == {"speed": LEFT_OUT}
    assert bits.spelled == f"RUN, bit_1 (without HOT: {LEFT_OUT})"
    assert plain(bits) == {"value": ["RUN", "bit_1"], "unit": "", "absent": {"HOT": LEFT_OUT}}
    assert level.absent == {"of": "95 lies outside 10 to 90"}
    assert plain(card) == {"value": 0, "unit": ""}

    bench.driver.card.write(1)
    found = bench.driver.run(readings(wanted[:2]))
    assert [one.spelled for one in found] == ["mode=5, speed=3, go=false", "RUN, HOT"]


def test_a_backup_says_it_too_and_is_read_back() -> None:
    bench = Bench(card=0, parts=0x0035, bits=3)
    taken = bench.driver.run(backup(type(bench.driver)))
    held = dict(taken.settings())
    assert held["parts"].absent == {"speed": LEFT_OUT}
    assert held["bits"].spelled == f"RUN, bit_1 (without HOT: {LEFT_OUT})"
    assert f"absent: {{speed: {LEFT_OUT}}}" in to_text(taken)


def test_configure_checks_each_value_in_the_state_that_those_before_it_leave() -> None:
    bench = Bench(function=HEATING, card=0)
    with pytest.raises(ConditionNotMet):
        bench.driver.configure({"output": 1})
    bench.driver.configure({"output": 1, "card": 1, "function": 1, "mode": bench.module.Mode2.AUTO})
    assert bench.driver.mode.read() is bench.module.Mode2.AUTO
    assert bench.driver.output.read() is bench.module.Output.RELAY


def test_texts_name_a_member_with_its_enum_where_two_enums_have_the_name() -> None:
    bench = Bench(function=COOLING, mode=1)
    register, module = bench.driver.registers["mode"], bench.module
    assert as_text(register, bench.driver.mode.read()) == "Mode2.AUTO"
    assert choices(register) == ("Mode1.OFF", "ECO", "Mode1.AUTO", "Mode2.OFF", "Mode2.AUTO")
    assert parse(register, "mode2.auto") is module.Mode2.AUTO
    assert parse(register, "eco") is module.Mode1.ECO
    assert parse(register, "off") == 0
    assert parse(register, "1") == 1
    with pytest.raises(ValueRefused, match=r"may be Mode1.AUTO \(2 auto\) or Mode2.AUTO \(1 auto\)"):
        parse(register, "auto")


def test_a_restore_gives_a_member_of_the_case_that_was_saved() -> None:
    first = Bench(function=COOLING, card=1, mode=1, output=1, bits=3, parts=0x0135)
    saved = first.driver.run(backup(type(first.driver)))
    other = Bench(function=HEATING, card=0, mode=2)
    other.driver.run(restore(type(other.driver), saved))
    restored = {path: other.device.peek_words(path)[0] for path in ("function", "mode", "output", "bits", "parts")}
    assert restored == {"function": 1, "mode": 1, "output": 1, "bits": 3, "parts": 0x0135}


def test_a_simulated_device_refuses_a_code_that_no_member_has_now() -> None:
    bench = Bench(function=COOLING)
    assert bench.device.handle(b"\x06\x00\x02\x00\x02") == b"\x86\x03"
    assert bench.device.handle(b"\x06\x00\x02\x00\x01") == b"\x06\x00\x02\x00\x01"
