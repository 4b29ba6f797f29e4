"""Every frame that a manual prints, byte for byte: sent to the simulated device, sent by the link, taken by the link.

Nothing but the project itself is needed here, so `make test` runs it.
"""

import contextlib
import socket
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from fractions import Fraction
from typing import NamedTuple

import pytest
from independent.drivers import bound
from independent.families import FAMILIES, compiled
from independent.stage import Stage, service, staged

from regscribe.model import FrameExample, RegisterMap, Space
from regscribe.simulate import SimulatedDevice
from regscribe_runtime.errors import NoAnswer
from regscribe_runtime.link.connect import tcp
from regscribe_runtime.link.links import Link
from regscribe_runtime.wire.requests import LOOPBACK, READ_STATUS, Request

SOON = 0.2
"""Seconds to wait where no answer must come."""

MAPS = tuple(dict.fromkeys(family.map for family in FAMILIES))
GIVENS = {family.map: family.givens for family in FAMILIES}
PLATINUM = "athena/platinum-c10-m10"
"""The map that cites the frames of the Platinum manual's general chapters, which are about no controller."""

ABLE = {"3.1": "x100-x400", "3.3": "x100-x400", "3.6": "m300", "3.7": "c10-m10", "3.9": "m300", "4": "c10-m10"}
"""A map whose controller has what the exchange of a general chapter speaks of."""

NOBODY = {
    "3.5": "bit 3 is read-only on every controller of chapters 7 to 12: the request is refused with 07",
    "3.8": "bits 0 to 3 cannot all be written on any of them: the request is refused with 07",
}
"""Exchanges that none of the controllers can carry out."""


class Printed(NamedTuple):
    """An exchange of a manual: `answer` None where it prints the request only."""

    map: str
    request: FrameExample
    answer: FrameExample | None

    @property
    def name(self) -> str:
        """How tests call it."""
        return f"{self.map} {self.request.source} {self.request.frame[:8].hex()}"

    @property
    def sent(self) -> bytes:
        """The request with its checksum, also where the manual leaves that out."""
        return with_crc(self.request)

    @property
    def body(self) -> bytes:
        """The request between unit id and checksum."""
        return self.sent[1:-2]


def with_crc(example: FrameExample) -> bytes:
    if example.crc:
        return example.frame
    crc = 0xFFFF  # spelled out once more, so that it is not the library's that is compared with itself
    for byte in example.frame:
        crc ^= byte
        for _ in range(8):
            crc = crc >> 1 ^ (0xA001 if crc & 1 else 0)
    return example.frame + crc.to_bytes(2, "little")


def exchanges(name: str) -> Iterator[Printed]:
    frames = [each for each in compiled(name).examples if isinstance(each, FrameExample)]
    for request, following in zip(frames, [*frames[1:], None], strict=True):
        if not request.answer:
            answered = following is not None and following.answer and following.source == request.source
            yield Printed(name, request, following if answered else None)


ALL = [each for name in MAPS for each in exchanges(name)]
OF_A_DEVICE = [each for each in ALL if each.map != PLATINUM]
GENERAL = [each for each in ALL if each.map == PLATINUM]
every_exchange = pytest.mark.parametrize("printed", ALL, ids=lambda printed: printed.name)


def device_for(printed: Printed, name: str = "") -> SimulatedDevice:
    """Make the device that the request addresses, in the state that the manual states or the answer shows."""
    register_map = compiled(name or printed.map)
    model = printed.request.model
    if name or printed.request.function == 3:  # addresses, of which some model may lack a few
        model = max(register_map.models, key=lambda each: len(each.registers)).name
    unit = printed.request.unit or None
    device = SimulatedDevice(register_map, model, unit=unit, givens=GIVENS.get(register_map.id, {}))
    for path, value in printed.request.state:
        device.poke(path, value)
    if printed.answer is not None and printed.answer.function in {1, 3, 7}:
        show(device, printed)
    return device


def show(device: SimulatedDevice, printed: Printed) -> None:
    """Let the device hold what the printed answer to a read shows."""
    assert printed.answer is not None
    data = printed.answer.frame[2:-2]
    space = {1: Space.COIL, 3: Space.HOLDING, 7: Space.STATUS}[printed.request.function]
    first = printed.request.address or 0
    for register in device.model.registers:
        place = register.address - first
        if register.base.space is space and 0 <= place < (printed.request.count or 1):
            device.state.store(register.path, Fraction(shown(data, space, place)))


