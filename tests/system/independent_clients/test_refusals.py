"""Independent clients provoke every exception and every silence that the manuals document."""

from collections.abc import Callable, Sequence
from pathlib import Path

import pytest
from independent.answers import (
    Answer,
    Client,
    Partly,
    Payload,
    Raw,
    Read,
    Refused,
    Silent,
    Unable,
    Values,
    Write,
    Written,
)
from independent.families import FAMILIES, Family
from independent.minimal import Minimal, MinimalRtu
from independent.refusals import SERIES_100, SERIES_C, Case, broadcasts, platinum
from independent.stage import Stage
from independent.ways import CLIENTS, OVER_TCP, talking

from regscribe.model import Space
from regscribe.simulate import Foreign, SimulatedDevice

pytestmark = pytest.mark.wire

Count = Callable[..., None]
PLAIN = [family for family in FAMILIES if not family.sets]
SOON = 0.3
"""Seconds to wait where nothing must come."""

each_client = pytest.mark.parametrize("kind", CLIENTS, ids=lambda kind: kind.name)
each_family = pytest.mark.parametrize("family", PLAIN, ids=lambda family: family.name)


def cases_of(family: Family) -> Sequence[Case]:
    if "platinum" in family.map:
        return tuple(platinum(family.register_map.model(family.model)))
    return SERIES_100 if family.map.startswith("fdc") else SERIES_C


def first_words(device: SimulatedDevice, asked: Read, count: int) -> tuple[int | None, ...]:
    return tuple(device.state.words(Space.HOLDING, asked.address, count))


def fits(answer: Answer, case: Case, device: SimulatedDevice) -> bool:
    """Tell whether a client's answer is the manual's, as far as the client tells."""
    if case.first:
        asked = case.question
        assert isinstance(asked, Read)
        enough = isinstance(answer, Values) and len(answer.words) == asked.count
        return enough and answer.words[: case.first] == first_words(device, asked, case.first)  # type: ignore[union-attr]  # as `enough` tells
    if isinstance(answer, Partly) and isinstance(case.answer, Partly):
        return answer.count in {None, case.answer.count}
    return answer == case.answer


def patience(client: Client, expected: Answer) -> float:
    """Return how long to wait: minimalmodbus waits as long as it may for what an exception answer is too short for."""
    short = isinstance(expected, Silent) or (isinstance(client, Minimal) and isinstance(expected, Refused))
    return SOON if short else 3.0


def verdict(case: Case) -> str:
    return "silences" if isinstance(case.answer, Silent) else "exceptions"


@each_family
@each_client
def test_a_client_is_refused_and_ignored_as_the_manual_says(
    kind: type[Client], family: Family, agree: Count, tmp_path: Path
) -> None:
    with talking(kind, family.device(), tmp_path) as (client, stage):
        for case in cases_of(family):
            for path, value in case.before.items():
                stage.device.poke(path, value)
            answer = client.ask(stage.device.unit, case.question, patience(client, case.answer))
            if isinstance(answer, Unable):
                continue
            assert fits(answer, case, stage.device), f"{case.what} ({case.source}): {answer}, not {case.answer}"
            assert {path: stage.device.peek(path) for path in case.after} == dict(case.after), case.what
            if isinstance(case.answer, Refused | Partly | Silent):
                agree(client.name, family.name, verdict(case))
        assert_in_step(client, stage, family)


def assert_in_step(client: Client, stage: Stage, family: Family) -> None:
    """After all that, an ordinary request gets its own answer."""
    address = next(each.address for each in stage.device.model.registers if each.base.space is Space.HOLDING)
    expected = first_words(stage.device, Read(3, address), 1)
    assert client.ask(stage.device.unit, Read(3, address)) == Values(expected), family.name  # type: ignore[arg-type]  # a register's word is no None


