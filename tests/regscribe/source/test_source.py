"""Text to plain values: YAML 1.2 scalars, refusals with their place, bounds on time and memory."""

import hashlib
import os
from collections.abc import Callable
from decimal import Decimal
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from regscribe.source import Document, load, parse
from regscribe.source.findings import MAX_FINDINGS


def value_of(scalar: str) -> object:
    """The value of `x` in a file that holds `x: SCALAR`."""
    document, found = parse(f"x: {scalar}\n", name="m.yaml")
    assert document is not None, found
    return document.data["x"]


def only(content: str | bytes) -> str:
    """The single finding in a text, as `rule line:column`."""
    document, found = parse(content, name="m.yaml")
    assert document is None
    assert len(found) == 1, found
    return f"{found[0].rule} {found[0].span.line}:{found[0].span.column}"


def read(text: str) -> Document:
    document, found = parse(text, name="m.yaml")
    assert document is not None, found
    return document


@pytest.mark.parametrize(
    ("scalar", "value"),
    [
        ("true", True),
        ("false", False),
        ("null", None),
        ("~", None),
        ("", None),
        ("0", 0),
        ("-7", -7),
        ("+7", 7),
        ("0x1F", 31),
        ("0o17", 15),
        ("1e3", Decimal("1e3")),
        ("-0.50", Decimal("-0.50")),
        (".5", Decimal("0.5")),
    ],
)
def test_plain_scalars_have_the_values_of_yaml_1_2(scalar: str, value: object) -> None:
    found = value_of(scalar)
    assert (type(found), found) == (type(value), value)


@pytest.mark.parametrize(
    "text",
    ["off", "on", "yes", "No", "True", "NULL", "12:30", "2004-06-01", "1..8", "0..0.9", "16C", "01.31.00", "=", "-x"],
)
def test_words_times_dates_and_ranges_stay_texts(text: str) -> None:
    assert value_of(text) == text


@pytest.mark.parametrize(
    "text", ["010", "-010", "00", "1_000", "0b101", "0X1F", "-0x1", ".inf", "-.inf", ".nan", "1e401", "9" * 101]
)
def test_a_number_that_readers_take_differently_is_refused(text: str) -> None:
    assert only(f"x: {text}\n") == "RS0116 1:4"


def test_a_refused_number_in_quotes_is_a_text() -> None:
    assert value_of("'010'") == "010"


def test_a_section_number_keeps_its_last_zero() -> None:
    assert str(value_of("4.10")) == "4.10"


@settings(deadline=None)
@given(st.integers() | st.decimals(allow_nan=False, allow_infinity=False, places=4))
def test_every_decimal_number_is_read_exactly(number: int | Decimal) -> None:
    text = f"{number:f}" if isinstance(number, Decimal) else str(number)
    if len(text) <= 100:
        assert value_of(text) == number


def test_codes_are_text_keys_in_decimal() -> None:
    assert list(read("{0x10: a, 7: b, -1: c, off: d, '010': e, 1.50: f}").data) == [
        "16",
        "7",
        "-1",
        "off",
        "010",
        "1.50",
    ]


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        ("a: 1\nb: {a: 1, a: 2}\n", "RS0109 2:11"),
        ("16: a\n0x10: b\n", "RS0109 2:1"),
        ("a: 1\n? [b]\n: 2\n", "RS0110 2:3"),
        ("a: &x b\n*x : 2\n", "RS0110 2:1"),
        ("? \n: 1\n", "RS0110 1:2"),
        ("a: !foo 1\n", "RS0111 1:4"),
        ("a: !!int one\n", "RS0111 1:4"),
        ("a: !!set {b}\n", "RS0111 1:4"),
        ("a: &x {b: 1}\nc:\n  <<: *x\n", "RS0112 3:3"),
        ("a: *b\n", "RS0114 1:4"),
        ("a: &b [*b]\n", "RS0114 1:8"),
        ("a: 1\n---\nb: 1\n", "RS0108 2:1"),
        ("a: 1\n...\nb: 1\n", "RS0108 3:1"),
        ("%TAG ! tag:example.org,2000:\n---\na: 1\n", "RS0118 1:1"),
        ("a:\n  - b\n\t- c\n", "RS0106 3:1"),
        ("a: 'b\n", "RS0105 1:4"),
        ("a: [b\nc: d\n", "RS0105 1:4"),
        ("a: {b: c", "RS0105 1:4"),
        ("a: {b: c\n\n\n", "RS0105 1:4"),
        ("a: {b: [c,", "RS0105 1:8"),
        ("a: b: c\n", "RS0105 1:5"),
        ("a: 1\nb\nc: 2\n", "RS0105 2:1"),
        ("a: @b\n", "RS0105 1:4"),
        ("", "RS0107 1:1"),
        ("# nothing\n", "RS0107 1:1"),
        ("---\n", "RS0107 1:1"),
        ("a: b\x07c\n", "RS0104 1:5"),
        ("a: b\x00c\n", "RS0104 1:5"),
        ("a: b\u202ec\n", "RS0104 1:5"),
        ("a: b\u2066c\n", "RS0104 1:5"),
        ('a: "b\\u202e"\n', "RS0104 1:4"),
        ('a: "\\0"\n', "RS0104 1:4"),
        ("a: b\ud800\n", "RS0104 1:5"),
        ("a: " + "[" * 80, "RS0115 1:67"),
        ("a: " + "b" * 100_001, "RS0117 1:4"),
        ("a: 1\nb: °C\n".encode("latin-1"), "RS0103 2:4"),
        ("a: 1\n".encode("utf-16"), "RS0103 1:1"),
        ("a: 1\n".encode("utf-16-be"), "RS0103 1:1"),
        ("a: 1\n".encode("utf-32"), "RS0103 1:1"),
    ],
)
def test_what_cannot_be_read_in_one_sense_is_refused_at_its_place(content: str | bytes, expected: str) -> None:
    assert only(content) == expected


