"""The site as people use it: the search finds registers, pages fit their windows, and nothing foreign is asked."""

import io
import os
from collections.abc import Iterator
from pathlib import Path

import pytest
from PIL import Image, ImageStat
from playwright.sync_api import Page

from regscribe.cli.app import run

from .pages import PHONE, WIDE, Opener, overflow, serious
from .served import served

pytestmark = pytest.mark.browser

ROOT = Path(__file__).parents[3]
REFERENCES = "generated/docs"
SERIES_C = f"{REFERENCES}/athena/series-c/"
FDC = f"{REFERENCES}/fdc/series-100/"
PAGES = ("", "docs/cli/", "docs/language/", f"{REFERENCES}/", SERIES_C, FDC, "api/driver/", "CHANGELOG/")
SHOTS = os.environ.get("SITE_SHOTS", "")
"""A folder for pictures of the pages, for people to look at."""

OVEN = """
format: 1
map: {id: acme/oven, title: Acme Oven, maker: Acme, class_prefix: Acme}
manual: {title: Oven, number: "7"}
models: {A: {}}
protocol: {source: "1", functions: [3, 4, 6]}
groups:
  - id: g
    name: Group
    source: "2"
    registers:
      - {at: 4049, id: chamber, name: Chamber Temperature, symbol: TCh, access: rw, enum: {0: cold, 1: hot}}
      - {at: 26, space: input, id: door, name: Door Counter, access: r}
"""

LINKS_OF_THE_SEARCH = """() => {
  const found = []
  const walk = (root) => root.querySelectorAll("*").forEach((element) => {
    if (element.shadowRoot) walk(element.shadowRoot)
    if (root !== document && element.matches("a[href]")) found.push(element.href)
  })
  walk(document)
  return found
}"""


SETTLED = f"""() => {{
  const now = ({LINKS_OF_THE_SEARCH})().join()
  const settled = window.searchBefore === now
  window.searchBefore = now
  return settled && new Promise((answer) => setTimeout(() => answer(({LINKS_OF_THE_SEARCH})().join() === now), 300))
}}"""
"""The search shows its results as they come."""


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """The address of the site that `make site` makes."""
    out = tmp_path_factory.mktemp("site") / "out"
    assert run(["site", str(ROOT / "maps"), "--docs", str(ROOT), "--api", "--title", "regscribe", "-o", str(out)]) == 0
    with served(out) as address:
        yield address


