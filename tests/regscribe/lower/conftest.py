"""Maps of a few lines, lowered by the phases that stand before."""

from collections.abc import Callable
from textwrap import dedent

import pytest

from regscribe.lower import lower
from regscribe.model import Diagnostic, Register, RegisterMap
from regscribe.schema import validate
from regscribe.source import parse

HEAD = """\
format: 1
map: {id: example/controller, title: Controller, maker: Example, class_prefix: Example}
manual: {title: Controller Manual, number: EX-1}
models: {A1: {}, B-2: {}}
"""

Result = tuple[RegisterMap | None, list[Diagnostic]]
Tried = Callable[[str], Result]
Lowered = Callable[[str], RegisterMap]
Registers = Callable[..., dict[str, Register]]


def attempt(body: str) -> Result:
    document, mistakes = parse(HEAD + dedent(body), name="maps/example/controller.yaml")
    assert document is not None, mistakes
    assert validate(document) == []
    return lower(document)


@pytest.fixture
def tried() -> Tried:
    """Lower a map given without its head (models A1 and B-2): the map, if it is one, and the diagnostics."""
    return attempt


@pytest.fixture
def lowered() -> Lowered:
    """Lower a map that has no mistake."""

    def run(body: str) -> RegisterMap:
        found, mistakes = attempt(body)
        assert mistakes == []
        assert found is not None
        return found

    return run


@pytest.fixture
def registers(lowered: Lowered) -> Registers:
    """Lower lines of registers, with tables of the map before them, and give those of one model by path."""

    def run(
        lines: str, *, tables: str = "", each: str = "{access: rw, type: int16}", model: str = "A1"
    ) -> dict[str, Register]:
        group = f"groups:\n  - id: main\n    name: Main\n    source: '1.1'\n    each: {each}\n    registers:\n"
        indented = "".join(f"      {line}\n" for line in dedent(lines).strip("\n").splitlines())
        return {found.path: found for found in lowered(dedent(tables) + group + indented).model(model).registers}

    return run
