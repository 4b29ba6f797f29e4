"""The columns of a register list for people: a heading that `regscribe import` knows, and what a cell holds."""

import json
from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from typing import Any, NamedTuple

from regscribe.dialects import LETTERS
from regscribe.emit.words import one_line, sentinel_words, special_words
from regscribe.export.csv import Row
from regscribe.model import IDENTITY, Kind, Model, Number, Order, Register, show

MOST_DIGITS = 15
"""Digits of a number that a spreadsheet keeps."""

NOT_STATED = "not stated"

Content = int | Decimal | str | None


class Line(NamedTuple):
    """A row of a sheet: the row of the CSV, and the register (None: a command or a computed value) of the model."""

    row: Row
    register: Register | None
    model: Model

    @property
    def more(self) -> dict[str, Any]:
        """What has no column in the CSV, by the keys of the map language."""
        found: dict[str, Any] = json.loads(self.row.more)
        return found


class Column(NamedTuple):
    """A column: heading, width, the fact that is lost where a cell is cut, its content; `always`: in every sheet."""

    heading: str
    width: int
    fact: str
    content: Callable[[Line], Content]
    always: bool = False


def number(text: str) -> Content:
    """A decimal as a number of the sheet, if a spreadsheet keeps all its digits; any other text as it is."""
    try:
        found = Decimal(text)
    except ArithmeticError:
        return text or None
    exact = found.is_finite() and len(found.as_tuple().digits) <= MOST_DIGITS and "e" not in text.lower()
    return (int(found) if found == found.to_integral_value() else found) if exact else text


def _plain_line(line: Line) -> tuple[Number, Number] | None:
    """Factor and summand of a scale that is the same in every state; None of any other, and of what has none."""
    one = line.register
    if one is None or one.kind not in {Kind.NUMBER, Kind.INTEGER} or len(one.scale) != 1:
        return None
    scale = one.scale[0].then
    if not one.scale[0].when.always or scale.decimals or one.base.times is not None:
        return None
    if not isinstance(scale.multiply, Number) or not isinstance(scale.add, Number):
        return None
    return Fraction(scale.multiply) / Fraction(one.base.factor), Fraction(scale.add)


def _multiplier(line: Line) -> Content:
    found = _plain_line(line)
    if found is None:
        return line.row.scale or None
    return None if found == (1, 0) else number(show(Fraction(found[0])))


def _offset(line: Line) -> Content:
    found = _plain_line(line)
    return None if found is None or not found[1] else number(show(Fraction(found[1])))


def _scale(line: Line) -> Content:
    """The formula where columns of numbers say less than it: a step, places, a case."""
    one = line.register
    if one is None or all(case.then == IDENTITY for case in one.scale):
        return line.row.scale if one is None else None
    return line.row.scale or None


def _order(line: Line) -> Content:
    """ABCD and so on, of a number of several words, and where it is not the common one."""
    one = line.register
    if one is None or one.base.space.is_bits:
        return None
    order = (one.base.order, one.base.byte_order)
    if order == (Order.BIG, Order.BIG) and (one.base.words == 1 or one.base.type.is_octets):
        return None
    letters = LETTERS.get(order) if all(isinstance(each, Order) for each in order) else None  # type: ignore[arg-type]  # both are
    return letters or "; ".join(str(line.more[key]) for key in ("word_order", "byte_order", "at") if key in line.more)


def _labels(text: str) -> Content:
    found: dict[str, str] = json.loads(text)
    return "; ".join(f"{code} = {label}" for code, label in found.items()) or None


def _values(line: Line) -> Content:
    """Codes of an enum, or what a command writes; special values and faults have columns of their own."""
    one = line.register
    if one is None:
        return _labels(line.row.values)
    labels = one.enum.labels if one.enum else {}
    return "; ".join(f"{code} = {one_line(label)}" for code, label in labels.items()) or None


def _specials(line: Line) -> Content:
    specials = line.register.specials if line.register else ()
    return "; ".join(special_words(one) for one in specials) or None


def _faults(line: Line) -> Content:
    sentinels = line.register.sentinels if line.register else ()
    return "; ".join(sentinel_words(one) for one in sentinels) or None


def _rest(line: Line) -> Content:
    """What has no column of its own, as `key: value` each."""
    gone = {"description", "sentinels"} | ({"word_order", "byte_order", "at"} if _order(line) else set())
    facts = ((key, value) for key, value in line.more.items() if key not in gone)
    return "; ".join(f"{key}: {value if isinstance(value, str) else json.dumps(value)}" for key, value in facts) or None


def _views(line: Line) -> Content:
    views: dict[str, dict[str, object]] = json.loads(line.row.views)
    told = (f"{name}: {', '.join(f'{key} {value}' for key, value in view.items())}" for name, view in views.items())
    return "; ".join(told) if len(views) > 1 else None


def _text(field: str) -> Callable[[Line], Content]:
    return lambda line: getattr(line.row, field) or None


def _number(field: str) -> Callable[[Line], Content]:
    return lambda line: number(getattr(line.row, field))


CORE = (
    Column("Group", 14, "group", _text("group")),
    Column("Name", 32, "name", _text("name")),
    Column("Symbol", 10, "symbol", _text("symbol")),
    Column("Space", 10, "register", _text("space")),
    Column("Address", 9, "register", _number("address")),
    Column("Words", 7, "register", _number("words")),
    Column("Data type", 11, "register", _text("type")),
    Column("Word order", 11, "register", _order),
    Column("Access", 7, "write", _text("access")),
    Column("Multiplier", 11, "scale", _multiplier),
    Column("Offset", 9, "offset", _offset),
    Column("Unit", 8, "unit", _text("unit")),
    Column("Min", 11, "range", _number("minimum")),
    Column("Max", 11, "range", _number("maximum")),
    Column("Default", 10, "default", _number("default")),
    Column("Values", 40, "enum", _values),
    Column("Bits", 40, "flags", lambda line: _labels(line.row.bits)),
    Column("Description", 50, "description", lambda line: line.more.get("description")),
    Column("Section", 10, "source", _text("section")),
)
"""What every sheet has, in the words of people's own lists."""

MORE = (
    Column("Path", 28, "register", _text("id")),
    Column("Kind", 9, "register", _text("kind")),
    Column("Formula", 16, "scale", _scale),
    Column("Specials", 24, "special-value", _specials),
    Column("Fault words", 24, "sentinel", _faults),
    Column("Exists while", 24, "condition", _text("exists")),
    Column("Aliases", 10, "alias", _text("aliases")),
    Column("Views", 30, "view", _views),
    Column("Memory", 10, "memory-wear", _text("persistence")),
    Column("Block", 8, "block", _text("block")),
    Column("Page", 10, "page", _text("page")),
    Column("File", 6, "register", _number("file")),
    Column("Queue", 6, "register", _number("queue")),
    Column("Unit id", 8, "page", _number("unit_id")),
    Column("More", 40, "register", _rest),
)
"""What stands in a sheet where some line has it."""

COLUMNS = (*(one._replace(always=True) for one in CORE), *MORE)
