"""Each rule of each room is held to its example maps: one against the rule, at one place, and one put right."""

import re
from collections.abc import Callable

import pytest

from regscribe import checks, compose
from regscribe.checks.catalogue import Example, all_rules, examples, room_of
from regscribe.model import Diagnostic, Severity

EXPECT = re.compile(r"# expect: (RS\d{4}) (\d+):(\d+)\b")
Diagnose = Callable[[Example], list[Diagnostic]]
WITH_BAD = [rule.id for rule in all_rules() if examples(rule.id)[0] is not None]
WITH_GOOD = [rule.id for rule in all_rules() if examples(rule.id)[1] is not None]
OWN = [rule.id for rule in (*checks.RULES, *compose.RULES)]


def test_ids_are_unique() -> None:
    ids = [rule.id for rule in all_rules()]
    assert len(ids) == len(set(ids))


def test_rules_are_sorted_by_id() -> None:
    ids = [rule.id for rule in all_rules()]
    assert ids == sorted(ids)


def test_each_room_has_hundreds_of_its_own() -> None:
    hundreds = {"source": "RS01", "schema": "RS02", "lower": "RS03", "checks": ("RS04", "RS06"), "compose": "RS05"}
    hundreds |= {"breaking": "RS07"}
    assert all(rule.id.startswith(hundreds[room_of(rule.id)]) for rule in all_rules())


def test_there_are_at_least_45_rules_about_meaning() -> None:
    assert len(OWN) >= 45


@pytest.mark.parametrize("rule", OWN)
def test_a_rule_about_meaning_has_both_examples(rule: str) -> None:
    assert None not in examples(rule)


@pytest.mark.parametrize("rule", all_rules(), ids=lambda rule: rule.id)
def test_a_rule_says_what_and_why(rule: object) -> None:
    title, why = getattr(rule, "title", ""), getattr(rule, "why", "")
    assert title[0].isupper()
    assert why.endswith(".")


@pytest.mark.parametrize("rule", WITH_BAD)
def test_a_bad_map_is_found_at_the_exact_place_and_nothing_else(rule: str, diagnose_files: Diagnose) -> None:
    bad = examples(rule)[0] or ()
    expected = EXPECT.match(bad[0][1])
    assert expected, "the first line says `# expect: RS0401 14:9`"
    found = [one for one in diagnose_files(bad) if one.severity is Severity.ERROR or one.rule == rule]
    places = [(one.rule, str(one.span.line), str(one.span.column)) for one in found]
    assert places == [expected.groups()]


@pytest.mark.parametrize("rule", OWN)
def test_a_bad_map_yields_no_warning_beside(rule: str, diagnose_files: Diagnose) -> None:
    assert [one.rule for one in diagnose_files(examples(rule)[0] or ())] == [rule]


@pytest.mark.parametrize("rule", OWN)
def test_a_finding_says_what_to_do(rule: str, diagnose_files: Diagnose) -> None:
    assert all(one.help for one in diagnose_files(examples(rule)[0] or ()))


@pytest.mark.parametrize("rule", WITH_GOOD)
def test_a_good_map_passes(rule: str, diagnose_files: Diagnose) -> None:
    found = diagnose_files(examples(rule)[1] or ())
    assert [one for one in found if one.severity is Severity.ERROR or one.rule == rule or rule in OWN] == []


@pytest.mark.parametrize("rule", [rule.id for rule in compose.RULES])
def test_a_finding_about_two_files_shows_the_other_one(rule: str, diagnose_files: Diagnose) -> None:
    (found,) = diagnose_files(examples(rule)[0] or ())
    others = {one.span.file for one in found.related} - {found.span.file}
    assert bool(others) == (rule not in {"RS0501", "RS0509", "RS0512", "RS0514", "RS0515"}), (
        "nothing to show: no file, no reason, no command, no notation, no number of it"
    )