def shown(data: bytes, space: Space, place: int) -> int:
    """Return bit or word `place` of the data of an answer to a read."""
    if space is Space.STATUS:
        return data[0]
    if space is Space.COIL:
        return int.from_bytes(data[1:], "little") >> place & 1
    return int.from_bytes(data[1 + 2 * place : 3 + 2 * place], "big")


def answer_of(stage: Stage, frame: bytes) -> bytes:
    """Put a frame on the line of the device; what comes back."""
    server = stage.servers[0]
    with socket.create_connection((server.host, server.port), timeout=5) as link:
        link.sendall(frame)
        if frame[0] == 0:
            link.settimeout(SOON)
        with contextlib.suppress(TimeoutError):
            return link.recv(512)
    return b""


def by_the_standard(printed: Printed, device: SimulatedDevice) -> bytes:
    """Return the answer that the Modbus standard gives a request which the manual prints without an answer."""
    request = printed.request
    if request.unit == 0:
        return b""
    if request.function in {6, 8}:
        return printed.sent
    if request.function == 16:
        return with_crc(replace(request, frame=request.frame[:6], crc=False))
    assert request.address is not None
    assert request.count is not None
    words = device.state.words(Space.HOLDING, request.address, request.count)
    data = b"".join((word or 0).to_bytes(2, "big") for word in words)
    return with_crc(replace(request, frame=bytes((request.unit, request.function, len(data))) + data, crc=False))


@pytest.mark.parametrize("printed", OF_A_DEVICE, ids=lambda printed: printed.name)
def test_the_device_does_what_a_printed_frame_asks_and_answers_as_printed(printed: Printed) -> None:
    device = device_for(printed)
    with staged(device, service("rtu-tcp")) as stage:
        expected = printed.answer.frame if printed.answer else by_the_standard(printed, device)
        assert answer_of(stage, printed.sent) == expected
        for path, value in printed.request.writes:
            assert device.peek(path) == value
        assert device.commands_run == ((printed.request.command,) if printed.request.command else ())


@pytest.mark.parametrize(
    "printed",
    [each for each in GENERAL if each.request.source not in NOBODY],
    ids=lambda printed: printed.request.source,
)
def test_an_exchange_of_the_general_chapters_is_that_of_a_controller_which_has_the_addresses(printed: Printed) -> None:
    device = device_for(printed, f"athena/platinum-{ABLE[printed.request.source]}")
    assert printed.answer is not None
    with staged(device, service("rtu-tcp")) as stage:
        assert answer_of(stage, printed.sent) == printed.answer.frame


@pytest.mark.parametrize("source", NOBODY)
@pytest.mark.parametrize("name", [name for name in MAPS if "platinum" in name])
def test_what_no_controller_can_carry_out_is_refused_by_each(name: str, source: str) -> None:
    (printed,) = (each for each in GENERAL if each.request.source == source)
    register_map = compiled(name)
    for model in register_map.models:
        device = SimulatedDevice(register_map, model.name, unit=printed.request.unit)
        refusal = bytes((0x80 | printed.request.function, 7))
        assert device.handle(printed.body) == refusal


@contextmanager
def other_end(answer: bytes) -> Iterator[tuple[Link, list[bytes]]]:
    """A link to a peer that keeps what it gets and answers everything with the same bytes."""
    got: list[bytes] = []
    with socket.create_server(("127.0.0.1", 0)) as listener:

        def listen() -> None:
            with contextlib.suppress(OSError), listener.accept()[0] as peer:
                while data := peer.recv(512):
                    got.append(data)
                    peer.sendall(answer)

        thread = threading.Thread(target=listen, daemon=True)
        thread.start()
        host, port = listener.getsockname()
        link = tcp(host, port=port, framing="rtu", timeout=5.0 if answer else SOON)
        link.open()
        try:
            yield link, got
        finally:
            link.close()
            thread.join(timeout=5)


def as_request(example: FrameExample) -> Request:
    """Return the request of a frame as the drivers hold it, read off the bytes."""
    body = example.frame[2:-2] if example.crc else example.frame[2:]
    address, second = (int.from_bytes(body[at : at + 2], "big") for at in (0, 2))
    words = {
        5: (int(second == 0xFF00),),
        6: (second,),
        8: (second,),
        15: tuple(body[5] >> bit & 1 for bit in range(second)) if example.function == 15 else (),
        16: tuple(int.from_bytes(body[at : at + 2], "big") for at in range(5, len(body), 2)),
    }.get(example.function, ())
    if example.function in {READ_STATUS, LOOPBACK}:
        return Request(example.function, 0, 1, words)
    return Request(example.function, address, 1 if example.function in {5, 6} else second, words)