@pytest.mark.parametrize(
    ("row", "place", "said", "advice"),
    [
        (
            "{at: 1, name: A, ",
            "2:5",
            "the `{` of line 2, column 5 is not closed before line 3",
            "`}` at the end of line 2",
        ),
        (
            "{at: 1, name: A",
            "2:5",
            "the `{` of line 2, column 5 is not closed before line 3",
            "`}` at the end of line 2",
        ),
        ("{at: 1,\n     name: A # }", "2:5", "`{` of line 2, column 5 is not closed before line 4", "end of line 3"),
        ("{at: 1, enum: {0: a", "2:19", "the `{` of line 2, column 19 is not closed before line 3", "`}}` at the end"),
        (
            "{at: [1, 2, ",
            "2:10",
            "the `[` of line 2, column 10 is not closed before line 3",
            "`]}` at the end of line 2",
        ),
        ("{at: [1, name: A}", "2:10", "`[` of line 2, column 10 is not closed before the `}` of line 2", "write `]`"),
        (
            "{at: 1, name: 'A}\n  - {at: 3, name: 'C'}",
            "2:19",
            "the `'` of line 2, column 19 is not closed",
            "write `'`",
        ),
        ("{at: 1, name: A}}", "2:21", "a `}` that closes nothing", "delete it"),
        ("{at: 1 name: A}", "2:12", "a `,` is missing before this", "write `,` in front of it"),
        ("{at: 1, name: Main: A}", "2:23", "a `: ` where no key can stand", "in quotes"),
        ("{at: 1, enum: {0: a} unit: s}", "2:26", "a `,` is missing before this", "write `,` in front of it"),
    ],
)
def test_what_is_not_closed_is_named_and_not_the_row_below(row: str, place: str, said: str, advice: str) -> None:
    _, found = parse(f"rows:\n  - {row}\n  - {{at: 2, name: B}}\n", name="m.yaml")
    assert [f"{one.span.line}:{one.span.column}" for one in found] == [place]
    assert said in found[0].message
    assert advice in found[0].help


def test_what_is_not_closed_at_the_end_of_a_file_is_named() -> None:
    _, found = parse("rows:\n  - {at: 1, name: A, \n", name="m.yaml")
    assert found[0].message == "the `{` of line 2, column 5 is not closed before the end"
    assert found[0].help == "write `}` at the end of line 2"


def test_brackets_that_go_on_without_indentation_are_read() -> None:
    assert read("{\n'a': [1,\n2],\n'b': 3}\n").data == {"a": [1, 2], "b": 3}


def test_a_duplicate_key_names_the_first_one() -> None:
    _, found = parse("a: 1\nb: 2\na: 3\n", name="m.yaml")
    assert [str(other.span) for other in found[0].related] == ["m.yaml:1:1"]


def test_all_mistakes_are_found_in_one_run_in_the_order_of_the_file() -> None:
    _, found = parse("a: 010\nb: 1\nb: !x 2\nc: *d\n", name="m.yaml")
    assert [(each.rule, each.span.line) for each in found] == [
        ("RS0116", 1),
        ("RS0109", 3),
        ("RS0111", 3),
        ("RS0114", 4),
    ]


def test_every_finding_says_what_to_do() -> None:
    _, found = parse("a: 010\nb: 1\nb: !x 2\nc: *d\n? [a]\n: 1\n", name="m.yaml")
    assert all(each.help and each.message for each in found)


def test_findings_without_end_stop_with_a_word_about_it() -> None:
    _, found = parse("a: 1\n" * 10_000, name="m.yaml")
    assert len(found) == MAX_FINDINGS + 1
    assert "RS0119" in {each.rule for each in found}


