"""The process of a library or a base in the maps that build on it."""

from collections.abc import Callable
from pathlib import Path
from textwrap import dedent

import pytest

from regscribe.model import RegisterMap

Found = Callable[[Path], RegisterMap]
Family = Callable[..., RegisterMap]

LIBRARY = """\
format: 1
library: {id: acme/control, title: How they control}
process: {value: temperature, setpoint: goal, outputs: [{percent: heat, except: [B]}, {percent: cool, models: [B]}]}
"""
USER = """\
format: 1
map: {id: acme/oven, title: Oven, maker: Acme, class_prefix: Acme}
manual: {title: M, number: N-1}
models: {A: {}, B: {}}
uses: [acme/control]
groups:
  - id: main
    name: Main
    source: "1"
    each: {access: rw, type: int16}
    registers:
      - {at: 0, name: Temperature}
      - {at: 1, name: Goal}
      - {at: 2, name: Heat}
      - {at: 3, name: Cool}
"""


@pytest.fixture
def family(maps: Callable[[str, str], Path], found: Found) -> Family:
    """A map that uses the library, with more lines; or with `models`, one that extends it under other names."""

    def build(more: str = "", *, models: str = "", extension: str = "") -> RegisterMap:
        maps("acme/control.library", LIBRARY)
        oven = maps("acme/oven", USER + dedent(more))
        if not models:
            return found(oven)
        head = "format: 1\nmap: {id: omega/oven, title: O, maker: Omega, class_prefix: Omega}\nextends: acme/oven\n"
        return found(maps("omega/oven", f"{head}models: {models}\n{dedent(extension)}"))

    return build


def percents(found: RegisterMap) -> dict[str, list[str]]:
    return {model.name: [each.percent for each in model.process.outputs] for model in found.models if model.process}


def test_a_map_has_the_process_of_its_library(family: Family) -> None:
    assert percents(family()) == {"A": ["heat"], "B": ["cool"]}


def test_the_maps_own_process_takes_the_place_of_the_librarys(family: Family) -> None:
    own = "process: {value: goal, setpoint: temperature, outputs: [{percent: cool}]}\n"
    assert percents(family(own)) == {"A": ["cool"], "B": ["cool"]}


def test_an_extension_inherits_the_process_under_its_own_models(family: Family) -> None:
    assert percents(family(models="{X: {from: B}, Y: {from: A}}")) == {"X": ["cool"], "Y": ["heat"]}
    assert percents(family(models="{Y: {from: A}}")) == {"Y": ["heat"]}


def test_an_extension_may_have_a_process_of_its_own(family: Family) -> None:
    own = "process: {value: goal, setpoint: temperature}\n"
    assert percents(family(models="{X: {from: B}}", extension=own)) == {"X": []}
