"""Pages as people see them: at a width, in the dark, with what they ask for; and what axe says of them."""

from dataclasses import dataclass, field
from urllib.parse import urlsplit

from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, BrowserContext, ConsoleMessage, Page, Request

WIDE, PHONE = 1280, 390
"""Widths of a usual window and of a phone, in pixels of CSS."""


@dataclass
class Opener:
    """Opens pages in contexts of their own, and collects what they ask foreign hosts for and report as errors."""

    browser: Browser
    contexts: list[BrowserContext] = field(default_factory=list)
    foreign: list[str] = field(default_factory=list)
    errors: list[str] = field(default_factory=list)

    def __call__(self, url: str, *, width: int = WIDE, height: int = 900, dark: bool = False) -> Page:
        """Open an address (`http://127.0.0.1:..` or `file://..`), and wait until it is loaded."""
        viewport = {"width": width, "height": height}
        scheme = "dark" if dark else "light"
        context = self.browser.new_context(viewport=viewport, color_scheme=scheme)  # type: ignore[arg-type]  # a TypedDict
        self.contexts.append(context)
        page = context.new_page()
        page.on("request", self._asked)
        page.on("console", self._said)
        page.on("pageerror", lambda error: self.errors.append(str(error)))
        page.goto(url)
        return page

    def close(self) -> None:
        """Close all pages."""
        for context in self.contexts:
            context.close()

    def _asked(self, request: Request) -> None:
        where = urlsplit(request.url)
        if where.scheme not in {"file", "data", "blob"} and where.hostname != "127.0.0.1":
            self.foreign.append(request.url)

    def _said(self, message: ConsoleMessage) -> None:
        if message.type == "error":
            self.errors.append(message.text)


def overflow(page: Page) -> int:
    """Return by how many pixels a page is wider than its window: 0 if it need not be scrolled sideways."""
    return max(0, int(page.evaluate("document.documentElement.scrollWidth - document.documentElement.clientWidth")))


def serious(page: Page) -> list[str]:
    """Return what axe finds serious or critical, with the first places of each."""
    found = Axe().run(page).response["violations"]
    return [
        f"{one['id']}: {[node['target'] for node in one['nodes'][:3]]}"
        for one in found
        if one["impact"] in {"serious", "critical"}
    ]