@each_family
@each_client
def test_a_client_gets_no_answer_to_what_it_sends_to_all(
    kind: type[Client], family: Family, agree: Count, tmp_path: Path
) -> None:
    with talking(kind, family.device(), tmp_path) as (client, stage):
        for sent, path, value in broadcasts(stage.device.model):
            stage.device.poke(path, 0)
            answer = client.ask(0, sent, SOON)
            if isinstance(answer, Unable):
                continue
            assert answer == Silent(), sent
            obeyed = sent.function in stage.device.register_map.protocol.broadcast
            assert stage.device.peek(path) == (value if obeyed else 0), sent
            agree(client.name, family.name, "silences")
        answer = client.ask(0, Read(3, 0), SOON)
        if not isinstance(answer, Unable):
            assert answer == Silent()
            agree(client.name, family.name, "silences")
        assert_in_step(client, stage, family)


@each_family
@each_client
def test_a_request_to_another_unit_gets_what_such_a_line_gives(
    kind: type[Client], family: Family, agree: Count, tmp_path: Path
) -> None:
    gateway = OVER_TCP.get(kind) == "tcp"
    asked = Read(3, 0, 2)
    with talking(kind, family.device(), tmp_path) as (client, stage):
        answer = client.ask(stage.device.unit + 5, asked, 3.0 if gateway else SOON)
        assert answer == (Refused(11) if gateway else Silent())
        agree(client.name, family.name, "exceptions" if gateway else "silences")
        assert_in_step(client, stage, family)


@pytest.mark.parametrize("kind", [kind for kind, way in OVER_TCP.items() if way == "tcp"], ids=lambda kind: kind.name)
def test_a_request_to_another_unit_is_ignored_over_tcp_where_that_is_wanted(
    kind: type[Client], agree: Count, tmp_path: Path
) -> None:
    family = PLAIN[0]
    with talking(kind, family.device(), tmp_path, foreign=Foreign.SILENCE) as (client, stage):
        assert client.ask(stage.device.unit + 5, Read(3, 0, 2), SOON) == Silent()
        agree(client.name, family.name, "silences")
        assert_in_step(client, stage, family)


@each_family
def test_a_frame_with_a_wrong_checksum_is_ignored(family: Family, agree: Count, tmp_path: Path) -> None:
    with talking(MinimalRtu, family.device(), tmp_path) as (client, stage):
        assert isinstance(client, Minimal)
        assert client.send(bytes((stage.device.unit, 3, 0, 0, 0, 1, 0x12, 0x34)), SOON) == b""
        agree(client.name, family.name, "silences")
        assert_in_step(client, stage, family)


@pytest.mark.parametrize("kind", CLIENTS, ids=lambda kind: kind.name)
def test_a_controller_that_counts_from_one_is_addressed_one_higher(
    kind: type[Client], agree: Count, tmp_path: Path
) -> None:
    family = next(family for family in PLAIN if family.map == "athena/platinum-m300")
    device = SimulatedDevice(family.register_map, family.model, addressing="jbus")
    device.poke("setpoint", 321)
    with talking(kind, device, tmp_path) as (client, _):
        assert client.ask(device.unit, Read(3, 2)) == Values((321,))
        assert client.ask(device.unit, Read(3, 0), patience(client, Refused(2))) == Refused(2)
        assert client.ask(device.unit, Write(6, 2, (322,))) == Written()
        assert device.peek("setpoint") == 322
        agree(client.name, family.name, "exceptions")


@each_family
def test_the_status_byte_is_read_by_function_seven_where_there_is_one(
    family: Family, agree: Count, tmp_path: Path
) -> None:
    statuses = [each for each in family.register_map.model(family.model).registers if each.base.space is Space.STATUS]
    with talking(MinimalRtu, family.device(), tmp_path) as (client, stage):
        answer = client.ask(stage.device.unit, Raw(7))
        if statuses:
            assert answer == Payload(bytes(stage.device.peek_words(statuses[0].path)))
        else:
            assert answer == (Refused(1) if family.map.startswith("fdc") else Silent())
            agree(client.name, family.name, "exceptions" if family.map.startswith("fdc") else "silences")
