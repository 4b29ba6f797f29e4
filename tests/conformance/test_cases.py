"""The conformance cases: bytes by hand on one side, a value on the other, and everybody between them agrees."""

import asyncio
import json
import struct
from collections.abc import Iterator
from typing import Any

import jsonschema
import pytest

from regscribe.simulate.device.value_arguments import Plain
from regscribe.tools.live.value_text import as_text
from regscribe_runtime import NotPresent

from . import judges
from .suite import FOLDER, Built, Case, Json, build, cases, diagnose, errors_of, load, whole_map, words_of
from .wire import Memory, Server

EVERY = list(cases())
BUILT: dict[str, Built] = {}
SOUND = [case for case in EVERY if not case.refused]
each_sound = pytest.mark.parametrize("case", SOUND, ids=repr)
each_apart = pytest.mark.parametrize("case", [one for one in SOUND if one.place in {"", "nested", "view"}], ids=repr)
"""For judges who take long, and who differ from the others in nothing that an array or an input register changes."""


@pytest.fixture(scope="module")
def server() -> Iterator[Server]:
    with Server() as running:
        yield running


def _built(case: Case) -> Built:
    if case.name not in BUILT:
        BUILT[case.name] = build(whole_map(case.map))
    return BUILT[case.name]


def _prepare(memory: Memory, case: Case, row: Json) -> None:
    case.prepare(memory, row.get("holds", {}))


def _reads(case: Case) -> list[Json]:
    return [row for row in case.rows if "words" in row and row.get("only") != "write"]


def _writes(case: Case, built: Built) -> list[Json]:
    not_sent = {"fault", "no_value", "unknown", "unnamed", "shows"}
    told = [row for row in case.rows if row.get("only") != "read" and not not_sent & set(row)]
    return [row for row in told if judges.register_of(built, row)[0].access.writable]


def _report(differences: list[str]) -> None:
    assert not differences, "\n".join(differences)


@pytest.mark.parametrize("path", sorted(FOLDER.glob("*.yaml")), ids=lambda path: path.stem)
def test_the_file_has_the_form_that_its_schema_says(path: Any) -> None:
    form = json.loads((FOLDER.parent / "case.schema.json").read_text(encoding="utf-8"))
    document = json.loads(json.dumps(load(path), default=float))
    jsonschema.Draft202012Validator(form).validate(document)


def test_every_name_stands_once() -> None:
    names = [case.name for case in EVERY]
    assert sorted(set(names)) == sorted(names)


@pytest.mark.parametrize("case", [case for case in EVERY if case.refused], ids=repr)
def test_a_map_without_meaning_is_refused(case: Case) -> None:
    _, found = diagnose(whole_map(case.map))
    rules = {one.rule for one in errors_of(found)}
    assert set(case.refused.split()) & rules, f"{case.refused} expected, found {sorted(rules)}"


@each_sound
def test_the_driver_reads_and_writes_what_the_case_says(case: Case, server: Server) -> None:
    built = _built(case)
    with built.module.CaseA.tcp("127.0.0.1", port=server.port, unit=1) as device:
        wrong = [text for row in _reads(case) for text in _read_wrong(case, built, row, server, device.link)]
        wrong += [
            text for row in _writes(case, built) for text in _written_wrong(case, built, row, server, device.link)
        ]
    _report(wrong)


def _read_wrong(case: Case, built: Built, row: Json, server: Server, link: Any) -> Iterator[str]:
    register, view = judges.register_of(built, row)
    _prepare(server.memory, case, row)
    server.memory.put(view.space.value, view.address(register.at), words_of(row["words"]))
    device = built.module.CaseA(link, unit=1)  # one that knows nothing from the row before
    bound = judges.attribute(device, row["register"])
    found = [judges.read_by_driver(lambda: bound.read(view=row.get("view")), row["register"])]
    if "view" not in row:
        found.append(judges.read_by_driver(lambda: device.read(bound.register)[row["register"]], row["register"]))
    yield from (f"{row}: read {one!r}" for one in found if not judges.same(one, judges.expected_of(row)))


