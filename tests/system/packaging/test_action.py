"""The GitHub action: its script as the runner calls it, on right and on wrong repositories, with strange inputs."""

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import yaml

from .distributions import ROOT, run
from .repositories import DRIVER, OVEN, PAGE, change, git, moved_register
from .steps import Ran, Service

pytestmark = pytest.mark.slow

ACTION = yaml.safe_load((ROOT / "action.yml").read_text(encoding="utf-8"))
Act = Callable[..., Ran]


@pytest.fixture
def act(user: Path, published: Path, tmp_path: Path) -> Act:
    """Run a script of the action in a folder, with inputs (the others as by default), where regscribe is installed."""

    def ran(folder: Path, step: str = "ask", **inputs: str) -> Ran:
        named = {name.replace("_", "-"): value for name, value in inputs.items()}
        assert named.keys() <= ACTION["inputs"].keys()
        values = {name: one["default"] for name, one in ACTION["inputs"].items()} | named
        variables = {"GITHUB_ACTION_PATH": str(published), "RUNNER_TEMP": str(tmp_path)}
        steps = [one for one in ACTION["runs"]["steps"] if f'action.sh" {step}' in one.get("run", "")]
        assert len(steps) == 1
        known = {f"inputs.{name}": value for name, value in values.items()}
        known["steps.python.outputs.python-path"] = str(user / "python")
        return Service(folder, user, variables, known).run(steps)

    return ran


def test_the_action_and_the_workflows_of_the_page_keep_to_their_schemas(tools: Path, tmp_path: Path) -> None:
    kinds = {"github-workflows": ".github/workflows/maps.yaml", "gitlab-ci": ".gitlab-ci.yml"}
    files = {kind: tmp_path / f"{kind}.yaml" for kind in kinds}
    for kind, name in kinds.items():
        files[kind].write_text(PAGE[name], encoding="utf-8")
    files["github-actions"] = ROOT / "action.yml"
    for kind, file in files.items():
        run(tools / "check-jsonschema", "--builtin-schema", f"vendor.{kind}", file, cwd=tmp_path)


def test_the_page_names_the_inputs_of_the_action() -> None:
    text = (ROOT / "docs" / "ci.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| `([a-z-]+)` \| (?:`(.*?)`|(.*?)) \|", text, re.MULTILINE)
    assert [name for name, _, __ in rows] == list(ACTION["inputs"])
    stated = {name: default for name, default, _ in rows if default}
    assert stated.items() <= {name: one["default"] for name, one in ACTION["inputs"].items()}.items()
    steps = yaml.safe_load(PAGE[".github/workflows/maps-by-action.yaml"])["jobs"]["maps"]["steps"]
    assert steps[-1]["with"].keys() <= ACTION["inputs"].keys()


def test_a_repository_that_is_right_passes(act: Act, repository: Path) -> None:
    ran = act(repository, strict="true", breaking_against="git:origin/main", sarif_file="out/found.sarif")
    assert ran.failed == "", ran.printed
    assert ran.outputs == "sarif-file=out/found.sarif\n"
    assert json.loads((repository / "out/found.sarif").read_text(encoding="utf-8"))["runs"][0]["results"] == []
    assert ran.summary == "## No change of the maps\n"


def test_without_sarif_file_none_is_written_and_nothing_is_handed_on(act: Act, repository: Path) -> None:
    ran = act(repository)
    assert (ran.failed, ran.outputs, ran.summary) == ("", "", "")
    assert "breaking" not in ran.printed


def test_a_broken_map_is_told_beside_its_line_and_in_sarif_and_fails_at_the_end(act: Act, repository: Path) -> None:
    change(repository, OVEN, "sentinels:", "sentinel:")
    ran = act(repository, sarif_file="found.sarif")
    assert ran.failed == "Check the maps"
    assert "::error file=maps/acme/oven.yaml,line=" in ran.printed
    assert ran.outputs == "sarif-file=found.sarif\n"
    (result, *_) = json.loads((repository / "found.sarif").read_text(encoding="utf-8"))["runs"][0]["results"]
    place: Any = result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"]
    assert place == "maps/acme/oven.yaml"
    assert "failed: check (exit code 1),generate --check (exit code 1)" in ran.printed


