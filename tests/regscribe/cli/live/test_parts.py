"""Some flags or fields of a word on the command line: those that are named are written, the others stay."""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from regscribe.emit import python
from regscribe.simulate import Running, simulate

Run = Callable[..., Any]
NUMBER = 2**128 - 1

TEXT = """\
format: 1
map: {id: example/drive, title: Drive, maker: Example, class_prefix: Drive}
manual: {title: Drive Manual, number: DM-1}
models: {D1: {}}
protocol: {functions: [3, 6, 16]}
groups:
  - id: all
    name: All
    each: {access: rw}
    registers:
      - {at: 0, name: Card, type: uint16}
      - at: 1
        name: Cfg
        type: uint16
        fields:
          limit: {bits: 0..3}
          mode: {bits: 4..7, enum: {0: "off", 5: heat}}
          speed: {bits: 8..11, when: {card: 1}}
      - {at: 2, name: Bits, type: uint16, flags: {0: run, 1: fan, 2: {label: hot, when: {card: 1}}}}
      - at: 3
        name: Order
        access: w
        type: uint16
        fields: {what: {bits: 0..3}, how: {bits: 4..7}}
      - {at: 10, name: Long, type: uint128}
"""


@pytest.fixture
def drive(folder: Path, model_of: Callable[[str], Any]) -> Iterator[Running]:
    register_map = model_of(TEXT)
    ((_, code),) = python.render(register_map).items()
    (folder / "drives").mkdir()
    (folder / "drives" / "__init__.py").write_text(code, encoding="utf-8")
    with simulate(register_map, "D1") as running:
        yield running


@pytest.fixture
def write(cli: Run, drive: Running, monkeypatch: pytest.MonkeyPatch) -> Run:
    """Write a register of that drive; the result, and the PDUs of the writes."""
    monkeypatch.syspath_prepend(str(Path.cwd()))
    target = f"tcp:{drive.host}:{drive.port}?unit=1&model=D1"

    def call(*arguments: object) -> tuple[Any, list[str]]:
        drive.requests.clear()
        result = cli("write", target, *arguments, "--package", "drives", "--no-check-identity")
        return result, [pdu.hex() for pdu in drive.requests if pdu[0] in {6, 16, 22}]

    return call


@pytest.mark.parametrize(
    ("text", "held", "sent"),
    [
        ("limit=3", 0x3150, "0600013153"),
        ("limit=3, mode=off", 0x3155, "0600013103"),
        ("rest=0x4000", 0x3150, "0600014150"),
        ("0x0003", 0x3150, "0600010003"),
    ],
)
def test_of_a_word_of_fields_the_parts_that_are_named_change(
    text: str, held: int, sent: str, write: Run, drive: Running
) -> None:
    drive.device.poke("card", 1)
    drive.device.poke("cfg", held)
    result, requests = write("cfg", text)
    assert (result.code, requests) == (0, [sent]), result.err


@pytest.mark.parametrize(
    ("text", "held", "sent"),
    [
        ("fan", 0x8001, "0600028003"),
        ("FAN=on, run=off", 0x8001, "0600028002"),
        ("run=off", 0x8003, "0600028002"),
        ("none", 0x8003, "0600028000"),
        ("none, fan", 0x8001, "0600028002"),
    ],
)
def test_of_a_word_of_flags_those_that_are_named_change(
    text: str, held: int, sent: str, write: Run, drive: Running
) -> None:
    drive.device.poke("bits", held)
    result, requests = write("bits", text)
    assert (result.code, requests) == (0, [sent]), result.err


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [
        ("cfg", "speed=1", "it exists only while card is 1; card is 0"),
        ("bits", "hot", "it exists only while card is 1; card is 0"),
        ("bits", "hot=off", "it exists only while card is 1; card is 0"),
        ("bits", "bit_9", "stays as it is"),
        ("cfg", "rest=0x0003", "name those"),
        ("cfg", "limit", "write part=value"),
        ("cfg", "", "no part is named"),
        ("cfg", "limit=16", "16 does not fit 4 bits"),
        ("order", "what=3", "it cannot be read, so all its parts must be named: how lacks"),
    ],
)
def test_a_part_that_cannot_be_changed_is_refused_before_anything_is_written(
    name: str, text: str, said: str, write: Run, drive: Running
) -> None:
    drive.device.poke("bits", 0x0004)
    result, requests = write(name, text)
    assert (result.code, requests, said in result.err) == (1, [], True), result.err


def test_a_word_that_cannot_be_read_is_written_whole(write: Run) -> None:
    result, requests = write("order", "what=3, how=1")
    assert (result.code, requests) == (0, ["0600030013"]), result.err


def test_a_dry_run_shows_the_whole_word_that_would_be_written(write: Run, drive: Running) -> None:
    drive.device.poke("cfg", 0x3050)
    result, requests = write("cfg", "limit=3", "--dry-run")
    assert (result.out.split()[:3], requests) == (["06", "1", "3053"], [])


def test_a_number_of_128_bits_is_written_with_all_its_digits(write: Run) -> None:
    result, requests = write("long", str(NUMBER))
    assert (result.code, requests) == (0, ["10000a000810" + "ff" * 16]), result.err
