"""What would be published: metadata, source distributions, and runners that install regscribe only to run it."""

import sys
import tarfile
import tomllib
import zipfile
from email import message_from_bytes
from email.message import Message
from pathlib import Path

import pytest

from .distributions import FOLDERS, ROOT, run

pytestmark = pytest.mark.slow


def read(wheel: Path, name: str) -> bytes:
    """A file of a wheel's dist-info."""
    with zipfile.ZipFile(wheel) as archive:
        (found,) = (one for one in archive.namelist() if one.endswith(f".dist-info/{name}"))
        return archive.read(found)


@pytest.fixture(params=FOLDERS)
def wheel(request: pytest.FixtureRequest, wheels: dict[str, Path]) -> Path:
    """Each of the three."""
    return wheels[request.param]


@pytest.fixture
def metadata(wheel: Path) -> Message:
    """What an index would show of it."""
    return message_from_bytes(read(wheel, "METADATA"))


def test_a_licence_is_stated_by_its_identifier_and_lies_in_each_distribution(metadata: Message, wheel: Path) -> None:
    assert metadata["License-Expression"] == "MIT"
    assert metadata["License-File"] == "LICENSE"
    assert read(wheel, "licenses/LICENSE") == (ROOT / "LICENSE").read_bytes()


def test_classifiers_name_every_python_that_is_tried(metadata: Message) -> None:
    versions = (ROOT / "tests/repository/versions.py").read_text(encoding="utf-8")
    (line,) = (one for one in versions.splitlines() if one.startswith("PYTHONS = "))
    tried = tomllib.loads(line.replace("(", "[").replace(")", "]"))["PYTHONS"]
    found = [one.rpartition(" :: ")[2] for one in metadata.get_all("Classifier", []) if "Python :: 3." in one]
    assert found == tried
    assert metadata["Requires-Python"] == f">={tried[0]}"


def test_a_description_renders_and_says_what_the_distribution_is(metadata: Message, wheel: Path, tools: Path) -> None:
    assert metadata["Description-Content-Type"] == "text/markdown"
    run(tools / "twine", "check", "--strict", wheel, cwd=ROOT)


def test_a_project_is_given_no_address_that_does_not_exist(metadata: Message) -> None:
    assert metadata.get_all("Project-URL") is None  # there is no public repository yet: add the addresses with it


def test_a_wheel_can_be_made_of_a_source_distribution_alone(
    sources: list[Path], wheels: dict[str, Path], tmp_path: Path
) -> None:
    for source in sources:
        with tarfile.open(source) as archive:
            archive.extractall(tmp_path, filter="data")
        folder = tmp_path / source.name.removesuffix(".tar.gz")
        run(sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", tmp_path, cwd=folder)
        (made,) = tmp_path.glob(f"{source.name.split('-')[0]}-*.whl")
        there = wheels[source.name.split("-")[0]]
        assert set(zipfile.ZipFile(made).namelist()) == set(zipfile.ZipFile(there).namelist())
    assert len(sources) == 3


def test_uvx_and_pipx_run_regscribe_from_its_wheels(
    wheels: dict[str, Path], wheel_folder: Path, tools: Path, tmp_path: Path
) -> None:
    places = {"UV_CACHE_DIR": "uv", "UV_TOOL_DIR": "uv-tools", "PIPX_HOME": "pipx", "PIPX_BIN_DIR": "pipx-bin"}
    variables = {name: str(tmp_path / folder) for name, folder in places.items()}
    variables |= {"PIP_FIND_LINKS": str(wheel_folder), "UV_FIND_LINKS": str(wheel_folder), "UV_PYTHON": sys.executable}
    wheel = wheels["regscribe"]
    for runner in ((tools / "uvx", "--from", wheel), (tools / "pipx", "run", "--spec", wheel)):
        said = run(*runner, "regscribe", "check", "fdc/series-100", cwd=tmp_path, **variables)
        assert said == "1 map checked: no findings\n"


def test_the_citation_is_valid_and_of_this_version(tools: Path, tmp_path: Path) -> None:
    text = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert f"\nversion: {project['version']}\n" in text
    assert f"\nlicense: {project['license']}\n" in text
    said = run(
        *(tools / "uvx", "--from", "cffconvert==2.0.0", "cffconvert", "--validate", "-i", ROOT / "CITATION.cff"),
        cwd=tmp_path,
        UV_CACHE_DIR=str(tmp_path / "uv"),
        UV_PYTHON=sys.executable,
    )
    assert "valid" in said
