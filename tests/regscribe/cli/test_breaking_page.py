"""docs/breaking.md: its sessions and its table of rules are as it says. Run this file to write them anew."""

import contextlib
import io
import os
import re
import shlex
import tempfile
from pathlib import Path

import pytest

from regscribe.breaking import RULES
from regscribe.breaking.change import Effect, Effects
from regscribe.breaking.examples import EDITS
from regscribe.breaking.report import WORDS
from regscribe.breaking.rules import MAP_ADDED, MAP_REMOVED
from regscribe.cli.app import run
from regscribe.model import Rule

PAGE = Path(__file__).parents[3] / "docs" / "breaking.md"
WHOLE = {
    MAP_ADDED: Effects(Effect.COMPATIBLE, Effect.COMPATIBLE),
    MAP_REMOVED: Effects(Effect.BREAKING, Effect.BREAKING),
}
BLOCK = re.compile(r"^```(\w+)([^\n]*)\n(.*?)^```$", re.DOTALL | re.MULTILINE)


TABLE = re.compile(
    r"(?<=^\| Rule \| Change \| On the wire \| For programs \|\n\|---\|---\|---\|---\|\n)(?:\|.*\n)*", re.MULTILINE
)


def played(page: str) -> str:
    """The page with what its commands print now, in the working directory, and the table of rules."""
    rows = "".join(f"| {rule.id} | {rule.title} | {' | '.join(_effects(rule))} |\n" for rule in RULES)
    return TABLE.sub(rows, BLOCK.sub(_block, page))


def _effects(rule: Rule) -> tuple[str, str]:
    """The effects of the example of a rule in words; of whole maps those that they always have."""
    effects = EDITS[rule].effects if rule in EDITS else WHOLE[rule]
    return tuple("\N{EN DASH}" if effect is Effect.NONE else WORDS[effect] for effect in effects)  # type: ignore[return-value]  # two of two


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
