"""The folder that Zensical builds from: pages in the layout of the repository, links mended, titles in front."""

import json
import posixpath
from collections.abc import Callable, Collection, Iterable
from dataclasses import dataclass
from functools import partial
from pathlib import PurePosixPath
from urllib.parse import unquote, urlsplit

from regscribe.site.built import Fault
from regscribe.site.dialect import convert

SILENT = frozenset({"contents", "overview"})
"""Sections of a reference that name every register: in the search they would hide the register that is meant."""

BROWSER = "registers.html"
"""The page that finds and calculates registers, if it is made."""


@dataclass(frozen=True, slots=True)
class Page:
    """A page in Markdown, at a path of the repository, with its place in the menu.

    `reference`: it is made of a map and has wide tables. `ready`: it is written for the site alone.
    """

    path: str
    title: str
    text: str
    section: tuple[str, ...] = ()
    reference: bool = False
    ready: bool = False


def staged(path: str) -> str:
    """Return where a page stands in the staged folder: a README is the index of its folder."""
    at = PurePosixPath(path)
    return str(at.with_name("index.md")) if at.name == "README.md" else path


@dataclass(frozen=True, slots=True)
class Around:
    """What pages link to beside pages: files of the site, and files of the project that are not on it.

    `exists` tells whether the project has a path. Links to what is there, but not on the site, go to the address of the
    repository in `public`; without it they become plain text.
    """

    files: Collection[str] = ()
    public: str = ""
    exists: Callable[[str], bool] = lambda _: False


def stage(pages: Iterable[Page], around: Around, *, browser: bool) -> tuple[dict[str, str], list[Fault]]:
    """Return the text of each staged page by its path, and the links of a project's own pages to what is nowhere."""
    known = {page.path: page for page in pages}
    broken: list[Fault] = []
    texts = {staged(path): _staged(page, known, around, broken, browser=browser) for path, page in known.items()}
    return texts, broken


def _staged(page: Page, pages: Collection[str], around: Around, broken: list[Fault], *, browser: bool) -> str:
    meta: dict[str, str | list[str]] = {"title": page.title}
    if page.reference:
        meta["hide"] = ["toc"]  # hundreds of entries; the page has its own contents
    front = "".join(f"{key}: {json.dumps(value, ensure_ascii=False)}\n" for key, value in meta.items())
    silent = SILENT if page.reference else frozenset[str]()
    text = page.text if page.ready else convert(page.text, partial(_target, page, pages, around, broken), silent)
    if browser and page.reference:
        text = _with_browser(text, page.path)
    return f"---\n{front}---\n\n{text}"


def _with_browser(text: str, path: str) -> str:
    """Put the link to the register browser below the title."""
    place = posixpath.relpath(BROWSER, posixpath.dirname(path) or ".")
    link = f"[Find a register and calculate its values]({place})"
    lines = text.split("\n")
    title = next((number for number, line in enumerate(lines) if line.startswith("# ")), 0)
    return "\n".join([*lines[: title + 1], "", link, *lines[title + 1 :]])


def _target(page: Page, pages: Collection[str], around: Around, broken: list[Fault], target: str) -> str:
    """Return the target of a link of a page on the site; empty if nothing there answers to it."""
    parts = urlsplit(target)
    if parts.scheme or parts.netloc or not parts.path:
        return target
    folder = posixpath.dirname(page.path)
    path = posixpath.normpath(posixpath.join(folder, unquote(parts.path)))
    fragment = f"#{parts.fragment}" if parts.fragment else ""
    for name in (path, posixpath.normpath(f"{path}/README.md")):
        if name in pages:
            return posixpath.relpath(staged(name), folder or ".") + fragment
    if path in around.files:
        return target
    inside = not path.startswith(("..", "/"))
    if not page.reference and not (inside and around.exists(path)):
        broken.append(
            Fault(page.path, f"the link to {target} leads nowhere", f"there is no {path}; name what is there")
        )
    return f"{around.public}/blob/HEAD/{path}{fragment}" if around.public and inside else ""
