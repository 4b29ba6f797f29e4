"""Single scalars of maps are changed at random: a change is found exactly where the export differs."""

import random
import shutil
from pathlib import Path
from typing import Any

import pytest

from regscribe.breaking.change import TEXT_ONLY
from regscribe.breaking.compare import compare
from regscribe.breaking.examples import BASE
from regscribe.map_files import shipped
from regscribe.model import RegisterMap
from regscribe.pipeline import compile_map

from .mutations import exported, mutant, scalars

FEW, SOME = 40, 60
MAPS = ("fdc/series-100", "athena/platinum-m300", "athena/platinum-x5000", "omega/cn8200")


def compiled(path: Path, text: str) -> RegisterMap | None:
    path.write_text(text, encoding="utf-8")
    return compile_map(path).map


def judge(old: RegisterMap, new: RegisterMap) -> str:
    """What is wrong with the changes that are found between two versions; nothing where they are right."""
    changes = compare([old], [new], alone=True).changes
    if bool(changes) == (exported(old) != exported(new)):
        return ""
    return f"found {[(one.rule.id, one.what, one.before, one.after) for one in changes]}"


def judge_mutants(path: Path, text: str, number: int, seed: int) -> tuple[list[str], int]:
    """What is wrong with mutants of the map at a path, and how many of them had no errors."""
    old = compiled(path, text)
    assert old is not None
    chance = random.Random(seed)  # noqa: S311 (no secret)
    places, wrong, good = scalars(text), [], 0
    for _ in range(number):
        mutated = mutant(text, place := chance.choice(places), chance)
        new = compiled(path, mutated)
        if new is not None:
            good += 1
            what = judge(old, new)
            wrong += [f"{text[place[0] - 30 : place[1] + 10]!r}: {what}"] if what else []
    return wrong, good


def test_mutants_of_a_small_map_are_found(tmp_path: Path) -> None:
    wrong, good = judge_mutants(tmp_path / "oven.yaml", BASE, FEW, seed=7)
    assert wrong == []
    assert good > FEW // 4


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(4))
def test_more_mutants_of_a_small_map_are_found(tmp_path: Path, seed: int) -> None:
    assert judge_mutants(tmp_path / "oven.yaml", BASE, SOME, seed)[0] == []


@pytest.mark.slow
@pytest.mark.parametrize("name", MAPS)
def test_mutants_of_shipped_maps_are_found(tmp_path: Path, name: str) -> None:
    shutil.copytree(shipped(), tmp_path / "maps")
    path = tmp_path / "maps" / f"{name}.yaml"
    assert judge_mutants(path, path.read_text(encoding="utf-8"), SOME, seed=1)[0] == []


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("unit: W", "unit: kW"),
        ("at: 13", "at: 14"),
        ("type: uint32", "type: int32"),
        ("words: [85]", "words: [86]"),
        ("0..400", "0..300"),
        ("default: 20", "default: 30"),
        ("unit_ids: 1..100", "unit_ids: 1..90"),
    ],
)
def test_a_change_beyond_texts_is_never_one_of_texts(edited: Any, old: str, new: str) -> None:
    assert [one for one in edited(old, new) if one.effects == TEXT_ONLY] == []
