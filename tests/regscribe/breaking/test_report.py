"""How changes are told."""

from typing import Any

import pytest

from regscribe.breaking.change import Change, Effect, Effects, Level, Verdict, verdict_of
from regscribe.breaking.report import diagnostics, markdown, sentence, told, verdict_words
from regscribe.breaking.rules import ADDRESS, CODE_ADDED, TEXT
from regscribe.model import Severity, Span

HERE, THERE = Span("maps/a.yaml", 3, 5, 3, 9), Span("old/a.yaml", 4, 5, 4, 9)


def change(*subjects: str, **more: Any) -> Change:
    usual: dict[str, Any] = {
        "rule": ADDRESS,
        "place": HERE,
        "subjects": subjects or ("mode",),
        "what": "address",
        "before": "holding 1",
        "after": "holding 2",
        "effects": Effects(Effect.BREAKING, Effect.NONE),
        "map": "acme/oven",
        "registers": subjects or ("mode",),
        "models": ("M1",),
    }
    return Change(**{**usual, **more})


ADDED = change(
    rule=CODE_ADDED, what="code", before="none", after="2 DRY", effects=Effects(Effect.NONE, Effect.BEHAVIOURAL)
)
WORDS = change(rule=TEXT, what="name", before='"A"', after='"B"', effects=Effects())


def test_four_subjects_are_named_and_of_five_three() -> None:
    assert sentence(change(*"abcd")).startswith("`a`, `b`, `c` and `d`: address")
    assert sentence(change(*"abcde")).startswith("`a`, `b`, `c` and 2 more: address")


@pytest.mark.parametrize(
    ("registers", "models", "end"),
    [
        (("a",), ("M1",), "holding 2"),
        (("a",), ("M1", "M2"), "holding 2 (on 2 models)"),
        (("a", "b"), ("M1",), "holding 2 (affects 2 registers of 1 model)"),
        (("a", "b"), ("M1", "M2"), "holding 2 (affects 2 registers of 2 models)"),
        ((), (), "holding 2"),
    ],
)
def test_a_change_says_how_much_it_affects(registers: tuple[str, ...], models: tuple[str, ...], end: str) -> None:
    assert sentence(change(registers=registers, models=models)).endswith(end)


def test_what_came_and_what_went_is_said_so() -> None:
    assert sentence(ADDED) == "`mode`: code 2 DRY is new"
    assert sentence(change(what="command", before="stop", after="none")) == "`mode`: command stop is gone"
    assert sentence(change("stop", what="command", before="stop", after="none")) == "`stop`: command is gone"


@pytest.mark.parametrize(
    ("wire", "api", "words"),
    [
        (Effect.BREAKING, Effect.BREAKING, "breaking on the wire and for programs"),
        (Effect.BREAKING, Effect.COMPATIBLE, "breaking on the wire, compatible for programs"),
        (Effect.NONE, Effect.BEHAVIOURAL, "behavioural for programs"),
        (Effect.NONE, Effect.NONE, "texts only"),
    ],
)
def test_effects_are_told_for_both_sides(wire: Effect, api: Effect, words: str) -> None:
    assert told(Effects(wire, api)) == words


def test_the_greatest_verdict_counts_with_its_rules() -> None:
    every = [WORDS, ADDED, change()]
    assert [verdict_of(every[:count]) for count in range(4)] == [
        Verdict.NONE,
        Verdict.PATCH,
        Verdict.MINOR,
        Verdict.MAJOR,
    ]
    assert verdict_words(every[:2], Level.API) == "minor: 1 behavioural change (RS0717)"
    assert verdict_words(every[:2], Level.WIRE) == "none: nothing that counts at this level differs"
    assert verdict_words([change(), change("other")], Level.WIRE).startswith("major: 2 breaking changes (RS0701);")


def test_only_what_breaks_at_a_level_is_an_error_there() -> None:
    found = diagnostics([change(), ADDED, WORDS], Level.API)
    assert [one.severity for one in found] == [Severity.ERROR, Severity.WARNING, Severity.WARNING]
    (renamed,) = diagnostics([change(effects=Effects(Effect.NONE, Effect.BREAKING))], Level.WIRE)
    assert renamed.severity is Severity.WARNING


def test_where_it_stood_is_the_other_party_unless_it_stood_there() -> None:
    first, second = diagnostics([change(was=THERE), change(was=HERE)], Level.API)
    assert [one.span for one in first.related] == [THERE]
    assert second.related == ()


def test_a_changelog_without_changes_says_so() -> None:
    assert markdown([], Level.API) == "## No change of the maps\n"


def test_a_changelog_escapes_what_maps_say() -> None:
    text = markdown([change(what="name", before='"*a*"', after='"<b>"', subjects=("a|b",))], Level.API)
    assert 'name "\\*a\\*" \N{RIGHTWARDS ARROW} "&lt;b&gt;"' in text
    assert "a\\|b" in text
