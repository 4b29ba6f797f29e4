"""tshark's Modbus dissector reads the traffic of the own driver's link with the simulated device as both meant it."""

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

import pytest
from independent.answers import Partly, Read, Refused, Write
from independent.capture import Packet, dissected, relayed
from independent.drivers import readings, written
from independent.families import FAMILIES, Family
from independent.places import reading_functions, stretches
from independent.refusals import SERIES_100, SERIES_C, Case, platinum
from independent.stage import service, staged

from regscribe.model import Space, WireType
from regscribe.simulate import SimulatedDevice
from regscribe_runtime.link.connect import tcp
from regscribe_runtime.wire.requests import Reply, Request

pytestmark = pytest.mark.wire

Count = Callable[..., None]
NAME = "tshark"
SIX_DIGITS = 1e-5
GOOD = "1"
"""How the dissector says that a checksum is right."""

FORMATS = {True: "MODICON FLT", False: "IEEE FLT   "}
"""The dissector's names for IEEE numbers whose low word comes first, or last."""


class Said(NamedTuple):
    """A request, the answer as the link understood it, and the column of the table."""

    request: Request
    reply: Reply
    column: str


def conversation(family: Family, device: SimulatedDevice) -> Iterator[tuple[Request, str]]:
    """Yield requests that cover the family: everything is read, some is written, what is refused is tried."""
    for stretch in stretches(device):
        for function in reading_functions(device.register_map, stretch.first.view.space):
            yield Request(function, stretch.first.address, stretch.words), f"{stretch.first.column} r"
    for case in written(family):
        yield Request(case.function, case.address, len(case.words), case.words), f"{case.column} w"
    for refused in refusals(family):
        if isinstance(refused.answer, Refused | Partly):
            match refused.question:
                case Read(function, address, count):
                    yield Request(function, address, count), "exceptions"
                case Write(function, address, words):
                    yield Request(function, address, len(words), words), "exceptions"


def refusals(family: Family) -> Sequence[Case]:
    if "platinum" in family.map:
        return tuple(platinum(family.register_map.model(family.model)))
    return SERIES_100 if family.map.startswith("fdc") else SERIES_C


def talk(family: Family, folder: Path, framing: str) -> tuple[list[Said], list[Packet]]:
    device = family.device()
    with (
        staged(device, service("tcp" if framing == "tcp" else "rtu-tcp")) as stage,
        relayed(stage.servers[0].host, stage.servers[0].port) as (host, port, chunks),
    ):
        link = tcp(host, port=port, framing=framing, timeout=5.0)
        link.open()
        asked = [each for each in conversation(family, device) if not beyond(each[0], framing)]
        said = [Said(request, link.call(device.unit, request), what) for request, what in asked]
        link.close()
    return said, dissected(chunks, folder, rtu=framing == "rtu")


def beyond(request: Request, framing: str) -> bool:
    """Tell whether pymodbus will not send it (126 words), or the dissector takes no frame for one (07 in RTU)."""
    return request.quantity > 125 or (framing == "rtu" and request.function == 7)


@pytest.mark.parametrize("framing", ["tcp", "rtu"])
@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.name)
def test_the_dissector_understands_each_request_and_each_answer(
    framing: str, family: Family, agree: Count, tmp_path: Path
) -> None:
    said, packets = talk(family, tmp_path, framing)
    assert len(packets) == 2 * len(said)
    for each, request, answer in zip(said, packets[::2], packets[1::2], strict=True):
        assert (request.by_client, answer.by_client) == (True, False)
        assert not request.complaint + answer.complaint, each
        if framing == "rtu":
            assert request.checksum == answer.checksum == GOOD
        assert_request(each.request, request)
        assert_answer(each, answer)
        agree(f"{NAME} {framing.upper()}", family.name, each.column)


def assert_request(request: Request, packet: Packet) -> None:
    assert packet.function == request.function
    if request.function in {7, 8}:
        return
    assert packet.address == request.address
    if request.function in {1, 2, 3, 4, 15, 16}:
        assert packet.count == request.quantity
    if request.function == 16:
        assert packet.words == request.words
        assert packet.numbers == tuple(range(request.address, request.address + len(request.words)))


def assert_answer(said: Said, packet: Packet) -> None:
    request, reply = said.request, said.reply
    assert packet.function == request.function
    assert packet.exception == reply.exception
    if reply.exception is not None or request.function in {7, 8}:
        return
    if request.function in {3, 4}:
        assert packet.words == reply.words
        assert packet.numbers == tuple(range(request.address, request.address + request.quantity))
    elif request.function in {1, 2}:
        assert packet.bits[: request.quantity] == reply.words
    else:
        assert packet.address == request.address
        assert request.function not in {15, 16} or packet.count == reply.quantity


@pytest.mark.parametrize("family", FAMILIES[:4], ids=lambda family: family.name)
def test_the_dissector_reads_the_numbers_that_the_driver_reads(family: Family, agree: Count, tmp_path: Path) -> None:
    said = readings(family)
    device = family.device()
    with (
        staged(device, service("tcp")) as stage,
        relayed(stage.servers[0].host, stage.servers[0].port) as (host, port, chunks),
    ):
        link = tcp(host, port=port, timeout=5.0)
        link.open()
        floats = [each for each in stretches(device) if each.first.view.type is WireType.FLOAT32]
        for stretch in floats:
            link.call(device.unit, Request(3, stretch.first.address, stretch.words))
        link.close()
    packets = dissected(chunks, tmp_path, floats=FORMATS[floats[0].first.swapped])
    for stretch, packet in zip(floats, packets[1::2], strict=True):
        for each, number in zip(stretch.values, packet.floats, strict=True):
            use = device.state.to_value(each.register, device.state.stored(each.register.path))  # type: ignore[arg-type]  # a number, as all IEEE registers
            assert number == pytest.approx(float(device.state.stored(each.register.path)), rel=SIX_DIGITS)
            assert said[each.register.path, "ieee"] == pytest.approx(float(use), rel=SIX_DIGITS)
            agree(f"{NAME} TCP", family.name, f"{each.column} r")
        assert each.view.space is Space.HOLDING
