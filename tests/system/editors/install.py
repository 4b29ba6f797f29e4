"""Installs what `make test-editors` needs where it is missing: packages of npm, below `.cache`.

The extension for Visual Studio Code is built in a copy of its folder, with the versions of its lock file. Node and npm
come from the system (Debian packages, as root with apt-get; else it says what to install and fails).

    python tests/system/editors/install.py
"""

import shutil
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "interop"))  # its installer is a program of its own, in no package

from install import NODE, Consumer, install

ROOT = Path(__file__).parents[3]
SOURCE, BUILT = ROOT / "editors" / "vscode", ROOT / ".cache" / "editors" / "vscode"
STEPS = (("ci", "--silent"), ("run", "-s", "check"), ("run", "-s", "build"), ("run", "-s", "package"))
"""What npm does in the copy: install, check the types, bundle, pack."""


def build() -> None:
    """Copy the extension and build it there; packages that are there already are kept if the lock is the same."""
    lock = BUILT / "package-lock.json"
    known = lock.is_file() and lock.read_bytes() == (SOURCE / lock.name).read_bytes()
    shutil.copytree(SOURCE, BUILT, dirs_exist_ok=True, ignore=shutil.ignore_patterns("node_modules", "dist"))
    for step in STEPS[known and (BUILT / "node_modules" / ".package-lock.json").is_file() :]:
        subprocess.run(["npm", *step], cwd=BUILT, check=True, stdin=subprocess.DEVNULL)  # noqa: S603, S607 - npm of the system


if __name__ == "__main__":
    install((Consumer("node", programs=NODE), Consumer("yaml-language-server", npm=("yaml-language-server@2.0.0",))))
    build()
