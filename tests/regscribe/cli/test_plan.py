"""`regscribe plan` shows the requests, what they carry and cost, and why they are apart."""

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Cli = Callable[..., Any]
MAP = """\
format: 1
map: {id: acme/oven, title: Oven, maker: Acme, class_prefix: Acme}
manual: {title: Oven manual, number: X1}
models:
  M1: {}
  M2: {}
protocol:
  functions: [1, 3, 6, 16]
  limits: {read_words: 20, write_words: 20}
  latency: {3: {fixed: 0..10, per_word: 0..2}}
  serial: {baud: [1200, 9600], formats: [8N1, "8E1"], default: 9600 8N1}
decimals:
  digits: {register: places}
groups:
  - id: control
    name: Control
    source: "1"
    each: {access: rw, type: int16}
    registers:
      - {at: 1, name: Setpoint, decimals: digits, range: 0..400, default: 20}
      - {at: 2, name: Mode, enum: {0: stop, 1: run}, default: 0}
      - {at: 3, name: Key, access: w}
      - {at: 5, name: Limit, range: 0..400, default: 20}
      - {at: 70, name: Places, range: 0..3, default: 0}
  - id: lamps
    name: Lamps
    source: "2"
    each: {access: r, space: coil, type: bit}
    registers:
      - {id: lamps, name: Lamp, repeat: 1..3, stride: 1, registers: [{at: 0, name: Lit}]}
"""


@pytest.fixture
def planned(folder: Path, cli: Cli) -> Cli:
    (folder / "oven.yaml").write_text(MAP, encoding="utf-8")

    def call(*arguments: str) -> Any:
        return cli("plan", "oven.yaml", *arguments)

    return call


def test_a_plan_says_what_each_request_carries_costs_and_why_it_is_apart(planned: Cli) -> None:
    done = planned("--model", "M1", "--group", "control", "--remembered")

    assert done.code == 0, done.err
    lines = done.out.splitlines()
    assert lines[0] == "# Oven M1, 9600 baud, 10 bits a character, RTU"
    assert lines[1].split() == ["FC", "ADDRESSES", "WANTED", "CARRIED", "BYTES", "MS", "APART", "BECAUSE", "REGISTERS"]
    # two words: 8 + 5 + 4 characters and 7 of silence, 5 ms and 1 ms a word: 25 + 7 ms
    assert lines[2].split() == ["03", "1..2", "2", "2", "17", "32.0", "setpoint,", "mode"]
    assert lines[3].split()[:6] == ["03", "5", "1", "1", "15", "28.9"]
    assert "unreadable (not readable 3..4)  limit" in lines[3]
    assert lines[4].split()[:6] == ["03", "70", "1", "1", "15", "28.9"]
    assert "hole (no registers 6..69)" in lines[4]
    assert lines[5] == "3 requests, 4 addresses wanted, 4 carried, 47 bytes, 89.8 ms"
    assert lines[6] == "one request a register: 4 requests, 115.7 ms, 1.3 times as long"


def test_json_has_the_same_and_what_is_read_along(planned: Cli) -> None:
    done = planned("--model", "M1", "setpoint", "--json")

    found = json.loads(done.out)
    assert found["also"] == ["places"]
    assert [(one["function"], one["address"], one["quantity"]) for one in found["requests"]] == [(3, 1, 1), (3, 70, 1)]
    assert found["requests"][1]["apart"] == {"because": "unreadable", "detail": "not readable 2..69"}
    assert found["total"]["requests"] == found["one_by_one"]["requests"] == 2
    assert found["line"] == {"tcp": False, "baud": 9600, "bits": 10, "framing": "rtu"}


def test_the_line_decides_what_a_plan_costs(planned: Cli) -> None:
    def ms(*line: str) -> float:
        total: float = json.loads(planned("--model", "M1", "mode", "--json", *line).out)["total"]["ms"]
        return total

    # 8 + 7 characters and 7 of silence; 5 ms and 1 ms of the device
    assert ms() == pytest.approx(22 * 10 / 9.6 + 6, abs=0.001)
    assert ms("--baud", "1200", "--line-format", "8E1") == pytest.approx(22 * 11 / 1.2 + 6, abs=0.001)
    assert ms("--tcp") < 8
    assert ms("--tcp", "--baud", "9600") > ms()
    assert ms("--ascii") == pytest.approx((17 + 15) * 10 / 9.6 + 6, abs=0.001)  # : + 2 x 7 + CR LF; : + 2 x 6 + CR LF


