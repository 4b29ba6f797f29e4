"""Random sound maps: driver, reference and simulated device agree on every reading and on every write."""

import random

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from regscribe.emit import python

from .places import block_of
from .strategies import FUZZ, STEADY, maps
from .suite import Built, Json, diagnose, errors_of, module_of, whole_map
from .trial import Trial

FEW = 200


def disagreements(parts: Json, seed: int) -> list[str]:
    """What is said otherwise of a map that no rule refuses; others do not count."""
    register_map, found = diagnose(whole_map(parts))
    assume(register_map is not None and not errors_of(found))
    assert register_map is not None
    ((_, code),) = python.render(register_map).items()
    trial = Trial(Built(register_map, module_of(code)), random.Random(seed))  # noqa: S311 (found again by its seed)
    return list(trial.differences())


@settings(STEADY, max_examples=FEW, derandomize=True)
@given(parts=maps(), seed=st.integers(0, 2**32))
def test_all_agree_on_random_maps(parts: Json, seed: int) -> None:
    assert disagreements(parts, seed) == []


@settings(STEADY, max_examples=FEW // 4, derandomize=True)
@given(parts=maps(), seed=st.integers(0, 2**32))
def test_all_agree_on_random_maps_in_a_block_of_a_chain(parts: Json, seed: int) -> None:
    inside = block_of(parts)
    assume(inside is not None)
    assert inside is not None
    assert disagreements(inside, seed) == []


@pytest.mark.slow
@settings(STEADY, max_examples=FUZZ)
@given(parts=maps(), seed=st.integers(0, 2**32))
def test_all_agree_on_many_random_maps(parts: Json, seed: int) -> None:
    assert disagreements(parts, seed) == []