def _written_wrong(case: Case, built: Built, row: Json, server: Server, link: Any) -> Iterator[str]:
    register, view = judges.register_of(built, row, writes=True)
    _prepare(server.memory, case, row)
    bound = judges.attribute(built.module.CaseA(link, unit=1), row["register"])
    value = judges.value_for(built, row)
    how = {"view": row.get("view"), "rounded": row.get("rounded", False), "verify": bool(case.pages)}
    place = (view.space.value, view.address(register.at), view.words)
    found = judges.written(lambda: bound.write(value, **how), server.memory, *place)
    if found != _words(row):
        yield f"{row}: wrote {found!r}"


def _words(row: Json) -> object:
    """What a write of a row has to leave on the wire."""
    return judges.REFUSED if "refuses" in row else words_of(row["words"])


@each_apart
def test_the_asynchronous_driver_reads_and_writes_what_the_case_says(case: Case, server: Server) -> None:
    built = _built(case)
    _report(asyncio.run(_asynchronously(case, built, server)))


async def _asynchronously(case: Case, built: Built, server: Server) -> list[str]:
    async with built.module.AsyncCaseA.tcp("127.0.0.1", port=server.port, unit=1) as device:
        return await _over(device.link, case, built, server)


async def _over(link: Any, case: Case, built: Built, server: Server) -> list[str]:
    wrong: list[str] = []
    for row in _reads(case):
        register, view = judges.register_of(built, row)
        _prepare(server.memory, case, row)
        server.memory.put(view.space.value, view.address(register.at), words_of(row["words"]))
        found = await _read(judges.attribute(built.module.AsyncCaseA(link, unit=1), row["register"]), row)
        wrong += [] if judges.same(found, judges.expected_of(row)) else [f"{row}: read {found!r}"]
    for row in _writes(case, built):
        place = judges.register_of(built, row, writes=True)
        _prepare(server.memory, case, row)
        bound = judges.attribute(built.module.AsyncCaseA(link, unit=1), row["register"])
        found = await _write(bound, judges.value_for(built, row), row, server.memory, place, verify=bool(case.pages))
        wrong += [] if found == _words(row) else [f"{row}: wrote {found!r}"]
    return wrong


async def _read(bound: Any, row: Json) -> object:
    try:
        value = await bound.read(view=row.get("view"))
    except judges.ValueNotDecodable as error:
        return judges.said_by_error(error, row["register"])
    return judges.said_by_driver(value)


async def _write(bound: Any, value: Any, row: Json, memory: Memory, place: Any, *, verify: bool) -> object:
    try:
        await bound.write(value, view=row.get("view"), rounded=row.get("rounded", False), verify=verify)
    except judges.UNSENT:
        return judges.REFUSED if not any(pdu[0] in {5, 6, 15, 16} for pdu in memory.log) else "refused too late"
    register, view = place
    return memory.get(view.space.value, view.address(register.at), view.words)


@each_sound
def test_the_reference_says_what_the_case_says(case: Case) -> None:
    built, memory = _built(case), Memory()
    wrong: list[str] = []
    for row in _reads(case):
        _prepare(memory, case, row)
        found = judges.read_by_reference(built, memory, row)
        wrong += [] if judges.same(found, judges.expected_of(row)) else [f"{row}: read {found!r}"]
    for row in _writes(case, built):
        if judges.of_another_sort(built, row):
            continue
        _prepare(memory, case, row)
        found = judges.written_by_reference(built, memory, row)
        wrong += [] if found == _words(row) else [f"{row}: wrote {found!r}"]
    _report(wrong)


@each_apart
def test_the_driver_passes_the_vectors_of_the_map(case: Case) -> None:
    bench = judges.bench_of(_built(case))
    bench.check_registers()
    bench.check_device()
    bench.check_decoding()
    bench.check_encoding()
    bench.check_refusals()
    bench.check_conditions_of_writing()


