"""Every recipe compiles without a finding, and its table is what comes over a wire that knows no map."""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from regscribe import source
from regscribe.schema import schema_json
from regscribe_runtime import RegscribeError

from .suite import Json, build, diagnose, whole_map, words_of
from .wire import Memory, Server

PAGE = (Path(__file__).parents[2] / "docs" / "recipes.md").read_text(encoding="utf-8")
BLOCK = re.compile(r"^```yaml\n(.*?)^```$", re.DOTALL | re.MULTILINE)
HELD = re.compile(r"(\w+) ([0-9:]+): `([0-9A-F ]+)`")


class Row(NamedTuple):
    """One line of a recipe's table: what the device holds, what a program asks, and what comes."""

    recipe: str
    text: str
    holds: str
    asks: str
    gets: str

    def __repr__(self) -> str:
        return f"{self.recipe}: {self.asks}"


def recipes() -> Iterator[tuple[str, str, str]]:
    """The title, the map and the rest of every recipe."""
    for section in PAGE.split("\n## More\n")[0].split("\n## ")[1:]:
        title, _, body = section.partition("\n")
        found = BLOCK.findall(body)
        assert len(found) == 1, f"{title}: one block of YAML"
        yield title, found[0], BLOCK.sub("", body)


def rows() -> Iterator[Row]:
    """Every line of every table."""
    for title, text, rest in recipes():
        lines = [line.strip("| ").split(" | ") for line in rest.splitlines() if line.startswith("|")]
        for cells in lines[2:]:
            holds, asks, gets = cells if len(cells) == 3 else ("", *cells)
            yield Row(title, text, holds, asks.strip("`"), gets)


def _parts(text: str) -> Json:
    document, found = source.parse(text, name="recipe.yaml")
    assert document is not None, found
    parts: Json = document.data
    return parts


def _memory(memory: Memory, holds: str) -> None:
    memory.clear()
    for space, address, text in HELD.findall(holds):
        part, _, inside = address.rpartition(":")  # of a file
        memory.put(space, int(part or 0) << 16 | int(inside), words_of(text))


@pytest.fixture(scope="module")
def server() -> Iterator[Server]:
    with Server() as running:
        yield running


@pytest.mark.parametrize(("title", "text"), [(title, text) for title, text, _ in recipes()], ids=lambda each: each[:30])
def test_a_recipe_is_a_sound_map(title: str, text: str) -> None:
    register_map, found = diagnose(whole_map(_parts(text)))

    assert register_map is not None, (title, found)
    assert found == [], title


ELSEWHERE = {"extends", "uses", "programs", "process"}
"""Keys with a page of their own, or for maps of several files."""


def _keys(node: Any) -> Iterator[str]:
    """Every key of a map."""
    for each in node.values() if isinstance(node, dict) else node if isinstance(node, list) else ():
        yield from _keys(each)
    if isinstance(node, dict):
        yield from map(str, node)


def test_every_key_that_the_index_by_task_names_has_a_recipe() -> None:
    used = {key for _, text, _ in recipes() for key in _keys(_parts(text))}
    schema = schema_json()
    tables = [schema, *schema["$defs"].values()]
    named = {key for table in tables for key, one in table.get("properties", {}).items() if "x-task" in one}

    assert named - used == ELSEWHERE


def _driver(row: Row, server: Server, givens: str) -> Any:
    built = build(whole_map(_parts(row.text)))
    model = built.map.models[0]
    stated = eval(f"dict({givens})")  # noqa: S307  an expression of our own page
    return getattr(built.module, model.class_name).tcp("127.0.0.1", port=server.port, unit=1, **stated)


@pytest.mark.parametrize("row", list(rows()), ids=repr)
def test_what_a_recipe_says_comes_over_the_wire(row: Row, server: Server) -> None:
    _memory(server.memory, row.holds)
    server.memory.long = range(0x10000 if "enron" in row.text else 0)
    asks, _, givens = row.asks.partition("` with `")
    with _driver(row, server, givens) as device:
        names = {name: getattr(device, name) for name in dir(device) if not name.startswith("_")}
        if row.gets.startswith("raises"):
            with pytest.raises(RegscribeError) as raised:
                eval(asks, {}, names)  # noqa: S307  an expression of our own page
            assert row.gets == f"raises `{raised.type.__name__}`"
            return
        value = eval(asks, {}, names)  # noqa: S307  as above
    written = HELD.fullmatch(row.gets)
    if written:
        words = words_of(written[3])
        assert server.memory.get(written[1], int(written[2]), len(words)) == words
    else:
        assert repr(value) == row.gets.strip("`")
