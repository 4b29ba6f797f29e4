"""docs/ci.md is true: its steps run in a fresh repository, pass what is right, and fail on each wrong change."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest
import yaml

from .distributions import ROOT, run
from .repositories import DRIVER, OVEN, PAGE, change, moved_register
from .steps import Ran, Service

pytestmark = pytest.mark.slow


def nothing(_: Path, __: Path) -> None:
    """Change nothing."""


def broken_map(folder: Path, _: Path) -> None:
    change(folder, OVEN, "sentinels:", "sentinel:")


def drift(folder: Path, _: Path) -> None:
    change(folder, DRIVER, '"sensor break"', '"sensor broken"')


def forgotten_generate(folder: Path, _: Path) -> None:
    change(folder, OVEN, "sensor break", "sensor broken")


Change = Callable[[Path, Path], None]
CHANGES: dict[Change, tuple[str, str]] = {
    nothing: ("", ""),
    broken_map: ("check", "did you mean `sentinels`?"),
    drift: ("generate --check", "sensor broken"),
    forgotten_generate: ("generate --check", "sensor broken"),
    moved_register: ("breaking", "RS0701"),
}
"""Changes with the command that must fail, and what it must say."""


def github(folder: Path, user: Path, wheels: Path) -> Ran:
    workflow = yaml.safe_load(PAGE[".github/workflows/maps.yaml"])
    values = {"github.event_name == 'pull_request'": "yes", "github.base_ref": "main"}
    return Service(folder, user, {"PIP_FIND_LINKS": str(wheels)}, values).run(workflow["jobs"]["maps"]["steps"])


def gitlab(folder: Path, user: Path, wheels: Path) -> Ran:
    job = yaml.safe_load(PAGE[".gitlab-ci.yml"])["maps"]
    base = run("git", "rev-parse", "origin/main", cwd=folder).strip()
    variables = {**job["variables"], "PIP_FIND_LINKS": str(wheels), "CI_MERGE_REQUEST_DIFF_BASE_SHA": base}
    return Service(folder, user, variables).run([{"run": line} for line in job["script"]])


def make(folder: Path, user: Path, _: Path) -> Ran:
    (folder / "Makefile").write_text(PAGE["Makefile"], encoding="utf-8")
    return Service(folder, user).run([{"run": "make check"}])


@pytest.mark.parametrize("changed", CHANGES, ids=lambda one: one.__name__)
@pytest.mark.parametrize("service", [github, gitlab], ids=lambda one: one.__name__)
def test_a_service_passes_what_is_right_and_stops_at_what_is_wrong(
    service: Callable[[Path, Path, Path], Ran], changed: Change, repository: Path, user: Path, wheel_folder: Path
) -> None:
    changed(repository, user)
    ran = service(repository, user, wheel_folder)
    command, said = CHANGES[changed]
    assert (command in _command(ran.failed)) if command else ran.failed == "", ran.printed
    assert said in ran.printed + ran.summary


def _command(failed: str) -> str:
    """The command of a step by its name in the workflow; of what has no name, the step itself."""
    steps = yaml.safe_load(PAGE[".github/workflows/maps.yaml"])["jobs"]["maps"]["steps"]
    return {str(step.get("name")): str(step.get("run")) for step in steps}.get(failed, failed)


@pytest.mark.parametrize("changed", [nothing, broken_map, drift], ids=lambda one: one.__name__)
def test_make_runs_the_same(changed: Change, repository: Path, user: Path, wheel_folder: Path) -> None:
    changed(repository, user)
    ran = make(repository, user, wheel_folder)
    command, said = CHANGES[changed]
    assert bool(ran.failed) == bool(command), ran.printed
    assert said in ran.printed
    assert f"regscribe {command}" in ran.printed


def test_a_driver_that_differs_from_its_vectors_fails_the_tests_of_the_page(repository: Path, user: Path) -> None:
    change(repository, DRIVER, 'Fraction("0.1")', 'Fraction("0.2")')
    assert "pytest generated/tests" in PAGE[".github/workflows/maps.yaml"]
    ran = Service(repository, user).run([{"run": "pytest generated/tests"}])
    assert ran.failed


def test_findings_stand_beside_their_lines(repository: Path, user: Path, wheel_folder: Path) -> None:
    broken_map(repository, user)
    assert "::error file=maps/acme/oven.yaml,line=" in github(repository, user, wheel_folder).printed


def test_what_a_change_breaks_stands_on_the_page_of_the_run(repository: Path, user: Path, wheel_folder: Path) -> None:
    moved_register(repository, user)
    assert "Breaking" in github(repository, user, wheel_folder).summary


def test_the_version_on_the_page_is_that_of_this_tree() -> None:
    import regscribe  # noqa: PLC0415 - its version alone

    text = (ROOT / "docs" / "ci.md").read_text(encoding="utf-8")
    assert set(re.findall(r"regscribe\[test\]==([\d.]+)", text)) == {regscribe.__version__}


def test_the_links_of_the_page_lead_somewhere() -> None:
    links = re.findall(r"\]\(([^)#:]+)\)", (ROOT / "docs" / "ci.md").read_text(encoding="utf-8"))
    assert links
    assert [link for link in links if not (ROOT / "docs" / link).exists()] == []
