"""What is read by function 23 needs a page that one request can select."""

from collections.abc import Callable

import pytest

from regscribe.model import Diagnostic

MAP = """
format: 1
map: {{id: test/asked, title: Asked, maker: Test, class_prefix: Asked}}
manual: {{title: Manual, number: "1"}}
models: {{A: {{}}}}
protocol: {{functions: [1, 3, 4, 5, 6, 16, 23], limits: {{write_words: 2}}}}
groups:
  - id: control
    name: Control
    source: "1"
    each: {{access: rw, stays: operation}}
    registers:
      - {{at: 2, name: Bank}}
      - {{at: 3, name: Row}}
      - {{at: 4, name: Column}}
      - {{at: 5, name: Switch, space: coil}}
  - id: cells
    name: Cells
    source: "1"
    {page}
    registers:
      - {{at: 10, name: Alpha, access: r, {alpha}}}
      - {{at: 11, name: Beta, access: r{beta}}}
"""
BY_23, ALSO = "functions: [23]", ", functions: [23]"


@pytest.mark.parametrize(
    ("page", "alpha", "beta", "told"),
    [
        ("page: {bank: 5}", BY_23, ALSO, ""),
        ("page: {bank: 5, row: 6}", BY_23, ", functions: [16, 23]", ""),
        ("page: {bank: 5}", "functions: [3, 23]", "", ""),
        ("description: no page", BY_23, ALSO, "no `page` says what is written before"),
        ("unit_id: 3", BY_23, ALSO, "no `page` says what is written before"),
        ("page: {bank: 5}", BY_23, "", "by function 03 on a page on which `alpha` is read by 23"),
        ("page: {bank: 5}", BY_23, ", space: input, functions: [4]", ""),
        ("page: {bank: 5, column: 6}", BY_23, ALSO, "`bank` and `column` stand at 2 and 4"),
        ("page: {row: 5, bank: 6}", BY_23, ALSO, "`row` and `bank` stand at 3 and 2"),
        ("page: {switch: 1}", BY_23, ALSO, "cannot write `switch`: space coil"),
        ("page: {bank: 5, row: 6, column: 7}", BY_23, ALSO, "are 3 words, of 2 that it writes at most"),
    ],
)
def test_a_page_is_one_that_a_request_can_select(
    diagnose: Callable[[str], list[Diagnostic]], page: str, alpha: str, beta: str, told: str
) -> None:
    found = diagnose(MAP.format(page=page, alpha=alpha, beta=beta))

    assert {one.rule for one in found} == ({"RS0680"} if told else set())
    assert all(told in one.message for one in found)
