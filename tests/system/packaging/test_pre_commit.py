"""The hooks for repositories with maps of their own, run by pre-commit as docs/ci.md has it."""

import re
import subprocess
from pathlib import Path

import pytest
import yaml

from .distributions import ROOT, environment, run
from .repositories import OVEN, PAGE, change, git

pytestmark = pytest.mark.slow

CONFIG = PAGE[".pre-commit-config.yaml"]


@pytest.fixture(scope="module")
def home(tmp_path_factory: pytest.TempPathFactory) -> str:
    """Where pre-commit keeps the environments of hooks."""
    return str(tmp_path_factory.mktemp("pre-commit"))


@pytest.fixture
def hooked(repository: Path, published: Path) -> Path:
    """The repository with the configuration of the page."""
    revision = run("git", "rev-parse", "HEAD", cwd=published).strip()
    config = CONFIG.replace("https://github.com/OWNER/regscribe", str(published)).replace("REF", revision)
    (repository / ".pre-commit-config.yaml").write_text(config, encoding="utf-8")
    git(repository, "add", ".")
    return repository


def commit(folder: Path, tools: Path, home: str) -> str:
    """What pre-commit prints of what is staged; "" if all hooks pass."""
    git(folder, "add", ".")
    done = subprocess.run(  # noqa: S603 - a program of our tools
        [tools / "pre-commit", "run"],
        cwd=folder,
        env=environment(PRE_COMMIT_HOME=home, PRE_COMMIT_COLOR="never"),
        capture_output=True,
        text=True,
        timeout=600,
        check=False,
    )
    return (done.stdout + done.stderr) * bool(done.returncode)


def test_the_hooks_of_the_page_are_those_of_this_repository(tools: Path) -> None:
    (used,) = yaml.safe_load(CONFIG)["repos"]
    offered = yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text(encoding="utf-8"))
    assert [one["id"] for one in used["hooks"]] == [one["id"] for one in offered]
    run(tools / "pre-commit", "validate-manifest", ROOT / ".pre-commit-hooks.yaml", cwd=ROOT)


def test_a_broken_map_is_not_committed(hooked: Path, tools: Path, home: str) -> None:
    change(hooked, OVEN, "sentinels:", "sentinel:")
    said = commit(hooked, tools, home)
    assert "register maps are right" in said
    assert "did you mean `sentinels`?" in said


def test_a_map_without_what_is_generated_from_it_is_not_committed(hooked: Path, tools: Path, home: str) -> None:
    change(hooked, OVEN, "sensor break", "sensor broken")
    said = commit(hooked, tools, home)
    assert re.search(r"register maps are right\.+Passed", said)
    assert "sensor broken" in said


def test_a_map_with_what_is_generated_from_it_is_committed(hooked: Path, tools: Path, home: str, user: Path) -> None:
    change(hooked, OVEN, "sensor break", "sensor broken")
    run(user / "regscribe", "generate", cwd=hooked)
    assert commit(hooked, tools, home) == ""
