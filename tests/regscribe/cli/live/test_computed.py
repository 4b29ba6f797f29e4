"""Numbers that follow from several registers, on the command line before a simulated device."""

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from regscribe.emit import python
from regscribe.simulate import Running, simulate
from regscribe.tools.live import catalogue, names

Cli = Callable[..., Any]
Run = Callable[..., Any]

TEXT = """\
format: 1
map: {id: example/meter, title: Meter, maker: Example, class_prefix: Meter}
manual: {title: Meter Manual, number: EM-1}
models: {E1: {}}
groups:
  - id: powers
    name: Powers
    registers:
      - {at: 0, name: Power 1, access: r, type: int16, decimals: 1, unit: W, sentinels: {-32768: {label: open}}}
      - {at: 1, name: Power 2, access: r, type: int16, decimals: 1, unit: W, poll: 60}
      - {at: 2, name: Mode, access: rw, type: uint16, enum: {0: "off", 1: "on"}}
computed:
  total: {name: Total, is: {sum: [power_1, power_2]}, unit: W, valid: -1000..1000}
  net: {name: Net, is: {sum: [power_1, {product: [-1, power_2]}]}, unit: W, when: {mode: "on"}}
"""


@pytest.fixture
def meter(folder: Path, model_of: Callable[[str], Any]) -> Iterator[Running]:
    """A meter with 12.5 W and 0.4 W that is off, and the package `meters` with its driver."""
    register_map = model_of(TEXT)
    ((_, code),) = python.render(register_map).items()
    package = folder / "meters"
    package.mkdir()
    (package / "__init__.py").write_text(code, encoding="utf-8")
    with simulate(register_map, "E1") as running:
        running.device.poke("power_1", 12.5)
        running.device.poke("power_2", 0.4)
        yield running


@pytest.fixture
def at(cli: Cli, meter: Running, monkeypatch: pytest.MonkeyPatch) -> Run:
    """Run a command before that meter."""
    monkeypatch.syspath_prepend(str(Path.cwd()))

    def call(command: str, *arguments: object) -> Any:
        target = f"tcp:{meter.host}:{meter.port}?unit=1&model=E1"
        return cli(command, target, *arguments, "--package", "meters")

    return call


def test_a_computed_value_is_read_by_name_with_its_unit_beside_registers(at: Run) -> None:
    result = at("read", "total", "power_1")
    assert (result.code, result.out.splitlines()) == (0, ["total    12.9 W", "power_1  12.5 W"])
    assert at("read", "total", "--value").out == "12.9\n"
    assert json.loads(at("read", "total", "--json").out)["registers"] == {"total": {"value": 12.9, "unit": "W"}}


def test_all_registers_of_several_computed_values_come_in_one_request(at: Run, meter: Running) -> None:
    meter.device.poke("mode", "on")
    result = at("read", "total", "net", "power_2", "--trace")
    assert [line.split()[1] for line in result.out.splitlines()] == ["12.9", "12.1", "0.4"]
    assert sum(" -> " in line for line in result.err.splitlines()) == 1


@pytest.mark.parametrize(
    ("pokes", "name", "kind", "why"),
    [
        ({"mode": "off"}, "net", "not-present", "it exists only while mode is ON (1); mode is OFF (0)"),
        ({"power_1": 999, "power_2": 2.5}, "total", "out-of-range", "1001.5 lies outside -1000 to 1000"),
        ({"mode": "on", "power_1": "open"}, "net", "not-decodable", "computed from power_1"),
    ],
)
def test_a_computed_value_that_cannot_be_had_says_why(
    at: Run, meter: Running, pokes: dict[str, Any], name: str, kind: str, why: str
) -> None:
    for register, value in pokes.items():
        meter.device.poke(register, value)
    assert why in at("read", name).out
    result = at("read", name, "--json")
    error = json.loads(result.out)["registers"][name]["error"]
    assert (result.code, error["kind"]) == (1, kind)
    assert why in error["message"]


def test_a_computed_value_has_no_words_and_is_not_written(at: Run) -> None:
    for result in (at("read", "total", "--raw"), at("write", "total", "5")):
        assert (result.code, result.out) == (2, "")
        assert "it is computed from power_1, power_2" in result.err


def test_a_dump_ends_with_what_is_computed(at: Run) -> None:
    result = at("dump")
    assert [line.split(None, 1) for line in result.out.splitlines()[-3:]] == [
        ["#", "Computed values"],
        ["total", "12.9 W"],
        ["net", "(it exists only while mode is ON (1); mode is OFF (0))"],
    ]
    assert "1 of 5 values cannot be had; each says why" in result.err
    computed = json.loads(at("dump", "--json").out)["computed"]
    assert (computed["total"], computed["net"]["error"]["kind"]) == ({"value": 12.9, "unit": "W"}, "not-present")
    assert "total" not in at("dump", "--group", "powers").out


def test_a_computed_value_is_watched_logged_and_drawn(at: Run) -> None:
    result = at("watch", "total", "net", "--count", "2", "--every", "0", "--log", "meter.csv", "--chart", "total")
    assert [line.split(None, 1)[1] for line in result.out.splitlines()[:2]] == [
        "total 12.9 W",
        "net (it exists only while mode is ON (1); mode is OFF (0))",
    ]
    assert "total" in Path("meter.csv").read_text("utf-8")


@pytest.mark.usefixtures("at")
def test_the_lists_of_a_model_name_what_is_computed_and_from_what(cli: Cli) -> None:
    text = cli("devices", "E1", "--registers", "--package", "meters").out
    assert "total  W  power_1, power_2" in text
    found = json.loads(cli("devices", "E1", "--registers", "--json", "--package", "meters").out)
    assert found["computed"] == [
        {"name": "total", "unit": "W", "computed_from": ["power_1", "power_2"]},
        {"name": "net", "unit": "W", "computed_from": ["power_1", "power_2", "mode"]},
    ]


def test_a_name_near_a_computed_value_is_told(at: Run) -> None:
    assert "did you mean `total`?" in at("read", "totl").err


def test_backups_hold_no_computed_value(at: Run) -> None:
    assert at("backup", "meter.yaml").code == 0
    text = Path("meter.yaml").read_text("utf-8")
    assert ("mode" in text, "total" in text, "net" in text) == (True, False, False)
    assert at("restore", "meter.yaml").code == 0
    Path("meter.yaml").write_text(text.replace("mode:", "total:"), encoding="utf-8")
    assert "total" in at("restore", "meter.yaml").err


@pytest.mark.usefixtures("at")
def test_a_shell_completes_the_name_of_a_computed_value_and_says_what_it_follows_from() -> None:
    found = dict(names.completions(catalogue.find("E1", ["meters"]).driver))
    assert found["total"] == "computed from power_1, power_2"
