"""docs/breaking.md: its maps and sessions are what it says. To write what the commands print now, run this file."""

import contextlib
import io
import os
import re
import shlex
import tempfile
from pathlib import Path

import pytest

from regscribe.cli.app import run

PAGE = Path(__file__).parents[3] / "docs" / "breaking.md"
BLOCK = re.compile(r"^```(\w+)([^\n]*)\n(.*?)^```$", re.DOTALL | re.MULTILINE)


def played(page: str) -> str:
    """The page with what its commands print now, in the working directory."""
    return BLOCK.sub(_block, page)


def _block(found: re.Match[str]) -> str:
    language, where, text = found.groups()
    if language == "yaml":
        path = Path(where.strip())
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    if language != "console":
        return found[0]
    commands = [line for line in text.splitlines() if line.startswith("$ ")]
    return f"```console\n{''.join(map(_session, commands))}```"


def _session(line: str) -> str:
    out = io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
        code = run(shlex.split(line.removeprefix("$ regscribe ")))
    ended = f"(exit code {code})\n" if code else ""
    return f"{line}\n{out.getvalue()}{ended}"


def test_the_sessions_of_the_page_print_what_it_shows(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    page = PAGE.read_text(encoding="utf-8")
    assert played(page) == page


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        PAGE.write_text(played(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
