"""Chromium for the tests of pages; where it is missing, they are skipped with what to do."""

import shutil
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, sync_playwright

from .pages import Opener

CHROMIUM = shutil.which("chromium")

OPTIONS = (
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1",
)
"""The pages are our own, and nothing but the pages is to be fetched; no name is ever looked up."""


@pytest.fixture(scope="session")
def chromium() -> Iterator[Browser]:
    """One browser for all tests; each page has cookies and storage of its own."""
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=list(OPTIONS))
        yield browser
        browser.close()


@pytest.fixture
def open_page(chromium: Browser) -> Iterator[Opener]:
    """Open pages; the test fails if one asked a foreign host, or if its scripts reported an error."""
    opener = Opener(chromium)
    yield opener
    opener.close()
    assert (opener.foreign, opener.errors) == ([], [])


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Skip, with what to do, where Chromium is missing: `make test-browser` installs it before it comes here."""
    skip = pytest.mark.skip(reason="chromium is not installed: `make test-browser` does that")
    for item in items if CHROMIUM is None else ():
        if item.get_closest_marker("browser"):
            item.add_marker(skip)
