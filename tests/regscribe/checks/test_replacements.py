"""A name that was probably meant is told apart from the sentence around it, for editors and for SARIF."""

import re
from collections.abc import Callable

import pytest

from regscribe.checks.catalogue import Example, all_rules, examples
from regscribe.model import Diagnostic

BAD = {rule.id: bad for rule in all_rules() if (bad := examples(rule.id)[0]) and not rule.id.startswith("RS07")}

Small = Callable[..., str]
Diagnose = Callable[[str], list[Diagnostic]]


@pytest.mark.parametrize("rule", BAD)
def test_each_did_you_mean_of_the_catalogue_has_a_replacement(
    rule: str, diagnose_files: Callable[[Example], list[Diagnostic]]
) -> None:
    for one in diagnose_files(BAD[rule]):
        guess = re.search(r"did you mean `(.*?)`\?", one.help)
        assert not guess or guess[1] in one.replacement, one


@pytest.mark.parametrize(
    ("register", "replacement"),
    [
        ("at: 1, nme: A", "name"),
        ("at: 1, label: A", "name"),
        ("at: 1, name: A, access: readonly", "r"),
        ("at: 1, name: A, type: unit16", "uint16"),
        ("at: 1, name: A, unit: Kelvin", "K"),
        ("at: 1, name: A, enum: of_on", "off_on"),
        ("at: 1, name: A, when: {mod.a: 1}", "mode.a"),
        ("at: 1, name: A, when: {mode.operatio: 1}", "mode.operation"),
        ("at: 1, name: A, when: {state: rum}", "run"),
        ("at: 1, name: A, when: {xyz: 1}", ""),
    ],
)
def test_the_replacement_is_all_that_stands_at_the_place(
    register: str, replacement: str, small: Small, diagnose: Diagnose
) -> None:
    mode = "at: 8, name: Mode, type: uint16, fields: {operation: {bit: 0}, a: {bit: 1}}"
    text = small(
        mode, "at: 9, name: State, type: uint16, enum: {0: stop, 1: run}", register, top="enums: {off_on: {0: x}}"
    )
    assert {one.replacement for one in diagnose(text)} - {""} == {replacement} - {""}
