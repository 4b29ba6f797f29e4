"""Zensical run over a staged folder; what it built is checked before it takes its place."""

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Mapping
from importlib.resources import files
from importlib.util import find_spec
from pathlib import Path

from regscribe.site.built import Fault, faults
from regscribe.site.staging import BROWSER

MARK = ".regscribe-site"
"""The file that tells a folder that was made here, and may be replaced, from any other."""

PATIENCE = 600
"""Seconds after which Zensical is given up."""

ASSETS = ("assets/regscribe.css", "assets/regscribe.js")
"""What comes with each site, and where it stands there and here."""

COLOURS = re.compile(r"\x1b\[[0-9;]*m")


class SiteError(Exception):
    """The site cannot be made: Zensical is missing or failed, or the place for the site is taken."""


class UnwrittenSiteError(SiteError):
    """The site cannot be put in its place: a full disk, a folder that is closed to the user."""


def usable(out: Path) -> None:
    """Raise SiteError unless a site can be put at `out`: it is free, empty or an earlier site."""
    if find_spec("zensical") is None:
        message = "a site needs Zensical: pip install 'regscribe[site]'"
        raise SiteError(message)
    if out.is_dir() and ((out / MARK).is_file() or not any(out.iterdir())):
        return
    if out.exists() or out.is_symlink():
        message = f"{out} is there already and is no site of regscribe: name another folder with -o, or remove it"
        raise SiteError(message)


def build(pages: Mapping[str, str], others: Mapping[str, bytes], config: str, work: Path) -> list[Fault]:
    """Build `work`/site of pages and other files; return what is wrong in it. Raises SiteError where Zensical fails."""
    contents = {path: text.encode(errors="replace") for path, text in pages.items()} | dict(others)
    contents |= {path: files("regscribe.site").joinpath(path).read_bytes() for path in ASSETS}
    for path, content in contents.items():
        target = work / "pages" / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(content)
    (work / "mkdocs.yml").write_text(config, encoding="utf-8")
    _zensical(work)
    (work / "site" / MARK).touch()
    return [_at_its_page(fault, pages) for fault in faults(work / "site", skipped={BROWSER})]


def _zensical(work: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "zensical", "build", "--clean", "--config-file", "mkdocs.yml"],
        cwd=work,
        env={**os.environ, "NO_COLOR": "1"},
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        encoding="utf-8",
        errors="replace",
        timeout=PATIENCE,
        check=False,
    )
    if done.returncode or not (work / "site" / "index.html").is_file():
        message = f"Zensical failed with {done.returncode}: {COLOURS.sub('', done.stdout)[-2000:]}"
        raise SiteError(message)


def _at_its_page(fault: Fault, pages: Mapping[str, str]) -> Fault:
    """Return a fault with the page in Markdown that the HTML was made of."""
    folder = fault.file.removesuffix("index.html")
    made_of = next((name for name in (f"{folder.rstrip('/')}.md", f"{folder}index.md") if name in pages), fault.file)
    return Fault(made_of, fault.what, fault.todo)


def place(work: Path, out: Path) -> None:
    """Put the site that was built in the place of the earlier one. Raises UnwrittenSiteError."""
    try:
        if out.is_dir():
            shutil.rmtree(out)
        out.parent.mkdir(parents=True, exist_ok=True)
        shutil.move(work / "site", out)
    except OSError as error:
        message = f"{out} cannot be written ({error.strerror or error})"
        raise UnwrittenSiteError(message) from None
