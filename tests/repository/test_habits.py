"""What is checked before a commit."""

import subprocess
from pathlib import Path

import pytest
import yaml

from .commit_subject import fault

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize(
    ("message", "said"),
    [
        ("Read a dependency without a plan\n\nIt is one request.\n", ""),
        ("x" * 72, ""),
        ("x" * 73, "73 characters"),
        ("# of a template only\n", "empty"),
        ("Subject\nbody", "empty line"),
    ],
)
def test_a_commit_message_is_judged_by_its_subject(message: str, said: str) -> None:
    assert said in fault(message)
    assert bool(said) == bool(fault(message))


def test_each_hook_runs_a_program_that_make_installs_or_a_file_that_is_there() -> None:
    (local,) = yaml.safe_load((ROOT / ".pre-commit-config.yaml").read_text(encoding="utf-8"))["repos"]
    commands = [hook["entry"].split() for hook in local["hooks"]]
    assert {command[0] for command in commands} == {
        ".venv/bin/ruff",
        ".venv/bin/mypy",
        ".venv/bin/regscribe",
        ".venv/bin/python",
    }
    assert [
        part for command in commands for part in command if part.endswith(".py") and not (ROOT / part).is_file()
    ] == []


def test_generated_files_are_kept_out_of_diffs_and_their_project_file_is_not() -> None:
    def diff(path: str) -> str:
        said = subprocess.run(["git", "check-attr", "diff", path], cwd=ROOT, capture_output=True, text=True, check=True)  # noqa: S603, S607 (git on paths of this file)
        return said.stdout.rsplit(": ", 1)[-1].strip()

    paths = ("generated/regscribe_devices/fdc/series_100.py", "generated/vectors/fdc/series-100.json")
    assert [diff(path) for path in paths] == ["unset", "unset"]
    assert diff("generated/pyproject.toml") == "set"
    assert diff("generator/regscribe/pipeline.py") == "unspecified"