def test_what_differs_from_its_map_fails_unless_nobody_asks(act: Act, repository: Path) -> None:
    change(repository, DRIVER, '"sensor break"', '"sensor broken"')
    assert "failed: generate --check (exit code 1)" in act(repository).printed
    assert act(repository, check_generated="false").failed == ""


def test_a_breaking_change_fails_and_stands_in_the_summary(act: Act, repository: Path, user: Path) -> None:
    moved_register(repository, user)
    ran = act(repository, breaking_against="git:origin/main")
    assert "failed: breaking (exit code 1)" in ran.printed
    assert "address input 0 → input 89" in ran.summary


def test_findings_in_a_folder_of_the_repository_have_the_paths_of_the_repository(act: Act, repository: Path) -> None:
    git(repository, "init", "-q", "whole")
    (repository / "maps").rename(repository / "whole" / "maps")
    (repository / "generated").rename(repository / "whole" / "generated")
    assert act(repository, working_directory="whole").failed == ""
    change(repository / "whole", OVEN, "sentinels:", "sentinel:")
    for paths in ("", "maps/acme\n"):
        ran = act(repository, working_directory="whole/", paths=paths)
        assert "::error file=whole/maps/acme/oven.yaml,line=" in ran.printed


def test_paths_may_begin_with_a_hyphen_and_hold_blanks_and_quotes(act: Act, repository: Path) -> None:
    for folder in ("-x", "a b", "it's", "$(touch owned)"):
        place = repository / folder / "acme"
        place.mkdir(parents=True)
        (place / "oven.yaml").write_bytes((repository / OVEN).read_bytes())
        ran = act(repository, paths=f"{folder}\n", check_generated="false", sarif_file=f"{folder}/found.sarif")
        assert ran.failed == "", ran.printed
        assert (repository / folder / "found.sarif").is_file()
    assert not (repository / "owned").exists()


@pytest.mark.parametrize(
    ("inputs", "said"),
    [
        ({"strict": "yes"}, "strict: write true or false"),
        ({"check_generated": ""}, "check-generated: write true or false"),
        ({"working_directory": "none"}, "working-directory: there is no such folder"),
        ({"sarif_file": "a\nb=c"}, "sarif-file: write a path of one line"),
        ({"paths": "none"}, "there is no map `none`"),
        ({"breaking_against": "--help"}, "failed: breaking (exit code 2)"),
        ({"breaking_against": "git:$(touch owned)"}, "failed: breaking (exit code 2)"),
    ],
)
def test_wrong_inputs_are_refused_by_name(act: Act, repository: Path, inputs: dict[str, str], said: str) -> None:
    ran = act(repository, **inputs)
    assert ran.failed
    assert said in ran.printed
    assert ran.outputs == ""
    assert not (repository / "owned").exists()


@pytest.mark.parametrize("version", ["--help", "0.1.0 ; x", "$(touch owned)", "0.1.0\n--index-url=x", "@ file:///x"])
def test_what_is_no_version_is_not_handed_to_pip(act: Act, repository: Path, version: str) -> None:
    ran = act(repository, "install", version=version)
    assert ran.failed
    assert "version: write a version of regscribe as 0.1.0" in ran.printed


def test_what_a_map_says_is_no_command_of_the_runner(act: Act, repository: Path) -> None:
    change(repository, DRIVER, '"sensor break"', '"sensor break"\n::error::owned\n')
    printed = act(repository).printed
    stopped = re.search(r"^::stop-commands::([0-9a-f]{32})$", printed, re.MULTILINE)
    assert stopped is not None
    assert stopped.end() < printed.index("::error::owned") < printed.index(f"\n::{stopped[1]}::\n")


def test_the_action_installs_the_regscribe_that_it_came_with(act: Act, repository: Path, tmp_path: Path) -> None:
    ran = act(repository, "install")
    assert ran.failed == "", ran.printed
    assert run(tmp_path / "regscribe/bin/regscribe", "--version", cwd=tmp_path).startswith("regscribe 0.")
