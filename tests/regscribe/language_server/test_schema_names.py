"""What the schema says that texts name (`x-names`): held against the shipped maps, and against what can be declared."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from regscribe.language_server.files import Files
from regscribe.language_server.names import GROUP, REGISTER, TABLES, VIEW, names_of
from regscribe.language_server.references import references_in, resolve
from regscribe.map_files import LIBRARY, MAP, shipped
from regscribe.schema import schema_json

MAPS = [path for path in sorted(shipped().glob("*/*.yaml")) if f".{LIBRARY}." not in path.name]
ALSO_TEXTS = {"unit", "decimals", "scale", REGISTER, MAP, LIBRARY}
"""Kinds in whose places something else may stand: a known unit, `not_stated`, `0..100`, a number; or names of files."""


def stated(node: object) -> Iterator[str]:
    if isinstance(node, dict):
        for key, value in node.items():
            if key == "x-names":
                yield from value.values() if isinstance(value, dict) else [value]
            else:
                yield from stated(value)
    elif isinstance(node, list):
        for one in node:
            yield from stated(one)


def test_each_kind_can_be_declared() -> None:
    assert set(stated(schema_json())) == {*TABLES, REGISTER, GROUP, VIEW, MAP, LIBRARY} - {"computed"}


@pytest.mark.parametrize("path", MAPS, ids=lambda path: path.stem)
def test_every_name_in_a_shipped_map_leads_to_a_declaration(path: Path) -> None:
    files = Files()
    project = files.project(path)
    names = names_of(project)
    lost = [one for one in references_in(project[0]) if not resolve(one, project[0], names)]
    assert [one for one in lost if one.kind not in ALSO_TEXTS] == []
    words = [one.text for one in lost if one.kind == REGISTER and not one.text.lstrip("-")[0].isdigit()]
    assert [one for one in words if "{i}" not in one] == []
