import io
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

WILD = "a: {  b: 1 }  # x\r\n"
TIDY = f"a: {{b: 1}}{' ' * 46}# x\n"


def typed(monkeypatch: pytest.MonkeyPatch, text: str) -> None:
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(text.encode())))


def test_files_are_formatted_in_their_place(cli: Callable[..., Any], oven: Path) -> None:
    oven.with_name("b.yaml").write_bytes(WILD.encode())
    result = cli("fmt")
    assert (result.code, result.err) == (0, "")
    assert result.out == "maps/acme/b.yaml formatted\n2 files: 1 formatted, 1 unchanged\n"
    assert oven.with_name("b.yaml").read_bytes() == TIDY.encode()


def test_check_shows_what_would_change_and_writes_nothing(cli: Callable[..., Any], oven: Path) -> None:
    oven.write_text("a:   1\n")
    result = cli("fmt", "--check")
    assert result.code == 1
    assert result.out == (
        "--- a/maps/acme/oven.yaml\n+++ b/maps/acme/oven.yaml\n@@ -1 +1 @@\n-a:   1\n+a: 1\n"
        "1 file: 1 to format, 0 unchanged\n"
    )
    assert oven.read_text() == "a:   1\n"


def test_check_of_what_is_formatted_exits_0(cli: Callable[..., Any], oven: Path) -> None:
    result = cli("fmt", "--check", oven)
    assert (result.code, result.out) == (0, "1 file: 0 to format, 1 unchanged\n")


def test_a_file_that_is_no_yaml_stays_and_the_others_are_formatted(cli: Callable[..., Any], oven: Path) -> None:
    oven.write_text("a: [1\n")
    oven.with_name("z.yaml").write_text("a:   1\n")
    result = cli("fmt")
    assert result.code == 1
    assert "maps/acme/oven.yaml:1:4" in result.err
    assert result.out.endswith("2 files: 1 formatted, 0 unchanged, 1 that cannot be read\n")
    assert oven.read_text() == "a: [1\n"
    assert oven.with_name("z.yaml").read_text() == "a: 1\n"


def test_libraries_are_formatted_too(cli: Callable[..., Any], oven: Path) -> None:
    library = oven.with_name("names.library.yaml")
    library.write_text("a:   1\n")
    assert cli("fmt").code == 0
    assert library.read_text() == "a: 1\n"


def test_standard_input_is_printed(cli: Callable[..., Any], monkeypatch: pytest.MonkeyPatch) -> None:
    typed(monkeypatch, WILD)
    result = cli("fmt", "-")
    assert (result.code, result.out, result.err) == (0, TIDY, "")


def test_standard_input_that_is_no_yaml_prints_nothing(
    cli: Callable[..., Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    typed(monkeypatch, "a: [1\n")
    result = cli("fmt", "-", "--stdin-filename", "maps/x.yaml")
    assert (result.code, result.out) == (1, "")
    assert "maps/x.yaml:1:4" in result.err


def test_standard_input_can_be_checked(cli: Callable[..., Any], monkeypatch: pytest.MonkeyPatch) -> None:
    typed(monkeypatch, TIDY)
    assert cli("fmt", "-", "--check").code == 0
    typed(monkeypatch, WILD)
    result = cli("fmt", "-", "--check", "--stdin-filename", "x.yaml")
    assert result.code == 1
    assert result.out.startswith("--- a/x.yaml\n+++ b/x.yaml\n")


def test_standard_input_stands_alone(cli: Callable[..., Any], oven: Path) -> None:
    assert cli("fmt", "-", oven).code == 2


def test_a_character_that_cannot_be_seen_is_printed_as_it_is(
    cli: Callable[..., Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    typed(monkeypatch, "a:   b\u200bc\n")
    assert cli("fmt", "-").out == "a: b\u200bc\n"


def test_a_new_map_is_formatted(cli: Callable[..., Any]) -> None:
    assert cli("new", "acme/oven-3").code == 0
    assert cli("fmt", "--check").code == 0