@pytest.fixture(scope="module")
def own_site(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """The address of the site of a user's own map."""
    folder = tmp_path_factory.mktemp("own")
    (folder / "oven.yaml").write_text(OVEN, encoding="utf-8")
    assert run(["site", str(folder / "oven.yaml"), "-o", str(folder / "out")]) == 0
    with served(folder / "out") as address:
        yield address


def found(open_page: Opener, site: str, query: str) -> list[str]:
    """What the search of the theme finds, the best first: places on the site."""
    page = open_page(site)
    page.click(".md-search__button")
    page.wait_for_function(f"({LINKS_OF_THE_SEARCH})().length === 0")
    page.keyboard.type(query)
    page.wait_for_function(f"({LINKS_OF_THE_SEARCH})().length > 0")
    page.wait_for_function(SETTLED)
    links: list[str] = page.evaluate(LINKS_OF_THE_SEARCH)
    places = (link.removeprefix(site).partition("?") for link in links)
    return [f"{path}#{rest.partition('#')[2]}" for path, _, rest in places]


INPUT_TYPE = (f"{SERIES_C}#register-input_type", f"{REFERENCES}/omega/cn8200/#register-input_type")
SPAN = (f"{SERIES_C}#register-high_voltage_span_adjustment",)


@pytest.mark.parametrize(
    ("query", "best"),
    [
        ("Input Type", INPUT_TYPE),
        ("input_type", INPUT_TYPE),
        ("4049", INPUT_TYPE),
        ("0xFD1", INPUT_TYPE),
        ("0xfd1", INPUT_TYPE),
        ("44050", INPUT_TYPE),
        ("High-Voltage Span", SPAN),
        ("1049", SPAN),  # the view x10 of 49
        ("0x419", SPAN),
        ("44016", (f"{SERIES_C}#register-segments-ramp_time",)),  # the second of eight
        ("INPT", (f"{FDC}#register-inpt",)),
        ("SP1L", (f"{FDC}#register-sp1l",)),
        ("40101", (f"{REFERENCES}/athena/platinum-x5000/#register-input_type",)),
    ],
)
def test_the_search_finds_a_register(open_page: Opener, site: str, query: str, best: tuple[str, ...]) -> None:
    assert set(best) <= set(found(open_page, site, query)[: max(3, len(best))])


@pytest.mark.parametrize(
    ("query", "anchor"),
    [
        ("Chamber", "chamber"),
        ("TCh", "chamber"),
        ("4049", "chamber"),
        ("0xFD1", "chamber"),
        ("44050", "chamber"),
        ("door counter", "door"),
        ("0x1A", "door"),
        ("30027", "door"),
    ],
)
def test_the_search_finds_a_register_of_ones_own_map(open_page: Opener, own_site: str, query: str, anchor: str) -> None:
    assert found(open_page, own_site, query)[0] == f"acme/oven/#register-{anchor}"


@pytest.mark.parametrize("place", PAGES)
def test_no_page_is_wider_than_its_window(open_page: Opener, site: str, place: str) -> None:
    for width, dark in ((WIDE, False), (WIDE, True), (PHONE, False)):
        page = open_page(site + place, width=width, dark=dark)
        keep(page, place, f"{width}{'-dark' if dark else ''}")
        assert overflow(page) == 0


@pytest.mark.parametrize("place", [SERIES_C, FDC])
def test_the_widest_tables_fit_a_usual_window(open_page: Opener, site: str, place: str) -> None:
    page = open_page(site + place)
    wraps = page.locator(".md-typeset__scrollwrap")
    assert wraps.evaluate_all("them => them.filter(one => one.scrollWidth > one.clientWidth + 1).length") == 0
    assert wraps.count() > 10


def keep(page: Page, place: str, kind: str) -> None:
    if SHOTS:
        name = place.strip("/").replace("/", "-") or "home"
        page.screenshot(path=f"{SHOTS}/{name}-{kind}.png")


def test_a_table_keeps_its_head_in_sight(open_page: Opener, site: str) -> None:
    page = open_page(f"{site}{SERIES_C}#overview")
    table = page.locator("h2#overview ~ .md-typeset__scrollwrap").first
    table.evaluate("element => element.scrollTop = 500")
    head, wrapper = table.locator("th").first.bounding_box(), table.bounding_box()
    assert head is not None
    assert wrapper is not None
    assert abs(head["y"] - wrapper["y"]) <= 2


def brightness(page: Page) -> float:
    """How bright the picture of the address space is, from 0 to 255."""
    shot = page.locator("img[src$='addresses.svg']").screenshot()
    return float(ImageStat.Stat(Image.open(io.BytesIO(shot)).convert("L")).mean[0])


def test_pictures_follow_the_switch_of_the_page_and_not_the_system(open_page: Opener, site: str) -> None:
    page = open_page(site + FDC)
    assert brightness(page) > 150
    for _ in range(2):  # from the system's mode to light, to dark
        page.locator(
            "label.md-header__button[for^=__palette]:visible, [data-md-component=palette] label:visible"
        ).click()
    assert page.evaluate("document.body.dataset.mdColorScheme") == "slate"
    assert brightness(page) < 100


def test_on_paper_there_is_the_page_alone(open_page: Opener, site: str, tmp_path: Path) -> None:
    page = open_page(site + FDC)
    page.emulate_media(media="print")
    assert [page.locator(part).first.is_visible() for part in (".md-header", ".md-sidebar", ".md-footer", "h1")] == [
        False,
        False,
        False,
        True,
    ]
    target = Path(SHOTS or tmp_path) / "print.pdf"
    page.pdf(path=target, prefer_css_page_size=True)
    assert target.read_bytes().startswith(b"%PDF")
    page.set_viewport_size({"width": 690, "height": 900})  # A4 without its margins
    keep(page, FDC, "print")
    assert overflow(page) == 0


@pytest.mark.parametrize("place", ["", FDC, f"{REFERENCES}/", "api/errors/", "docs/import/"])
@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
def test_axe_finds_nothing_serious(open_page: Opener, site: str, place: str, dark: bool) -> None:  # noqa: FBT001 (a parameter)
    assert serious(open_page(site + place, dark=dark)) == []


def test_the_register_browser_opens_from_a_reference(open_page: Opener, site: str) -> None:
    page = open_page(site + FDC)
    page.click("text=Find a register and calculate its values")
    page.wait_for_url("**/registers.html*")
    assert page.locator("input[type=search], input").first.is_visible()
