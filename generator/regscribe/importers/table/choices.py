"""The options of the importer: what the user says of the table as a whole."""

import re
from collections.abc import Mapping
from dataclasses import dataclass

from regscribe.importers.table.cells import Unclear
from regscribe.importers.table.cells.addresses import base_words
from regscribe.importers.table.cells.dialects import read_dialect
from regscribe.importers.table.cells.range_columns import STORED, VALUE
from regscribe.importers.table.cells.scales import Way
from regscribe.importers.table.sheet_structure import Area, area_of
from regscribe.model import Access, Space, WireType
from regscribe.plugins import Option, OptionError
from regscribe_runtime.values.wire_types import Order

OPTIONS = (
    Option("sheet", "a sheet, by name or number; * stands for all", metavar="SHEET", several=True),
    Option("range", "the cells to read, A5:H120, or the rows, 5:120", metavar="RANGE"),
    Option("pages", "the pages of a PDF to read, 3-5,8", metavar="PAGES"),
    Option("area", "the part of each page to read, in points: LEFT,TOP,RIGHT,BOTTOM", metavar="AREA"),
    Option("header", "the number of the row that names the columns; none: no row does", metavar="ROW"),
    Option("columns", 'what columns say, at=Register,type="Data type",unit=-', metavar="ROLE=HEADING", several=True),
    Option("cell", "corrects one cell, NAME / HEADING = TEXT or B7 = TEXT", metavar="CELL=TEXT", several=True),
    Option("encoding", "how the characters of a text are encoded (cp1250, gbk, ..)", metavar="NAME"),
    Option("delimiter", "what separates cells: comma, semicolon, tab, bar, blanks", metavar="WORD"),
    Option("base", f"how addresses count: {', '.join(base_words())}, several joined by commas", metavar="WORDS"),
    Option("space", "the space of registers whose row says none: holding, input, coil, discrete", metavar="SPACE"),
    Option("type", "the type of registers whose row says none: uint16, int16, ..", metavar="TYPE"),
    Option("access", "the access of registers whose row says none: r, rw, w", metavar="ACCESS"),
    Option(
        "word-order", "of numbers of several words, where no row says it: big (ABCD), little (CDAB)", metavar="ORDER"
    ),
    Option("scale", "what a bare number in a scale does: multiply, divide, decimals", metavar="WAY"),
    Option("ranges", f"what ranges and defaults count: {STORED}, {VALUE}", metavar="WORD"),
    Option("digits", "what 3 and 4 in a column of spaces are: function, region", metavar="WORD"),
    Option("dialect", "what words of types mean: int=32,text=characters,size=bytes,little=words", metavar="WORD=.."),
)

RANGE_OF_PAGES = re.compile(r"(\d{1,5})(?:-(\d{1,5}))?")


@dataclass(frozen=True, slots=True)
class Choices:
    """What the user says; empty or None where nothing is said."""

    sheets: tuple[str, ...] = ()
    cells: Area | None = None
    pages: tuple[int, ...] = ()
    area: tuple[float, float, float, float] | None = None
    header: str = ""
    columns: str = ""
    corrections: tuple[str, ...] = ()
    encoding: str = ""
    delimiter: str = ""
    base: str = ""
    space: Space | None = None
    type: WireType | None = None
    access: Access | None = None
    word_order: Order | None = None
    scale: str = ""
    ranges: str = ""
    digits: str = ""
    dialect: str = ""


def choices(options: Mapping[str, str]) -> Choices:
    """Read the options. Raises OptionError with what may be written."""
    texts = {name: text.strip() for name, text in options.items()}
    return Choices(
        sheets=tuple(filter(None, texts.get("sheet", "").split("\n"))),
        cells=_cells(texts.get("range", "")),
        pages=_pages(texts.get("pages", "")),
        area=_area(texts.get("area", "")),
        header=_header(texts.get("header", "")),
        columns=texts.get("columns", ""),
        corrections=tuple(filter(None, texts.get("cell", "").split("\n"))),
        encoding=texts.get("encoding", ""),
        delimiter=texts.get("delimiter", ""),
        base=_base(texts.get("base", "")),
        space=Space(text) if (text := _one(texts, "space", [*Space])) else None,
        type=WireType(text) if (text := _one(texts, "type", [*WireType])) else None,
        access=Access(text) if (text := _one(texts, "access", [*Access])) else None,
        word_order=Order(text) if (text := _one(texts, "word-order", [*Order])) else None,
        scale=_one(texts, "scale", [*Way]),
        ranges=_one(texts, "ranges", [STORED, VALUE]),
        digits=_one(texts, "digits", ["function", "region"]),
        dialect=_dialect(texts.get("dialect", "")),
    )


def _one(texts: Mapping[str, str], name: str, known: list[str]) -> str:
    text = texts.get(name, "")
    if text and text not in known:
        message = f"--{name} {text}: write one of {', '.join(known)}"
        raise OptionError(message)
    return text


def _base(text: str) -> str:
    known = base_words()
    if wrong := [word for word in text.split(",") if word and word.strip() not in known]:
        message = f"--base {wrong[0]}: write some of {', '.join(known)}"
        raise OptionError(message)
    return text


def _header(text: str) -> str:
    if text and text != "none" and not re.fullmatch(r"[1-9]\d{0,6}", text):
        message = f"--header {text}: write the number of the row that names the columns, or none"
        raise OptionError(message)
    return text


def _cells(text: str) -> Area | None:
    area = area_of(text) if text else None
    if text and area is None:
        message = f"--range {text}: write the first and the last cell, A5:H120, or the first and the last row, 5:120"
        raise OptionError(message)
    return area


def _pages(text: str) -> tuple[int, ...]:
    pages: dict[int, None] = {}
    for part in filter(None, text.replace(" ", "").split(",")):
        found = RANGE_OF_PAGES.fullmatch(part)
        first, last = (int(found[1]), int(found[2] or found[1])) if found else (0, 0)
        if not 1 <= first <= last:
            message = f"--pages {text}: write pages that count from 1, for example 3-5,8"
            raise OptionError(message)
        pages |= dict.fromkeys(range(first, last + 1))
    return tuple(pages)


def _area(text: str) -> tuple[float, float, float, float] | None:
    if not text:
        return None
    parts = text.replace(" ", "").split(",")
    if len(parts) != 4 or not all(re.fullmatch(r"\d{1,5}(\.\d{1,3})?", part) for part in parts):  # noqa: PLR2004 - corners
        message = f"--area {text}: write LEFT,TOP,RIGHT,BOTTOM in points, for example 0,120,595,700 of an A4 page"
        raise OptionError(message)
    left, top, right, bottom = map(float, parts)  # lengths on paper, no values of a register
    if left >= right or top >= bottom:
        message = f"--area {text}: the right and the bottom end must be larger than the left and the top one"
        raise OptionError(message)
    return left, top, right, bottom


def _dialect(text: str) -> str:
    if isinstance(found := read_dialect(text), Unclear):
        message = f"--dialect: {found.message}"
        raise OptionError(message)
    return text
