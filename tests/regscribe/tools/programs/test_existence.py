"""A program that exists only while a condition holds."""

import asyncio
import json
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from regscribe import checks, lower, schema, source
from regscribe.emit import markdown
from regscribe.export.json import json_text
from regscribe.simulate import simulate
from regscribe.tools import programs
from regscribe.tools.programs import Program, ProgramSlot, Segment, setting
from regscribe_runtime import NotPresent

from .conftest import KILN, PATIENCE, Bench, Built

LACKING = KILN.replace("    array: recipes\n", "    array: recipes\n    when: {programmer: fitted}\n").replace(
    "      - {at: 6, name: Order 2",
    "      - {at: 9, name: Programmer, enum: {0: none, 1: fitted}}\n      - {at: 6, name: Order 2",
)
OFF = Segment(to=setting("20 °C"), ramp=setting("1 min"), soak=setting("0 min"), outputs={"fan": "OFF"})
PROGRAM = Program(segments=(OFF, OFF), cycles=1, time_unit="min", holdback=setting("5 °C"))
TASKS: tuple[Callable[[ProgramSlot], Any], ...] = (
    programs.read,
    programs.status,
    lambda place: programs.check(place, PROGRAM),
    lambda place: programs.write(place, PROGRAM),
    lambda place: programs.act(place, "start"),
)
SAYS = "recipe 1: it exists only while programmer is FITTED (1); programmer is NONE (0)"


@pytest.fixture(scope="module")
def lacking(build: Callable[[str], Built]) -> Built:
    return build(LACKING)


@pytest.fixture
def bench(lacking: Built) -> Iterator[Bench]:
    with (
        simulate(lacking.map, "K1", unit=1) as running,
        lacking.driver.tcp(running.host, port=running.port, unit=1, timeout=PATIENCE) as device,
    ):
        yield Bench(running, device)


@pytest.mark.parametrize("task", TASKS)
def test_nothing_is_done_with_a_program_that_does_not_exist_now(task: Callable[[Any], Any], bench: Bench) -> None:
    place = programs.place(bench.device, "recipe 1")
    with pytest.raises(NotPresent) as caught:
        bench.device.run(task(place))
    assert str(caught.value) == SAYS
    assert bench.written == []

    bench.poke(programmer="FITTED")
    bench.device.run(task(place))


@pytest.mark.parametrize("task", TASKS)
def test_an_asyncio_driver_refuses_the_same(task: Callable[[Any], Any], lacking: Built) -> None:
    async def work(host: str, port: int) -> None:
        async with lacking.asynchronous.tcp(host, port=port, unit=1, timeout=PATIENCE) as device:
            await device.run(task(programs.place(device, "recipe 1")))

    with simulate(lacking.map, "K1", unit=1) as running, pytest.raises(NotPresent) as caught:
        asyncio.run(work(running.host, running.port))
    assert str(caught.value) == SAYS


def test_the_docs_and_the_export_say_when_it_exists(lacking: Built) -> None:
    (page,) = (text for path, text in markdown.render(lacking.map).items() if path.endswith(".md"))
    assert "| Exists only if | [`programmer`](#register-programmer) is fitted (1) |" in page
    (exported,) = json.loads(json_text([lacking.map]))["maps"]
    (program,) = exported["models"][0]["programs"]
    (test,) = program["when"]["tests"]
    assert test["register"] == "programmer"


def _rules(text: str) -> list[str]:
    document, _ = source.parse(text, name="maps/test/kiln.yaml")
    assert document is not None
    assert schema.validate(document) == []
    register_map, found = lower.lower(document)
    return [one.rule for one in (checks.check(register_map) if register_map else found)]


@pytest.mark.parametrize("key", ["when: {programmer: [0, 1]}", "requires: {when: {programmer: 1}, reason: an option}"])
def test_a_condition_of_a_program_can_hold(key: str) -> None:
    never = key.replace("{programmer: [0, 1]}", "[{programmer: 0}, {programmer: 1}]").replace(": 1}, r", ": 7}, r")
    assert "RS0470" in _rules(LACKING.replace("when: {programmer: fitted}", never))
    assert "RS0470" not in _rules(LACKING.replace("when: {programmer: fitted}", key))


@pytest.mark.parametrize("key", ["when: {programmer: 1}", "requires: {when: {programmer: 1}, reason: an option}"])
def test_a_condition_that_cannot_be_read_is_refused(key: str) -> None:
    text = LACKING.replace("when: {programmer: fitted}", key)
    assert "RS0463" not in _rules(text)
    assert "RS0463" in _rules(text.replace("name: Programmer, enum", "name: Programmer, access: w, enum"))


@pytest.mark.parametrize("key", ["when: {given: option}", "requires: {when: {given: option}, reason: an option}"])
def test_a_given_that_a_program_needs_is_not_in_vain(key: str) -> None:
    givens = "givens: {option: {type: boolean, description: is it fitted, reason: an option}}\nprograms:\n"
    text = LACKING.replace("programs:\n  recipe", givens + "  recipe")
    assert "RS0473" in _rules(text)
    assert "RS0473" not in _rules(text.replace("when: {programmer: fitted}", key))
