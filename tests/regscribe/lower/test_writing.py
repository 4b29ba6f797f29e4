"""What maps say of writes: what is not copied, what governs the line, when a read-back counts."""

from collections.abc import Callable

import pytest

from regscribe.model import Governs, Register, Setting

Registers = Callable[..., dict[str, Register]]


def test_a_reason_to_stay_may_be_given_for_a_group_and_otherwise_for_a_register(registers: Registers) -> None:
    found = registers(
        """
        - {at: 0, name: Gain}
        - {at: 1, name: Hours, stays: counter}
        """,
        each="{access: rw, type: int16, stays: calibration}",
    )
    assert {path: register.stays for path, register in found.items()} == {"gain": "calibration", "hours": "counter"}


def test_a_variant_may_take_away_what_governs_the_line(registers: Registers) -> None:
    line = (
        "- {at: 0, name: Own, stays: address, governs: address, settle: 5, variants: [{models: [B-2], governs: null}]}"
    )
    assert registers(line)["own"].governs == Governs(Setting.ADDRESS)
    assert registers(line, model="B-2")["own"].governs is None
    assert registers(line, model="B-2")["own"].settle == 5


def test_codes_and_the_moment_are_kept(registers: Registers) -> None:
    line = "- {at: 0, name: Speed, stays: line, governs: {setting: baud, codes: {6: 4800, 7: 9600}, from: at_once}}"
    assert registers(line)["speed"].governs == Governs(Setting.BAUD, ((6, "4800"), (7, "9600")), "at_once")


@pytest.mark.parametrize("setting", list(Setting))
def test_every_setting_has_a_short_form(registers: Registers, setting: Setting) -> None:
    found = registers(f"- {{at: 0, name: Own, governs: {setting}}}")["own"].governs
    assert found == Governs(setting)


def test_what_says_nothing_of_it_has_nothing_of_it(registers: Registers) -> None:
    plain = registers("- {at: 0, name: Gain}")["gain"]
    assert (plain.stays, plain.governs, plain.settle) == ("", None, 0)
