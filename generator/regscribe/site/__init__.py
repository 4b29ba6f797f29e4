"""A static site to search: pages of Markdown staged for Zensical, built by it, and checked link by link."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from regscribe import register_browser
from regscribe.model import RegisterMap
from regscribe.site.building import SiteError, UnwrittenSiteError, build, place, usable
from regscribe.site.built import Fault
from regscribe.site.config import configuration
from regscribe.site.nav import navigation
from regscribe.site.sources import GUIDES, REFERENCES, map_pages, project_pages, public_address, runtime_pages
from regscribe.site.staging import BROWSER, Around, stage

FIRST = {(), (GUIDES,)}
"""Sections of a project's own pages that stand before the references; the others stand behind."""

__all__ = ["Fault", "Site", "SiteError", "UnwrittenSiteError", "make"]


@dataclass(frozen=True, slots=True)
class Site:
    """What is wanted: maps, a project whose own pages come with them, the runtime's reference, title and address."""

    maps: Sequence[RegisterMap]
    project: Path | None = None
    api: bool = False
    title: str = "Registers"
    url: str = ""


def make(site: Site, out: Path) -> tuple[int, list[Fault]]:
    """Make a site at `out`; return how many pages it has, and what is wrong: then nothing was written.

    Raises SiteError where it cannot be built.
    """
    usable(out)
    references, files = map_pages(site.maps, REFERENCES if site.project else "")
    own, pictures = project_pages(site.project) if site.project else ([], {})
    first = [page for page in own if page.section in FIRST]
    api = runtime_pages() if site.api else []
    pages = [*first, *references, *api, *(page for page in own if page not in first)]
    files |= pictures | {BROWSER: register_browser.page(site.maps).encode(errors="replace")}
    public = public_address(site.project) if site.project else ""
    project = site.project
    exists = (lambda path: (project / path).exists()) if project else (lambda _: False)
    staged, broken = stage(pages, Around(files, public, exists), browser=True)
    menu = navigation(pages, browser=True)
    config = configuration(site.title, menu, url=site.url, repository=public, api=site.api)
    with TemporaryDirectory() as folder:
        found = build(staged, files, config, Path(folder))
        found = sorted({*broken, *found})
        if not found:
            place(Path(folder), out)
    return len(pages), found
