"""The tools of these tests notice what they are for."""

from pathlib import Path

import pytest
from playwright.sync_api import Browser

from .pages import PHONE, Opener, overflow, serious

pytestmark = pytest.mark.browser

FAULTY = """<!doctype html><html lang=en><title>Faulty</title><main><h1>Faulty</h1>
<img src="http://pictures.invalid/a.png"><input><p style="width:400px">wide</p><script>nothing.here()</script></main>"""


@pytest.fixture
def faulty(chromium: Browser, tmp_path: Path) -> Opener:
    (tmp_path / "faulty.html").write_text(FAULTY, encoding="utf-8")
    return Opener(chromium)


def test_a_page_that_asks_a_foreign_host_or_fails_is_noticed(faulty: Opener, tmp_path: Path) -> None:
    faulty((tmp_path / "faulty.html").as_uri())
    faulty.close()
    assert faulty.foreign == ["http://pictures.invalid/a.png"]
    assert "nothing is not defined" in faulty.errors


def test_a_page_wider_than_a_phone_and_fields_without_labels_are_noticed(faulty: Opener, tmp_path: Path) -> None:
    page = faulty((tmp_path / "faulty.html").as_uri(), width=PHONE)
    assert overflow(page) == 18  # 400 px and the 8 px of a body's margin, on 390
    assert [one.partition(":")[0] for one in serious(page)] == ["image-alt", "label"]
    faulty.close()
