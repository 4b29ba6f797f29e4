"""The tutorial and the page on imports are true: their blocks are carried out, and what they show is what comes out."""

import os
import re
import shlex
import socket
import subprocess
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import groupby
from pathlib import Path
from typing import NamedTuple

import pytest

from regscribe.cli.app import run

ROOT = Path(__file__).parents[2]
PAGES = {name: (ROOT / "docs" / f"{name}.md").read_text(encoding="utf-8") for name in ("tutorial", "import")}
END = re.compile(r"^>>> \w+\.close\(\)$", re.MULTILINE)
BLOCK = re.compile(r"^```([^\n]+)\n(.*?)^```$", re.DOTALL | re.MULTILINE)
PORT = "5020"
WRONG = (AssertionError, OSError, ValueError, subprocess.SubprocessError)
COMMAND = "from regscribe.cli import main; main()"
DOCTEST = """
import doctest, sys
test = doctest.DocTestParser().get_doctest(sys.stdin.read(), {}, "tutorial", "tutorial.md", 0)
sys.exit(doctest.DocTestRunner(optionflags=doctest.ELLIPSIS | doctest.FAIL_FAST).run(test).failed)
"""


class Block(NamedTuple):
    """A fenced block: the first word behind the fence, what follows it, and the lines."""

    language: str
    where: str
    text: str


def blocks(page: str) -> list[Block]:
    return [Block(*info.partition(" ")[::2], text) for info, text in BLOCK.findall(page)]


@dataclass
class Player:
    """Carries out blocks in a folder; the simulator runs until `stop`."""

    folder: Path
    capture: Callable[[], str]
    port: str = ""
    simulator: subprocess.Popen[str] | None = None
    python: list[str] = field(default_factory=list)

    def play(self, played: Iterable[Block]) -> None:
        """Carry out blocks; AssertionError if the page shows something else than what comes."""
        for block in played:
            self._play(block)

    def _play(self, block: Block) -> None:
        match block:
            case Block("yaml", where, text):
                path = self.folder / where.removesuffix(", at its end")
                kept = path.read_text(encoding="utf-8") if where.endswith(", at its end") else ""
                path.write_text(kept + text, encoding="utf-8")
            case Block("diff", where, text):
                self._mend(self.folder / where, text)
            case Block("console", "", text):
                self._session(text)
            case Block("console", _, text):
                self._serve(text)
            case Block("pycon", "", text):
                self._python(text)
            case Block("python", "", text):
                subprocess.run([sys.executable, "-c", text], cwd=self.folder, check=True)  # noqa: S603 - as below
            case _:
                pytest.fail(f"nobody knows how to carry out {block}")

    def stop(self) -> None:
        if self.simulator is not None:
            self.simulator.kill()
            self.simulator.communicate()

    def _mend(self, path: Path, diff: str) -> None:
        text = path.read_text(encoding="utf-8")
        for old, new in _pairs(diff):
            assert text.count(old) == 1, f"`{old}` stands {text.count(old)} times in {path.name}"
            text = text.replace(old, new)
        path.write_text(text, encoding="utf-8")

    def _session(self, text: str) -> None:
        command, shown = text.removeprefix("$ ").split("\n", 1)
        name, *arguments = shlex.split(command)
        if name == "regscribe":
            self.capture()
            run(arguments)
            printed = self.capture()
        else:
            done = subprocess.run([name, *arguments], cwd=self.folder, capture_output=True, text=True, check=True)  # noqa: S603 - the page is ours
            printed = done.stdout
        pattern = ".*".join(map(re.escape, shown.split("…")))
        assert re.fullmatch(pattern, printed, re.DOTALL), f"{command}\n{printed}"

    def _serve(self, text: str) -> None:
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.port = str(free.getsockname()[1])
        command, shown = text.replace(PORT, self.port).removeprefix("$ regscribe ").split("\n", 1)
        arguments = [sys.executable, "-c", COMMAND, *shlex.split(command)]
        self.simulator = subprocess.Popen(arguments, cwd=self.folder, stdout=subprocess.PIPE, text=True)  # noqa: S603 - as above
        assert self.simulator.stdout is not None
        assert self.simulator.stdout.readline() == shown

    def _python(self, text: str) -> None:
        # all that was typed so far, in a process of its own: the module that is imported is the one just generated
        self.python.append(text.replace(PORT, self.port))
        if not END.search(text):
            return
        done = subprocess.run(  # noqa: S603 - as above
            [sys.executable, "-c", DOCTEST],
            input="\n".join(self.python),
            cwd=self.folder,
            env={
                **os.environ,
                "PYTHONPATH": os.pathsep.join(["build", *filter(None, sys.path)]),
                "PYTHONIOENCODING": "utf-8",
            },
            capture_output=True,
            text=True,
            timeout=60,
            check=False,
        )
        assert done.returncode == 0, done.stdout + done.stderr


def _pairs(diff: str) -> Iterator[tuple[str, str]]:
    """The lines that go and those that come in their place, hunk by hunk."""
    runs = [
        "".join(f"{line[1:]}\n" for line in lines) for _, lines in groupby(diff.splitlines(), key=lambda line: line[0])
    ]
    return zip(runs[::2], runs[1::2], strict=True)


@contextmanager
def player(folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Iterator[Player]:
    monkeypatch.chdir(folder)
    monkeypatch.setenv("XDG_CACHE_HOME", str(folder / ".cache"))

    def capture() -> str:
        captured = capsys.readouterr()
        return captured.out + captured.err

    found = Player(folder, capture)
    try:
        yield found
    finally:
        found.stop()


@pytest.mark.parametrize("page", PAGES)
def test_every_block_of_a_page_can_be_carried_out_and_shows_what_comes(
    page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    found = blocks(PAGES[page])
    with player(tmp_path, monkeypatch, capsys) as play:
        play.play(found)
    assert len(found) == len(re.findall(r"^```\S", PAGES[page], re.MULTILINE))
    assert {block.language for block in found} >= {"diff", "console", "pycon"}


@pytest.mark.parametrize(
    ("page", "number"),
    [(page, number) for page, text in PAGES.items() for number in range(len(blocks(text)))],
)
def test_a_block_that_is_changed_is_noticed(
    page: str, number: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    played = blocks(PAGES[page])
    changed = played[number]._replace(text=_changed(played[number]))
    with player(tmp_path, monkeypatch, capsys) as play, pytest.raises(WRONG):
        play.play([*played[:number], changed, *played[number + 1 :]])


def _changed(block: Block) -> str:
    """The block with another figure in the line that holds the most of them."""
    line = max(block.text.splitlines(), key=lambda one: len(re.findall(r"\d", one)))
    return block.text.replace(line, re.sub(r"\d", lambda digit: str((int(digit[0]) + 1) % 10), line), 1)


@pytest.mark.parametrize("page", PAGES)
def test_the_links_of_a_page_lead_somewhere(page: str) -> None:
    links = re.findall(r"\]\(([^)#:]+)\)", PAGES[page])
    assert [link for link in links if not (ROOT / "docs" / link).exists()] == []
    assert links
