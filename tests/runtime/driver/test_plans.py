"""`regscribe plan` shows what a driver sends, request by request, to a server that knows nothing of plans."""

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from regscribe.cli.app import run
from regscribe.map_files import shipped
from regscribe.model import GivenKind, RegisterMap
from regscribe.simulate.map_cache import find_map
from regscribe.tools.live import catalogue
from regscribe_runtime.values.serial_line import SerialLine

Requests = list[tuple[int, int, int]]
SERIAL = ("--baud", "9600", "--line-format", "8N1")
MAPS = sorted(path for path in shipped().rglob("*.yaml") if not path.name.endswith(".library.yaml"))
HEAD = """\
format: 1
map: {id: test/planned, title: Planned, maker: Nobody, class_prefix: Planned}
manual: {title: None}
models: {One: {}}
protocol: {functions: [3, 6, 16], limits: {read_words: 20, write_words: 20}}
"""
GROUP = """\
groups:
  - id: main
    name: Main
    source: "1"
    each: {access: rw, type: int16}
    registers:
"""
ORDER = "word_order: {register: order, codes: {0: big, 1: little}}"
TWO_PLACES = f"""{HEAD}
views:
  two:
    base: {{type: uint32, stride: 2, preferred: true}}
    other: {{type: uint32, offset: 100, stride: 2, {ORDER}}}
{GROUP}      - {{at: 0, name: Value, views: two}}
      - {{at: 102, name: Beside}}
      - {{at: 300, name: Order, range: 0..1}}
"""
FLOATS = TWO_PLACES.replace("uint32", "float32")
PREFERRED = f"""{HEAD}
views:
  two:
    base: {{type: uint32, stride: 2}}
    other: {{type: uint32, offset: 100, stride: 2, preferred: true, {ORDER}}}
{GROUP}      - {{at: 0, name: Value, views: two}}
      - {{at: 2, name: Beside}}
      - {{at: 300, name: Order, range: 0..1}}
"""
CIRCLE = f"""{HEAD}
decimals: {{one: {{register: high_places}}, two: {{register: low_places}}}}
{GROUP}      - {{at: 0, name: Low, decimals: one}}
      - {{at: 1, name: Low places, range: 0..3}}
      - {{at: 500, name: High, decimals: two}}
      - {{at: 501, name: High places, range: 0..3}}
"""
ARRAY = f"""{HEAD}
decimals: {{one: {{register: places}}}}
{GROUP}      - id: rows
        name: Row
        repeat: 1..4
        stride: 40
        registers:
          - {{at: 0, name: Value, decimals: one}}
          - {{at: 30, name: Places, range: 0..3}}
          - {{at: 1, name: Wide, type: uint32, {ORDER}}}
          - {{at: 33, name: Order, range: 0..1}}
"""


def shown(capsys: pytest.CaptureFixture[str], path: Path, model: str, *words: str) -> Requests:
    """The requests of the plan that the command shows."""
    capsys.readouterr()
    assert run(["plan", str(path), "--model", model, "--json", *words]) == 0
    found = json.loads(capsys.readouterr().out)
    return [(one["function"], one["address"], one["quantity"]) for one in found["requests"]]


def sent(device: Any, *what: Any) -> Requests:
    """The requests of a driver that reads something, or everything, once it knows what values depend on."""
    device.read(*what)
    device.link.log.clear()
    device.read(*what)
    return [(one.function, one.address, one.quantity) for one in device.link.log]


def givens_of(register_map: RegisterMap) -> dict[str, Any]:
    return {one.id: frozenset({4}) if one.kind is GivenKind.CODES else True for one in register_map.givens}


def devices(register_map: RegisterMap) -> Iterator[tuple[str, Any]]:
    """The shipped drivers of a map's models."""
    for model in register_map.models:
        yield model.name, catalogue.find(f"{register_map.id}:{model.name}").driver


@pytest.mark.parametrize("path", MAPS, ids=lambda path: path.stem)
def test_the_plan_of_a_shipped_model_is_what_its_driver_sends(
    path: Path, words: Any, direct: Any, capsys: pytest.CaptureFixture[str]
) -> None:
    register_map = find_map(path)
    lines = [(SerialLine("", 9600), SERIAL), (None, ("--tcp",))]
    for number, (name, driver) in enumerate(devices(register_map)):
        line, settings = lines[number % 2]
        link = direct(words({}))
        link.line = line
        device = driver(link, unit=1, **givens_of(register_map))

        assert shown(capsys, path, name, "--all", *settings) == sent(device), (name, settings)


@pytest.mark.parametrize("path", MAPS, ids=lambda path: path.stem)
def test_the_plan_of_a_group_and_of_a_register_is_what_a_shipped_driver_sends(
    path: Path, words: Any, direct: Any, capsys: pytest.CaptureFixture[str]
) -> None:
    register_map = find_map(path)
    name, driver = next(devices(register_map))
    device = driver(direct(words({})), unit=1, **givens_of(register_map))
    groups = {one: members for one, group in device.session.groups.items() if (members := group.registers(driver))}
    largest = max(groups, key=lambda one: len(groups[one]))
    one = next(iter(groups.values()))[-1]

    assert shown(capsys, path, name, one.path, *SERIAL) == sent(device, one)
    assert shown(capsys, path, name, "--group", largest, one.path, *SERIAL) == sent(device, *groups[largest], one)


@pytest.mark.parametrize(
    "text",
    [TWO_PLACES, FLOATS, PREFERRED, CIRCLE, ARRAY],
    ids=["two", "floats", "preferred", "circle", "array"],
)
@pytest.mark.parametrize("holds", [{}, {300: 1}], ids=["big", "little"])
def test_the_plan_of_a_small_map_is_what_its_driver_sends(
    text: str,
    holds: dict[int, int],
    tmp_path: Path,
    talk: Callable[[str, dict[int, int]], Any],
    capsys: pytest.CaptureFixture[str],
) -> None:
    path = tmp_path / "planned.yaml"
    path.write_text(text, encoding="utf-8")

    assert shown(capsys, path, "One", "--all", *SERIAL) == sent(talk(text, holds).driver)


def test_what_goes_round_in_a_circle_is_shown_once_more_at_the_end(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "planned.yaml"
    path.write_text(CIRCLE, encoding="utf-8")

    assert run(["plan", str(path), "--model", "One", "--all"]) == 0

    last = capsys.readouterr().out.splitlines()[4]
    assert last.split()[:4] == ["03", "1", "1", "1"]
    assert "once more (others depend on it, and it on them)" in last
    assert last.endswith("low_places")


def test_a_view_whose_word_order_stands_in_a_register_is_no_other_way_to_read(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "planned.yaml"
    path.write_text(TWO_PLACES, encoding="utf-8")

    assert shown(capsys, path, "One", "--all", *SERIAL) == [(3, 0, 2), (3, 102, 1), (3, 300, 1)]
