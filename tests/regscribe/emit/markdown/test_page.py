"""The reference page is valid Markdown, its links lead somewhere, and hostile maps stay text."""

import ast
import os
import re
import subprocess
import sys
from collections.abc import Callable
from dataclasses import fields, is_dataclass, replace
from enum import Enum
from pathlib import Path
from typing import Any

import pytest
from markdown_it import MarkdownIt

from regscribe.emit.docs_index import render_index
from regscribe.emit.header import header
from regscribe.emit.markdown import render
from regscribe.evidence.index_row import card
from regscribe.model import Open, RegisterMap

ROOT = Path(__file__).parents[4]
MAPS = [path for path in sorted((ROOT / "maps").glob("*/*.yaml")) if not path.name.endswith(".library.yaml")]
HOSTILE = (
    "a|b <script>alert(1)</script>\n\n# `x` [x](javascript:y) 😀 \u202e -->\n| - | </details> "
    "${7*7} {{ 7*7 }} \"quoted' https://a.example"
)
FREE_TEXT = {
    "title", "maker", "description", "number", "date", "publisher", "name", "label", "reason", "meaning", "danger",
    "why", "what", "printed", "read", "where", "text", "section", "symbol", "persistence", "source", "notes", "serial",
}  # fmt: skip
TAGS = {
    "h1", "h2", "h3", "h4", "h5", "p", "a", "table", "thead", "tbody", "tr", "th", "td", "ul", "li", "code", "pre",
    "em", "strong", "blockquote", "br", "details", "summary", "img",
}  # fmt: skip


def hostile(value: Any) -> Any:
    """Replace every free text of a map; ids, paths, model names and orders of registers stay."""
    if isinstance(value, Open):
        return Open(HOSTILE)
    if isinstance(value, tuple) and not hasattr(value, "_fields"):
        return tuple(hostile(item) for item in value)
    if isinstance(value, tuple):
        plain = {name: hostile(item) for name, item in zip(value._fields, value, strict=True)}
        texts = {name: HOSTILE for name in FREE_TEXT & plain.keys() if isinstance(plain[name], str)}
        return type(value)(**plain | texts)
    if not is_dataclass(value) or isinstance(value, type | Enum):
        return value
    changed: dict[str, Any] = {}
    for item in fields(value):
        old = getattr(value, item.name)
        if item.name in FREE_TEXT and isinstance(old, str):
            changed[item.name] = HOSTILE
        elif item.name == "by_path":
            changed[item.name] = {}
        elif item.name == "notes":
            changed[item.name] = (HOSTILE,)
        else:
            changed[item.name] = hostile(old)
    return replace(value, **changed)


@pytest.fixture(scope="session", params=["small", *MAPS], ids=lambda item: item if isinstance(item, str) else item.stem)
def any_map(request: pytest.FixtureRequest, oven: RegisterMap, load: Callable[[Path], RegisterMap]) -> RegisterMap:
    return oven if request.param == "small" else load(request.param)


@pytest.fixture(scope="session")
def any_text(any_map: RegisterMap) -> str:
    return rendered(any_map)


@pytest.fixture(scope="session")
def any_page(any_text: str, markdown: MarkdownIt, parse: Callable[[str], Any]) -> Any:
    return parse(markdown.render(any_text))


def rendered(register_map: RegisterMap) -> str:
    return next(iter(render(register_map).values()))


def test_every_row_of_every_table_has_as_many_cells_as_its_headers(any_text: str, any_page: Any) -> None:
    assert all(len(set(table)) == 1 for table in any_page.tables)
    assert len(any_page.tables) == len(re.findall(r"^\|(?: --- \|)+$", any_text, re.MULTILINE))
    for block in re.findall(r"(?:^\|.*\n)+", any_text, re.MULTILINE):
        assert len({len(re.findall(r"(?<!\\)\|", row)) for row in block.splitlines()}) == 1, block


def test_every_link_leads_to_an_anchor_of_the_page(any_page: Any) -> None:
    assert any_page.links
    others = {link for link in any_page.links if link.endswith(".md")}
    assert {link for link in any_page.links if link.removeprefix("#") not in any_page.anchors} == others
    assert all((ROOT / "maps" / "fdc" / link).with_suffix(".yaml").is_file() for link in others)
    assert len(any_page.anchors) == len(set(any_page.anchors))


def lettered(path: str) -> str:
    """The path with the indexes of arrays as letters: `programs[i].segments[j].time`."""
    letters = iter("ij")
    return re.sub(r"\[\d+\]", lambda _: f"[{next(letters)}]", path)


