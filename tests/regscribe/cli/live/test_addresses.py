"""Registers by address in every notation, and flags and fields by name, on the command line."""

import json
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from regscribe.simulate import Running, simulate

Run = Callable[..., Any]

PUMP = """\
format: 1
map: {id: acme/pump, title: Acme Pump, maker: Acme, class_prefix: Acme}
manual: {title: Pump Manual, number: PM-1}
models: {P1: {}}
protocol: {functions: [1, 3, 4, 5, 6, 16]}
unused: [{at: 43..47, space: holding}, {at: 45, space: input}]
views:
  both:
    base: {offset: 0, type: int16, region: 40..40}
    fine: {offset: 1000, type: int16, factor: 10, region: 1040..1040}
groups:
  - id: works
    name: Works
    each: {access: rw, type: uint16}
    registers:
      - {at: 0, name: Kind, access: r}
      - {at: 1, name: Hours, type: uint32, unit: h}
      - {at: 40, name: Level, views: both}
      - {at: 42, name: Order, access: w}
      - {at: 50, name: Status, flags: {0: run, 1: {label: hot, when: {kind: 1}}, 2: fan}}
      - at: 51
        name: Cfg
        fields:
          limit: {bits: 0..3}
          mode: {bits: 4..7, enum: {0: "off", 5: heat}}
          lock: {bits: 8..9, when: {kind: 1}}
      - {at: 48, name: Near}
      - {at: 40049, name: Far}
  - id: more
    name: More
    registers:
      - {at: 50, name: Seen, access: r, type: uint16, space: input}
      - {at: 7, name: Lamp, access: rw, type: bit, space: coil}
"""


CFG = "cfg  limit=3, mode=HEAT (without lock: it exists only while kind is 1; kind is 0)"


@pytest.fixture
def pump(folder: Path, model_of: Callable[[str], Any]) -> Iterator[Running]:
    """A simulated pump whose map is in maps/ here."""
    (folder / "maps" / "acme").mkdir(parents=True)
    (folder / "maps" / "acme" / "pump.yaml").write_text(PUMP, encoding="utf-8")
    with simulate(model_of(PUMP), "P1") as running:
        for name, value in (("hours", 70_000), ("level", 25), ("status", 0x8001), ("cfg", 0x53), ("seen", 9)):
            running.device.poke(name, value)
        yield running


@pytest.fixture
def read(cli: Run, pump: Running) -> Run:
    return lambda *arguments: cli("read", f"tcp:{pump.host}:{pump.port}?model=P1", *arguments)


@pytest.fixture
def write(cli: Run, pump: Running) -> Run:
    """Write to the pump; the result, and the PDUs of the writes."""

    def call(*arguments: str) -> tuple[Any, list[str]]:
        pump.requests.clear()
        result = cli("write", f"tcp:{pump.host}:{pump.port}?model=P1", *arguments)
        return result, [pdu.hex() for pdu in pump.requests if pdu[0] in {5, 6, 16}]

    return call


@pytest.mark.parametrize(
    ("address", "row", "said"),
    [
        ("0", "kind  0", "holding 0 (0x0, 40001) is kind"),
        ("0x33", CFG, "holding 51 (0x33, 40052) is cfg"),
        ("33h", CFG, "holding 51 (0x33, 40052) is cfg"),
        ("40052", CFG, "holding 51 (0x33, 40052) is cfg"),
        ("400052", CFG, "holding 51 (0x33, 40052) is cfg"),
        ("1", "hours  70000 h", "holding 1 (0x1, 40002) is word 1 of 2 of hours, which begins at 1"),
        ("2", "hours  70000 h", "holding 2 (0x2, 40003) is word 2 of 2 of hours, which begins at 1"),
        ("40", "level  25", "holding 40 (0x28, 40041) is level"),
        ("1040", "level (fine)  25", "holding 1040 (0x410, 41041) is level in the view fine"),
        ("30051", "seen  9", "input 50 (0x32, 30051) is seen"),
        ("00008", "lamp  false", "coil 7 (0x7, 00008) is lamp"),
        ("7", "lamp  false", "coil 7 (0x7, 00008) is lamp"),
        ("input:0x32", "seen  9", "input 50 (0x32, 30051) is seen"),
    ],
)
def test_an_address_reads_the_register_there_and_says_which_it_is(address: str, row: str, said: str, read: Run) -> None:
    result = read(address)
    assert (result.code, result.out, result.err) == (0, f"{row}\n", f"{said}\n")


def test_an_address_of_another_view_asks_that_view(read: Run, pump: Running) -> None:
    pump.requests.clear()
    assert read("1040", "--value").out == "25\n"
    assert [pdu.hex() for pdu in pump.requests] == ["0304100001"]  # 1040 is 0410 in hexadecimal
    assert read("1040", "--raw").out == "level (fine)  00FA\n"  # 25 times 10


@pytest.mark.parametrize(
    ("address", "said"),
    [
        ("50", "holding:50 is status; input:50 is seen: write holding:50 or input:50"),
        ("40049", "holding:40049 is far; holding:48 is near: write holding:40049 or holding:48"),
    ],
)
def test_an_address_with_several_meanings_is_asked_about(address: str, said: str, read: Run) -> None:
    result = read(address)
    assert (result.code, said in result.err) == (2, True), result.err


def test_of_several_meanings_the_one_that_exists_counts(read: Run) -> None:
    assert read("40041", "--value").out == "25\n"  # no register has the wire address 40041
    assert read("holding:40049", "48", "--value").out == "0\n0\n"


