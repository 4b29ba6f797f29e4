"""The calculator of the register browser, held to the worked examples of the manual of Series C and to IEEE 754."""

from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from .pages import Opener, serious
from .register_pages import SERIES_C, known, map_of, reading, search, written

pytestmark = pytest.mark.browser


@pytest.fixture(scope="module")
def address(tmp_path_factory: pytest.TempPathFactory) -> str:
    return written(tmp_path_factory.mktemp("series-c"), map_of(SERIES_C))


@pytest.fixture
def setpoint(open_page: Opener, address: str) -> Page:
    """Setpoint (RAM): an integer at 2, ten times at 1002, an IEEE number at 8004 whose words 4084 puts in order."""
    return open_page(f"{address}#register-setpoint_ram")


def write_words(page: Page, *words: str) -> None:
    for place, word in enumerate(words):
        field = page.locator(f'[data-word="16-{place}"]')
        field.fill(word)
        field.press("Tab")


def test_a_linear_input_has_decimals_of_another_register(setpoint: Page) -> None:
    setpoint.locator("[data-choice=view]").select_option("base")
    write_words(setpoint, "1D97")
    assert reading(setpoint) == "7575 °F"
    known(setpoint, "input_type").select_option("14")
    known(setpoint, "linear_decimal_position").fill("2")
    assert reading(setpoint) == "75.75"  # section 3.6.2.3 of the manual; a linear input has no unit
    known(setpoint, "linear_decimal_position").fill("1")
    write_words(setpoint, "05E1")
    assert reading(setpoint) == "150.5"  # section 3.4.1


def test_the_order_of_words_is_that_of_the_register(setpoint: Page) -> None:
    write_words(setpoint, "0000", "437A")
    assert reading(setpoint) == "250 °F"  # section 1.2.7.2: 0000 437A in the order that is usual
    known(setpoint, "ieee_register_ordering").select_option("0")
    assert reading(setpoint) != "250 °F"
    write_words(setpoint, "437A", "0000")
    assert reading(setpoint) == "250 °F"


def test_a_value_becomes_words_a_line_of_python_and_a_request(setpoint: Page) -> None:
    setpoint.locator("[data-choice=view]").select_option("x10")
    known(setpoint, "temperature_decimal_position").fill("1")
    setpoint.get_by_label("Value to write").fill("150.5")
    assert setpoint.locator('[data-word="16-0"]').input_value() == "0x05E1"  # section 3.4.1
    assert setpoint.locator('[data-word="10-0"]').input_value() == "1505"
    labels, texts = (
        setpoint.locator(".lines dt").all_inner_texts(),
        setpoint.locator(".lines dd code").all_inner_texts(),
    )
    lines = dict(zip(labels, texts, strict=True))
    assert lines == {
        "Words": "05E1",
        "Python, read": 'controller.setpoint_ram.read(view="x10")',
        "Python, write": 'controller.setpoint_ram.write(150.5, view="x10")',
        "Command line, read": "regscribe read DEVICE setpoint_ram",
        "Command line, write": "regscribe write --view x10 DEVICE setpoint_ram 150.5",
        "RTU request, read": "01 03 03 EA 00 01 A5 BA",
        "RTU request, write": "01 06 03 EA 05 E1 6B 62",
    }


def test_a_refusal_says_why(setpoint: Page) -> None:
    setpoint.get_by_label("Value to write").fill("1401")
    expect(setpoint.locator(".refused")).to_contain_text("Refused: 1401 lies outside the range. Decided above by")
    known(setpoint, "setpoint_high_limit").fill("1402")
    expect(setpoint.locator(".refused")).to_have_count(0)
    known(setpoint, "setpoint_high_limit").fill("")
    expect(setpoint.locator(".refused")).to_contain_text("setpoint_high_limit is not known")


def test_a_value_may_have_the_unit_that_it_is_shown_with_and_no_other(setpoint: Page) -> None:
    setpoint.locator("[data-choice=view]").select_option("x10")
    known(setpoint, "temperature_decimal_position").fill("1")
    value = setpoint.get_by_label("Value to write")
    value.fill("150.5 °F")
    assert setpoint.locator('[data-word="16-0"]').input_value() == "0x05E1"
    value.fill("150.5 °C")
    expect(setpoint.locator(".refused")).to_contain_text("Refused: the unit is °F here, not °C")
    known(setpoint, "input_type").select_option("14")  # a linear input has no unit
    expect(setpoint.locator(".refused")).to_contain_text("as things stand there is no unit °C")


def test_a_refusal_leads_to_the_registers_that_decided_it(setpoint: Page) -> None:
    setpoint.locator("[data-choice=view]").select_option("x10")
    known(setpoint, "temperature_decimal_position").fill("1")
    setpoint.get_by_label("Value to write").fill("150.05")
    refused = setpoint.locator(".refused")
    expect(refused).to_contain_text("150.05 is no multiple of 0.1. Decided above by")
    expect(refused.get_by_role("button", name="view = x10")).to_be_visible()
    expect(refused).not_to_contain_text("Linear Input")  # of another case
    refused.get_by_role("button", name="Decimal Position for Thermocouple or RTD Input = 1").click()
    expect(known(setpoint, "temperature_decimal_position")).to_be_focused()


