"""Files are read with the place of each mistake, and what is written is read back as it was, or nothing is."""

import os
from decimal import Decimal
from errno import ENOSPC
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from regscribe import files, source
from regscribe.source.utf8 import find_invisible

VISIBLE = st.characters(exclude_categories=["Cc", "Cs"]).filter(lambda one: find_invisible(one) is None)
"""What RS0104 lets into a file: no byte order or direction marks."""
TEXTS = st.text(VISIBLE, max_size=20) | st.sampled_from(
    ["off", "yes", "~", "null", "1e3", "0x1F", "010", "12:30", "-", "{a}", "1_000", ".inf", "2026-11-22", "", " x "]
)
VALUES = st.recursive(
    st.booleans() | st.integers(-(10**12), 10**12) | st.floats(allow_nan=False, allow_infinity=False, width=32) | TEXTS,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(TEXTS.filter(bool), inner, max_size=3),
    max_leaves=8,
)


@given(st.dictionaries(TEXTS.filter(bool), VALUES, max_size=4))
def test_what_is_dumped_is_read_back_by_the_rules_of_yaml_1_2(data: dict[str, object]) -> None:
    document, found = source.parse(files.dump(data).encode(), name="dumped")
    assert found == []
    assert document is not None
    assert as_floats(document.data) == data


def as_floats(value: object) -> object:
    """Numbers with a point are read exactly, as decimals."""
    if isinstance(value, dict):
        return {key: as_floats(one) for key, one in value.items()}
    if isinstance(value, list):
        return [as_floats(one) for one in value]
    return float(value) if isinstance(value, Decimal) else value


def test_a_mapping_on_one_line_reads_as_the_same_mapping() -> None:
    text = files.dump({"a": files.OneLine({"b": 1, "c": ["d", "off"]})}, remarks=("one", "two"))
    assert text == "# one\n# two\na: {b: 1, c: [d, 'off']}\n"


def test_every_mistake_of_a_file_is_told_with_its_place(tmp_path: Path) -> None:
    file = tmp_path / "wrong.yaml"
    file.write_text("format: 2\nbackup: {map: x}\n", encoding="utf-8")
    with pytest.raises(files.FileError, match=r"is no backup") as error:
        files.read(file, language="backup", what="backup")
    assert "wrong.yaml:1:9" in str(error.value)
    assert "wrong.yaml:2:" in str(error.value)


def test_a_file_that_is_too_large_is_not_read(tmp_path: Path) -> None:
    file = tmp_path / "large.yaml"
    with file.open("wb") as open_file:
        open_file.truncate(9_000_000)
    with pytest.raises(files.FileError, match="9000000 bytes"):
        files.read(file, language="backup", what="backup")


def test_a_full_disk_leaves_what_was_there(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(_: int) -> None:
        raise OSError(ENOSPC, "No space left on device")

    file = tmp_path / "kept.yaml"
    files.save(file, "first")
    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(files.FileError, match="No space left"):
        files.save(file, "second")
    assert [(one.name, one.read_text(encoding="utf-8")) for one in tmp_path.iterdir()] == [("kept.yaml", "first")]


def test_a_pipe_is_written_to_and_stays(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    reader = os.open(pipe, os.O_RDWR | os.O_NONBLOCK)  # without a byte in it the read fails in place of waiting
    files.save(pipe, "through")
    assert os.read(reader, 100) == b"through"
    os.close(reader)
    assert pipe.is_fifo()


def test_what_a_link_leads_to_is_written_and_the_link_stays(tmp_path: Path) -> None:
    (tmp_path / "real.yaml").write_text("first", encoding="utf-8")
    link = tmp_path / "link.yaml"
    link.symlink_to("real.yaml")
    files.save(link, "second")
    assert link.is_symlink()
    assert (tmp_path / "real.yaml").read_text(encoding="utf-8") == "second"


def test_a_loop_of_links_cannot_be_written(tmp_path: Path) -> None:
    loop = tmp_path / "loop"
    loop.symlink_to("loop")
    with pytest.raises(files.FileError, match="cannot be written"):
        files.save(loop, "never")


def test_a_new_file_is_not_put_over_one_that_another_wrote_meanwhile(tmp_path: Path) -> None:
    file = tmp_path / "map.yaml"
    files.save(file, "first", new=True)
    with pytest.raises(files.FileError, match="File exists"):
        files.save(file, "second", new=True)
    assert [(one.name, one.read_text(encoding="utf-8")) for one in tmp_path.iterdir()] == [("map.yaml", "first")]
