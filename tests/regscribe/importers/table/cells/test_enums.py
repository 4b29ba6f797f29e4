"""Codes and bits with their labels in one cell."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from regscribe.importers.table.cells import Unclear
from regscribe.importers.table.cells.enums import Codes, parse_codes

OFF_ON = {0: "Off", 1: "On"}


@pytest.mark.parametrize(
    "text",
    [
        "0=Off 1=On",
        "0=Off;1=On",
        "0: Off; 1: On",
        "0:Off|1:On",
        "0 = Off, 1 = On",
        "0=Off\n1=On",
        "0-Off/1-On",
        "0 - Off, 1 - On",
        "0 \N{EN DASH} Off\n1 \N{EN DASH} On",
        "0 :Off1: On",
        "(0) Off (1) On",
        "0) Off 1) On",
        "0 (Off), 1 (On)",
        "0='Off', 1='On'",
        "0→Off 1→On",
        "0x00=Off 0x01=On",
        "00h: Off, 01h: On",
        '{"0": "Off", "1": "On"}',
    ],
)
def test_codes_are_split_whatever_separates_them(text: str) -> None:
    assert parse_codes(text) == Codes(OFF_ON)


def test_labels_may_have_digits_and_the_other_separators() -> None:
    assert parse_codes("0=9600 baud: fast 1=19200 baud") == Codes({0: "9600 baud: fast", 1: "19200 baud"})
    assert parse_codes("1: 50 Hz 2: 60 Hz") == Codes({1: "50 Hz", 2: "60 Hz"})
    assert parse_codes("0=Mode 1 1=Mode 2") == Codes({0: "Mode 1", 1: "Mode 2"})
    assert parse_codes("0: from 12:30 1: never") == Codes({0: "from 12:30", 1: "never"})
    assert parse_codes("0=x (see 3.2); 1=y") == Codes({0: "x (see 3.2)", 1: "y"})


def test_ranges_and_all_others_are_told_apart() -> None:
    found = parse_codes("0=a; 1=b; 2..5 = reserved; others = invalid")
    assert found == Codes({0: "a", 1: "b"}, ranges=((2, 5, "reserved"),), other="invalid")


def test_negative_and_hexadecimal_codes() -> None:
    assert parse_codes("-1=error 0=ok") == Codes({-1: "error", 0: "ok"})
    assert parse_codes("AAh=start 55h=stop") == Codes({0xAA: "start", 0x55: "stop"})


@pytest.mark.parametrize("text", ["bit 0: alarm, bit 1: door", "b0=alarm b1=door", "Bit0 = alarm; Bit1 = door"])
def test_bits_are_flags(text: str) -> None:
    assert parse_codes(text) == Codes({0: "alarm", 1: "door"}, flags=True)


def test_several_bits_are_ranges_of_flags() -> None:
    assert parse_codes("bit 0-3: mode; bit 4: run") == Codes({4: "run"}, flags=True, ranges=((0, 3, "mode"),))


def test_bare_numbers_are_bits_where_the_type_says_so() -> None:
    assert parse_codes("0: alarm 1: door", flags=True) == Codes({0: "alarm", 1: "door"}, flags=True)


def test_masks_beyond_all_bits_are_bits() -> None:
    found = parse_codes("0=ok 1=a 2=b 4=c 16=d", flags=True)
    assert found == Codes({0: "a", 1: "b", 2: "c", 4: "d"}, flags=True, none="ok")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("0=open; 0=closed", "code 0 twice: as `open` and as `closed`"),
        ("1=a 2=b 4=c 8=d", "masks"),
        ("00=a 01=b 10=c 11=d", "binary or decimal"),
        ("0=", "without a label"),
        ("bit 16: x", "bit 16, and the last is 15"),
        ("bit 0: a, 1: b", "bits and codes"),
        ("off/on", "no codes"),
    ],
)
def test_what_is_not_clear_is_not_guessed(text: str, said: str) -> None:
    found = parse_codes(text)
    assert isinstance(found, Unclear)
    assert said in found.reason


def test_bits_counted_from_1_are_proposed_and_not_moved() -> None:
    found = parse_codes("; ".join(f"bit {number}: n{number}" for number in range(1, 17)))
    assert isinstance(found, Unclear)
    assert found.proposal == "bits counted from 1"


def test_labels_alone_are_proposed_in_their_order() -> None:
    found = parse_codes("off/on")
    assert isinstance(found, Unclear)
    assert found.proposal == "`{0: off, 1: on}`"


@pytest.mark.parametrize("text", ["", "text", "0/1", "0..100", "1-phase/3-phase", "see section 3: limits", "0-100"])
def test_no_codes(text: str) -> None:
    assert parse_codes(text) is None


def test_a_text_before_the_codes_is_kept() -> None:
    assert parse_codes("Mode: 0=auto, 1=manual") == Codes({0: "auto", 1: "manual"}, lead="Mode")


def test_a_code_that_stands_twice_with_one_label_is_no_contradiction() -> None:
    assert parse_codes("0=off 1=on 0=Off") == Codes({0: "Off", 1: "on"})


def test_a_cell_of_5_megabytes_is_refused_at_once() -> None:
    found = parse_codes("0=off " * 1_000_000)
    assert isinstance(found, Unclear)
    assert "6000000 characters" in found.reason


@given(st.text(max_size=60), st.booleans())
def test_no_text_raises(text: str, flags: bool) -> None:  # noqa: FBT001 - a case
    assert isinstance(parse_codes(text, flags=flags), Codes | Unclear | None)


@given(st.text("012bit=:-;,/ axh{}\"'\n", max_size=40))
def test_no_text_that_looks_like_codes_raises(text: str) -> None:
    assert isinstance(parse_codes(text), Codes | Unclear | None)


CODE_WORDS = ("bit", "b ", "d ", "other", "else", "all", "any", "andere", "sonst")
LABELS = st.from_regex(r"[A-Za-z][A-Za-z ]{0,8}[A-Za-z]", fullmatch=True).filter(
    lambda text: not text.lower().startswith(CODE_WORDS)
)


@given(
    st.dictionaries(st.sampled_from([0, 1, 3, 5, 6, 7, 9, 300]), LABELS, min_size=2),
    st.sampled_from(["=", ": ", " = "]),
    st.sampled_from(["; ", ", ", "\n", " "]),
)
def test_codes_read_back(labels: dict[int, str], separator: str, between: str) -> None:
    text = between.join(f"{code}{separator}{label}" for code, label in labels.items())
    assert parse_codes(text) == Codes({code: " ".join(label.split()) for code, label in labels.items()})
