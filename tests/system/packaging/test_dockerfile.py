"""The Dockerfile without an engine: its steps as those of a shell, on what .dockerignore lets in."""

import re
import shutil
import subprocess
from fnmatch import fnmatch
from pathlib import Path

import pytest

from .distributions import ROOT, environment, run

pytestmark = pytest.mark.slow

STEPS = re.sub(r"\\\n\s*", "", (ROOT / "Dockerfile").read_text(encoding="utf-8"))
BUILD, IMAGE = (stage.splitlines() for stage in STEPS.split("\nFROM ")[1:])


@pytest.fixture
def context(published: Path, tmp_path: Path) -> Path:
    """What an engine would be sent of this tree."""
    lines = (ROOT / ".dockerignore").read_text(encoding="utf-8").splitlines()
    kept = [line[1:] for line in lines if line.startswith("!")]
    dropped = [line for line in lines if line[:1] not in {"!", "#", "*", ""}]
    folder = tmp_path / "source"
    folder.mkdir()
    for name in kept:
        copy = shutil.copytree if (published / name).is_dir() else shutil.copy2
        copy(published / name, folder / name)
    for path in list(folder.rglob("*")):
        if path.is_dir() and any(fnmatch(path.relative_to(folder).as_posix(), one) for one in dropped):
            shutil.rmtree(path)
    return folder


def test_the_steps_of_the_build_give_a_regscribe_that_runs(context: Path, tmp_path: Path) -> None:
    assert not (context / "generated/docs").exists()
    assert "COPY . /source" in BUILD
    for line in BUILD:
        if line.startswith("RUN "):
            command = re.sub(r"(?<![\w.])/(source|wheels|opt)\b", rf"{tmp_path}/\1", line.removeprefix("RUN "))
            done = subprocess.run(  # noqa: S602 - steps of our own file
                command, shell=True, env=environment(), capture_output=True, text=True, timeout=600, check=False
            )
            assert done.returncode == 0, done.stdout + done.stderr
    assert run(tmp_path / "opt/regscribe/bin/regscribe", "--version", cwd=tmp_path).startswith("regscribe 0.")


def test_the_image_runs_as_a_user_and_takes_the_commands_of_regscribe() -> None:
    assert "USER regscribe" in IMAGE
    assert 'ENTRYPOINT ["regscribe"]' in IMAGE
    assert IMAGE.index("USER regscribe") > max(IMAGE.index(line) for line in IMAGE if line.startswith(("RUN", "COPY")))
    assert "COPY --from=build /opt/regscribe /opt/regscribe" in IMAGE