def test_an_alias_repeats_a_value_but_has_its_own_place() -> None:
    document = read("a: &x {b: 1}\nc: *x\n")
    assert document.data == {"a": {"b": 1}, "c": {"b": 1}}
    assert (document.span(("c",)).line, document.span(("c", "b")).line) == (2, 1)


def test_spans_of_values_and_keys_count_from_one_and_end_exclusively() -> None:
    document = read("a:\n  - {at: 12, name: °C}\n")
    value, key = document.span(("a", 0, "name")), document.key_span(("a", 0, "name"))
    assert (value.line, value.column, value.end_column) == (2, 20, 22)
    assert (key.line, key.column, key.end_column) == (2, 14, 18)


def test_a_block_mapping_ends_with_its_last_value() -> None:
    span = read("a:\n  b: 1\n  c: 23\n\n# x\nd: 1\n").span(("a",))
    assert (span.line, span.column, span.end_line, span.end_column) == (2, 3, 3, 8)


def test_a_value_that_is_not_there_is_looked_for_above() -> None:
    document = read("a:\n  b: 1\n")
    assert document.span(("a", "z", 3)) == document.span(("a",))
    assert document.key_span(("a", "z")) == document.span(("a",))


def test_byte_order_mark_and_line_ends_do_not_move_places() -> None:
    document, found = parse(b"\xef\xbb\xbfa: 1\r\nb: 2\r\n", name="m.yaml")
    assert document is not None, found
    assert (document.text, document.key_span(("a",)).column, document.span(("b",)).line) == ("a: 1\nb: 2\n", 1, 2)


def test_the_content_hash_is_that_of_the_bytes() -> None:
    assert read("a: 1\n").content_hash == hashlib.sha256(b"a: 1\n").hexdigest()


@pytest.mark.parametrize(
    "content",
    [
        "[" + "1," * 2_000_000 + "]",
        "a: &a [1,1,1,1,1,1,1,1,1]\n"
        + "".join(f"{b}: &{b} [{','.join(['*' + a] * 9)}]\n" for a, b in zip("abcdefgh", "bcdefghi", strict=True)),
        "x: &x '" + "y" * 90_000 + "'\nz: [" + "*x," * 100_000 + "]\n",
    ],
    ids=["long list", "aliases of aliases", "aliases of a long text"],
)
def test_values_without_number_are_refused(content: str) -> None:
    assert only(content).startswith("RS0113")


@pytest.mark.parametrize(
    "content",
    [
        "[" * 4_000_000,
        "a: " * 2_000_000,
        "? " * 4_000_000,
        "\n" * 8_000_000,
        "\t\n" * 4_000_000,
        "a: '" + "b" * 8_000_000,
        "%T x\n" * 1_600_000,
    ],
    ids=["brackets", "colons", "marks", "empty lines", "tabs", "quote", "directives"],
)
def test_eight_megabytes_of_nonsense_are_refused(content: str) -> None:
    """A quadratic reader would be stopped: see `HANG_SECONDS`."""
    document, found = parse(content, name="m.yaml")
    assert document is None
    assert found


@settings(deadline=None)
@given(
    st.text(alphabet=st.sampled_from("ab01:-?[]{},&*!|>'\"%@#<~. \t\n\\x\u202e\x07"), max_size=60)
    | st.binary(max_size=40)
)
def test_no_text_and_no_bytes_give_anything_but_a_document_or_findings(content: str | bytes) -> None:
    document, found = parse(content, name="m.yaml")
    assert (document is None) == bool(found)


def test_a_file_is_named_relative_to_the_working_directory(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "m.yaml").write_text("a: 1\na: 2\n")
    monkeypatch.chdir(tmp_path)
    _, found = load(tmp_path / "m.yaml")
    assert str(found[0].span) == "m.yaml:2:1"


def _missing(folder: Path) -> Path:
    return folder / "none.yaml"


def _directory(folder: Path) -> Path:
    return folder


def _pipe(folder: Path) -> Path:
    os.mkfifo(folder / "pipe")
    return folder / "pipe"


def _endless_name(folder: Path) -> Path:
    return folder / ("n" * 5000)


def _nul(folder: Path) -> Path:
    return folder / "a\0b"


@pytest.mark.parametrize("make", [_missing, _directory, _pipe, _endless_name, _nul])
def test_what_is_no_readable_file_is_a_finding(make: Callable[[Path], Path], tmp_path: Path) -> None:
    document, found = load(make(tmp_path))
    assert document is None
    assert [each.rule for each in found] == ["RS0101"]


def test_a_file_of_fifty_megabytes_is_refused_from_its_size(tmp_path: Path) -> None:
    path = tmp_path / "large.yaml"
    with path.open("wb") as file:
        file.truncate(50_000_000)
    _, found = load(path)
    assert [each.rule for each in found] == ["RS0102"]
    assert "50,000,000" in found[0].message
