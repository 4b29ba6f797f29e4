"""What formatting keeps, whatever stands there: values, comments, and itself."""

from collections import Counter
from dataclasses import replace
from pathlib import Path
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from regscribe import source
from regscribe.export.json import json_text
from regscribe.map_files import shipped
from regscribe.map_format import formatted
from regscribe.map_format.tokens import comments_of
from regscribe.pipeline import compile_map
from regscribe.source import Document

from .random_text import Layout

MAPS = sorted(shipped().glob("*/*.yaml"))


def read(text: str) -> Document:
    document, diagnostics = source.parse(text, name="map.yaml")
    assert document is not None, diagnostics
    return document


@settings(derandomize=True, max_examples=400)
@given(st.integers(0, 2**32))
def test_any_text_keeps_its_values_and_comments_and_is_formatted_once(seed: int) -> None:
    text = Layout(Random(seed)).text()  # noqa: S311 - a layout, no secret
    document, _ = source.parse(text, name="map.yaml")
    if document is None:
        return  # an indentation or a key that nobody reads

    once = formatted(document)

    again = read(once)
    assert repr(again.data) == repr(document.data)
    assert comments_of(once) == comments_of(document.text)
    assert formatted(again) == once


def test_most_of_these_texts_are_read() -> None:
    texts = [Layout(Random(seed)).text() for seed in range(200)]  # noqa: S311 - as above
    read_ones = [text for text in texts if source.parse(text, name="map.yaml")[0]]
    assert len(read_ones) > 80
    assert sum("#" in text for text in read_ones) > 40
    assert sum("\r" in text for text in read_ones) > 3


@pytest.mark.parametrize("path", MAPS, ids=lambda path: path.name)
def test_a_shipped_map_that_was_spoilt_comes_back(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    random = Random(path.name)  # noqa: S311 - as above

    spoilt = "\r\n".join(spoil(line, random) for line in text.split("\n"))

    assert spoilt != text
    assert formatted(read(spoilt)) == text


def spoil(line: str, random: Random) -> str:
    """More blanks where they mean nothing: behind lines, before comments, and, where no quote stands, in brackets."""
    if '"' not in line and "'" not in line and line.lstrip().startswith("- {") and line.endswith("}"):
        line = line.replace(", ", f"{' ' * random.randint(0, 2)},  ").replace("}", " }")
    if line.rstrip().endswith(("{}", "}", "]")):
        line += " " * random.randint(0, 3)
    return line


def test_a_formatted_map_compiles_to_the_same_model(tmp_path: Path) -> None:
    path = shipped() / "fdc/series-100.yaml"
    wild = tmp_path / "maps/fdc/series-100.yaml"
    wild.parent.mkdir(parents=True)
    wild.write_text(path.read_text(encoding="utf-8").replace("{at: ", "{ 'at':   "), encoding="utf-8")
    before = compile_map(wild).map
    assert before is not None

    wild.write_text(formatted(read(wild.read_text(encoding="utf-8"))), encoding="utf-8")

    after = compile_map(wild).map
    assert after is not None
    assert json_text([replace(after, content_hash=before.content_hash)]) == json_text([before])
    assert wild.read_text(encoding="utf-8") == path.read_text(encoding="utf-8")


@pytest.mark.parametrize("path", MAPS, ids=lambda path: path.name)
def test_a_shipped_map_is_formatted(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    assert formatted(read(text)) == text


def test_comments_are_counted_not_just_found() -> None:
    assert Counter(comments_of("a: 1 # x\n# x\nb: | # y\n  # no comment\n")) == {"# x": 2, "# y": 1}
