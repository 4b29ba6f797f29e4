"""The calculator of the register browser is a judge as well: it reads and writes what the cases say.

It sees the words that all registers hold, and works out itself what decides about a row. All rows go through one run of
Node.js.
"""

from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from typing import Any, NamedTuple

import pytest

from regscribe.model import Register, RegisterMap, View
from regscribe.model.located import layout_of, located

from . import judges
from .browser_codec import run
from .suite import Built, Case, Json, cases, diagnose, whole_map, words_of
from .wire import Memory

FAR = {"snan": "sNaN", "huge": "1E+5000", "tiny": "1E-5000", "long": f"1{'0' * 5000}"}
"""How people type numbers that must not even be compared, or worked with."""


class Asked(NamedTuple):
    """A row, as it is put to the page to read or to write."""

    case: str
    row: Json
    register: Register
    job: Json


class Compiled(NamedTuple):
    """A case with its map, as written and with its registers where the device has them."""

    case: Case
    map: RegisterMap
    built: Built


PLACES = {"", "array", "nested"}
"""What another place changes, the page does not see."""


@pytest.fixture(scope="module")
def answered() -> list[tuple[Asked, Json]]:
    """All rows with what the page says."""
    asked = [(one, [*_reads(one), *_writes(one)]) for one in _every()]
    made = run([([one.map], [row.job for row in rows]) for one, rows in asked])
    found = (said[0]["cases"][0] for each in made for said in each)
    return list(zip((row for _, rows in asked for row in rows), found, strict=True))


def _every() -> Iterator[Compiled]:
    return (_compiled(case) for case in cases() if not case.refused and case.place in PLACES)


def _compiled(case: Case) -> Compiled:
    register_map, found = diagnose(whole_map(case.map))
    assert register_map is not None, found
    (model,) = register_map.models
    placed = replace(register_map, models=(located(model, layout_of(register_map, model, {})),))
    return Compiled(case, register_map, Built(placed, None))


def test_the_page_reads_what_the_cases_say(answered: list[tuple[Asked, Json]]) -> None:
    rows = [(one, _said(one, said["decode"][0])) for one, said in answered if said["decode"]]
    wrong = [
        f"{one.case}: {one.row}: {said}" for one, said in rows if not judges.same(said, judges.expected_of(one.row))
    ]
    assert wrong == []
    assert len(rows) > 2500


def _reads(one: Compiled) -> Iterator[Asked]:
    for row in one.case.rows:
        if "words" in row and row.get("only") != "write":
            register, view = judges.register_of(one.built, row)
            yield _asked(one, row, register, view, decode=[words_of(row["words"])])


def _asked(one: Compiled, row: Json, register: Register, view: View, **what: Any) -> Asked:
    memory = Memory()
    one.case.prepare(memory, row.get("holds", {}))
    held = {each.path: _held(memory, each) for each in one.built.map.models[0].registers}
    case = {"view": view.name, "held": held, **what}
    return Asked(one.case.name, row, register, {"map": one.map.id, "places": [["A", register.path]], "cases": [case]})


def _held(memory: Memory, register: Register) -> list[int]:
    view = register.preferred
    return memory.get(view.space.value, view.address(register.at), view.words)


def _said(one: Asked, said: Json) -> object:
    """What the page says, in the words of rows."""
    if said["meaning"] == "fault":
        return {"fault": said["fault"]}
    if said["meaning"] == "unknown_member":
        return {"unknown": int(said["value"])}
    if said["meaning"] != "value":
        return {"no value": True} if said["meaning"] != "not_here" else said
    return _value(one, said)


def _value(one: Asked, said: Json) -> object:
    value, row = said["value"], one.row
    if "member" in row or "special" in row:
        return {"name": said["member" if "member" in row else "special"]}
    if "fields" in row:
        return {"fields": {name: _part(part) for name, part, reads, _ in said["fields"] if reads}}
    if "flags" in row:
        rest = int(value) & ~one.register.named_bits
        names = {name for name, _, _, is_set in said["fields"] if is_set}
        return {"flags": names} | ({"unnamed": rest} if rest else {})
    return value if isinstance(row.get("value"), str) else Fraction(value)


def _part(text: str) -> object:
    try:
        return Fraction(text)
    except ValueError:
        return text


def test_the_page_writes_what_the_cases_say(answered: list[tuple[Asked, Json]]) -> None:
    rows = [(one, said) for one, said in answered if said["encode"]]
    wrong = [f"{one.case}: {one.row}: {said}" for one, said in rows if _sent(one, said) != _words(one.row)]
    assert wrong == []
    assert len(rows) > 2000


def _writes(one: Compiled) -> Iterator[Asked]:
    not_sent = {"fault", "no_value", "unknown", "unnamed", "shows"}
    for row in one.case.rows:
        odd = judges.of_another_sort(one.built, row) and row["refuses"] not in {*FAR, *judges.NO_NUMBERS}
        if row.get("only") == "read" or not_sent & set(row) or odd:
            continue
        register, view = judges.register_of(one.built, row, writes=True)
        if register.access.writable:
            yield _asked(one, row, register, view, encode=[[_text(register, row), row.get("rounded", False)]])


def _text(register: Register, row: Json) -> str:
    """The value of a row as people type it."""
    if "member" in row or "special" in row:
        return str(row.get("member", row.get("special"))).rpartition(".")[2]
    if "flags" in row:
        return str(sum(1 << one.low for one in register.fields if one.id in row["flags"]))
    if "fields" in row:
        return str(_word(register, row["fields"]))
    value = row.get("value", row.get("refuses"))
    if isinstance(value, bool):
        return str(value).lower()
    return FAR.get(value, str(value))


def _word(register: Register, parts: Json) -> int:
    """A word whose parts are numbers, or report the faults of these ids."""
    word = 0
    for field in register.fields:
        part = parts.get(field.id, 0)
        ends = next((fault.ends for fault in field.sentinels if fault.id == part), None)
        bits = int(ends[0]) % (1 << field.width) if ends else _bits(field, part)
        word |= bits << field.low
    return word


def _bits(field: Any, part: Any) -> int:
    number = (Fraction(part) - field.add) / field.multiply
    assert number.denominator == 1
    return int(number) % (1 << field.width)


def _sent(one: Asked, said: Json) -> object:
    refused = "words" not in said["encode"][0] or (one.register.writable and said["writable"] is not True)
    return judges.REFUSED if refused else said["encode"][0]["words"]


def _words(row: Json) -> object:
    return judges.REFUSED if "refuses" in row else words_of(row["words"])
