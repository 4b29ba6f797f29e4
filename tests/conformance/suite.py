"""The cases as files have them: read, completed to a map, compiled; rows with words as bytes on the wire."""

import importlib.util
import itertools
import struct
from collections.abc import Iterator, Mapping
from dataclasses import replace
from decimal import Decimal
from functools import cache
from pathlib import Path
from types import MappingProxyType, ModuleType
from typing import Any, NamedTuple

from regscribe import checks, compose, lower, schema, source
from regscribe.emit import python
from regscribe.files import dump
from regscribe.model import Diagnostic, RegisterMap, Severity
from regscribe.model.located import layout_of, located

from .places import places_of
from .wire import LONG, ON, Memory

FOLDER = Path(__file__).parent / "cases"
PAGE_BITS = 16
FUNCTIONS = [1, 2, 3, 4, 5, 6, 7, 15, 16, 20, 21, 24, 43]
Json = dict[str, Any]

_numbers = itertools.count()


class Case(NamedTuple):
    """One case: parts of a map, what the device holds besides, and rows or the rule that refuses the map."""

    name: str
    map: Json
    holds: Mapping[str, Mapping[int, str]]
    rows: tuple[Json, ...]
    refused: str
    place: str
    paged: int = 0x10000
    pages: tuple[Json, ...] = ()

    def __repr__(self) -> str:
        return self.name

    @property
    def long(self) -> range:
        """The addresses of registers of 32 bits: all or none."""
        return range(0x10000 if "enron" in str(self.map) else 0)

    def prepare(self, memory: Memory, *holds: Mapping[str, Mapping[int, str]]) -> None:
        """Let a device of nothing but words hold what the case says, and more."""
        memory.clear()
        memory.long, memory.paged = self.long, self.paged
        memory.pages = tuple(
            page if "unit" in page else {space: _words(cells) for space, cells in page.items()} for page in self.pages
        )
        for held in (self.holds, *holds):
            for space, cells in held.items():
                for address, words in _words(cells).items():
                    memory.put(space, address, words)

    def selecting(self, address: int) -> tuple[int, list[bytes]]:
        """The unit id of the page of an address (1: that of the device), and the requests that select the page."""
        number = address >> PAGE_BITS if address < LONG else 0
        page = self.pages[number - 1] if 0 < number <= len(self.pages) else {}
        if "unit" in page:
            return page["unit"], []
        cells = [(space, at, words) for space, held in page.items() for at, words in _words(held).items()]
        return 1, [_selects(*cell) for cell in cells]


def _selects(space: str, at: int, words: list[int]) -> bytes:
    """The request that writes what selects a page."""
    if space == "coil":
        return struct.pack(">BHH", 5, at, ON * words[0])
    return struct.pack(f">BHHB{len(words)}H", 16, at, len(words), 2 * len(words), *words)


def _words(cells: Mapping[Any, str]) -> dict[int, list[int]]:
    """Words by address, on page 2 spelled `2/10`."""
    return {address_of(key): words_of(text) for key, text in cells.items()}


def address_of(key: Any) -> int:
    """An address of `holds`, with the number of its page above it."""
    page, _, at = str(key).rpartition("/")
    return int(page or 0) << PAGE_BITS | int(at)


class Built(NamedTuple):
    """A case's map, compiled, its registers where the device has them, and its driver; `bases` of its blocks.

    `written` is the map with addresses in blocks as they are written, where it has any.
    """

    map: RegisterMap
    module: Any
    bases: Mapping[str, int] = MappingProxyType({})
    written: RegisterMap | None = None


def load(path: Path) -> list[Json]:
    """The cases of a file, read by YAML 1.2: `off` is a text, a number with a fraction is a Decimal."""
    document, found = source.load(path)
    assert document is not None, found
    assert not found, found
    value: list[Json] = document.data
    return value


