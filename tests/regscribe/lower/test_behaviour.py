"""What devices do by themselves becomes model: effects of commands, followers, shadows and the process."""

from collections.abc import Callable
from fractions import Fraction
from typing import Any

import pytest

from regscribe.model import Effect, RegisterMap, TripKind

Lowered = Callable[[str], RegisterMap]
Tried = Callable[[str], Any]

LINES = """\
- {at: 0, name: Process Value, access: r}
- {at: 1, name: Setpoint, default: 20, persistence: both}
- {at: 2, name: Setpoint RAM, id: setpoint_ram, persistence: ram, shadows: setpoint}
- {at: 3, name: Mode, enum: {0: auto, 1: manual}, default: 0}
- {at: 4, name: Output, access: r}
- {at: 5, name: Band, difference: true, unit: degrees}
- {at: 6, name: Status, access: r, flags: {0: {label: on, follows: {mode: auto}}, 1: {label: alarm}}}
- {at: 7, name: In Use, access: r, follows: [{when: {mode: manual}, is: setpoint_ram}, {is: setpoint}]}
- {at: 8, name: Second Limit, models: [A1]}
- {at: 9, name: Copy, access: r, follows: setpoint}
"""


def body(more: str) -> str:
    rows = "".join(f"      {line}\n" for line in LINES.splitlines())
    each = "{access: rw, type: int16}"
    units = "units: {degrees: [{when: {mode: auto}, symbol: °C}, {symbol: °F}]}\n"
    return (
        f"{units}groups:\n  - id: main\n    name: Main\n    source: '1'\n    each: {each}\n    registers:\n{rows}{more}"
    )


def command(effects: str) -> str:
    return body(f"commands:\n  go: {{name: Go, source: '2', steps: [{{at: 90, words: [1]}}], effects: {effects}}}\n")


def process(keys: str) -> str:
    return body(f"process: {{value: process_value, setpoint: in_use, {keys}}}\n")


def effects_of(found: RegisterMap, model: str = "A1") -> tuple[Effect, ...]:
    return found.model(model).commands[0].effects


def test_followers_and_shadows_name_registers(lowered: Lowered) -> None:
    found = lowered(body("")).model("A1")
    assert found.register("setpoint_ram").shadows == "setpoint"
    assert [case.then for case in found.register("in_use").follows] == ["setpoint_ram", "setpoint"]
    assert [case.when.always for case in found.register("in_use").follows] == [False, True]
    assert [case.then for case in found.register("copy").follows] == ["setpoint"]
    assert [field.follows is not None for field in found.register("status").fields] == [True, False]
    assert (found.register("band").difference, found.register("setpoint").difference) == (True, False)


def test_all_defaults_are_those_that_can_be_written_less_what_is_kept(lowered: Lowered) -> None:
    assert effects_of(lowered(command("[{defaults: all}]")))[0].defaults == ("setpoint", "mode")
    assert effects_of(lowered(command("[{defaults: all, keep: [setpoint]}]")))[0].defaults == ("mode",)
    assert effects_of(lowered(command("[{defaults: [setpoint]}]")))[0].defaults == ("setpoint",)


def test_an_effect_sets_members_by_name_on_the_models_that_have_it(lowered: Lowered) -> None:
    found = lowered(command("[{when: {mode: auto}, set: {mode: manual, setpoint: 30}, models: [A1]}, {unlatch: true}]"))
    first, second = effects_of(found)
    assert first.sets == (("mode", Fraction(1)), ("setpoint", Fraction(30)))
    assert (first.when.registers, second.unlatch) == (("mode",), True)
    assert effects_of(found, "B-2") == (second,)


def test_a_process_has_the_outputs_and_alarms_of_each_model(lowered: Lowered) -> None:
    outputs = "outputs: [{percent: output, full: 1000, pid: {band: band, span: [setpoint, in_use]}}]"
    trips = "[{low: band, when: {mode: auto}}, {high: second_limit}]"
    alarms = f"alarms: [{{active: [status.alarm], trips: {trips}, models: [A1]}}]"
    found = lowered(process(f"{outputs}, {alarms}, manual: {{mode: manual}}"))
    one, other = (found.model(name).process for name in ("A1", "B-2"))
    assert one is not None
    assert other is not None
    assert one.outputs == other.outputs
    assert one.outputs[0].pid is not None
    assert (one.outputs[0].full, one.outputs[0].pid.ends) == (1000, ("setpoint", "in_use"))
    trips_of = [(trip.kind, trip.limit) for trip in one.alarms[0].trips]
    assert trips_of == [(TripKind.LOW, "band"), (TripKind.HIGH, "second_limit")]
    assert other.alarms == ()


@pytest.mark.parametrize(
    ("text", "rule"),
    [
        (command("[{set: {moed: manual}}]"), "RS0301"),
        (command("[{set: {mode: stop}}]"), "RS0305"),
        (command("[{set: {status.off: 1}}]"), "RS0303"),
        (command("[{defaults: [nothing]}]"), "RS0301"),
        (command("[{when: {moed: 1}, unlatch: true}]"), "RS0301"),
        (command("[{unlatch: true, models: [Z]}]"), "RS0314"),
        (process("outputs: [{percent: outptu}]"), "RS0301"),
        (process("fault: status.broken"), "RS0303"),
        (process("alarms: [{active: [status.alarm], trips: [{high: second_limit}]}]"), "RS0302"),
        (process("off: nowhere"), "RS0307"),
        (body("").replace("shadows: setpoint", "shadows: setpiont"), "RS0301"),
        (body("").replace("is: setpoint_ram", "is: setpoint_rom"), "RS0301"),
    ],
)
def test_a_name_that_means_nothing_is_told(tried: Tried, text: str, rule: str) -> None:
    _, found = tried(text)
    assert {each.rule for each in found} == {rule}