def test_an_address_of_no_register_names_its_neighbours_and_is_read_raw(read: Run) -> None:
    result = read("45")
    assert result.code == 2
    assert (
        "no register of P1 has the address 45: order is at holding 42 and near is at holding 48; "
        "read --raw reads the word there as it stands" in result.err
    )
    assert read("45", "--raw").out == "holding 45 (0x2D, 40046)  0000\n"
    found = json.loads(read("input:45", "--raw", "--json").out)
    assert found["registers"] == {"input 45 (0x2D, 30046)": {"words": [0]}}


def test_words_of_a_device_without_a_model_are_read_by_address(cli: Run, pump: Running) -> None:
    pump.requests.clear()
    link = f"tcp:{pump.host}:{pump.port}"
    assert cli("read", link, "holding:45", "input:45", "--raw").out.split()[-1] == "0000"
    assert [pdu.hex() for pdu in pump.requests] == ["03002d0001", "04002d0001"]  # nothing asks what it is
    refused = cli("read", link, "99", "--raw")
    assert (refused.code, refused.err.endswith("with exception 02 (illegal data address)\n")) == (1, True), refused.err


def test_a_device_that_fits_no_model_is_refused_in_the_words_of_no_manual(cli: Run, pump: Running) -> None:
    refused = cli("read", f"tcp:{pump.host}:{pump.port}", "level")
    assert (refused.code, "none that drivers exist for" in refused.err) == (2, True), refused.err
    told = re.findall(r"exception 0[12] \(([^)]*)\)", refused.err)
    assert set(told) <= {"illegal function", "illegal data address"}, refused.err
    assert told


def test_the_advice_to_read_a_doubtful_address_raw_says_what_to_write(read: Run) -> None:
    advice = "read --raw with holding:40046 or holding:45 reads the word there as it stands"
    assert advice in read("40046").err
    assert read("holding:45", "--raw").code == 0


def test_a_number_of_two_notations_is_asked_about_where_no_register_is(read: Run) -> None:
    result = read("40046", "--raw")
    assert (result.code, "write holding:40046 or holding:45" in result.err) == (2, True), result.err


def test_an_address_that_can_only_be_written_is_not_read(read: Run, write: Run) -> None:
    assert "holding 42 (0x2A, 40043) of P1 is order, which can only be written" in read("42").err
    assert write("40043", "5")[1] == ["06002a0005"]


def test_flags_and_fields_are_read_by_name(read: Run) -> None:
    result = read("status.run", "status.FAN", "cfg.mode", "cfg.limit")
    assert [line.split() for line in result.out.splitlines()] == [
        ["status.RUN", "true"],
        ["status.FAN", "false"],
        ["cfg.mode", "HEAT"],
        ["cfg.limit", "3"],
    ]
    found = json.loads(read("status.run", "cfg.limit", "--json").out)["registers"]
    assert found == {"status.RUN": {"value": True, "unit": ""}, "cfg.limit": {"value": 3, "unit": ""}}


@pytest.mark.parametrize("name", ["status.hot", "cfg.lock"])
def test_a_part_that_does_not_exist_now_says_why(name: str, read: Run) -> None:
    result = read(name)
    assert (result.code, "it exists only while kind is 1; kind is 0" in result.out) == (1, True), result.out


@pytest.mark.parametrize(
    ("name", "value", "sent"),
    [
        ("status.fan", "true", "0600328005"),
        ("status.run", "off", "0600328000"),
        ("cfg.mode", "off", "0600330003"),
        ("cfg.limit", "9", "0600330059"),
        ("51", "limit=9", "0600330059"),
        ("1040", "2.5", "0604100019"),
        ("1040", "26", "0604100104"),
    ],
)
def test_a_part_or_an_address_is_written_and_the_rest_stays(name: str, value: str, sent: str, write: Run) -> None:
    result, requests = write(name, value)
    assert requests == [sent], result.err


@pytest.mark.parametrize(
    ("name", "value", "code", "said"),
    [
        ("status.fan", "maybe", 1, "status.FAN: `maybe` is neither true nor false"),
        ("cfg.limit", "1,mode=off", 1, "cfg.limit: `1,mode=off` is more than one value"),
        ("cfg.limt", "1", 2, "there is no part `limt` in cfg of P1; did you mean `limit`?"),
        ("2", "5", 2, "word 2 of 2 of hours, which begins at 1: write a register by its name"),
        ("45", "5", 2, "no register of P1 has the address 45"),
        ("0", "5", 1, "kind: the register is read-only"),
    ],
)
def test_what_cannot_be_written_is_refused_before_anything_is_sent(
    name: str, value: str, code: int, said: str, write: Run
) -> None:
    result, requests = write(name, value)
    assert (result.code, said in result.err, requests) == (code, True, []), result.err


def test_unknown_names_list_groups_and_near_names(read: Run) -> None:
    assert "did you mean `level`?; groups: works, more" in read("levle").err
    assert "there is no part `fn` in status of P1; did you mean `FAN`?" in read("status.fn").err


def test_plan_takes_the_same_names_as_read(cli: Run, pump: Running) -> None:
    def planned(*names: str) -> set[str]:
        result = cli("plan", "acme/pump", *names, "--json")
        assert result.code == 0, result.err
        return {path for one in json.loads(result.out)["requests"] for path in one["registers"]}

    assert pump.host
    assert planned("more") == {"seen", "lamp"}
    assert planned("40041", "status.fan", "2") == {"level", "status", "kind", "hours"}
    assert "groups: works, more" in cli("plan", "acme/pump", "zzz").err
