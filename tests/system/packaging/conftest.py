"""The three wheels, and environments that they are installed in."""

import shutil
import sys
import sysconfig
import venv
from collections.abc import Callable
from pathlib import Path

import pytest

from .distributions import FOLDERS, ROOT, run
from .repositories import PAGE, WHO, git
from .steps import Service

LIBRARIES = {"pymodbus", "serial", "yaml", "_yaml", "jinja2", "markupsafe", "jsonschema", "jsonschema_specifications"}
LIBRARIES |= {"referencing", "rpds", "attr", "attrs", "click", "rich", "plotille", "pygments", "markdown_it", "mdurl"}
LIBRARIES |= {"typing_extensions.py", "openpyxl", "et_xmlfile", "defusedxml", "platformdirs"}

TOOLS = ("pre-commit", "check-jsonschema", "twine", "uv", "pipx")


@pytest.fixture(scope="session")
def wheel_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder with all three wheels, for `pip --find-links`."""
    out = tmp_path_factory.mktemp("wheels")
    for folder in FOLDERS.values():
        run(sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", out, cwd=ROOT / folder)
    return out


@pytest.fixture(scope="session")
def sources(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    """The source distributions."""
    out = tmp_path_factory.mktemp("sources")
    for folder in FOLDERS.values():
        run(sys.executable, "-m", "hatchling", "build", "-t", "sdist", "-d", out, cwd=ROOT / folder)
    return sorted(out.glob("*.tar.gz"))


@pytest.fixture(scope="session")
def wheels(wheel_folder: Path) -> dict[str, Path]:
    """The wheel of each distribution by its import package."""
    return {path.name.split("-")[0]: path for path in wheel_folder.glob("*.whl")}


@pytest.fixture(scope="session")
def environment(
    wheels: dict[str, Path], tmp_path_factory: pytest.TempPathFactory
) -> Callable[[set[str], set[str]], Path]:
    """Make an environment of some wheels and some libraries of this one; its bin folder."""

    def make(packages: set[str], libraries: set[str]) -> Path:
        folder = tmp_path_factory.mktemp("environment")
        venv.create(folder, with_pip=False, symlinks=True)
        (site,) = folder.glob("lib/python*/site-packages")
        for library in libraries:
            source = Path(sysconfig.get_path("purelib")) / library
            if source.exists():
                (site / library).symlink_to(source)
        chosen = [wheels[package] for package in sorted(packages)]
        pip = (sys.executable, "-m", "pip", "--python", folder / "bin/python", "install", "--no-deps")
        run(*pip, *chosen, cwd=folder)
        return folder / "bin"

    return make


@pytest.fixture(scope="session")
def installed(environment: Callable[[set[str], set[str]], Path]) -> Path:
    """All three, with the libraries that they ask for and with theirs."""
    return environment(set(FOLDERS), LIBRARIES)


@pytest.fixture(scope="session")
def user(wheel_folder: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The bin folder of an environment in which a user said `pip install 'regscribe[test]'`."""
    folder = tmp_path_factory.mktemp("user")
    venv.create(folder, with_pip=True, symlinks=True)
    run(folder / "bin/python", "-m", "pip", "install", "regscribe[test]", cwd=folder, PIP_FIND_LINKS=str(wheel_folder))
    return folder / "bin"


@pytest.fixture(scope="session")
def tools(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The bin folder of an environment with programs of others that read what we publish."""
    folder = tmp_path_factory.mktemp("tools")
    venv.create(folder, with_pip=True, symlinks=True)
    run(folder / "bin/python", "-m", "pip", "install", *TOOLS, cwd=folder)
    return folder / "bin"


@pytest.fixture(scope="session")
def published(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A repository with this tree as its only commit: what others would fetch."""
    folder = tmp_path_factory.mktemp("published")
    names = run("git", "ls-files", "--cached", "--others", "--exclude-standard", "-z", cwd=ROOT)
    for name in filter(None, names.split("\0")):
        if (ROOT / name).is_file():  # not one that was removed and not committed
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, folder / name)
    for command in (["init", "-q"], ["add", "."], ["commit", "-qm", "Publish"]):
        git(folder, *command)
    return folder


@pytest.fixture
def repository(user: Path, wheel_folder: Path, tmp_path: Path) -> Path:
    """A repository made by the lines of the page, and checked out as a service does: its main branch is origin's."""
    origin, folder = tmp_path / "origin", tmp_path / "repository"
    origin.mkdir()
    made = Service(origin, user, {**WHO, "PIP_FIND_LINKS": str(wheel_folder)}).run([{"run": PAGE["a new repository"]}])
    assert made.failed == "", made.printed
    git(tmp_path, "clone", "-q", str(origin), str(folder))
    return folder
