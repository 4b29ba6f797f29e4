"""Search of the register browser, its filters, and its state in the address of the page."""

from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from .pages import Opener
from .register_pages import SERIES_C, every_map, map_of, names, search, written

pytestmark = pytest.mark.browser


@pytest.fixture(scope="module")
def address(tmp_path_factory: pytest.TempPathFactory) -> str:
    return written(tmp_path_factory.mktemp("series-c"), map_of(SERIES_C))


@pytest.fixture
def series_c(open_page: Opener, address: str) -> Page:
    return open_page(address)


@pytest.mark.parametrize(
    ("query", "first", "why"),
    [
        ("4049", "Input Type", "base view at 4049"),
        ("0xFD1", "Input Type", "base view at 4049"),
        ("$fd1", "Input Type", "base view at 4049"),
        ("FD1h", "Input Type", "base view at 4049"),
        ("44050", "Input Type", "base view at 4049"),
        ("444050", "", ""),
        ("1002", "Setpoint (RAM)", "x10 view at 1002"),
        ("8004", "Setpoint (RAM)", "word 1 of 2 of ieee view at 8004"),
        ("8005", "Setpoint (RAM)", "word 2 of 2 of ieee view at 8005"),
        ("48006", "Setpoint (RAM)", "word 2 of 2 of ieee view at 8005"),
        ("4016", "Ramp Time 1 … 8", "segments[3].ramp_time, base view at 4016"),
        ("input_type", "Input Type", ""),
        ("Input Type", "Input Type", ""),
        ("bAud", "Baud Rate", ""),
        ("thermocouple platinel", "Input Type", "value: Platinel II thermocouple"),
        ("4.4.2 blank", "Setpoint Display Blanking", "section: 4.4.2"),
        ("7000", "Load All Parameter Defaults", "writes 7000"),
        ("nothing has this name", "", ""),
    ],
)
def test_what_people_write_finds_a_register(series_c: Page, query: str, first: str, why: str) -> None:
    found = search(series_c, query)
    assert (found or [""])[0] == first
    assert why in (series_c.locator("#results .why").first.inner_text() if why else "")


def test_an_address_with_two_meanings_shows_both(series_c: Page) -> None:
    search(series_c, "44050")
    assert series_c.locator("#readings li").all_inner_texts() == [
        "wire 44050: nothing there",
        "holding 4049 (Modicon): 1 register",
    ]


def test_a_number_of_the_manuals_own_counting_is_found_after_the_wire_address(
    open_page: Opener, tmp_path: Path
) -> None:
    page = open_page(written(tmp_path, map_of("athena/platinum-x5000")))  # JBUS counts from 1
    assert search(page, "65") == ["MASTER enable", "Read Status"]
    assert page.locator("#readings li").all_inner_texts() == ["wire 65: 1 register", "holding 64 (JBUS): 1 register"]


def test_a_further_address_is_found(open_page: Opener, tmp_path: Path) -> None:
    page = open_page(written(tmp_path, map_of("fdc/series-100")))  # the process value is at 64 and at 128
    assert search(page, "128") == search(page, "64")
    search(page, "128")
    assert page.locator("#results .why").all_inner_texts() == ["alias at 128"]


def test_all_maps_are_searched_at_once(open_page: Opener, tmp_path: Path) -> None:
    page = open_page(written(tmp_path, *every_map()))
    assert search(page, "0xFD1") == ["Input Type", "Input Type"]
    assert page.locator("#results .map").all_inner_texts() == ["Athena Series C", "Omega CN8200 Series"]
    page.locator("#results .row").nth(1).click()
    assert page.url.endswith("#q=0xFD1&open=omega%2Fcn8200%2Fregister-input_type")
    page.reload()
    assert page.locator("#details .summary").inner_text().endswith("Omega CN8200 Series")


def test_spaces_are_found_and_told_apart(open_page: Opener, tmp_path: Path) -> None:
    page = open_page(written(tmp_path, map_of("athena/platinum-x5000")))
    coils = search(page, "coil")
    assert len(coils) > 1
    assert page.locator("#results .place").first.inner_text().startswith("coil ")
    assert search(page, "no such thing") == []
    expect(page.locator("#count")).to_have_text("Nothing is called or stands at “no such thing”")


def test_filters_count_and_combine(series_c: Page) -> None:
    readable = series_c.get_by_label("read only", exact=False)
    total = int(series_c.locator("label", has=readable).locator(".number").inner_text())
    readable.check()
    expect(series_c.locator("#count")).to_contain_text(f"{total} of ")
    series_c.get_by_label("1ZC", exact=False).check()
    narrowed = names(series_c)
    assert 0 < len(narrowed) < total
    assert "Process Value" in narrowed
    assert "#model=1ZC" in series_c.url or "&model=1ZC" in series_c.url
    series_c.reload()
    assert names(series_c) == narrowed
    series_c.get_by_role("button", name="Clear filters").click()
    assert len(names(series_c)) > total


