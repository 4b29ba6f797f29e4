"""Our three distributions, and commands that are run without what would let them see the source tree."""

import os
import subprocess
from pathlib import Path

ROOT = Path(__file__).parents[3]
FOLDERS = {"regscribe_runtime": "generator/runtime", "regscribe_devices": "generated", "regscribe": "."}
"""The import package of each distribution, and the folder of its pyproject file."""

FOREIGN = ("PYTHON", "PYTEST", "GITHUB", "PRE_COMMIT", "GIT_", "VIRTUAL_ENV", "CI")
"""How variables begin that programs take for the place they run at."""


def environment(**more: str) -> dict[str, str]:
    """The variables of this process, without what tells of the source tree, its tests or of a service."""
    return {key: value for key, value in os.environ.items() if not key.startswith(FOREIGN)} | more


def run(*command: str | Path, cwd: Path, **more: str) -> str:
    """Standard output of a command that must succeed; `more` are variables of the environment."""
    done = subprocess.run(  # noqa: S603 - our own commands
        list(map(str, command)),
        cwd=cwd,
        env=environment(**more),
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout
