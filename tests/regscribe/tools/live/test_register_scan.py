"""Scanning the addresses of a unit, against devices with all the ways to refuse one."""

from collections.abc import Callable
from contextlib import closing
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from regscribe.simulate import Running, simulate
from regscribe.tools.live import link_names, scan_files
from regscribe.tools.live.errors import TargetError
from regscribe.tools.live.register_scan import RegisterScan, ScanLimits, ScanRecord, runs, spaces_of, spans_of
from regscribe.tools.live.target import Target, link_of
from regscribe_runtime import Link, NoAnswer
from regscribe_runtime.values.wire_types import Space

TEXT = """\
format: 1
map: {{id: acme/pump, title: Acme Pump, maker: Acme, class_prefix: Acme}}
manual: {{title: Pump Manual, number: PM-1}}
models: {{P1: {{}}}}
protocol: {{functions: [1, 3, 6, 16], limits: {{read_words: {most}}}, faults: {{{faults}}}}}
groups:
  - id: all
    name: All
    each: {{access: rw, type: uint16}}
    registers:
      - {{at: 0, name: A, default: 11}}
      - {{at: 1, name: B, default: 12}}
      - {{at: 4, name: C, type: uint32, default: 65538}}
      - {{at: 39, name: D, default: 14}}
      - {{at: 70, name: E, default: 15}}
      - {{at: 3, name: Lamp, space: coil, type: bit, default: 1}}
"""
HELD = {0: 11, 1: 12, 4: 1, 5: 2, 39: 14, 70: 15}
"""What the holding registers of that device hold: 65538 is 1 times 65536, and 2."""

Device = Callable[..., Any]


@pytest.fixture
def device(model_of: Callable[[str], Any]) -> Device:
    """Simulate that device with other faults or limits."""
    return lambda faults="", most=125, **more: simulate(model_of(TEXT.format(faults=faults, most=most)), "P1", **more)


def link_to(running: Running, timeout: float = 0.1) -> Link:
    at = f"rtu:{running.path}?baud=9600&" if running.path else f"tcp:{running.host}:{running.port}?"
    name, _ = link_names.split(f"{at}timeout={timeout}")
    return link_of(Target(link=name))


def scanned(
    running: Running, record: ScanRecord, text: str = "0..79", space: Space = Space.HOLDING, **limits: Any
) -> int:
    """Scan; the number of requests."""
    with closing(link_to(running)) as link:
        link.open()
        scan = RegisterScan(link, 1, record, ScanLimits(**limits), sleep=lambda _: None)
        list(scan.run({space: spans_of(text)}))
        return scan.requests


@pytest.mark.parametrize(
    ("faults", "most", "refusal"),
    [
        ("address: 2", 125, "2"),
        ("address: 3", 125, "3"),
        ("address: 2, later_read: garbage", 125, "2"),
        ("address: 2, later_read: zeros", 125, "2"),
        ("address: 2, quantity: 3", 8, "2"),
        ("address: 2, quantity: silence", 8, "2"),
    ],
)
def test_the_addresses_that_answer_are_found_however_the_others_are_refused(
    faults: str, most: int, refusal: str, device: Device
) -> None:
    record = ScanRecord()
    with device(faults, most) as running:
        scanned(running, record)
        assert {pdu[0] for pdu in running.requests} == {3}
    assert record.answered(Space.HOLDING) == HELD
    assert record.refused(Space.HOLDING) == {at: refusal for at in range(80) if at not in HELD}


def test_addresses_that_are_silent_are_told_from_those_that_answer(device: Device) -> None:
    record = ScanRecord()
    with device("address: silence") as running:
        scanned(running, record, "0..11", block=8)
    assert record.answered(Space.HOLDING) == {at: word for at, word in HELD.items() if at < 12}
    assert set(record.refused(Space.HOLDING).values()) == {"silent"}


def test_a_scan_works_on_a_serial_line(device: Device) -> None:
    record = ScanRecord()
    with device("address: 2", transport="pty") as running:
        scanned(running, record, "0..7")
    assert record.answered(Space.HOLDING) == {0: 11, 1: 12, 4: 1, 5: 2}


def test_bits_are_scanned_as_bits(device: Device) -> None:
    record = ScanRecord()
    with device() as running:
        scanned(running, record, "0..9", Space.COIL)
    assert record.answered(Space.COIL) == {3: 1}


def test_a_function_that_the_unit_lacks_is_asked_for_once_or_twice(device: Device) -> None:
    record = ScanRecord()
    with device() as running:
        assert scanned(running, record, "0..9999", Space.INPUT) == 2
    assert record.is_left_out(Space.INPUT)