def test_arrays_and_all_registers_can_be_named(planned: Cli) -> None:
    lamps = json.loads(planned("--model", "M1", "lamps", "--json").out)
    one = json.loads(planned("--model", "M1", "lamps[2]", "--json").out)
    everything = json.loads(planned("--model", "m2", "--all", "--json").out)

    assert [request["quantity"] for request in lamps["requests"]] == [3]
    assert one["requests"][0]["registers"] == ["lamps[2].lit"]
    assert {name for request in everything["requests"] for name in request["registers"]} == {
        "setpoint", "mode", "limit", "places", "lamps[1].lit", "lamps[2].lit", "lamps[3].lit",
    }  # fmt: skip # one name a line says no more


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--model", "M1", "setpiont"], "there is no register or group `setpiont` in M1; did you mean `setpoint`?"),
        (["--model", "M1", "--group", "contrl"], "there is no group `contrl` of M1; did you mean `control`?"),
        (["--model", "M9", "--all"], "there is no model `M9` in acme/oven"),
        (["--model", "M1", "key"], "`key` of M1 can only be written"),
        (["--model", "M1"], "say what to read: --all, --group ID, or ids of registers"),
        (["--model", "M1", "--all", "mode"], "say what to read"),
        (["--model", "M1", "--all", "--line-format", "9X1"], "--line-format 9X1: write data bits"),
        (["--model", "M1", "--all", "--baud", "0"], "--baud"),
    ],
)
def test_what_is_not_understood_is_said(planned: Cli, arguments: list[str], said: str) -> None:
    done = planned(*arguments)

    assert done.code == 2
    assert said in done.err


def test_a_speed_that_the_manual_does_not_list_is_planned_for_with_a_remark(planned: Cli) -> None:
    done = planned("--model", "M1", "mode", "--baud", "115200")

    assert (done.code, "the manual does not list 115200 baud: 1200, 9600" in done.err) == (0, True)


def test_a_shipped_map_is_found_by_its_id(cli: Cli) -> None:
    done = cli("plan", "fdc/series-100", "--model", "C21", "pv", "--json")

    assert json.loads(done.out)["model"] == "C21"


DOCS = Path(__file__).parents[3] / "docs" / "plans.md"
SHOWN = re.findall(
    r"^```console\n\$ regscribe (plan .*)\n((?:.*\n)*?)```$", DOCS.read_text(encoding="utf-8"), re.MULTILINE
)


@pytest.mark.parametrize(("line", "output"), SHOWN)
def test_the_documentation_shows_what_is_printed(cli: Cli, line: str, output: str) -> None:
    assert cli(*line.split()).out == output


def test_the_documentation_shows_plans() -> None:
    assert len(SHOWN) >= 2


def test_what_does_not_exist_in_a_state_is_not_planned(folder: Path, cli: Cli) -> None:
    text = MAP.replace("{at: 5, name: Limit,", "{at: 5, name: Limit, when: {mode: run},")
    (folder / "oven.yaml").write_text(text, encoding="utf-8")
    plans = [cli("plan", "oven.yaml", "--model", "M1", "--all", *more) for more in ([], ["--with", "mode=run"])]
    assert ["left out, since they do not exist then: limit" in one.out for one in plans] == [True, False]
    held = cli("plan", "oven.yaml", "--model", "M1", "--all", "--with", "mode=stop", "--json")
    assert json.loads(held.out)["absent"] == ["limit"]
    wrong = cli("plan", "oven.yaml", "--model", "M1", "--all", "--with", "nothing=1")
    assert "write NAME=VALUE" in wrong.err


def test_fewer_elements_of_a_packed_array_are_refused(folder: Path, cli: Cli) -> None:
    inside = "{at: 2, name: Points}, {id: curve, name: Curve, stride: 1, "
    inside += (
        "repeat: {from: 1, to: points, most: 2, packed: true}, registers: [{at: 3, name: Volts}]}, {at: 5, name: Tail}"
    )
    blocks = "chains: {chain: {at: 0}}\nblocks: {block: {chain: chain, id: 705}}\ngroups:\n"
    group = f"  - {{id: own, name: Own, block: block, each: {{access: r}}, registers: [{inside}]}}\n"
    (folder / "oven.yaml").write_text(MAP.replace("groups:\n", blocks + group), encoding="utf-8")
    plans = [cli("plan", "oven.yaml", "--model", "M1", "--group", "own", f"--with=points={count}") for count in (2, 1)]
    assert plans[0].code == 0
    assert "1 of the 2 elements of `curve`, which is packed" in plans[1].err