@each_sound
def test_a_simulated_device_sends_and_takes_what_the_case_says(case: Case) -> None:
    built = _built(case)
    wrong = [text for row in _reads(case) if "shows" in row for text in _shown_wrong(case, built, row)]
    for row in _reads(case):
        register, view = judges.register_of(built, row)
        plain = _plain(row)
        if plain is None or row.get("lossy") or "shows" in row:
            continue
        device = judges.simulated(built, _held(case, row))
        device.poke(register.path, plain)
        found = _asked(case, device, register, view)
        wrong += [] if found == words_of(row["words"]) else [f"{row}: a device with {plain!r} sends {found}"]
    for row in _reads(case):
        if {"fault", "no_value", "shows"} & set(row) or row.get("lossy"):
            continue
        register, view = judges.register_of(built, row)
        device = judges.simulated(built, _held(case, row))
        judges.prime(device, view.space.value, view.address(register.at), words_of(row["words"]))
        found = _asked(case, device, register, view)
        wrong += [] if found == words_of(row["words"]) else [f"{row}: the words come back as {found}"]
    _report(wrong)


def _shown_wrong(case: Case, built: Built, row: Json) -> Iterator[str]:
    """What a device that holds the words of `shows` in the base view sends in the row's view."""
    register, view = judges.register_of(built, row)
    device, base = judges.simulated(built, _held(case, row)), register.base
    judges.prime(device, base.space.value, register.address, words_of(row["shows"]))
    found = _asked(case, device, register, view)
    if found != words_of(row["words"]):
        yield f"{row}: shown as {found}"


def _asked(case: Case, device: Any, register: Any, view: Any) -> list[int]:
    """The words of a view, on the page where it stands."""
    unit, requests = case.selecting(view.address(register.at))
    if 23 in view.functions:
        return _selected_and_asked(device, view.address(register.at) & 0xFFFF, view.words, requests)
    for request in requests:
        device.handle(request, unit=1)
    return judges.ask(device, register, view, unit=unit)


def _selected_and_asked(device: Any, address: int, count: int, requests: list[bytes]) -> list[int]:
    """The words of the answer to function 23, which writes what the requests write, and reads."""
    data = b"".join(request[6:] for request in requests)
    head = struct.pack(">BHH2sHB", 23, address, count, requests[0][1:3], len(data) // 2, len(data))
    return words_of(device.handle(head + data)[2:].hex())


def _held(case: Case, row: Json) -> Json:
    return {space: {**case.holds.get(space, {}), **row.get("holds", {}).get(space, {})} for space in _spaces(case, row)}


def _spaces(case: Case, row: Json) -> set[str]:
    return {*case.holds, *row.get("holds", {})}


def _plain(row: Json) -> Plain | None:
    for key in ("fault", "member", "special"):
        if key in row:
            return str(row[key]).rpartition(".")[2]
    if {"flags", "fields", "unknown", "no_value"} & set(row):
        return None
    value: Plain = row["value"]
    return int(value) if isinstance(value, bool) else value


@each_sound
def test_a_captured_answer_is_decoded_as_the_case_says(case: Case) -> None:
    built, memory = _built(case), Memory()
    wrong: list[str] = []
    for row in _reads(case):
        _prepare(memory, case, row)
        found = judges.decoded_by_tool(built, memory, row, case.selecting)
        sound = not {"fault", "no_value"} & set(row)
        if found.startswith("problem") is sound or (sound and found.partition(", rest=")[0] != _text(built, row)):
            wrong.append(f"{row}: decoded as {found!r}")
    _report(wrong)


def _text(built: Built, row: Json) -> str:
    """What `decode` prints for the value of a row."""
    declared = built.module.CaseA.registers[row["register"]]
    if "unknown" in row:
        return f"UNKNOWN_{row['unknown']}"
    value = judges.value_for(built, row)
    if "unnamed" in row:
        value |= row["unnamed"]
    absent = set(getattr(value, "parts", ())) - set(row.get("fields", ()))
    return as_text(declared, value.lacking(dict.fromkeys(absent, NotPresent("", "", {}))) if absent else value)
