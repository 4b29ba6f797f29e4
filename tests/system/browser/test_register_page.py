"""The page of the register browser as a whole: hostile maps, what it asks for, axe, widths, print."""

import re
from dataclasses import replace
from pathlib import Path

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, Page, expect

from regscribe.emit.markdown.context import context as reference
from regscribe.emit.markdown.entries import sections
from regscribe.model import RegisterMap
from regscribe.pipeline import compile_map
from regscribe.register_browser.inline_text import runs

from .pages import PHONE, WIDE, Opener, overflow
from .register_pages import SERIES_C, every_map, map_of, names, search, written

pytestmark = pytest.mark.browser

ATTACKS = (
    "<script>window.hit = 1</script>",
    "</script><script>window.hit = 1</script>",
    "<img src=x onerror='window.hit = 1'>",
    '" onfocus="window.hit = 1" autofocus x="',
    "[x](javascript:window.hit=1)",
    "`${window.hit = 1}` ${1}",
    "<!-- <script> {{ 1 }}",
)
TURNED = "\u202eevil \u2066\u200f"
"""Marks that turn the direction of text: `check` refuses them in files, but a page is given any map."""

LONG = "N" * 10_000
OPEN = "(hash) => { history.replaceState(null, '', hash); dispatchEvent(new Event('popstate')) }"


def hostile_map(folder: Path) -> Path:
    """A map that says all this wherever it may say something."""
    quoted = [text.replace("'", "''") for text in (*ATTACKS, LONG)]
    rows = "".join(
        f"""
      - at: {number}
        id: r{number}
        name: '{text}'
        symbol: '{text}'
        description: '{text}'
        danger: '{text}'
        source: '{text}'
        enum: {{0: '{text}', 1: 'other {text}'}}"""
        for number, text in enumerate(quoted)
    )
    path = folder / "maps" / "acme" / "hostile.yaml"
    path.parent.mkdir(parents=True)
    path.write_text(
        f"""format: 1
map: {{id: acme/hostile, title: '{quoted[0]} {LONG}', maker: '{quoted[1]}', class_prefix: Acme}}
manual: {{title: '{quoted[1]}', number: '{quoted[2]}'}}
models: {{A1: {{description: '{quoted[2]}'}}}}
description: '{quoted[1]}'
groups:
  - id: control
    name: '{quoted[2]}'
    source: '{quoted[1]}'
    each: {{access: rw, type: int16}}
    registers:{rows}
""",
        encoding="utf-8",
    )
    return path


def turned(register_map: RegisterMap) -> RegisterMap:
    """The map with a first register whose name turns the direction of text."""
    model = register_map.models[0]
    registers = (replace(model.registers[0], name=TURNED), *model.registers[1:])
    return replace(register_map, models=(replace(model, registers=registers, members=registers),))


@pytest.fixture
def series_c(tmp_path: Path) -> str:
    return written(tmp_path, map_of(SERIES_C))


def test_a_hostile_map_injects_nothing(open_page: Opener, tmp_path: Path) -> None:
    compiled = compile_map(hostile_map(tmp_path))
    assert compiled.map is not None, compiled.diagnostics
    page = open_page(written(tmp_path, turned(compiled.map)))
    for number in range(len(ATTACKS) + 1):
        page.goto(f"{(tmp_path / 'registers.html').as_uri()}#register-r{number}")
        page.get_by_label("Value to write").fill("1")
        search(page, ATTACKS[number % len(ATTACKS)].split()[0])
        assert overflow(page) == 0
    assert page.evaluate("window.hit") is None
    assert page.evaluate("document.querySelectorAll('script').length") == 2
    assert (
        page.evaluate("document.querySelectorAll('img, iframe, [onfocus], [onerror], a:not([href^=\"#\"])').length")
        == 0
    )
    assert "\u202e" not in page.inner_text("body")
    assert search(page, "evil") == ["U+202Eevil U+2066U+200F"]


def test_the_policy_lets_no_script_run_but_the_pages_own(chromium: Browser, series_c: str) -> None:
    opener = Opener(chromium)
    page = opener(series_c)
    page.evaluate(
        """() => {
          const added = document.createElement('script')
          added.textContent = 'window.hit = 1'
          document.body.append(added)
          document.body.setAttribute('onclick', 'window.hit = 1'); document.body.click()
        }"""
    )
    assert page.evaluate("window.hit") is None
    assert page.evaluate("fetch('http://127.0.0.1:9/').then(() => 'sent', () => 'refused')") == "refused"
    opener.close()
    assert ["Content Security Policy" in error for error in opener.errors] == [True] * 4  # element, attribute, request


