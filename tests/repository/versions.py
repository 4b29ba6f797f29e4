"""Runs the tests of the runtime and of the drivers with every Python and the oldest and the newest pymodbus we allow.

Each pair has an environment below .cache/versions, kept until `make clean`. An interpreter is taken from PATH (as
python3.12), else from pyenv; none is downloaded, and those that are not here are named in the table.
"""

import os
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).parents[2]
CACHE = ROOT / ".cache" / "versions"
PYTHONS = ("3.11", "3.12", "3.13", "3.14")
TESTS = ("tests/runtime", "generated/tests")
OURS = ("generator/runtime", "generated", ".")
TOOLS = ("hypothesis", "pytest", "pytest-xdist")
TRUE_VERSION = "import sys, venv, ensurepip; print('%d.%d' % sys.version_info[:2])"


def pymodbus() -> tuple[str, str]:
    """Return the oldest version that the runtime allows, and the newest: the one that requirements.lock pins."""
    project = tomllib.loads((ROOT / "generator" / "runtime" / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    (allowed,) = (one for one in project["dependencies"] if one.startswith("pymodbus"))
    lock = (ROOT / "requirements.lock").read_text(encoding="utf-8")
    (oldest,), (newest,) = re.findall(r">=([\d.]+)", allowed), re.findall(r"(?m)^pymodbus==(\S+)", lock)
    return oldest, newest


def interpreter(python: str) -> str | None:
    """Return a program that is this Python and can make environments; a shim of pyenv may be neither."""
    kept = Path(os.environ.get("PYENV_ROOT", Path.home() / ".pyenv")) / "versions"
    places = [shutil.which(f"python{python}"), *sorted(kept.glob(f"{python}.*/bin/python"), reverse=True)]
    for place in (str(one) for one in places if one):
        said = subprocess.run([place, "-c", TRUE_VERSION], capture_output=True, text=True, check=False)  # noqa: S603 (found above)
        if said.stdout.strip() == python:
            return place
    return None


def run(*command: str | Path) -> bool:
    """Run a program in the repository, with our modules as they are installed; whether it succeeded."""
    clean = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    return subprocess.run(command, cwd=ROOT, env=clean, check=False).returncode == 0  # noqa: S603 (commands of this file)


def installed(program: str, folder: Path, version: str) -> bool:
    """Make an environment with this pymodbus; pip refuses one that the runtime does not allow."""
    lock = (ROOT / "requirements.lock").read_text(encoding="utf-8")
    pins = CACHE / "pins.txt"
    pins.write_text(re.sub(r"(?m)^pymodbus==.*\n", "", lock), encoding="utf-8")
    ours = (part for folder in OURS for part in ("--editable", folder))
    wanted = ("--constraint", pins, *ours, f"pymodbus=={version}", *TOOLS)
    pip = (folder / "bin" / "python", "-m", "pip", "install", "--quiet", "--disable-pip-version-check")
    return (folder.is_dir() or run(program, "-m", "venv", folder)) and run(*pip, *wanted)


def judged(python: str, version: str) -> str:
    """Return what became of the tests with one Python and one pymodbus."""
    program = interpreter(python)
    if program is None:
        return "left out: no such interpreter here"
    folder = CACHE / f"{python}-{version}"
    if not installed(program, folder, version):
        return "not installed"
    pytest = (folder / "bin" / "python", "-m", "pytest", "-q", "-n", "2", "-p", "no:cacheprovider")
    chosen = ("-m", "not slow", "-k", "not mypy and not pyright")  # what is seen of types does not depend on pymodbus
    return "passed" if run(*pytest, *chosen, *TESTS) else "failed"


def main() -> int:
    """Print a row for each pair; 1 if the tests of one failed or none could be run."""
    CACHE.mkdir(parents=True, exist_ok=True)
    results = {(python, version): judged(python, version) for python in PYTHONS for version in pymodbus()}
    print(f"\n{'Python':8}{'pymodbus':10}result")  # noqa: T201 (a command)
    for (python, version), result in results.items():
        print(f"{python:8}{version:10}{result}")  # noqa: T201 (a command)
    bad = {"failed", "not installed"} & {*results.values()}
    return int(bool(bad) or "passed" not in results.values())


if __name__ == "__main__":
    sys.exit(main())
