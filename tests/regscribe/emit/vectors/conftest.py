"""Maps of a few lines and their vectors."""

from collections.abc import Callable, Iterator
from pathlib import Path
from textwrap import dedent, indent
from typing import Any

import pytest

from regscribe.emit.vectors import document
from regscribe.lower import lower
from regscribe.model import RegisterMap
from regscribe.schema import validate
from regscribe.source import parse

HEAD = """\
format: 1
map: {id: example/controller, title: Controller, maker: Example, class_prefix: Example}
manual: {title: Controller Manual}
models: {A1: {}, B2: {}}
"""
GROUP = """\
groups:
  - id: main
    name: Main
    source: '1'
    each: {access: rw, type: int16}
    registers:
"""
ROOT = Path(__file__).parents[4]

Json = dict[str, Any]
Compiled = Callable[..., RegisterMap]


class Cases:
    """The vector sets of a map, with the questions that tests ask."""

    def __init__(self, register_map: RegisterMap) -> None:
        self.document: Json = document(register_map)

    def set_of(self, path: str, model: str = "A1") -> Json:
        """The set that holds for a register."""
        return next(
            entry
            for entry in self.document["sets"]
            for place in entry["registers"]
            if place["path"] == path and model in place["models"]
        )

    def cases(self, path: str, *, view: str = "base", **state: str) -> Iterator[Json]:
        """The cases of a register in a view whose state has these values."""
        for case in self.set_of(path)["cases"]:
            if case["view"] == view and state.items() <= case.get("state", {}).items():
                yield case

    def vectors(self, path: str, what: str, *, view: str = "base", **state: str) -> list[Json]:
        """All decode, encode or refuse vectors of these cases."""
        return [vector for case in self.cases(path, view=view, **state) for vector in case.get(what, ())]

    def values(self, path: str, *, view: str = "base", **state: str) -> dict[tuple[int, ...], str]:
        """Words -> value, or fault, or outcome."""
        vectors = self.vectors(path, "decode", view=view, **state)
        return {tuple(one["words"]): one.get("value") or one.get("fault") or one.get("outcome", "") for one in vectors}

    def words(self, path: str, *, view: str = "base", **state: str) -> dict[str, list[int]]:
        """Value -> words, of values that need no rounding."""
        vectors = self.vectors(path, "encode", view=view, **state)
        return {one["value"]: one["words"] for one in vectors if not one.get("rounded")}

    def reasons(self, path: str, *, view: str = "base", **state: str) -> dict[str, str]:
        """Value -> why it is refused."""
        return {one["value"]: one["reason"] for one in self.vectors(path, "refuse", view=view, **state)}


@pytest.fixture
def compiled() -> Compiled:
    """Lower lines of registers, with tables of the map before them and parts behind them."""

    def run(lines: str, *, tables: str = "", after: str = "") -> RegisterMap:
        registers = indent(dedent(lines).strip("\n"), "      ")
        text = HEAD + dedent(tables) + GROUP + registers + "\n" + dedent(after)
        found, mistakes = parse(text, name="maps/example/controller.yaml")
        assert found is not None, mistakes
        assert validate(found) == []
        register_map, mistakes = lower(found)
        assert register_map is not None, mistakes
        return register_map

    return run


@pytest.fixture
def vectors_of(compiled: Compiled) -> Callable[..., Cases]:
    """The vectors of such a map."""

    def run(lines: str, **more: str) -> Cases:
        return Cases(compiled(lines, **more))

    return run
