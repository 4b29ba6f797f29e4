"""No key of an object is ignored: without it, or with another value, something is done or said otherwise."""

import pytest

from . import matrix_keys as matrix

FEW = 29
"""Of so many keys one is tried by `make test`; `make conformance` tries all that are settled."""
KEYS = [key for key in matrix.tried_here() if key.partition(".")[0] in matrix.SETTLED]


def test_each_key_of_each_object_has_a_specimen() -> None:
    assert [key for key, where in matrix.places().items() if not where] == []


def test_each_exception_is_a_key() -> None:
    assert (matrix.FOR_READERS | matrix.UNTOLD) - set(matrix.tried_here()) == set()


@pytest.mark.parametrize("key", KEYS[::FEW])
def test_some_keys_are_not_ignored(key: str) -> None:
    assert matrix.ignored(key) == ""


@pytest.mark.slow
@pytest.mark.parametrize("key", KEYS)
def test_no_key_is_ignored(key: str) -> None:
    assert matrix.ignored(key) == ""
