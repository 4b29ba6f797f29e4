"""Texts of more words than a request carries are read and written in portions; their fate is that of the whole."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from regscribe.cli.app import run
from regscribe.simulate.device.device import SimulatedDevice
from regscribe_runtime import ExceptionAnswer, NotConfigured, PartialWrite, ValueRefused, WriteUnknown
from regscribe_runtime.driver.broadcast import request_for

MAP = """\
format: 1
map: {id: test/long, title: Long, maker: Nobody, class_prefix: Long}
manual: {title: None}
models: {One: {}}
protocol: {functions: [3, 6, 16], broadcast: [16], limits: {read_words: 4, write_words: 3}}
groups:
  - id: main
    name: Main
    source: "1"
    each: {access: rw}
    registers:
      - {at: 0, name: Before}
      - {at: 1, name: Label, type: string, length: 7, persistence: eeprom}
      - {at: 8, name: After}
"""
TEXT = "ABCDEFGHIJKLMN"
READ = [(3, 1, 4), (3, 5, 3)]
WRITTEN = [(16, 1, (0x4142, 0x4344, 0x4546)), (16, 4, (0x4748, 0x494A, 0x4B4C)), (16, 7, (0x4D4E,))]


@pytest.fixture
def device(build: Callable[[str], Any], direct: Any) -> Any:
    """A driver on a simulated device."""
    built = build(MAP)
    return built.driver("One")(direct(SimulatedDevice(built.map, "One", unit=1)), unit=1)


def _sent(device: Any) -> list[tuple[int, int, tuple[int, ...] | int]]:
    found = [(one.function, one.address, one.words or one.quantity) for one in device.link.log]
    device.link.log.clear()
    return found


def test_it_is_written_in_portions_and_compared_as_a_whole(device: Any) -> None:
    device.label.write(TEXT)

    assert _sent(device) == [*READ, *WRITTEN, *READ]  # what wears a memory out is looked at before
    assert device.label.read() == TEXT
    device.label.write(TEXT)
    assert [one for one in _sent(device) if one[0] == 16] == []
    assert (device.wear["label"].written, device.wear["label"].spared) == (1, 1)


def test_it_is_read_along_with_others(device: Any) -> None:
    device.link.device.poke("label", TEXT)
    device.link.device.poke("after", 7)

    found = device.read()

    assert (found["before"], found["label"], found["after"]) == (0, TEXT, 7)
    assert _sent(device) == [(3, 0, 1), *READ, (3, 8, 1)]


def test_the_first_portion_that_is_refused_tells_how_far_it_went(device: Any) -> None:
    device.link.device = _Refusing(device.link.device, 4)
    with pytest.raises(PartialWrite) as caught:
        device.label.write(TEXT)
    assert (caught.value.sent, caught.value.written, caught.value.first_unwritten) == (7, 3, 4)

    device.link.device.at = 1
    with pytest.raises(ExceptionAnswer):
        device.label.write(TEXT)


def test_a_lost_portion_is_not_sent_again_and_leaves_the_whole_in_doubt(device: Any) -> None:
    device.link.fate, device.link.writes_only = {2: "missed"}, True
    with pytest.raises(WriteUnknown, match="takes several requests, and holds 'ABCDEF', not"):
        device.label.write(TEXT)


def test_a_lost_answer_to_the_last_portion_is_no_harm(device: Any) -> None:
    device.link.fate, device.link.writes_only = {3: "lost"}, True
    device.label.write(TEXT)
    assert device.label.read() == TEXT


def test_a_configuration_records_each_request_and_writes_back_what_was_begun(device: Any) -> None:
    device.link.device.poke("label", "before")
    planned = device.configure({"label": TEXT}, dry_run=True).requests
    assert [(one.function, one.address, one.words) for one in planned] == WRITTEN

    device.link.device = _Refusing(device.link.device, 4, once=True)
    with pytest.raises(NotConfigured) as caught:
        device.configure({"label": TEXT, "after": 9})
    assert caught.value.report.changes[0].fate == "restored"
    assert device.label.read() == "before"


def test_it_is_no_broadcast(device: Any) -> None:
    with pytest.raises(ValueRefused, match="several requests"):
        request_for(device.registers["label"], TEXT, {"one": device}, givens={})


def test_a_plan_shows_the_requests_as_they_go_out(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "long.yaml").write_text(MAP, encoding="utf-8")
    assert run(["plan", str(tmp_path / "long.yaml"), "--all", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    requests = [(one["function"], one["address"], one["quantity"], one["wanted"]) for one in found["requests"]]
    assert requests == [(3, 0, 1, 1), (3, 1, 4, 4), (3, 5, 3, 3), (3, 8, 1, 1)]
    assert [one["registers"] for one in found["requests"][1:3]] == [["label"], ["label"]]
    assert found["one_by_one"]["requests"] == 4


class _Refusing:
    """A device that refuses writes at an address."""

    unit = 1

    def __init__(self, device: Any, at: int, *, once: bool = False) -> None:
        self.device, self.at, self.once = device, at, once

    def handle(self, pdu: bytes) -> Any:
        if pdu[0] == 16 and int.from_bytes(pdu[1:3], "big") == self.at:
            self.at = -1 if self.once else self.at
            return bytes([0x90, 3])
        return self.device.handle(pdu)
