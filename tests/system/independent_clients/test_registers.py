"""Independent clients read and write every kind of register of every family, as the drivers and the devices do."""

import struct
from collections.abc import Callable, Sequence
from pathlib import Path

import pytest
from independent.answers import Client, Partly, Payload, Raw, Read, Unable, Values, Write, Written
from independent.drivers import FINE, Case, agrees, bound, readings, written
from independent.families import FAMILIES, Family
from independent.mbpoll import Mbpoll
from independent.places import Shown, Stretch, reading_functions, stretches
from independent.ways import CLIENTS, own_link, talking

from regscribe.model import Space, WireType
from regscribe.simulate import SimulatedDevice

pytestmark = pytest.mark.wire

Count = Callable[..., None]
SIX_DIGITS = 1e-5

each_client = pytest.mark.parametrize("kind", CLIENTS, ids=lambda kind: kind.name)
each_family = pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.name)


def seen(client: Client, device: SimulatedDevice, stretch: Stretch) -> Sequence[float | str] | None:
    """Return what the client makes of each value; None if it cannot ask for them."""
    first, unit = stretch.first, device.unit
    match first.view.type:
        case WireType.INT16:
            return client.signed(unit, first.address, stretch.words)
        case WireType.FLOAT32:
            return client.floats(unit, first.address, len(stretch.values), swapped=first.swapped)
        case WireType.STRING:
            return [client.text(unit, first.address, stretch.words)]
        case _:
            return words(client, device, stretch, reading_functions(device.register_map, first.view.space)[0])


def words(client: Client, device: SimulatedDevice, stretch: Stretch, function: int) -> tuple[int, ...] | None:
    asked = Raw(7) if function == 7 else Read(function, stretch.first.address, stretch.words)
    match client.ask(device.unit, asked):
        case Values(found):
            return found
        case Payload(data):
            return tuple(data)
        case Unable():
            return None
        case other:
            pytest.fail(f"{client.name} got {other} for {asked}")


@each_family
@each_client
def test_a_client_reads_in_every_view_what_driver_and_device_have(
    kind: type[Client], family: Family, agree: Count, tmp_path: Path
) -> None:
    said = readings(family)
    with talking(kind, family.device(), tmp_path) as (client, stage):
        for stretch in stretches(stage.device):
            numbers = seen(client, stage.device, stretch)
            if numbers is None:
                assert stretch.first.view.space is Space.STATUS, "only function 07 is beyond a client"
                continue
            assert len(numbers) == len(stretch.values)
            for each, number in zip(stretch.values, numbers, strict=True):
                fine = SIX_DIGITS if isinstance(client, Mbpoll) else FINE
                assert is_held(stage.device, each, number, fine), (each, number)
                driven = said[each.register.path, each.view.name]
                assert agrees(stage.device, each.register, each.view, number, driven, fine), (each, number, driven)
                agree(client.name, family.name, f"{each.column} r")
            assert_functions_alike(client, stage.device, stretch)


def is_held(device: SimulatedDevice, each: Shown, number: float | str, fine: float) -> bool:
    """Tell whether the device holds what the client read, compared as words packed by the struct module."""
    view = each.view
    if view.type is WireType.FLOAT32:
        stored = device.state.stored(each.register.path)
        assert not isinstance(stored, str)
        single: float = struct.unpack(">f", struct.pack(">f", stored * view.factor))[0]
        return number == pytest.approx(single, rel=fine)
    held = device.peek_words(each.register.path, view.name)
    if isinstance(number, str):
        return number.encode("latin-1") == struct.pack(f">{len(held)}H", *held)
    return (int(number) & 0xFFFF,) == held


def assert_functions_alike(client: Client, device: SimulatedDevice, stretch: Stretch) -> None:
    """Where the manual says that another function does the same, it does."""
    functions = reading_functions(device.register_map, stretch.first.view.space)
    found = {words(client, device, stretch, function) for function in functions}
    assert len(found) == 1, found


@each_family
@each_client
def test_a_client_writes_as_the_driver_does_byte_for_byte(
    kind: type[Client], family: Family, agree: Count, tmp_path: Path
) -> None:
    cases = written(family)
    assert cases or "c10" in family.map, "nothing could be written"
    with (
        talking(kind, family.device(), tmp_path) as (client, stage),
        family.driver(own_link(stage), stage.device.unit) as driver,
    ):
        for case in cases:
            before = stage.device.state.stored(case.path)
            for function in writing_functions(stage.device, case):
                stage.device.state.store(case.path, before)
                stage.requests.clear()
                answer = write(client, stage.device.unit, case, function)
                if isinstance(answer, Unable):
                    continue
                assert answer == Written(), (case, answer)
                if function == case.function:
                    assert stage.writes() == [case.pdu], f"the driver sent {case.pdu.hex(' ')}"
                assert stage.device.peek_words(case.path, case.view) == case.words
                assert bound(driver, case.path).read(view=case.view) == pytest.approx(case.value)
                agree(client.name, family.name, f"{case.column} w")
            stage.device.state.store(case.path, before)


def write(client: Client, unit: int, case: Case, function: int) -> Written | Partly | object:
    if case.column.startswith("float32"):
        return client.write_float(unit, case.address, case.number, swapped="low word first" in case.column)
    return client.ask(unit, Write(function, case.address, case.words))


def writing_functions(device: SimulatedDevice, case: Case) -> tuple[int, ...]:
    """Return the functions that may write a case: one or several, bits or words."""
    if case.column == "coil":
        return (5, 15)
    if len(case.words) > 1:
        return (16,)
    return tuple(function for function in (6, 16) if function in device.register_map.protocol.functions)


@each_client
@pytest.mark.parametrize("family", FAMILIES[::2], ids=lambda family: family.name)
def test_a_client_writes_several_values_at_once(
    kind: type[Client], family: Family, agree: Count, tmp_path: Path
) -> None:
    singles = {case.address: case for case in written(family) if case.function == 6}
    first = next((case for case in singles.values() if case.address + 1 in singles), None)
    if first is None:
        pytest.skip("no two harmless registers stand side by side")
    both = (first, singles[first.address + 1])
    with talking(kind, family.device(), tmp_path) as (client, stage):
        sent = tuple(word for case in both for word in case.words)
        assert client.ask(stage.device.unit, Write(16, first.address, sent)) == Written()
        assert stage.writes() == [struct.pack(">BHHB2H", 16, first.address, 2, 4, *sent)]
        for case in both:
            assert stage.device.peek_words(case.path, case.view) == case.words
            agree(client.name, family.name, f"{case.column} w")
