"""Platinum drivers against simulated controllers: programs, JBUS, bits, and who answers."""

import importlib
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import Any

import pytest

from regscribe.simulate import simulate
from regscribe.simulate.map_cache import find_map
from regscribe_devices.athena.platinum_c10_m10 import AthenaC10
from regscribe_devices.athena.platinum_x5000 import AthenaX5000
from regscribe_runtime import ExceptionAnswer, ValueRefused, identify, known_models, tcp

MAPS = Path(__file__).parents[3] / "maps"
PATHS = sorted(path for path in MAPS.glob("*/*.yaml") if not path.name.endswith(".library.yaml"))


FAMILIES = {path.stem: find_map(path) for path in PATHS}
MODELS = [(family, model.name) for family, found in FAMILIES.items() for model in found.models]
ALIKE = [{"18C", "25C", "CN8240", "CN8260"}, {"16C", "CN8200"}, {"C10", "M10"}]
"""Models whose identity registers give the same answer (a CN8200 is a 16C under another name)."""


def test_a_segment_of_a_program_is_reached_by_the_manuals_numbers() -> None:
    with (
        simulate(FAMILIES["platinum-x5000"], "X5000", unit=1) as running,
        AthenaX5000.tcp(running.host, port=running.port, unit=1) as controller,
    ):
        controller.programs[2].segments[7].setpoint.write(850)

        assert running.device.peek_words("programs[2].segments[7].setpoint") == (850,)
        assert AthenaX5000.registers["programs[2].segments[7].setpoint"].at == 180 + 68 + 5 + 7 * 4 + 1
        assert [len(program.segments) for program in controller.programs] == [15] * 4
        with pytest.raises(IndexError, match="1 to 4"):
            controller.programs[5]
        with pytest.raises(IndexError, match="0 to 14"):
            controller.programs[1].segments[15]


def test_a_whole_program_is_read_in_one_request() -> None:
    with (
        simulate(FAMILIES["platinum-x5000"], "X5000", unit=1) as running,
        AthenaX5000.tcp(running.host, port=running.port, unit=1) as controller,
    ):
        before = len(running.requests)
        program = controller.programs[3].read()
        segment = controller.programs[3].segments[4].read()

    assert len(running.requests) - before == 2
    assert len(program) == 68
    assert program["segments[4].setpoint"] == segment["setpoint"]


def test_a_unit_set_to_jbus_is_addressed_one_higher() -> None:
    with simulate(FAMILIES["platinum-c10-m10"], "C10", unit=1, addressing="jbus") as running:
        with AthenaC10.tcp(running.host, port=running.port, unit=1, addressing="jbus") as controller:
            controller.local_setpoint.write(123)
            assert controller.local_setpoint.read() == 123
            assert controller.read(controller.groups.status) is not None
        assert running.device.peek("local_setpoint") == 123
        assert running.requests[-2][1:3] != (4).to_bytes(2, "big")
        with AthenaC10.tcp(running.host, port=running.port, unit=1) as misled:
            assert misled.proportional_band.read_raw() == (123,)  # the neighbour


def test_configuration_is_brought_into_effect_by_the_write_that_changes_it() -> None:
    with (
        simulate(FAMILIES["platinum-c10-m10"], "C10", unit=1) as running,
        AthenaC10.tcp(running.host, port=running.port, unit=1) as controller,
    ):
        controller.decimal_point.write(1)

        assert running.device.commands_run == ("apply_configuration",)


def test_a_read_only_word_is_refused_with_the_manuals_code() -> None:
    with (
        simulate(FAMILIES["platinum-c10-m10"], "C10", unit=1) as running,
        AthenaC10.tcp(running.host, port=running.port, unit=1) as controller,
    ):
        with pytest.raises(ValueRefused, match="read-only"):
            AthenaC10.process_variable.encode(5)
        with pytest.raises(ExceptionAnswer) as caught:
            controller.run(_write(0))
        assert caught.value.code == 7


def _write(address: int) -> Any:
    from regscribe_runtime.wire.requests import Request  # noqa: PLC0415 (this one test speaks the wire itself)

    def task(session: Any) -> Any:
        return (yield from session.exchange(Request(6, address, 1, (1,))))

    return task


@pytest.mark.parametrize(("family", "model"), MODELS)
def test_every_model_is_recognised_and_only_those_that_answer_alike_with_it(family: str, model: str) -> None:
    found = FAMILIES[family]
    givens = {given.id: {1} for given in found.givens}
    with simulate(found, model, unit=1, givens=givens) as running:
        link = tcp(running.host, port=running.port)
        link.open()
        told = {known.model for known in identify(link, unit=1).models}
        link.close()

    expected = next((alike for alike in ALIKE if model in alike), {model})
    assert model in told
    assert told <= expected


def module(family: str) -> Any:
    """The generated driver of a family."""
    return importlib.import_module(f"regscribe_devices.{FAMILIES[family].id.replace('-', '_').replace('/', '.')}")


@pytest.mark.parametrize(("family", "model"), MODELS)
def test_registers_stand_in_the_order_of_the_own_manual_and_cite_its_sections(family: str, model: str) -> None:
    found = FAMILIES[family].model(model)
    for prefix in ("", "Async"):
        driver = getattr(module(family), f"{prefix}{found.class_name}")
        told = [(path, one.section, one.persistence, one.stays) for path, one in driver.registers.items()]
        assert told == [(one.path, one.section, one.persistence, one.stays) for one in found.registers]


def said(thing: Any) -> Any:
    """What a map says of something, but for what its manual numbers or the models keep in their own way."""
    if isinstance(thing, tuple):
        return tuple(map(said, thing))
    own = {"span", "section", "group", "persistence", "endurance"}
    if is_dataclass(thing):
        return tuple(said(getattr(thing, one.name)) for one in fields(thing) if one.name not in own)
    return thing


def test_what_two_platinum_maps_say_alike_stands_in_their_library() -> None:
    seen: dict[Any, str] = {}
    for family, found in ((family, found) for family, found in FAMILIES.items() if family.startswith("platinum")):
        own = [one for model in found.models for one in model.registers if not one.span.file.endswith(".library.yaml")]
        for register in own:
            alike = said(register)
            assert seen.setdefault(alike, family) == family, f"{seen[alike]} and {family} both declare {register.path}"
    assert set(seen.values()) == {family for family in FAMILIES if family.startswith("platinum")}


def test_all_21_models_are_known() -> None:
    assert {(known.map_id.split("/")[1], known.model) for known in known_models()} >= set(MODELS)
    assert len(MODELS) == 21
