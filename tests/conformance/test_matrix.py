"""No key of a register is ignored: each changes what goes over the wire, or a rule refuses it."""

import os
from collections.abc import Iterable

import pytest

from . import matrix, matrix_views

ALL = int(os.environ.get("MATRIX_EVERY", "23"))
"""Of so many combinations one is tried by `make conformance`; 1: all of them, which takes hours."""
FEW, FEW_VIEWS = 4001, 709
"""The same for `make test`. Both are prime, so that the steps run through all kinds, types, spaces and places."""


def ignored(verdicts: Iterable[matrix.Verdict | matrix_views.Verdict]) -> str:
    """The combinations that changed nothing, one a line."""
    return "\n".join(one.line() for one in verdicts if one.fate == "ignored")


def test_each_key_of_a_register_is_tried() -> None:
    assert list(matrix.TRIALS) == matrix.register_keys()


def test_of_some_combinations_no_key_is_ignored() -> None:
    verdicts = matrix.judged(every=FEW)
    assert ignored(verdicts) == ""
    assert len(verdicts) > 25


def test_each_key_of_a_view_is_tried() -> None:
    assert list(matrix_views.TRIALS) == list(matrix.SCHEMA["$defs"]["view"]["properties"])


def test_of_some_views_no_key_is_ignored() -> None:
    verdicts = list(matrix_views.judged(every=FEW_VIEWS))
    assert ignored(verdicts) == ""
    assert {"refused", "driver"} <= {one.fate for one in verdicts}


@pytest.mark.slow
def test_of_all_views_no_key_is_ignored() -> None:
    verdicts = list(matrix_views.judged(every=max(1, ALL // 3)))
    assert ignored(verdicts) == ""


def test_a_key_that_nothing_looks_at_is_found() -> None:
    seed = matrix.Seed("number", "int16", "holding", "rw", "alone")
    fates = [matrix.judge(seed, key, 20, {}) for key in ("settle", "x-settle")]
    assert [one.fate for one in fates if one] == ["driver", "ignored"]


@pytest.mark.slow
def test_no_key_is_ignored(capsys: pytest.CaptureFixture[str]) -> None:
    verdicts = matrix.judged_by_all_cores(every=ALL)
    with capsys.disabled():
        print(f"\n{matrix.table(verdicts)}")  # noqa: T201 (what this run is for)
    assert ignored(verdicts) == ""
