"""The reference of the map language: up to date, complete, and sound Markdown."""

import re
from pathlib import Path
from typing import Any

import pytest
from markdown_it import MarkdownIt

from regscribe.emit.language_index import BY_TASK, SUBJECTS
from regscribe.emit.language_index import KNOWN_UNITS as KNOWN_UNITS_HEADING
from regscribe.emit.language_reference import render
from regscribe.model.units import KNOWN_UNITS
from regscribe.schema import schema_json

PAGE = Path(__file__).parents[2] / "docs" / "language.md"


def small(**properties: Any) -> dict[str, Any]:
    """A schema with one definition `thing` that has `properties`."""
    thing = {"description": "A thing.", "type": "object", "properties": properties, "x-examples": [{}]}
    return {"description": "A file.", "type": "object", "properties": {}, "x-examples": [], "$defs": {"thing": thing}}


def key(**keywords: Any) -> dict[str, Any]:
    return {"title": "key", "description": "What it does.", "x-examples": [1], "type": "integer"} | keywords


def test_the_committed_page_is_what_the_schema_says() -> None:
    assert PAGE.read_text(encoding="utf-8") == render(schema_json())


def test_every_key_of_the_language_has_a_row_or_stands_in_a_list_of_borrowed_keys() -> None:
    page = render(schema_json())
    for name, definition in schema_json()["$defs"].items():
        section = page.split(f"\n## {name.replace('_', ' ').capitalize()}\n")[1].split("\n## ")[0]
        assert [one for one in definition.get("properties", {}) if f"`{one}`" not in section] == [], name


def test_every_link_leads_to_a_heading() -> None:
    page = render(schema_json())
    headings = {
        line.removeprefix("## ").lower().replace(" ", "-") for line in page.splitlines() if line.startswith("## ")
    }
    assert set(re.findall(r"\]\(#([^)]*)\)", page)) <= headings


def _of_recipes(pattern: str) -> list[str]:
    return re.findall(pattern, PAGE.with_name("recipes.md").read_text(encoding="utf-8"), re.MULTILINE)


def test_every_link_of_the_recipes_leads_to_one() -> None:
    titles = {re.sub(r"[^a-z0-9 -]", "", title.lower()).replace(" ", "-") for title in _of_recipes("^## (.*)$")}
    assert set(_of_recipes(r"\]\(#([^)]*)\)")) <= titles


def test_the_index_by_task_has_something_for_every_subject() -> None:
    index = render(schema_json()).split(f"\n## {BY_TASK}\n")[1].split("\n## ")[0]
    assert [one.count("\n- that ") >= 3 for one in index.split("\n**")[1:]] == [True] * len(SUBJECTS)


PLAIN = {
    *("at", "name", "id", "symbol", "printed", "description", "source", "views", "range_decimals", "except"),
}
"""Keys of a register that every reader of the tutorial knows, or that belong to another."""


def test_every_key_of_a_register_says_in_x_task_what_it_is_for() -> None:
    properties = schema_json()["$defs"]["register"]["properties"]
    assert {key for key, details in properties.items() if "x-task" not in details} - PLAIN == set()


def test_the_known_units_are_listed() -> None:
    listed = render(schema_json()).split(f"\n## {KNOWN_UNITS_HEADING}\n")[1]
    assert [symbol for symbol in KNOWN_UNITS if f"`{symbol}`" not in listed] == []


def test_headings_are_unique() -> None:
    headings = [line for line in render(schema_json()).splitlines() if line.startswith("#")]
    assert len(headings) == len(set(headings))


def test_every_row_of_every_table_has_all_cells() -> None:
    page = render(schema_json())
    rows = [line for line in page.splitlines() if line.startswith("| `")]
    tokens = MarkdownIt().enable("table").parse(page)
    assert sum(token.type == "tr_open" for token in tokens) - sum(
        token.type == "thead_open" for token in tokens
    ) == len(rows)
    assert {len(re.split(r"(?<!\\)\|", row)) for row in rows} == {8}


@pytest.mark.parametrize(
    ("details", "cell"),
    [
        (key(), "| `k` | whole number |  |  | What it does. | `1` |"),
        (key(minimum=1, maximum=9), "| whole number (at least 1, at most 9) |"),
        (key(description="What it does. Default: 7."), "|  | 7 | What it does. |"),
        (key(enum=["a", "b"]), "| `a`, `b` |"),
        (key(type=["integer", "string"]), "| whole number or text |"),
        (key(description="Either a|b."), "| Either a\\|b. |"),
        ({"$ref": "#/$defs/thing", "x-examples": [{}]}, "| [thing](#thing) |  |  | A thing. | `{}` |"),
    ],
)
def test_a_key_is_a_row_of_form_default_meaning_and_example(details: dict[str, Any], cell: str) -> None:
    assert cell in render(small(k=details))
