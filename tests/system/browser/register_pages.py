"""Pages of the register browser in a file, as `regscribe browse` writes them, and what tests do with them."""

from functools import cache
from pathlib import Path

from playwright.sync_api import Locator, Page

from regscribe.map_files import shipped
from regscribe.model import RegisterMap
from regscribe.pipeline import compile_map
from regscribe.register_browser import page

SERIES_C = "athena/series-c"


@cache
def map_of(name: str) -> RegisterMap:
    """Compile a shipped map."""
    found = compile_map(shipped() / f"{name}.yaml").map
    assert found is not None
    return found


def every_map() -> list[RegisterMap]:
    """All shipped maps."""
    paths = sorted(shipped().glob("*/*.yaml"))
    return [map_of(f"{path.parent.name}/{path.stem}") for path in paths if ".library" not in path.name]


def written(folder: Path, *maps: RegisterMap) -> str:
    """Write the page of maps; return its address."""
    path = folder / "registers.html"
    path.write_text(page(maps), encoding="utf-8")
    return path.as_uri()


def search(page: Page, query: str) -> list[str]:
    """Return the names of what a query finds, in their order."""
    page.get_by_role("searchbox").fill(query)
    return names(page)


def names(page: Page) -> list[str]:
    """Return the names in the list."""
    return page.locator("#results .name").all_inner_texts()


def reading(page: Page) -> str:
    """Return what the words in the calculator mean."""
    return page.locator("output.reading").inner_text()


def known(page: Page, name: str) -> Locator:
    """Return the field of a register that decides about others."""
    return page.locator(f'[data-known="{name}"]')