def test_the_filter_of_errata_keeps_what_they_are_about_and_not_all_of_a_section(series_c: Page, address: str) -> None:
    series_c.get_by_text("Errata", exact=True).click()
    series_c.get_by_label("about it", exact=False).check()
    assert 0 < len(names(series_c)) < 20
    series_c.locator("#results .row").first.click()
    expect(series_c.locator("#details")).to_contain_text("Errata about it (")
    series_c.goto(f"{address}#register-input_type")
    expect(series_c.locator("#details")).to_contain_text("Errata of its section, which need not concern it (")


def test_words_of_errata_are_found_with_a_link_to_all_that_say_them(series_c: Page) -> None:
    search(series_c, "printed")
    link = series_c.locator("#more a")
    count = int(link.inner_text().split()[0])
    link.click()
    heading = series_c.locator("#errata")
    expect(heading).to_be_in_viewport()
    assert count <= int(heading.inner_text().removeprefix("Errata (").removesuffix(")"))


def test_how_many_writes_a_memory_endures_is_searched_and_filtered(open_page: Opener, tmp_path: Path) -> None:
    page = open_page(written(tmp_path, map_of("athena/platinum-m300")))
    page.get_by_text("Endurance", exact=True).click()
    box = page.locator("[data-facet=endurance]").first
    words = box.get_attribute("data-value")
    box.check()
    kept = names(page)
    page.get_by_role("button", name="Clear filters").click()
    assert set(kept) <= set(search(page, f"endurance {words}")) == set(search(page, words))


def test_a_link_reproduces_what_was_seen_and_back_returns(series_c: Page, address: str) -> None:
    search(series_c, "alarm")
    found = names(series_c)
    series_c.locator("#results .row").first.click()
    expect(series_c.get_by_role("heading", level=2)).to_have_text(found[0])
    series_c.go_back()
    assert names(series_c) == found
    expect(series_c.locator("#details h2")).to_have_text("Choose a register")
    series_c.goto(f"{address}#register-input_type")
    expect(series_c.get_by_role("heading", level=2)).to_have_text("Input Type")


def test_a_link_in_a_condition_leads_to_its_meaning(series_c: Page, address: str) -> None:
    series_c.goto(f"{address}#register-setpoint_ram")
    series_c.locator("#details").get_by_role("link", name="linear input").click()
    assert series_c.url.endswith("#condition-linear_input")
    expect(series_c.locator("#condition-linear_input")).to_be_in_viewport()
    series_c.locator("#details").get_by_role("link", name="input_type").first.click()
    expect(series_c.get_by_role("heading", level=2)).to_have_text("Input Type")


def test_an_element_that_was_searched_is_the_one_that_opens(series_c: Page) -> None:
    search(series_c, "4016")
    series_c.keyboard.press("Enter")
    assert series_c.locator(".addresses code").first.inner_text() == "4016"
    assert series_c.get_by_label("Element").input_value() == "3"


def test_what_was_searched_opens_in_a_model_that_has_it(series_c: Page, address: str) -> None:
    series_c.goto(f"{address}#register-led_status_indicator_byte")
    model = series_c.locator("[data-choice=model]")
    expect(model).to_have_value("1ZC")  # the first
    search(series_c, "led A2")  # a bit that 1ZC does not have
    expect(model).to_have_value("16C")
    assert "1ZC: not what was searched" in model.locator("option").all_inner_texts()
    model.select_option("1ZC")  # who wants another model has it
    series_c.locator("#theme").click()
    expect(model).to_have_value("1ZC")


def test_the_choice_of_models_says_which_have_no_such_register(series_c: Page, address: str) -> None:
    series_c.goto(f"{address}#model=1ZC&open=register-display_filter")
    model = series_c.locator("[data-choice=model]")
    expect(model).to_have_value("16C")
    expect(model.locator("option", has_text="1ZC: does not have it")).to_be_disabled()


def test_the_keyboard_is_enough(series_c: Page) -> None:
    series_c.keyboard.press("/")
    series_c.keyboard.type("setpoint limit")
    series_c.keyboard.press("ArrowDown")
    series_c.keyboard.press("ArrowDown")
    series_c.keyboard.press("ArrowUp")
    first = names(series_c)[0]
    expect(series_c.locator("#results .row").first).to_be_focused()
    series_c.keyboard.press("Enter")
    expect(series_c.get_by_role("heading", level=2)).to_have_text(first)
    expect(series_c.get_by_role("heading", level=2)).to_be_focused()
    series_c.keyboard.press("Escape")
    expect(series_c.locator("#results .row").first).to_be_focused()
    series_c.keyboard.press("ArrowUp")
    expect(series_c.get_by_role("searchbox")).to_be_focused()
