"""A handful of the mutants of `make mutate`, in this process, so that every test run knows that the vectors bite."""

import importlib.util
import sys
import tomllib
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from regscribe.emit.vectors import render
from regscribe.testing import Vectors, load

HERE = Path(__file__).parent
KILN = (HERE / "kiln.yaml").read_text(encoding="utf-8")
MUTANTS = tomllib.loads((HERE / "mutants.toml").read_text(encoding="utf-8"))
FAST = [one for one in MUTANTS["map"] if one.get("fast")]
ENOUGH = 60


@pytest.fixture(scope="module")
def judge() -> ModuleType:
    """The judge, which is a script and no package."""
    spec = importlib.util.spec_from_file_location("mutation_judge", HERE / "judge.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module  # its dataclasses look their module up
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def vectors(judge: ModuleType, tmp_path_factory: pytest.TempPathFactory) -> Vectors:
    """The vectors of the sound kiln."""
    path = tmp_path_factory.mktemp("kiln") / "kiln.json"
    path.write_text(render(judge.compiled(KILN))["vectors/test/kiln.json"], encoding="utf-8")
    return load(path)


def test_the_sound_kiln_passes(judge: ModuleType, vectors: Vectors) -> None:
    assert judge.caught_by(judge.compiled(KILN), vectors) == ""


@pytest.mark.parametrize("mutant", FAST, ids=[one["name"] for one in FAST])
def test_a_broken_map_is_caught(judge: ModuleType, vectors: Vectors, mutant: dict[str, Any]) -> None:
    assert KILN.count(mutant["old"]) == 1
    broken = judge.compiled(KILN.replace(mutant["old"], mutant["new"]))
    assert judge.caught_by(broken, vectors, models=2)


def test_there_are_at_least_sixty_mutants_and_each_can_still_be_made() -> None:
    package = HERE.parents[2] / "generator"
    gone = [
        f"{room}: {one['name']}"
        for room, several in MUTANTS.items()
        for one in several
        if ((package / one["file"]).read_text(encoding="utf-8") if "file" in one else KILN).count(one["old"]) != 1
    ]
    assert gone == []
    assert sum(map(len, MUTANTS.values())) >= ENOUGH
    assert len(FAST) >= 8
