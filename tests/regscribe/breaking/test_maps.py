"""Maps, models and what all models share."""

from typing import Any

import pytest

from regscribe.breaking.change import Effect, Effects, Level, Verdict, verdict_of
from regscribe.breaking.compare import compare
from regscribe.breaking.examples import BASE

KILN = BASE.replace("acme/oven", "acme/kiln").replace("name: Fan", "name: Blower")


def told(found: Any) -> list[tuple[str, str, str]]:
    return [(one.rule.id, one.before, one.after) for one in found]


def test_maps_pair_by_their_ids(bench: Any) -> None:
    oven, kiln = bench.compiled(BASE), bench.compiled(KILN)
    assert compare([oven, kiln], [kiln, oven]).changes == ()


def test_a_map_that_is_new_and_one_that_is_gone_are_one_change_each(bench: Any) -> None:
    found = compare([bench.compiled(BASE)], [bench.compiled(KILN)]).changes
    assert sorted(told(found)) == [("RS0748", "none", "acme/kiln"), ("RS0749", "acme/oven", "none")]
    assert verdict_of(found) is Verdict.MAJOR


def test_a_map_with_another_id_and_the_same_models_is_a_rename(bench: Any) -> None:
    found = compare([bench.compiled(BASE)], [bench.compiled(BASE.replace("acme/oven", "acme/stove"))]).changes
    assert ("RS0750", "acme/oven", "acme/stove") in told(found)
    assert "RS0748" not in {one.rule.id for one in found}


def test_nothing_is_found_where_there_are_no_maps() -> None:
    found = compare([], []).changes
    assert (found, verdict_of(found, Level.API)) == ((), Verdict.NONE)


def test_a_code_that_is_retired_may_go(edited: Any) -> None:
    found = edited("2: cool}", "2: {invalid: no firmware has had it since 3.0}}")
    gone = [one.effects for one in found if one.rule.id == "RS0718"]
    assert gone == [Effects(Effect.COMPATIBLE, Effect.COMPATIBLE)]
    assert verdict_of(found) is Verdict.MINOR


@pytest.mark.parametrize(
    ("old", "new", "rule", "effects"),
    [
        ("range: 0..400", "range: 0..300", "RS0713", Effects(Effect.NONE, Effect.BREAKING)),
        ("sentinels: {-32768: no sensor}", "range: 0..9, sentinels: {-32768: no sensor}", "RS0713", None),
        ("range: 0..100, when", "when", "RS0714", Effects(Effect.NONE, Effect.BEHAVIOURAL)),
        ("name: Output, range: 0..100,", "name: Output, range: [0..50, 60..100],", "RS0713", None),
        ("name: Output, range: 0..100,", "name: Output, range: [0..100, 110..120],", "RS0714", None),
    ],
)
def test_limits_are_judged_for_who_writes_and_who_reads(
    old: str, new: str, rule: str, effects: Effects | None, edited: Any
) -> None:
    (found,) = edited(old, new)
    assert found.rule.id == rule
    assert effects in {None, found.effects}


def test_limits_of_what_is_only_read_break_nothing(edited: Any) -> None:
    (found,) = edited("name: Power, type: int16, unit: W", "name: Power, type: int16, range: 0..9, unit: W")
    assert (found.rule.id, found.effects) == ("RS0713", Effects(Effect.NONE, Effect.COMPATIBLE))


def test_a_new_code_of_what_is_only_written_is_compatible(edited: Any, bench: Any) -> None:
    old = BASE.replace("name: Fan, models", "name: Fan, access: w, enum: {0: low, 1: high}, models")
    (found,) = bench.compared(old, old.replace("1: high}", "1: high, 2: full}")).changes
    assert (found.rule.id, found.effects) == ("RS0717", Effects(Effect.NONE, Effect.COMPATIBLE))
    assert edited("2: cool}", "2: cool, 3: dry}")[0].effects == Effects(Effect.NONE, Effect.BEHAVIOURAL)


@pytest.mark.parametrize(
    ("old", "new", "what", "effects"),
    [
        ("functions: [3, 6, 16]", "functions: [3, 6, 16, 23]", "function codes", (Effect.COMPATIBLE, Effect.NONE)),
        ("unit_ids: 1..100", "unit_ids: 1..200", "unit ids", (Effect.COMPATIBLE, Effect.COMPATIBLE)),
        ("baud: [9600, 19200]", "baud: [9600]", "speeds in baud", (Effect.BREAKING, Effect.BEHAVIOURAL)),
        ("baud: [9600, 19200]", "baud: [9600, 19200, 38400]", "speeds in baud", (Effect.COMPATIBLE, Effect.COMPATIBLE)),
        ("range: 1..10,", "range: 1..20,", "limits of the given", (Effect.NONE, Effect.COMPATIBLE)),
        ("range: 1..10,", "range: 1..10, default: 2,", "default of the given", (Effect.NONE, Effect.COMPATIBLE)),
        ("danger: the heating stops, ", "", "danger", (Effect.NONE, Effect.COMPATIBLE)),
        ("danger: the heating stops, ", "danger: it gets cold, ", "danger", (Effect.NONE, Effect.NONE)),
        ("when: hot, ", "", "condition of existence", (Effect.BEHAVIOURAL, Effect.COMPATIBLE)),
        (
            "name: Timer, unit",
            "name: Timer, when: hot, unit",
            "condition of existence",
            (Effect.BEHAVIOURAL, Effect.BREAKING),
        ),
        (", static: true", "", "never changes", (Effect.NONE, Effect.BEHAVIOURAL)),
        (
            "steps: [{at: 7000, words: [85]}]",
            "steps: [{at: 7000, words: [85], function: 16}]",
            "requests",
            (Effect.BEHAVIOURAL, Effect.NONE),
        ),
    ],
)
def test_a_direction_decides_how_much_it_matters(
    old: str, new: str, what: str, effects: tuple[Effect, Effect], edited: Any
) -> None:
    found = [one.effects for one in edited(old, new) if one.what == what]
    assert found == [effects]


def test_a_model_that_is_gone_takes_its_registers_with_it(edited: Any) -> None:
    found = edited(
        ", M2: {description: with a second loop}",
        "",
        "      - {at: 23, name: Fan, models: [M2]}\n",
        "",
        "[M1, M2]",
        "[M1]",
    )
    assert told(found) == [("RS0746", "M2", "none")]


@pytest.mark.parametrize("at", ["zones[].high", "zones.high", "zones[2].high"])
def test_a_waiver_excuses_what_its_path_names(at: str, bench: Any) -> None:
    new = BASE.replace("{at: 1, name: High, type: int16}", "{at: 1, name: High, type: int16, unit: s}")
    waivers = f"waivers: [{{rule: RS0712, at: '{at}', reason: it was always in seconds}}]\n"
    assert [one.rule.id for one in bench.compared(BASE, new).changes] == ["RS0712"]
    found = bench.compared(BASE, new + waivers)
    assert ([len(one.registers) for one in found.changes], found.idle) == ([3] if "2" in at else [], ())


def test_a_waiver_of_another_rule_or_place_excuses_nothing(bench: Any) -> None:
    new = BASE.replace("unit: W,", "unit: kW,")
    for rule, at in (("RS0711", "power"), ("RS0712", "total")):
        waivers = f"waivers: [{{rule: {rule}, at: {at}, reason: it was always so}}]\n"
        found = bench.compared(BASE, new + waivers)
        assert [one.rule.id for one in found.changes] == ["RS0712"]
        assert [one.at for one in found.idle] == [at]
