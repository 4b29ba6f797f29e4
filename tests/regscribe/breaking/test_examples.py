"""The example of each rule is found, with the effects that it states, and `explain` can show it."""

from typing import Any

import pytest

from regscribe.breaking import RULES, examples, rules
from regscribe.breaking.change import Effect, Effects, Level, Verdict
from regscribe.model import Rule

WHOLE = {rules.MAP_ADDED, rules.MAP_REMOVED}


def test_each_rule_has_an_example_unless_it_is_about_a_whole_map() -> None:
    assert set(RULES) - set(examples.EDITS) == WHOLE


@pytest.mark.parametrize("rule", examples.EDITS, ids=lambda rule: rule.id)
def test_an_example_is_found_with_its_effects(rule: Rule, bench: Any) -> None:
    found = bench.compared(examples.BASE, examples.edited(rule)).changes
    mine = [change.effects for change in found if change.rule is rule]
    assert mine != []
    assert max(mine) == examples.EDITS[rule].effects


@pytest.mark.parametrize("rule", examples.EDITS, ids=lambda rule: rule.id)
def test_an_edit_replaces_what_stands_in_the_map(rule: Rule) -> None:
    text = examples.BASE
    for old, new in examples.EDITS[rule].replaced:
        assert old in text
        text = text.replace(old, new, 1)
    assert text != examples.BASE
    assert examples.shown(rule).startswith("@@")


def test_the_map_of_the_examples_is_no_change_against_itself(bench: Any) -> None:
    assert bench.compared(examples.BASE, f"# another comment\n{examples.BASE}").changes == ()


@pytest.mark.parametrize(
    ("effects", "level", "verdict"),
    [
        (Effects(Effect.BREAKING, Effect.NONE), Level.WIRE, Verdict.MAJOR),
        (Effects(Effect.NONE, Effect.BREAKING), Level.WIRE, Verdict.NONE),
        (Effects(Effect.NONE, Effect.BREAKING), Level.API, Verdict.MAJOR),
        (Effects(Effect.COMPATIBLE, Effect.BEHAVIOURAL), Level.API, Verdict.MINOR),
        (Effects(Effect.COMPATIBLE, Effect.NONE), Level.WIRE, Verdict.MINOR),
        (Effects(), Level.API, Verdict.NONE),
        (Effects(), Level.DOCS, Verdict.PATCH),
    ],
)
def test_effects_ask_for_a_version(effects: Effects, level: Level, verdict: Verdict) -> None:
    assert effects.verdict(level) is verdict
