"""The sessions of docs/cli.md and other pages: carried out against simulated devices, in this process.

`make sessions` writes into the pages what their commands print now; a test holds the pages to it. What differs from run
to run stands in the pages as it stands here: ports, times, the path of a serial line.
"""

import contextlib
import io
import itertools
import os
import re
import shlex
import tempfile
from collections.abc import Callable, Iterator
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any
from unittest import mock

from regscribe.cli.app import run
from regscribe.cli.commands import watch as watching
from regscribe.pipeline import compile_map
from regscribe.simulate import Running, simulate
from regscribe.tools.live.watch import Round, watch

ROOT = Path(__file__).parents[4]
PAGES = (ROOT / "README.md", *(ROOT / "docs" / name for name in ("cli.md", "settings.md", "programs.md")))
BLOCK = re.compile(r"^```(\w+)([^\n]*)\n(.*?)^```$", re.DOTALL | re.MULTILINE)
START = datetime(2026, 11, 22, 10, 0, 0, tzinfo=UTC)
TIME = re.compile(r"20\d\d-\d\d-\d\dT\d\d:\d\d:\d\d(?:\.\d\d\d)?Z")
CLOCK = re.compile(r"^\d\d:\d\d:\d\d\.\d\d\d(?= (?:->|<-))", re.MULTILINE)
OVEN, SPARE, LINE = "10.0.0.7:502", "10.0.0.8:502", "/dev/ttyUSB0"
"""How the pages call two 16C over TCP, and a line with an M5000 as unit 3."""

RISE = (77, 84.5, 97, 109.5, 121, 131.5, 140, 145.5, 149, 150.5, 150, 149.5)
"""What the process value of the oven is in one round of `watch` after the other."""


class Player:
    """Carries out the blocks of a page; `wire` replaces what the page calls a device by where it is simulated."""

    def __init__(self, oven: Running, spare: Running, line: Running) -> None:
        self.oven = oven
        self.wire = {OVEN: f"{oven.host}:{oven.port}", SPARE: f"{spare.host}:{spare.port}", LINE: line.path}

    def played(self, page: str) -> str:
        """The page with what its commands print now."""
        return BLOCK.sub(self._block, page)

    def _block(self, found: re.Match[str]) -> str:
        language, where, text = found.groups()
        if language == "yaml" and where:
            Path(where.strip()).write_text(self._there(text), encoding="utf-8")
        if language != "console":
            return found[0]
        commands = [line for line in text.splitlines() if line.startswith("$ ")]
        return f"```console{where}\n{''.join(map(self._session, commands))}```"

    def _session(self, line: str) -> str:
        name, *arguments = shlex.split(self._there(line.removeprefix("$ ")))
        if name == "cat":
            return f"{line}\n{self._here(Path(arguments[0]).read_text(encoding='utf-8'))}"
        if name == "head":
            lines = Path(arguments[2]).read_text(encoding="utf-8").splitlines(keepends=True)[: int(arguments[1])]
            return f"{line}\n{self._here(''.join(lines))}"
        out = io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
            code = run(arguments)
        ended = f"(exit code {code})\n" if code else ""
        return f"{line}\n{self._here(out.getvalue())}{ended}"

    def _there(self, text: str) -> str:
        for shown, real in self.wire.items():
            text = text.replace(shown, real)
        if any(name.split(":", maxsplit=1)[0] in text for name in (OVEN, SPARE)) or LINE in text:
            message = f"this is simulated nowhere: {text}"
            raise ValueError(message)
        return text

    def _here(self, text: str) -> str:
        for shown, real in self.wire.items():
            text = text.replace(real, shown)
        return CLOCK.sub("10:00:00.000", TIME.sub(lambda found: _kept(found[0]), text))

    def watch(self, *arguments: Any, every: float, **more: Any) -> Iterator[Round]:
        """In place of `watch`: the process value rises, and every round is `every` seconds after the last."""
        values = itertools.cycle(RISE)
        self.oven.device.poke("process_value", next(values))
        rounds = watch(
            *arguments, every=every, sleep=lambda _: self.oven.device.poke("process_value", next(values)), **more
        )
        for number, one in enumerate(rounds):
            yield one._replace(time=START + timedelta(seconds=number * every), late=False)


def _kept(moment: str) -> str:
    """Times of watching are made here; others are those of this run."""
    made = datetime.fromisoformat(moment) - START
    if timedelta() <= made < timedelta(hours=1):
        return moment
    return START.isoformat().replace("+00:00", ".000Z" if "." in moment else "Z")


@contextlib.contextmanager
def player(compiled: Callable[[str], Any]) -> Iterator[Player]:
    """A player with its devices, in the working directory."""
    with (
        simulate(compiled("athena/series-c"), "16C") as oven,
        simulate(compiled("athena/series-c"), "16C") as spare,
        simulate(compiled("athena/platinum-m5000"), "M5000", unit=3, transport="pty") as line,
    ):
        found = Player(oven, spare, line)
        with mock.patch.object(watching, "watch", found.watch):
            yield found


def _compiled(name: str) -> Any:
    return compile_map(ROOT / "maps" / f"{name}.yaml").map


def main() -> None:
    """Write each page anew; every page has devices and a folder of its own."""
    for path in PAGES:
        page = path.read_text(encoding="utf-8")
        with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
            os.environ["XDG_CONFIG_HOME"] = folder
            with player(_compiled) as found:
                path.write_text(found.played(page), encoding="utf-8")


if __name__ == "__main__":
    main()