def test_words_count_while_they_are_typed_and_the_caret_stays(setpoint: Page) -> None:
    setpoint.locator("[data-choice=view]").select_option("base")
    field = setpoint.locator('[data-word="10-0"]')
    field.fill("55")
    field.press("ArrowLeft")
    field.press("0")
    assert reading(setpoint) == "505 °F"
    expect(field).to_be_focused()
    assert field.evaluate("field => field.selectionStart") == 2
    field.press("Control+z")
    assert reading(setpoint) == "55 °F"  # what a browser knows to undo is not lost


@pytest.mark.parametrize(
    ("field", "text", "reason"),
    [
        ("word=16-0", "0x", "0x is no hexadecimal number"),
        ("word=16-0", "12345", "12345 is more than 0xFFFF"),
        ("word=10-0", "70000", "70000 is more than 65535"),
        ("word=10-0", "-32769", "-32769 is less than -32768"),
        ("word=10-0", "1.5", "1.5 is no whole number"),
        ("word=10-0", "", "Empty: a word needs a number"),
        ("value=text", "warm", "Refused: warm is no number"),
        ("known=setpoint_high_limit", "warm", "warm is no number"),
        ("known=linear_decimal_position", "70000", "70000 lies outside -32768 to 32767 of int16"),
    ],
)
def test_a_text_that_is_no_value_has_its_reason_beside_it(setpoint: Page, field: str, text: str, reason: str) -> None:
    name, _, value = field.partition("=")
    written = setpoint.locator(f'[data-{name}="{value}"]')
    written.fill(text)
    expect(written).to_have_attribute("aria-invalid", "true")
    expect(setpoint.locator(f"[id='{written.get_attribute('aria-describedby')}']")).to_have_text(reason)
    expect(setpoint.locator("#said")).to_contain_text(reason)  # once nothing more is typed
    assert serious(setpoint) == []
    written.fill("1")
    expect(written).not_to_have_attribute("aria-invalid", "true")


def test_a_number_that_is_no_address_says_so(setpoint: Page) -> None:
    for text, reason in (("70000", "70000 is more than 65535"), ("0x", "0x is no number")):
        search(setpoint, text)
        expect(setpoint.locator("#count")).to_contain_text(reason)


def test_a_view_that_stops_shows_no_value(open_page: Opener, address: str) -> None:
    page = open_page(f"{address}#register-alarm_1_process_setpoint")
    page.locator("[data-choice=view]").select_option("x10")
    write_words(page, "7FFF")
    assert reading(page) == "the view stops here: this is no value"  # section 3.8.4.2.3


def test_a_fault_has_its_name(open_page: Opener, address: str) -> None:
    page = open_page(f"{address}#register-process_value")
    page.locator("[data-choice=view]").select_option("base")
    page.locator('[data-word="10-0"]').fill("-32768")
    page.locator('[data-word="10-0"]').press("Tab")
    assert reading(page) == "Low Error (a fault, no value)"


def test_bits_are_turned_by_clicking_and_have_their_names(open_page: Opener, address: str) -> None:
    page = open_page(f"{address}#model=16C&open=register-led_status_indicator_byte")
    page.get_by_role("button", name="Bit 4: A2").click()
    page.get_by_role("button", name="Bit 5: A1").click()
    assert page.locator('[data-word="10-0"]').input_value() == "48"  # erratum on 4.15.2: 48 means A1 and A2
    lit = page.locator(".parts .set").all_inner_texts()
    assert [text.split()[0] for text in lit] == ["A2", "A1"]
    expect(page.get_by_role("button", name="Bit 5: A1")).to_be_focused()


def test_a_member_is_picked_by_name(open_page: Opener, address: str) -> None:
    page = open_page(f"{address}#register-input_type")
    assert reading(page) == "3 = J thermocouple"
    page.get_by_label("Pick a member").select_option(label="11 = RTD")
    assert page.locator('[data-word="16-0"]').input_value() == "0x000B"
    page.get_by_label("Value to write").fill("J thermocouple")
    assert reading(page) == "3 = J thermocouple"
    assert "controller.input_type.write(InputType.J_THERMOCOUPLE)" in page.locator(".lines").inner_text()


def test_what_is_said_of_a_device_stays_for_its_other_registers(setpoint: Page, address: str) -> None:
    known(setpoint, "input_type").select_option("14")
    setpoint.goto(f"{address}#register-process_value")
    assert known(setpoint, "input_type").input_value() == "14"


def test_what_a_manual_leaves_open_is_asked(open_page: Opener, tmp_path: Path) -> None:
    page = open_page(f"{written(tmp_path, map_of('fdc/series-100'))}#register-sp1")
    assert reading(page) == "? cannot be told: linear_inputs is not known"
    known(page, "inpt").fill("5")
    known(page, "dp").fill("2")
    known(page, "linear_inputs").press_sequentially("1, 4..6")
    write_words(page, "4E20")
    assert reading(page) == "0.01"  # 20000/100 - 199.99, for a linear input with two decimals
    known(page, "inpt").fill("7")
    assert reading(page) == "0.1"  # 20000/10 - 1999.9, for the others


def test_an_address_is_copied(setpoint: Page) -> None:
    setpoint.context.grant_permissions(["clipboard-read", "clipboard-write"])
    setpoint.get_by_role("button", name="Copy 0x1F44").click()
    expect(setpoint.locator("#said")).to_have_text("Copied 0x1F44")
    assert setpoint.evaluate("navigator.clipboard.readText()") == "0x1F44"
