"""What `make test-versions` runs: the ends of the range, on interpreters that are what they are called."""

import sys
from pathlib import Path

import pytest
from packaging.specifiers import SpecifierSet

from .versions import ROOT, TESTS, interpreter, pymodbus


def test_the_range_has_its_two_ends_in_it_and_not_what_was_yanked() -> None:
    text = (ROOT / "generator" / "runtime" / "pyproject.toml").read_text(encoding="utf-8")
    (allowed,) = (
        SpecifierSet(line.split('"')[1][8:]) for line in text.splitlines() if line.startswith('    "pymodbus')
    )
    oldest, newest = pymodbus()
    assert oldest != newest
    assert [oldest in allowed, newest in allowed, "3.16.0" in allowed, "3.17.0" in allowed] == [
        True,
        True,
        False,
        False,
    ]


def test_the_tests_that_it_runs_are_there() -> None:
    assert [name for name in TESTS if not (ROOT / name).is_dir()] == []


def test_a_program_is_taken_by_what_it_is_and_not_by_its_name(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    here = ".".join(map(str, sys.version_info[:2]))
    for name in (here, "3.2"):
        (tmp_path / f"python{name}").symlink_to(sys.executable)
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setenv("PYENV_ROOT", str(tmp_path))
    assert interpreter(here) == str(tmp_path / f"python{here}")
    assert interpreter("3.2") is None
