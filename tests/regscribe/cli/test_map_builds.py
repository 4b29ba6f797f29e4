"""Several maps of one build are made at once, and nobody can tell from what comes out."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

SCRIPT = """\
import os, sys
from pathlib import Path
from regscribe import pipeline
from regscribe.cli.shared import map_builds as making
from regscribe.cli.app import run

compile_map = pipeline.compile_map
def traced(path):
    Path(f"made-{path.stem}").write_text(str(os.getpid()))
    return compile_map(path)
pipeline.compile_map, making._cores = traced, lambda: CORES
print("parent", os.getpid())
sys.exit(run(["generate", "maps", "--out", "CORES"]))
"""


@pytest.fixture
def build(process: Callable[..., Any]) -> Callable[[int], Any]:
    """Generate everything into a folder that is named like the number of cores."""
    return lambda cores: process(SCRIPT.replace("CORES", str(cores)), python=True)


@pytest.fixture
def three(oven: Path) -> list[Path]:
    """The oven and two more maps like it."""
    text = oven.read_text(encoding="utf-8")
    paths = [oven.with_name(f"{name}.yaml") for name in ("dryer", "kiln")]
    for path in paths:
        renamed = text.replace("acme/oven", f"acme/{path.stem}").replace("prefix: Acme", f"prefix: {path.stem.title()}")
        path.write_text(renamed, encoding="utf-8")
    return [paths[0], paths[1], oven]


def test_many_cores_write_what_one_core_writes(build: Callable[[int], Any], three: list[Path]) -> None:
    assert [build(cores).code for cores in (1, 3)] == [0, 0]
    one, many = (
        {path.relative_to(out): path.read_bytes() for path in Path(out).rglob("*") if path.is_file()}
        for out in ("1", "3")
    )
    assert one == many
    assert len(one) > 3 * len(three)


def test_the_work_is_done_in_other_processes(build: Callable[[int], Any], three: list[Path]) -> None:
    parent = build(3).out.split()[1]
    makers = {Path(f"made-{path.stem}").read_text(encoding="utf-8") for path in three}
    assert makers
    assert parent not in makers


def test_one_map_is_made_in_this_process(build: Callable[[int], Any], oven: Path) -> None:
    parent = build(3).out.split()[1]
    assert Path(f"made-{oven.stem}").read_text(encoding="utf-8") == parent


def test_what_is_wrong_is_told_in_the_order_of_the_maps(build: Callable[[int], Any], three: list[Path]) -> None:
    for path in three[:2]:
        path.write_text(path.read_text(encoding="utf-8").replace("range: 0..400", "range: 400..0"), encoding="utf-8")
    three[1].write_text(f"{three[1].read_text(encoding='utf-8')}# the largest of all, which is made first\n")
    one, many = build(1), build(3)
    assert (one.code, many.code) == (1, 1)
    assert one.err == many.err
    assert one.err.index("dryer.yaml") < one.err.index("kiln.yaml")
    assert not Path("3").exists()
