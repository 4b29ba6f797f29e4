"""Type checkers infer what drivers return and refuse what a device does not have."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

FOLDER = Path(__file__).parent / "typing"
ROOT = Path(__file__).parents[3]


def errors(command: list[str], pattern: str) -> set[int]:
    """The lines that a checker complains about."""
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)  # noqa: S603 (fixed commands)
    found = {int(number) for number in re.findall(pattern, done.stdout)}
    assert (done.returncode == 0) == (not found), done.stdout + done.stderr
    return found


def marked(path: Path) -> set[int]:
    """The lines that say they are refused."""
    lines = path.read_text(encoding="utf-8").splitlines()
    return {number for number, line in enumerate(lines, 1) if "# refused:" in line}


@pytest.fixture(scope="module", params=["mypy", "pyright"])
def check(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> object:
    """A function from a file to the lines with errors."""
    if request.param == "mypy":
        cache = tmp_path_factory.mktemp("mypy")
        command = [sys.executable, "-m", "mypy", "--strict", f"--cache-dir={cache}", "--no-error-summary"]
        return lambda path: errors([*command, str(path)], rf"{path.name}:(\d+): error")
    return lambda path: errors(
        [sys.executable, "-m", "pyright", "--pythonpath", sys.executable, str(path)], r":(\d+):\d+ - error"
    )


def test_types_are_inferred_from_the_declarations(check: object) -> None:
    assert check(FOLDER / "accepted.py") == set()  # type: ignore[operator] # a fixture's type is an object


def test_what_a_device_does_not_have_is_refused_line_by_line(check: object) -> None:
    path = FOLDER / "refused.py"

    assert check(path) == marked(path)  # type: ignore[operator] # as above
    assert len(marked(path)) > 10