@every_exchange
def test_the_link_of_the_drivers_sends_the_printed_bytes(printed: Printed) -> None:
    refusal = with_crc(replace(printed.request, frame=bytes((printed.sent[0], 0x80 | printed.sent[1], 4)), crc=False))
    with other_end(refusal if printed.request.unit else b"") as (link, got), contextlib.suppress(NoAnswer):
        link.call(printed.request.unit, as_request(printed.request))
    assert b"".join(got) == printed.sent


@pytest.mark.parametrize("printed", [each for each in ALL if each.answer], ids=lambda printed: printed.name)
def test_the_link_of_the_drivers_takes_the_printed_answer(printed: Printed) -> None:
    assert printed.answer is not None
    asked = as_request(printed.request)
    data = printed.answer.frame[2:-2]
    with other_end(printed.answer.frame) as (link, _):
        reply = link.call(printed.request.unit, asked)
    if printed.answer.function & 0x80:
        assert (reply.function, reply.exception) == (asked.function, data[0])
    elif asked.function in {1, 3, 7}:
        space = {1: Space.COIL, 3: Space.HOLDING, 7: Space.STATUS}[asked.function]
        assert reply.words == tuple(shown(data, space, place) for place in range(asked.quantity))
    else:
        assert reply.address == asked.address
        assert reply.words == asked.words or reply.quantity == len(asked.words)


def by_a_driver(printed: Printed) -> bool:
    """Tell whether one verb of a driver makes the frame: a command, or the write of one value by 06 or 16."""
    one = len(printed.request.writes) == 1 and (printed.request.function == 6 or printed.request.view == "ieee")
    return printed.request.unit != 0 and (bool(printed.request.command) or one)


@pytest.mark.parametrize("printed", [each for each in ALL if by_a_driver(each)], ids=lambda printed: printed.name)
def test_a_driver_makes_the_printed_request_of_a_value_or_a_command(printed: Printed) -> None:
    family = next(family for family in FAMILIES if family.map == printed.map)
    model = replace(family, model=printed.request.model)
    with staged(device_for(printed), service("tcp")) as stage:
        server = stage.servers[0]
        with model.driver(tcp(server.host, port=server.port), printed.request.unit) as driver:
            if printed.request.command:
                getattr(driver.commands, printed.request.command)(confirm=True)
            for path, value in printed.request.writes:
                bound(driver, path).write(float(value) if value.denominator > 1 else int(value), confirm=True)
        assert printed.body in stage.requests


class Misprint(NamedTuple):
    """A frame that a manual prints wrongly: `where` is how its erratum begins, `wrong` are the printed bytes."""

    map: str
    where: str
    wrong: str
    right: str


MISPRINTS = (
    Misprint("athena/series-c", "2.3.3", "00 06 01 E2 00 05 E9 D2", "00 06 0F F2 00 05 EA FF"),
    Misprint("omega/cn8200", "3.3.3", "00 06 01 E2 00 05 E9 D2", "00 06 0F F2 00 05 EA FF"),
)


@pytest.mark.parametrize("misprint", MISPRINTS, ids=lambda misprint: misprint.map)
def test_a_misprinted_frame_is_an_erratum_and_does_not_do_what_the_manual_says(misprint: Misprint) -> None:
    register_map = compiled(misprint.map)
    assert any(misprint.where in each.where and misprint.wrong in each.printed for each in register_map.errata)
    assert rate_after(register_map, bytes.fromhex(misprint.wrong)) == 7, "the speed of a new device"
    assert rate_after(register_map, bytes.fromhex(misprint.right)) == 5, "2400 baud, as the text says"


def rate_after(register_map: RegisterMap, frame: bytes) -> object:
    device = SimulatedDevice(register_map, register_map.models[-1].name)
    with staged(device, service("rtu-tcp")) as stage:
        assert answer_of(stage, frame) == b""
    return device.peek("baud_rate")


def test_no_printed_frame_is_left_out() -> None:
    """The manuals print 11 (Series C), 11 (CN8200, the same), 8 (Series 100) and 16 (Platinum) frames."""
    counted = {
        name: {each.frame for each in compiled(name).examples if isinstance(each, FrameExample)} for name in MAPS
    }
    assert len(counted["athena/series-c"]) == len(counted["omega/cn8200"]) == 11
    assert len(counted["fdc/series-100"]) == 8
    general = [each for each in compiled(PLATINUM).examples if isinstance(each, FrameExample)]
    assert len(general) == 16
