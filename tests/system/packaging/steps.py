"""Carries out the steps of a page or an action as a CI service would: scripts for bash, until one fails."""

import os
import re
import subprocess
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, NamedTuple

from .distributions import environment

BLOCK = re.compile(r"^```\S+ ([^\n]+)\n(.*?)^```$", re.DOTALL | re.MULTILINE)
EXPRESSION = re.compile(r"\$\{\{ (.*?) \}\}")
BASH = ("bash", "--noprofile", "--norc", "-eo", "pipefail")
"""How GitHub calls bash for a step with `shell: bash`; without it is `bash -e`, which forgives more."""


class Ran(NamedTuple):
    """What came of steps: the name of the first that failed or "", all that was printed, the summary, the outputs."""

    failed: str
    printed: str
    summary: str
    outputs: str


class Service(NamedTuple):
    """A CI service in a repository; `programs` go before others on PATH, `values` are those of expressions."""

    folder: Path
    programs: Path
    variables: Mapping[str, str] = {}
    values: Mapping[str, str] = {}

    def run(self, steps: Iterable[Mapping[str, Any]]) -> Ran:
        """Run the steps that have a script; their conditions are keys of `values`, where "" is false."""
        files = {name: self.folder.parent / f"{self.folder.name}.{name}" for name in ("summary", "output")}
        for file in files.values():
            file.write_text("", encoding="utf-8")
        failed, printed = "", ""
        for step in steps:
            if "run" in step and not failed and self._wanted(step):
                done = self._run(step, files)
                printed += done.stdout
                failed = str(step.get("name", step["run"])) if done.returncode else ""
        summary, outputs = (files[name].read_text(encoding="utf-8") for name in ("summary", "output"))
        return Ran(failed, printed, summary, outputs)

    def _wanted(self, step: Mapping[str, Any]) -> bool:
        return "if" not in step or bool(self.values[step["if"]])

    def _run(self, step: Mapping[str, Any], files: Mapping[str, Path]) -> subprocess.CompletedProcess[str]:
        own = {
            name: EXPRESSION.sub(lambda one: self.values[one[1]], str(text))
            for name, text in step.get("env", {}).items()
        }
        assert "${{" not in step["run"], "what others may choose must not be written into a script"
        script = self.folder.parent / "step.sh"
        script.write_text(step["run"], encoding="utf-8")
        places = {"GITHUB_STEP_SUMMARY": files["summary"], "GITHUB_OUTPUT": files["output"]}
        path = f"{self.programs}{os.pathsep}{os.environ['PATH']}"
        variables = {**{name: str(place) for name, place in places.items()}, "PATH": path, **self.variables, **own}
        return subprocess.run(  # noqa: S603 - scripts of our own pages
            [*BASH, str(script)],
            cwd=self.folder,
            env=environment(**variables),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=300,
            check=False,
        )


def blocks(page: str) -> dict[str, str]:
    """The texts of fenced blocks by the place that stands behind their language."""
    return dict(BLOCK.findall(page))
