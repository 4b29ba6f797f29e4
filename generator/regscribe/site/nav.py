"""The menu: sections of pages in the order of the pages, by titles that people know."""

from collections.abc import Iterable
from typing import Any

from regscribe.site.staging import BROWSER, Page, staged

REGISTERS = "Registers"
"""The section of the references of maps."""


def navigation(pages: Iterable[Page], *, browser: bool) -> list[Any]:
    """Return the menu; the register browser stands first among the registers."""
    menu: list[Any] = []
    for page in pages:
        place = menu
        for title in page.section:
            place = _section(place, title)
            if browser and title == REGISTERS and not place:
                place.append({"Register browser": BROWSER})
        place.append({page.title: staged(page.path)})
    return menu


def _section(menu: list[Any], title: str) -> list[Any]:
    for item in menu:
        if isinstance(item.get(title), list):
            found: list[Any] = item[title]
            return found
    made: list[Any] = []
    menu.append({title: made})
    return made
