"""No file, however broken, makes composing raise; and what comes out does not depend on how often it is done."""

import random
from collections.abc import Callable
from pathlib import Path

import pytest

from regscribe.export.json import json_text
from regscribe.pipeline import compile_map

WORDS = (
    "null",
    "{}",
    "[]",
    "x",
    "7",
    "'7'",
    "{a: b}",
    "[1, 2]",
    "all",
    "{set: control}",
    "16C",
    "~",
    "true",
    "-1",
    "' '",
)
FULL = """
uses: [acme/common]
protocol: {limits: {write_words: 9}}
renumber: {4: "5"}
drop: {registers: [{id: rate, reason: r}], errata: ["9.1"], notes: all}
override:
  - {register: setpoint, reason: r, set: {default: 80, range: {from: 0, to: 300}}}
  - {enum: action, reason: r, set: {2: plain}}
  - {group: control, reason: r, set: {name: C}}
  - {command: clear, reason: r, set: {danger: d}}
commands: {save: null}
sets: {own: [{at: 900, name: Own, access: r}]}
unused: [{at: 950..960}]
groups:
  - id: more
    name: More
    source: "9"
    registers: [{set: control, except_ids: [setpoint, segments], shift: 200, set_each: {source: "9"}}, {set: own}]
"""


def mutated(text: str, chance: random.Random) -> str:
    """The text with a word replaced, a line taken out, put elsewhere or doubled."""
    lines = text.splitlines()
    place = chance.randrange(len(lines))
    match chance.randrange(4):
        case 0:
            del lines[place]
        case 1:
            lines.insert(chance.randrange(len(lines)), lines.pop(place))
        case 2:
            lines.insert(place, lines[place])
        case _:
            parts = lines[place].split(" ")
            parts[chance.randrange(len(parts))] = chance.choice(WORDS)
            lines[place] = " ".join(parts)
    return "\n".join(lines) + "\n"


@pytest.mark.parametrize("name", ["omega/x.yaml", "acme/series-c.yaml", "acme/common.library.yaml"])
def test_no_mutated_file_makes_the_compiler_raise(extension: Callable[..., Path], name: str) -> None:
    path = extension(FULL)
    target = path.parents[1] / name
    good = target.read_text()
    chance = random.Random(name)  # noqa: S311 - a test must repeat itself
    for _ in range(150):
        text = good
        for _ in range(chance.randrange(1, 4)):
            text = mutated(text, chance)
        target.write_text(text)
        compiled = compile_map(path)
        assert (compiled.map is None) <= bool(compiled.diagnostics), text
        assert all(one.span.file and one.message and one.span.line > 0 for one in compiled.diagnostics), text
        compile_map(target)


def test_the_unbroken_map_is_good(extension: Callable[..., Path]) -> None:
    assert compile_map(extension(FULL)).diagnostics == ()


def test_a_map_is_the_same_at_every_run(extension: Callable[..., Path]) -> None:
    path = extension(FULL)
    maps = [compile_map(path).map for _ in range(2)]
    assert None not in maps
    assert maps[0] == maps[1]
    texts = {json_text([map_]) for map_ in maps if map_ is not None}
    assert len(texts) == 1
