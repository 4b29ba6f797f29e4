"""Registers at one address on several pages must be told apart; what cannot stand on a page is refused by its name."""

from collections.abc import Callable

import pytest

from regscribe.model import Diagnostic

MAP = """
format: 1
map: {{id: test/pager, title: Pager, maker: Test, class_prefix: Pager}}
manual: {{title: Manual, number: "1"}}
models: {{A: {{}}}}
protocol: {{functions: [3, 4, 6, 16]}}
{commands}
groups:
  - id: control
    name: Control
    source: "1"
    each: {{access: rw, stays: operation}}
    registers: [{{at: 2, name: Bank}}, {{at: 3, name: Row}}]
  - {{id: one, name: One, source: "1", {one}, registers: [{{at: 20, name: Alpha, access: rw}}]}}
  - {{id: two, name: Two, source: "1", {two}, registers: [{{at: 19, name: Beta, access: rw, {beta}}}]}}
"""
Diagnose = Callable[[str], list[Diagnostic]]


def _told(diagnose: Diagnose, one: str, two: str, beta: str, commands: str = "") -> list[str]:
    text = MAP.format(one=one, two=two, beta=beta, commands=commands)
    return [f"{found.rule} {found.message}" for found in diagnose(text)]


@pytest.mark.parametrize(
    ("one", "two", "where"),
    [
        ("page: {bank: 1}", "page: {row: 1}", "on a page of `row`, and `alpha` on a page of `bank`"),
        (
            "page: {bank: 1}",
            "page: {row: 3, bank: 1}",
            "on a page of `row` and `bank`, and `alpha` on a page of `bank`",
        ),
        ("page: {bank: 1}", 'description: "x"', "on no page, and `alpha` on a page of `bank`"),
    ],
)
def test_pages_that_may_be_shown_at_once_have_no_address_in_common(
    diagnose: Diagnose, one: str, two: str, where: str
) -> None:
    told = f"RS0689 `beta` takes holding 20 {where}: a device may show both at once"
    assert _told(diagnose, one, two, "type: uint32") == [told]
    assert _told(diagnose, one, two, "type: int16") == []


@pytest.mark.parametrize("two", ["page: {bank: 2}", "page: {row: 1, bank: 2}", "unit_id: 4"])
def test_pages_with_different_values_of_one_register_and_other_units_may(diagnose: Diagnose, two: str) -> None:
    assert _told(diagnose, "page: {bank: 1}", two, "type: uint32") == []


@pytest.mark.parametrize(("one", "where"), [("page: {bank: 1}", "on a page"), ("unit_id: 9", "at unit id 9")])
def test_a_step_on_a_page_or_at_another_unit_is_refused_by_name(diagnose: Diagnose, one: str, where: str) -> None:
    step = 'commands: {go: {name: Go, source: "1", steps: [{register: alpha, value: 3}]}}'
    assert _told(diagnose, one, "unit_id: 4", "type: uint32", step) == [
        f"RS0479 command `go` writes `alpha`, which stands {where}, where no step writes"
    ]