def test_every_value_of_every_model_is_in_the_overview(any_map: RegisterMap, any_text: str) -> None:
    overview = any_text.split('<a id="overview">')[1].split('<a id="registers">', maxsplit=1)[0]
    paths = {lettered(register.path) for model in any_map.models for register in model.registers}
    assert {path for path in paths if f"`{path}`" not in overview} == set()
    rows = re.findall(r"^\| \d.*$", overview.split("Reserved by the manual")[0], re.MULTILINE)
    assert len(rows) == len(paths)


def test_a_hostile_map_stays_text(oven: RegisterMap, markdown: MarkdownIt, parse: Callable[[str], Any]) -> None:
    page = parse(markdown.render(rendered(hostile(oven))))
    assert page.tags <= TAGS
    assert page.attributes <= {"id", "href", "class", "style", "src", "alt"}
    assert all(link.startswith("#") for link in page.links)
    assert all(len(set(table)) == 1 for table in page.tables)
    assert {link for link in page.links if link[1:] not in page.anchors} == set()
    assert "<script>alert(1)</script>" in page.text
    assert "\u202e" not in page.text
    assert "49" not in page.text.split("alert(1)")[1][:120]


def test_the_examples_in_python_are_python(any_text: str, oven: RegisterMap) -> None:
    for text in (any_text, rendered(hostile(oven))):
        blocks = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
        assert len(blocks) == 2
        for block in blocks:
            ast.parse(block)


def test_the_page_begins_with_the_header_and_ends_with_one_line_end(any_map: RegisterMap, any_text: str) -> None:
    assert any_text.startswith(header(any_map, prefix="<!-- ", suffix=" -->") + "\n\n# ")
    assert any_text.endswith("\n")
    assert not any_text.endswith("\n\n")


def test_no_blank_line_is_doubled_outside_the_examples(any_text: str) -> None:
    assert "\n\n\n" not in re.sub(r"```python\n.*?```", "code", any_text, flags=re.DOTALL)
    assert not re.search(r"[ \t]$", any_text, re.MULTILINE)


def test_the_path_comes_from_the_id(oven: RegisterMap) -> None:
    assert list(render(oven)) == ["docs/acme/big-oven.md"]


def test_the_index_links_every_page(oven: RegisterMap, markdown: MarkdownIt, parse: Callable[[str], Any]) -> None:
    other = replace(oven, id="acme/another", title="A|nother <b>")
    pages = render_index([card(oven), card(other)])
    page = parse(markdown.render(pages["docs/README.md"]))
    assert page.links[:2] == ["acme/another.md", "acme/big-oven.md"]
    assert "A|nother <b>" in page.text
    assert render_index([card(other), card(oven)]) == pages


def test_the_index_of_a_hostile_map_stays_text(
    oven: RegisterMap, markdown: MarkdownIt, parse: Callable[[str], Any]
) -> None:
    page = parse(markdown.render(render_index([card(hostile(oven))])["docs/README.md"]))
    assert page.tags <= TAGS
    assert set(page.links) == {"acme/big-oven.md"}
    assert all(len(set(table)) == 1 for table in page.tables)
    assert "<script>alert(1)</script>" in page.text


def test_the_header_names_map_and_hash_and_no_date(oven: RegisterMap) -> None:
    first = header(replace(oven, content_hash="0123456789abcdef" * 4), prefix="# ", separator="\n# ")
    assert first == (
        "# Generated by regscribe from maps/acme/big-oven.yaml; do not edit; regenerate with: regscribe generate.\n"
        "# format 1, map sha256 0123456789abcdef"
    )


def test_no_id_can_end_the_comment_of_the_header(oven: RegisterMap) -> None:
    assert "-->" not in header(replace(oven, id="a-->\nb"))


SCRIPT = """
import sys
from pathlib import Path
from regscribe import lower, source
from regscribe.export.csv import csv_text
from regscribe.export.json import json_text
from regscribe.emit.markdown import render
found, _ = lower.lower(source.load(Path(sys.argv[1]))[0])
sys.stdout.buffer.write("".join([*render(found).values(), csv_text([found]), json_text([found])]).encode())
"""


def test_the_output_does_not_depend_on_the_hash_seed_the_directory_or_the_clock(
    tmp_path: Path, oven_path: Path
) -> None:
    outputs = set()
    for seed, zone in (("1", "UTC"), ("77", "Asia/Tokyo")):
        environment = os.environ | {"PYTHONHASHSEED": seed, "TZ": zone, "LC_ALL": "C"}
        where = tmp_path / seed
        where.mkdir()
        command = [sys.executable, "-c", SCRIPT, str(oven_path)]
        outputs.add(subprocess.run(command, env=environment, cwd=where, capture_output=True, check=True).stdout)  # noqa: S603 (our own script)
    assert len(outputs) == 1
