"""What was built, checked: links lead to a file and an id in it, no id stands twice, nothing is asked of others."""

import re
from collections import Counter
from collections.abc import Collection, Iterator
from dataclasses import dataclass, field
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urljoin, urlsplit

FETCHED = {("script", "src"), ("img", "src"), ("iframe", "src"), ("source", "src"), ("video", "src"), ("audio", "src")}
"""Attributes whose address a browser fetches by itself; of a `link` it depends on what it is."""

QUIET = {"canonical", "alternate", "next", "prev", "edit"}
"""Relations of a `link` that no browser follows by itself."""

CSS_FETCHES = re.compile(r"(?:url\(\s*['\"]?|@import\s+['\"])\s*((?:https?:)?//[^'\")\s]+)", re.IGNORECASE)


@dataclass(frozen=True, slots=True, order=True)
class Fault:
    """What is wrong in a built file, and what to do."""

    file: str
    what: str
    todo: str

    def __str__(self) -> str:
        """The line that is shown."""
        return f"{self.file}: {self.what}: {self.todo}"


@dataclass(slots=True)
class Built(HTMLParser):
    """The ids and the addresses of a page; `fetched` are those that a browser asks for by itself."""

    ids: Counter[str] = field(default_factory=Counter)
    links: dict[str, None] = field(default_factory=dict)
    fetched: dict[str, None] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Make ready for the text."""
        HTMLParser.__init__(self)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Take the id and the addresses of an element."""
        found = {name: value or "" for name, value in attrs}
        if "id" in found:
            self.ids[found["id"]] += 1
        for name in ("href", "src"):
            if name in found:
                fetched = (tag, name) in FETCHED or (tag == "link" and not QUIET & set(found.get("rel", "").split()))
                (self.fetched if fetched else self.links)[found[name]] = None


def faults(site: Path, skipped: Collection[str] = ()) -> list[Fault]:
    """Return what is wrong in the pages below a folder, in order; none if all is well.

    Of pages that are `skipped` nothing is read: what makes them checks them.
    """
    names = {path.relative_to(site).as_posix(): path for path in sorted(site.rglob("*.html"))}
    pages = {name: _parsed(path) for name, path in names.items() if name not in skipped}
    files = {path.relative_to(site).as_posix() for path in site.rglob("*") if path.is_file()}
    found = {fault for name, page in pages.items() for fault in _of_page(name, page, pages, files)}
    for path in site.rglob("*.css"):
        asked = CSS_FETCHES.findall(path.read_text(encoding="utf-8"))
        found |= {_foreign(path.relative_to(site).as_posix(), address) for address in asked}
    return sorted(found)


def _parsed(path: Path) -> Built:
    page = Built()
    page.feed(path.read_text(encoding="utf-8"))
    return page


def _foreign(name: str, address: str) -> Fault:
    return Fault(name, f"{address} is fetched from another host", "put a copy beside the pages")


def _of_page(name: str, page: Built, pages: dict[str, Built], files: set[str]) -> Iterator[Fault]:
    for one, times in page.ids.items():
        if times > 1:
            yield Fault(name, f"the id {one} stands {times} times", "give one of the headings another name")
    for address in (*page.links, *page.fetched):
        parts = urlsplit(address)
        if parts.scheme or parts.netloc:
            if address in page.fetched and parts.scheme != "data":
                yield _foreign(name, address)
        elif missing := _missing(name, address, pages, files):
            yield Fault(name, f"the link to {address} leads nowhere", missing)


def _missing(name: str, address: str, pages: dict[str, Built], files: set[str]) -> str:
    """Return what a link inside the site lacks; nothing if it leads somewhere."""
    parts = urlsplit(urljoin(f"//site/{name}", address))
    path = unquote(parts.path).removeprefix("/")
    target = next((one for one in (path, f"{path.rstrip('/')}/index.html".removeprefix("/")) if one in files), "")
    if not target:
        return f"there is no {path or 'index.html'}; name a file that is on the site"
    anchor = unquote(parts.fragment)
    if anchor and target in pages and anchor not in pages[target].ids:
        return f"{target} has no id {anchor}; link to one of its headings"
    return ""
