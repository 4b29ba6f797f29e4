"""The pictures of the README: a terminal, the register browser, a page of the site, with what is printed and made now.

`make pictures` writes them into docs/pictures/. No test compares them: each release of a browser draws differently.
"""

import io
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from playwright.sync_api import Browser, sync_playwright
from rich.console import Console
from rich.terminal_theme import MONOKAI
from rich.text import Text

from regscribe.model import RegisterMap
from regscribe.pipeline import compile_map
from regscribe.register_browser import page
from regscribe.simulate import simulate

from .conftest import CHROMIUM, OPTIONS
from .served import served

ROOT = Path(__file__).parents[3]
PICTURES = ROOT / "docs" / "pictures"
COLUMNS = 104
DEVICE = "10.0.0.7:502"
"""How the picture calls the simulated device."""

OVEN = """\
format: 1
map: {id: acme/oven, title: Oven, maker: Acme, class_prefix: Acme}
manual: {title: Oven manual, number: A-1}
models: {O1: {}}
enums:
  mode: {0: idle, 1: heating}
groups:
  - id: control
    name: Control
    source: "3.2"
    registers:
      - {at: 10, name: Mode, enum: mood, access: rw}
"""
"""A map with a mistake to be told."""


def terminal() -> str:
    """The picture of a terminal in which three commands were typed, as SVG that asks no foreign host."""
    with tempfile.TemporaryDirectory() as folder, simulate(_series_c(), "16C") as oven:
        (Path(folder) / "oven.yaml").write_text(OVEN, encoding="utf-8")
        there = f"{oven.host}:{oven.port}"
        lines = [
            "regscribe check oven.yaml",
            f"regscribe read tcp:{DEVICE}?model=16C 0xFD1 setpoint_ram setpoints",
            "regscribe decode 16C 01 03 0F D1 00 01 D7 27",
        ]
        said = [f"\x1b[1;32m$\x1b[0m {line}\n{_printed(line.replace(DEVICE, there), folder)}" for line in lines]
    recorder = Console(record=True, width=COLUMNS, file=io.StringIO(), force_terminal=True)
    recorder.print(Text.from_ansi("\n".join(said).replace(there, DEVICE)))
    drawn = recorder.export_svg(title="regscribe", theme=MONOKAI)
    return re.sub(r"@font-face \{.*?\}", "", drawn, flags=re.DOTALL)


def _series_c() -> RegisterMap:
    compiled = compile_map(ROOT / "maps" / "athena" / "series-c.yaml").map
    assert compiled is not None
    return compiled


def _printed(line: str, folder: str) -> str:
    program = [str(Path(sys.executable).parent / "regscribe"), "--color", "always", *line.split()[1:]]
    done = subprocess.run(  # noqa: S603 - our own program
        program, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False
    )
    return done.stdout


def register_browser(browser: Browser) -> bytes:
    """The register browser of Series C, open at the setpoint in RAM."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "registers.html"
        file.write_text(page([_series_c()]), encoding="utf-8")
        return _photographed(browser, f"{file.as_uri()}#register-setpoint_ram")


def site(browser: Browser) -> bytes:
    """The page of Series C on the site, at one of its registers."""
    with tempfile.TemporaryDirectory() as folder:
        program = [str(Path(sys.executable).parent / "regscribe"), "site", "athena/series-c", "--out", folder]
        subprocess.run(program, cwd=ROOT, check=True)  # noqa: S603 - our own program
        with served(Path(folder)) as address:
            return _photographed(browser, f"{address}athena/series-c/#register-input_type")


def _photographed(browser: Browser, address: str) -> bytes:
    shown = browser.new_page(viewport={"width": 1280, "height": 800})
    shown.goto(address)
    shown.wait_for_timeout(500)  # until it has moved to the place after `#`
    return shown.screenshot()


def main() -> None:
    """Write all pictures anew."""
    PICTURES.mkdir(exist_ok=True)
    (PICTURES / "terminal.svg").write_text(terminal(), encoding="utf-8")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=list(OPTIONS))
        (PICTURES / "register-browser.png").write_bytes(register_browser(browser))
        (PICTURES / "site.png").write_bytes(site(browser))


if __name__ == "__main__":
    main()