def test_the_page_asks_for_nothing(open_page: Opener, series_c: str) -> None:
    page = open_page(series_c)
    asked: list[str] = []
    page.on("request", lambda request: asked.append(request.url))
    search(page, "alarm")
    page.locator("#results .row").first.click()
    page.locator("#theme").click()
    assert asked == []
    assert page.evaluate("performance.getEntriesByType('resource').length") == 0


@pytest.mark.parametrize("dark", [False, True])
@pytest.mark.parametrize("width", [WIDE, PHONE])
@pytest.mark.parametrize(
    "state", ["", "#q=0xFD1", "#register-setpoint_ram", "#register-led_status_indicator_byte", "#about"]
)
def test_axe_finds_nothing_and_nothing_is_wider_than_the_window(
    open_page: Opener, series_c: str, state: str, *, width: int, dark: bool
) -> None:
    page = open_page(series_c + state, width=width, dark=dark)
    for facet in page.locator("#facets summary").all() if not state else ():
        facet.click()
    assert [(one["id"], one["nodes"][0]["target"]) for one in Axe().run(page).response["violations"]] == []
    assert overflow(page) == 0


def test_a_phone_shows_the_list_or_a_register(open_page: Opener, series_c: str) -> None:
    page = open_page(series_c, width=PHONE)
    expect(page.locator("#details")).to_be_hidden()
    page.locator("#results .row").first.click()
    expect(page.locator("#results")).to_be_hidden()
    page.get_by_role("button", name="Close").click()
    expect(page.locator("#results")).to_be_visible()


def test_the_switch_turns_light_to_dark_and_back(open_page: Opener, series_c: str) -> None:
    page = open_page(series_c)
    back = "getComputedStyle(document.documentElement).backgroundColor"
    light = page.evaluate(back)
    page.locator("#theme").click()
    assert page.evaluate(back) != light
    page.locator("#theme").click()
    assert page.evaluate(back) == light


def test_print_opens_all_that_was_found(open_page: Opener, series_c: str) -> None:
    page = open_page(f"{series_c}#q=thermocouple")
    found = names(page)
    page.emulate_media(media="print")
    page.evaluate("dispatchEvent(new Event('beforeprint'))")
    assert page.locator("article h2").all_inner_texts() == found
    assert page.locator("article .table").count() > len(found)
    expect(page.locator("#results")).to_be_hidden()
    page.evaluate("dispatchEvent(new Event('afterprint'))")
    assert page.locator("article").count() == 0


def test_registers_of_all_maps_can_be_opened(open_page: Opener, tmp_path: Path) -> None:
    page = open_page(written(tmp_path, *every_map()))
    opened = page.evaluate(
        """() => {
          const links = () => [...document.querySelectorAll('#results .row')]
          document.querySelector('#more button').click()
          let opened = 0
          for (const { hash } of links().filter((_, place) => place % 9 === 0)) {
            history.replaceState(null, '', hash); dispatchEvent(new Event('popstate'))
            if (document.querySelector('#details .title')) opened += 1
          }
          return [opened, Math.ceil(links().length / 9)]
        }"""
    )
    assert opened[0] == opened[1] > 100


def test_a_register_shows_all_that_the_reference_says_of_it(open_page: Opener, series_c: str) -> None:
    page, context = open_page(series_c), reference(map_of(SERIES_C))
    lacking: list[tuple[str, str]] = []
    for section in sections(context):
        for entry in section.entries:
            if not entry.anchor:
                continue
            rows = [row for row in entry.facts.rows if row[0] != "Wire address"]
            tables = [one.table for one in entry.tables if not one.folded and not one.title.startswith("Views")]
            cells = [cell for row in (*rows, *(row for one in tables for row in one.rows)) for cell in row]
            texts = (
                entry.name,
                entry.summary,
                *entry.danger,
                *entry.paragraphs,
                *entry.remarks,
                *cells,
                section.name,
                *section.paragraphs,
            )
            page.evaluate(OPEN, f"#{entry.anchor}")
            shown = shown_text(page)
            lacking += [(entry.anchor, text) for text in map(plain, texts) if text not in shown]
    assert lacking == []


def plain(markdown: str) -> str:
    """The text of Markdown as people see it."""
    parts = [run if isinstance(run, str) else run.get("text", "") for run in runs(markdown)]
    return re.sub(r"\s+", "", "".join(parts))


def shown_text(page: Page) -> str:
    return re.sub(r"\s+", "", page.locator("#details").text_content() or "")
