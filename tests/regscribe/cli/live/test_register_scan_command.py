"""`regscribe scan --registers`: its table, its files, and how it ends."""

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from regscribe.simulate import Running, simulate
from regscribe.tools.live.register_scan import RegisterScan

Run = Callable[..., Any]

TEXT = """\
format: 1
map: {id: acme/pump, title: Acme Pump, maker: Acme, class_prefix: Acme}
manual: {title: Pump Manual, number: PM-1}
models: {P1: {}}
protocol:
  functions: [1, 3, 5, 6]
  exceptions: {2: {name: no such thing, meaning: the address is wired to nothing}}
groups:
  - id: all
    name: All
    each: {access: rw, type: uint16}
    registers:
      - {at: 40001, name: A, default: 0}
      - {at: 40002, name: B, default: 258}
      - {at: 40005, name: C, default: 3}
      - {at: 7, name: Lamp, space: coil, type: bit, default: 1}
"""


@pytest.fixture
def pump(folder: Path, model_of: Callable[[str], Any]) -> Iterator[Running]:
    (folder / "maps" / "acme").mkdir(parents=True)
    (folder / "maps" / "acme" / "pump.yaml").write_text(TEXT, encoding="utf-8")
    with simulate(model_of(TEXT), "P1") as running:
        yield running


@pytest.fixture
def scan(cli: Run, pump: Running) -> Run:
    return lambda *arguments: cli("scan", f"tcp:{pump.host}:{pump.port}?timeout=0.2", *arguments)


def test_what_answers_is_a_table_and_what_cannot_be_told_is_said(scan: Run) -> None:
    result = scan("--registers", "40000..40009", "--space", "holding,coil,input")
    assert result.out == "holding  40001..40002  2  0000 0102\nholding  40005         1  0003\n"
    assert result.code == 0
    assert "holding: 7 addresses: exception 02 (illegal data address)\n" in result.err
    assert "input: left out, since the unit does not have function 04\n" in result.err
    assert "holding: 3 answer, 1 of them with 0: whether a device answers 0 or anything else" in result.err


def test_exceptions_have_the_names_of_the_map_where_the_model_is_known(cli: Run, pump: Running) -> None:
    target = f"tcp:{pump.host}:{pump.port}?model=P1"
    result = cli("scan", target, "--registers", "40001..40003", "--json")
    found = json.loads(result.out)
    assert found["found"] == [{"space": "holding", "address": 40001, "words": [0, 258]}]
    meant = "exception 02 (no such thing: the address is wired to nothing)"
    assert found["refused"] == [{"space": "holding", "answer": meant, "count": 1}]
    assert (found["complete"], found["ended"]) == (True, None)


def test_the_table_of_a_scan_becomes_a_map(scan: Run, cli: Run, pump: Running) -> None:
    assert scan("--registers", "0..9,40000..40009", "--space", "holding,coil", "--csv", "found.csv").code == 0
    result = cli("import", "found.csv", "--as", "acme/found", "-o", "maps/acme/found.yaml")
    assert result.code == 0, result.err
    assert cli("check", "maps/acme/found.yaml").code == 0
    made = json.loads(cli("devices", "acme/found", "--registers", "--json").out)["registers"]
    assert [(one["space"], one["address"], one["access"]) for one in made] == [
        ("holding", 40001, "read"),
        ("holding", 40002, "read"),
        ("holding", 40005, "read"),
        ("coil", 7, "read"),
    ]
    assert "TODO: found by a scan, which read 258 (0x102)" in Path("maps/acme/found.yaml").read_text(encoding="utf-8")
    target = f"tcp:{pump.host}:{pump.port}?map=acme/found"
    assert cli("read", target, "holding_40002", "coil_7", "--value").out == "258\ntrue\n"


def test_a_scan_that_is_too_long_ends_and_goes_on(scan: Run, pump: Running) -> None:
    arguments = ("--registers", "40000..40009", "--max-requests", "5", "--resume", "scan.json")
    first = scan(*arguments)
    assert "stopped after 5 requests (--max-requests)\nthe same command goes on from scan.json\n" in first.err
    for _ in range(8):
        last = scan(*arguments)
        if "stopped" not in last.err:
            break
    assert last.out == "holding  40001..40002  2  0000 0102\nholding  40005         1  0003\n"
    pump.requests.clear()
    assert scan(*arguments).out == last.out
    assert not pump.requests


def test_ctrl_c_keeps_what_is_known(scan: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    send = RegisterScan._sent

    def interrupted(self: RegisterScan, *arguments: Any) -> Any:
        if self.requests == 6:
            raise KeyboardInterrupt
        return send(self, *arguments)

    monkeypatch.setattr(RegisterScan, "_sent", interrupted)
    result = scan("--registers", "40001..40009", "--block", "2", "--resume", "scan.json", "--csv", "found.csv")
    assert (result.code, result.out.splitlines()[0]) == (130, "holding  40001..40002  2  0000 0102")
    assert "stopped before the end\nthe same command goes on from scan.json\n" in result.err
    assert json.loads(Path("scan.json").read_text(encoding="utf-8"))["words"]["holding"]["40002"] == 258
    assert len(Path("found.csv").read_text(encoding="utf-8").splitlines()) == 3


def test_nobody_there_is_said_with_its_own_exit_code(scan: Run, cli: Run) -> None:
    assert cli("scan", "tcp:127.0.0.1:1", "--registers", "0..9").code == 3
    assert scan("--registers", "100..109").code == 1  # it is there, but no address answers


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--registers", "9..0"), "names no addresses"),
        (("--registers", "0..9", "--space", "holdings"), "is no space of addresses"),
        (("--registers", "0..9", "--units", "1-3"), "scans the addresses of one unit"),
        (("--resume", "scan.json"), "belong to a scan of addresses"),
        (("--registers", "0..9", "--block", "0"), "--block"),
    ],
)
def test_a_scan_that_is_not_understood_is_refused(
    arguments: tuple[str, ...], said: str, scan: Run, pump: Running
) -> None:
    result = scan(*arguments)
    assert (result.code, said in result.err, pump.requests) == (2, True, []), result.err


def test_a_scan_of_units_says_what_exception_02_means(scan: Run) -> None:
    result = scan("--units", "1", "--no-names")
    assert "exception 02" in result.out
    assert "exception 02: the unit has no holding register at that address; it is there all the same" in result.err


def test_who_may_have_meant_numbers_of_modicon_is_told_what_these_are_on_the_wire(scan: Run) -> None:
    result = scan("--registers", "40010..40020,400100", "--space", "holding")
    assert result.code == 2  # 400100 is no address of the wire
    told = scan("--registers", "40010..40020,40100", "--space", "holding,coil").err
    assert "holding: these are the numbers that are sent; if Modicon's were meant: --registers 9..19,99..99\n" in told
    assert "coil: these" not in told
    assert "these are the numbers" not in scan("--registers", "40001..40010", "--space", "holding").err