def cases() -> Iterator[Case]:
    """Every case of every file, at every place where it holds; each register of a list is a case of its own."""
    for path in sorted(FOLDER.glob("*.yaml")):
        for one in load(path):
            for number, register in enumerate(one.get("each", ()), 1):
                name = f"{path.stem}: {one['name']}, {number}"
                yield Case(name, {"registers": [register]}, {}, (), one["refused"], "")
            for place, each in places_of(one) if "map" in one else ():
                yield _case(path.stem, each, place)


def _case(stem: str, one: Json, place: str) -> Case:
    name = f"{stem}: {one['name']}{place and f' ({place})'}"
    return Case(
        name,
        one["map"],
        one.get("holds", {}),
        tuple(one.get("rows", ())),
        one.get("refused", ""),
        place,
        one.get("paged", 0x10000),
        tuple(one.get("pages", ())),
    )


def words_of(text: str) -> list[int]:
    """Words of bytes in hexadecimal, as they follow each other on the wire; one digit alone is a bit or a byte."""
    raw = text.replace(" ", "")
    return [int(raw, 16)] if len(raw) <= 2 else [int(raw[at : at + 4], 16) for at in range(0, len(raw), 4)]


def whole_map(parts: Json) -> str:
    """A map of the parts that a case gives, as YAML: one model, all registers in one group, read-write unless told.

    A recipe may have groups of its own.
    """
    tables = {key: value for key, value in parts.items() if key not in {"registers", "block"}}
    group = {"id": "all", "name": "All", "source": "1", "each": {"access": "rw"}, "registers": parts.get("registers")}
    group |= {"block": parts["block"]} if "block" in parts else {}
    document: Json = {
        "format": 1,
        "map": {"id": "test/case", "title": "Case", "maker": "Test", "class_prefix": "Case"},
        "manual": {"title": "Manual", "number": "1"},
        "models": {"A": {}},
        "protocol": {"functions": FUNCTIONS},
        **tables,
        "groups": parts.get("groups", [group]),
    }
    return dump(plain(document))


def plain(value: Any) -> Any:
    """Decimals as floats, which YAML writes as their shortest decimals."""
    if isinstance(value, dict):
        return {key: plain(each) for key, each in value.items()}
    if isinstance(value, list):
        return [plain(each) for each in value]
    return float(value) if isinstance(value, Decimal) else value


def diagnose(text: str) -> tuple[RegisterMap | None, list[Diagnostic]]:
    """Compile a map (as YAML) as far as it goes; what was found on the way."""
    document, found = source.parse(text, name="maps/test/case.yaml")
    assert document is not None, found
    found = [*found, *schema.validate(document)]
    if found:
        return None, found
    composed = compose.compose(document, Path("maps/test/case.yaml"))
    if composed.document is None:
        return None, list(composed.diagnostics)
    register_map, found = lower.lower(composed.document)
    if register_map is None or found:
        return None, found
    return register_map, checks.check(register_map)


def errors_of(found: list[Diagnostic]) -> list[Diagnostic]:
    """What of the findings is an error."""
    return [one for one in found if one.severity is Severity.ERROR]


@cache
def build(text: str) -> Built:
    """Compile a sound map (as YAML) and import its driver."""
    register_map, found = diagnose(text)
    assert register_map is not None, found
    assert not errors_of(found), found
    ((_, code),) = python.render(register_map).items()
    (model,) = register_map.models
    layout = layout_of(register_map, model, {})
    placed = replace(register_map, models=(located(model, layout),)) if layout.headers else register_map
    return Built(placed, module_of(code), {name: header.base for name, header in layout.headers.items()}, register_map)


def module_of(code: str) -> ModuleType:
    """Import a generated driver from its text."""
    name = f"conformance_driver_{next(_numbers)}"
    spec = importlib.util.spec_from_loader(name, loader=None)
    assert spec is not None
    module = importlib.util.module_from_spec(spec)
    exec(compile(code, f"<{name}>", "exec"), vars(module))  # noqa: S102 (a driver that was generated just now)
    return module