def test_a_block_that_is_too_long_teaches_shorter_ones(device: Device) -> None:
    record = ScanRecord()
    with device("quantity: 3", 8) as running:
        scanned(running, record, "0..1,4..5", block=32)
        scanned(running, record, "0..70", block=32)
    assert record.longest.get(Space.HOLDING, 32) <= 32


def test_a_register_that_answers_only_as_a_whole_is_found(serve: Callable[..., Any]) -> None:
    record = ScanRecord()
    with serve() as running, closing(link_to(running)) as link:
        link.open()
        list(RegisterScan(link, 1, record, ScanLimits(block=4)).run({Space.HOLDING: ((8002, 8005),)}))
    assert sorted(record.answered(Space.HOLDING)) == [8002, 8003, 8004, 8005]


def test_a_scan_is_bounded_and_goes_on_where_it_was(device: Device) -> None:
    record, whole = ScanRecord(), ScanRecord()
    with device() as running:
        every = scanned(running, whole)
        rounds = 0
        while list(record.unknown(Space.HOLDING, ((0, 79),))):
            assert scanned(running, record, most=20) <= 22  # an end is asked for with its block
            rounds += 1
            assert rounds < 20
    assert record.answered(Space.HOLDING) == HELD
    assert (record.words, record.refusals, every > 20) == (whole.words, whole.refusals, True)


def test_a_unit_that_never_answers_ends_the_scan(device: Device) -> None:
    with device(transport="rtu-tcp") as running:
        name, _ = link_names.split(f"tcp:{running.host}:{running.port}?framing=rtu&timeout=0.02")
        with closing(link_of(Target(link=name))) as link:
            link.open()
            scan = RegisterScan(link, 9, ScanRecord(), ScanLimits())
            with pytest.raises(NoAnswer):
                list(scan.run({Space.HOLDING: ((0, 99),)}))
    assert scan.requests <= 6


@given(st.sets(st.integers(0, 300)))
def test_runs_are_spans_without_gaps(addresses: set[int]) -> None:
    spans = list(runs(sorted(addresses)))
    assert {at for first, last in spans for at in range(first, last + 1)} == addresses
    assert all(second[0] > first[1] + 1 for first, second in pairwise(spans))


def test_addresses_are_a_list_of_numbers_and_spans_in_the_usual_notations() -> None:
    assert spans_of("5, 0..3,0x10-0x12,4") == ((0, 5), (16, 18))
    assert spans_of("65535") == ((65535, 65535),)


@pytest.mark.parametrize("text", ["", "5..3", "0..65536", "a", "1..", "-1", "0..1..2", "9" * 60])
def test_addresses_that_are_none_are_refused(text: str) -> None:
    with pytest.raises(TargetError, match="names no addresses"):
        spans_of(text)


def test_spaces_are_named() -> None:
    assert spaces_of("coil, input,coil") == (Space.COIL, Space.INPUT)
    with pytest.raises(TargetError, match="there are holding, input, coil, discrete"):
        spaces_of("file")


def test_a_record_is_read_as_it_was_kept(tmp_path: Path) -> None:
    record = ScanRecord({Space.HOLDING: {0: 7}}, {Space.HOLDING: {1: "2", 2: "silent"}}, {Space.HOLDING: 8})
    scan_files.save(tmp_path / "scan.json", record, "tcp:h:502", 3)
    assert scan_files.load(tmp_path / "scan.json", "tcp:h:502", 3) == record
    assert scan_files.load(tmp_path / "none.json", "tcp:h:502", 3) == ScanRecord()
    with pytest.raises(TargetError, match="is the record of unit 3 on tcp:h:502"):
        scan_files.load(tmp_path / "scan.json", "tcp:h:502", 4)


HEAD = '{"format": 1, "link": "l", "unit_id": 1'


@pytest.mark.parametrize(
    "text",
    [
        "",
        "[]",
        "{}",
        '{"format": 2}',
        f'{HEAD}, "longest": {{}}, "words": {{"holding": {{"70000": 1}}}}, "refusals": {{}}}}',
        f'{HEAD}, "longest": {{}}, "words": {{"holding": {{"0": 65536}}}}, "refusals": {{}}}}',
        f'{HEAD}, "longest": {{}}, "words": {{"holding": {{"0": "\\u001b[2J"}}}}, "refusals": {{}}}}',
        f'{HEAD}, "longest": {{}}, "words": {{}}, "refusals": {{"holding": {{"0": "\\u001b[2J"}}}}}}',
        f'{HEAD}, "longest": {{}}, "words": {{"file": {{"0": 1}}}}, "refusals": {{}}}}',
        "[" * 100_000,
    ],
)
def test_a_file_that_is_no_record_is_refused(text: str, tmp_path: Path) -> None:
    (tmp_path / "scan.json").write_text(text, encoding="utf-8")
    with pytest.raises(TargetError, match="is no record of a scan"):
        scan_files.load(tmp_path / "scan.json", "l", 1)
