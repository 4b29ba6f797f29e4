"""`regscribe browse` writes one page, or nothing."""

from pathlib import Path

import pytest

from regscribe.cli.app import run


def test_a_page_is_written_to_a_file(tmp_path: Path) -> None:
    out = tmp_path / "registers.html"
    assert run(["browse", "fdc/series-100", "-o", str(out)]) == 0
    text = out.read_text("utf-8")
    assert text.startswith("<!doctype html>")
    assert "FDC" in text or "Future Design" in text


def test_without_a_file_it_goes_to_standard_output(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["browse", "athena/platinum-m300", "athena/platinum-m400"]) == 0
    assert "Registers of 2 maps" in capsys.readouterr().out


def test_a_map_with_errors_gives_no_page(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    wrong, out = tmp_path / "wrong.yaml", tmp_path / "registers.html"
    wrong.write_text("format: 1\n", encoding="utf-8")
    assert run(["browse", str(wrong), "-o", str(out)]) == 1
    assert "nothing was written" in capsys.readouterr().err
    assert not out.exists()


def test_a_folder_is_no_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["browse", "athena/platinum-m300", "-o", str(tmp_path)]) != 0
    assert str(tmp_path) in capsys.readouterr().err
