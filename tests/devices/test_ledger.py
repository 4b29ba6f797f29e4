"""Each section of each manual has a line in its ledger below docs/evidence, and what the line names is in the map.

A ledger is a table `| section | what it says | where |`. In the column `where` a name in backticks is one of the map: a
register, array, group, command, program, enum, a key or name of its YAML (`protocol.faults`, `notes`, a decimals rule),
the `where` of an erratum or the `source` of an example.
"""

import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

from regscribe.model import RegisterMap
from regscribe.pipeline import compile_map
from regscribe.source import load

ROOT = Path(__file__).parents[2]
MAPS = {
    "athena-platinum": (
        "athena/platinum-c10-m10",
        "athena/platinum-m300",
        "athena/platinum-m400",
        "athena/platinum-m5000",
        "athena/platinum-x100-x400",
        "athena/platinum-x5000",
    ),
    "athena-series-c": ("athena/series-c",),
    "fdc-series-100": ("fdc/series-100",),
    "omega-cn8200": ("omega/cn8200",),
}
"""The maps that a ledger is about; a manual may have several."""
LEDGERS = sorted(path.stem for path in (ROOT / "docs" / "evidence").glob("*.md"))
NUMBER = re.compile(r"\d+(?:[.-]\d+)*")
NAME = re.compile(r"`([^`]+)`")


@cache
def rows(ledger: str) -> tuple[tuple[str, str, str], ...]:
    text = (ROOT / "docs" / "evidence" / f"{ledger}.md").read_text(encoding="utf-8")
    lines = [line for line in text.splitlines() if line.startswith("|")]
    assert lines[0] == "| section | what it says | where |"
    cells = [[cell.strip() for cell in line.strip("|").split(" | ")] for line in lines[2:]]
    assert [line for line in cells if len(line) != 3 or not all(line)] == []
    return tuple((section, says, where) for section, says, where in cells)


@cache
def compiled(name: str) -> RegisterMap:
    found = compile_map(ROOT / "maps" / f"{name}.yaml").map
    assert found is not None
    return found


def keys(node: object, path: str = "") -> Iterator[str]:
    """All keys of a document, alone and behind those above them."""
    if isinstance(node, list):
        for one in node:
            yield from keys(one, path)
    if isinstance(node, dict):
        for key, value in node.items():
            yield from (str(key), f"{path}{key}")
            yield from keys(value, f"{path}{key}.")


def files(name: str) -> Iterator[Path]:
    """The YAML files that make a map: its own, those that it builds on, and the libraries that these use."""
    path = ROOT / "maps" / f"{name}.yaml"
    yield path
    text = path.read_text(encoding="utf-8")
    for base in re.findall(r"^extends: (\S+)", text, re.MULTILINE):
        yield from files(base)
    for listed in re.findall(r"^uses: \[([^\]]*)\]", text, re.MULTILINE):
        yield from (ROOT / "maps" / f"{one.strip()}.library.yaml" for one in listed.split(","))


@cache
def names(name: str) -> frozenset[str]:
    one = compiled(name)
    found: set[str] = set()
    for path in files(name):
        document, _ = load(path)
        assert document is not None
        found.update(keys(document.data))
    for model in one.models:
        for register in model.registers:
            found.update((register.id, register.path, register.array))
            found.update(f"{register.path}.{field.id}" for field in register.fields)
        found.update(group.id for group in model.groups)
        found.update(command.id for command in model.commands)
    return frozenset(found)


def errata(ledger: str) -> set[str]:
    return {one.where for name in MAPS[ledger] for one in compiled(name).errata}


def examples(ledger: str) -> set[str]:
    return {one.source for name in MAPS[ledger] for one in compiled(name).examples}


@pytest.mark.parametrize("ledger", LEDGERS)
def test_every_name_of_a_ledger_is_in_the_map(ledger: str) -> None:
    known = frozenset().union(*map(names, MAPS[ledger]))
    places = errata(ledger) | examples(ledger)
    strange = [
        (section, name)
        for section, _, where in rows(ledger)
        for name in NAME.findall(where)
        if name not in known and name not in places
    ]
    assert strange == []


@pytest.mark.parametrize("ledger", LEDGERS)
def test_a_ledger_leaves_out_no_section(ledger: str) -> None:
    """Below each heading, and at the top, numbers follow each other without a gap, in order, each once."""
    sections = [section for section, _, _ in rows(ledger) if NUMBER.fullmatch(section)]
    assert sections, "a ledger needs numbered sections"
    before: dict[str, int] = {}
    for section in sections:
        parent, _, last = section.rpartition("-" if "-" in section and "." not in section else ".")
        expected = before.get(parent, int(last) - 1 if not parent else 0) + 1
        assert (section, int(last)) == (section, expected)
        before[parent] = int(last)
        assert not parent or parent in sections, f"{section} stands below {parent}, which has no line"


@pytest.mark.parametrize("ledger", LEDGERS)
def test_every_erratum_and_every_example_stands_beside_a_section(ledger: str) -> None:
    named = {name for _, _, where in rows(ledger) for name in NAME.findall(where)}
    assert errata(ledger) - named == set()
    assert examples(ledger) - named == set()


@pytest.mark.parametrize("ledger", LEDGERS)
def test_every_section_that_the_map_cites_has_a_line(ledger: str) -> None:
    sections = {section for section, _, _ in rows(ledger)}
    cited = {
        part
        for name in MAPS[ledger]
        for model in compiled(name).models
        for one in (*model.registers, *model.groups, *model.commands)
        for part in re.split(r"[^\d.-]+", one.section)
        if NUMBER.fullmatch(part)
    }
    assert cited - sections == set()


def test_the_page_about_evidence_leads_to_every_ledger() -> None:
    page = (ROOT / "docs" / "evidence.md").read_text(encoding="utf-8")
    assert [name for name in LEDGERS if f"](evidence/{name}.md)" not in page] == []
