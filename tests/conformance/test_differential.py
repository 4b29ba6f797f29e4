"""Random sound maps: driver, reference and simulated device agree on every reading and on every write."""

import random
import re
from typing import Any

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from regscribe.emit import python

from .places import block_of
from .strategies import FUZZ, STEADY, maps
from .suite import Built, Json, diagnose, errors_of, module_of, whole_map
from .trial import Trial

FEW = 48


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


FIRST = {"coil": 1, "discrete": 100_001, "input": 300_001, "holding": 400_001}
"""The number of the first address of each space, in six digits."""


def numbered(node: Any, space: str = "holding") -> Any:
    """Registers as a manual numbers them; where the number tells the space, the row does not say it."""
    if isinstance(node, list):
        return [numbered(each, space) for each in node]
    if not isinstance(node, dict):
        return node
    space = node.get("space", space)
    if space not in FIRST:
        return node
    told = {"space"} if space in {"input", "discrete"} and "at" in node else set()
    inner = {key: numbered(each, space) for key, each in node.items() if key in {"registers", "variants", "write"}}
    first = {key: node[key] + FIRST[space] for key in node.keys() & {"at", "write_at"}}
    if "aliases" in node:
        first["aliases"] = [alias + FIRST[space] for alias in node["aliases"]]
    return {key: each for key, each in node.items() if key not in told} | inner | first


def driver_of(parts: Json) -> str:
    """The code of a map's driver, without what is said of the file that it comes from; empty where it is refused."""
    register_map, found = diagnose(whole_map(parts))
    if register_map is None or errors_of(found):
        return ""
    ((_, code),) = python.render(register_map).items()
    return re.sub(r"sha256( = .)? *\w+", "", code)


@settings(STEADY, max_examples=FEW // 2, derandomize=True)
@given(parts=maps())
def test_the_numbers_of_a_manual_mean_the_same_as_wire_addresses(parts: Json) -> None:
    code = driver_of(parts)
    assume(code)
    written = {**parts, "written_in": "modicon", "registers": numbered(parts["registers"])}
    assert driver_of(written) == code


@pytest.mark.slow
@settings(STEADY, max_examples=FUZZ)
@given(parts=maps(), seed=st.integers(0, 2**32))
def test_all_agree_on_many_random_maps(parts: Json, seed: int) -> None:
    assert disagreements(parts, seed) == []
