"""The run of a scan of addresses: progress, the record that is kept, and what is printed of the result."""

from collections import Counter
from collections.abc import Mapping, Sequence
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

from regscribe import files
from regscribe.cli.shared.diagnostic_text import count
from regscribe.cli.shared.exit_codes import INTERRUPTED
from regscribe.cli.shared.failure import unwritten
from regscribe.cli.shared.live_report import failure, refused_if
from regscribe.cli.shared.long_work import progress
from regscribe.cli.shared.output import hexadecimal, print_json, remark, show_table
from regscribe.cli.shared.output_file import save_result
from regscribe.tools.live import scan, scan_files
from regscribe.tools.live.register_scan import NOISE, RegisterScan, ScanLimits, ScanRecord, Span, of_modicon, runs
from regscribe.tools.live.target import Target, link_of
from regscribe_runtime import LinkLost, NoAnswer
from regscribe_runtime.values.protocol import Protocol
from regscribe_runtime.values.wire_types import Space

OFTEN = 50
"""After so many requests the record is kept anew."""

SHOWN = 4
"""Words of a run of addresses that the table shows."""


class ScanFiles(NamedTuple):
    """Where the record of a scan is kept, and where its table goes; None: nowhere."""

    resume: Path | None
    table: Path | None


def run_scan(
    target: Target, wanted: Mapping[Space, Sequence[Span]], limits: ScanLimits, kept: ScanFiles, *, as_json: bool
) -> int:
    """Scan addresses of a target and print what answers; the exit code."""
    name, unit = str(target.link), target.unit
    record = scan_files.load(kept.resume, name, unit) if kept.resume else ScanRecord()
    total = sum(last + 1 - first for space, spans in wanted.items() for first, last in record.unknown(space, spans))
    remark(f"asking unit {unit} for {count(total, 'address', 'addresses')}, {limits.block} a request where it answers")
    ended, code = "", 0
    try:
        ended = _scanned(target, wanted, record, limits, kept, total)
    except KeyboardInterrupt:
        ended, code = "stopped before the end", INTERRUPTED
    except (LinkLost, NoAnswer) as error:
        lost = failure(error)
        ended, code = lost.message, lost.exit_code
    _keep(kept, record, name, unit)
    _show(record, target, ended, as_json=as_json)
    for space in wanted:
        if (meant := of_modicon(space, wanted[space])) and not record.words.get(space):
            remark(f"{space}: these are the numbers that are sent; if Modicon's were meant: --registers {meant}")
    if ended and kept.resume:
        remark(f"the same command goes on from {kept.resume}")
    elif kept.table:
        remark(f"regscribe import {kept.table} makes a map of it")
    return code or refused_if(not any(record.words.values()))


def _scanned(
    target: Target,
    wanted: Mapping[Space, Sequence[Span]],
    record: ScanRecord,
    limits: ScanLimits,
    kept: ScanFiles,
    total: int,
) -> str:
    """Carry out the scan; why it ended before the end, empty where it did not."""
    seconds = scan.seconds_for(target.link, words=limits.block)
    with (
        closing(link_of(replace(target, link=replace(target.link, timeout=seconds)))) as link,
        progress(total, "scanning") as advance,
    ):
        link.open()
        scanning = RegisterScan(link, target.unit, record, limits)
        for asked in scanning.run(wanted):
            for _ in range(asked.size if asked.words or asked.size == 1 else 0):
                advance(f"{asked.space} {asked.first}, {scanning.requests} requests")
            if scanning.requests % OFTEN == 0 and kept.resume:
                with unwritten(files.UnwrittenError):
                    scan_files.save(kept.resume, record, str(target.link), target.unit)
    left = any(
        True for space, spans in wanted.items() for _ in record.unknown(space, spans) if not record.is_left_out(space)
    )
    return f"stopped after {count(limits.most, 'request')} (--max-requests)" if left else ""


def _keep(kept: ScanFiles, record: ScanRecord, link: str, unit: int) -> None:
    """Write the files of a scan; Failure where one cannot be written."""
    if kept.resume:
        with unwritten(files.UnwrittenError):
            scan_files.save(kept.resume, record, link, unit)
    if kept.table:
        save_result(kept.table, scan_files.as_table(record))


def _show(record: ScanRecord, target: Target, ended: str, *, as_json: bool) -> None:
    protocol = target.known().driver.protocol if target.model else None
    if as_json:
        _show_json(record, target, ended, protocol)
    else:
        rows = [row for space, words in record.words.items() for row in _rows(space, words)]
        show_table(("SPACE", "ADDRESSES", "COUNT", "WORDS"), rows)
    for line in _remarks(record, protocol):
        remark(line)
    if ended:
        remark(ended)


def _rows(space: Space, words: Mapping[int, int]) -> list[tuple[str, ...]]:
    rows: list[tuple[str, ...]] = []
    for first, last in runs(sorted(words)):
        held = [words[address] for address in range(first, min(last + 1, first + SHOWN))]
        text = " ".join(map(str, held)) if space.is_bits else hexadecimal(held)
        more = " ..." if last - first >= SHOWN else ""
        span = str(first) if first == last else f"{first}..{last}"
        rows.append((str(space), span, str(last + 1 - first), f"{text}{more}"))
    return rows


def _show_json(record: ScanRecord, target: Target, ended: str, protocol: Protocol | None) -> None:
    found = [
        {"space": str(space), "address": first, "words": [words[address] for address in range(first, last + 1)]}
        for space, words in record.words.items()
        for first, last in runs(sorted(words))
    ]
    refused = [
        {"space": str(space), "answer": _answer(text, protocol), "count": number}
        for space, refusals in record.refusals.items()
        for text, number in Counter(refusals.values()).items()
    ]
    print_json(
        device=str(target), unit_id=target.unit, complete=not ended, ended=ended or None, found=found, refused=refused
    )


def _answer(refusal: str, protocol: Protocol | None) -> str:
    if refusal.isdigit():
        meaning = scan.exception_meaning(int(refusal), protocol)
        return f"exception {int(refusal):02d}{f' ({meaning})' if meaning else ''}"
    return "what came is no answer" if refusal == NOISE else "no answer"


def _remarks(record: ScanRecord, protocol: Protocol | None) -> list[str]:
    """What the addresses that do not answer say instead, and what cannot be told of those that do."""
    lines = []
    for space, refusals in record.refusals.items():
        for text, number in Counter(refusals.values()).most_common():
            lines.append(f"{space}: {count(number, 'address', 'addresses')}: {_answer(text, protocol)}")
        if record.is_left_out(space):
            lines.append(f"{space}: left out, since the unit does not have function {space.read_function:02d}")
    for space, words in record.words.items():
        if words and space.is_words:
            zero = sum(not word for word in words.values())
            lines.append(
                f"{space}: {len(words)} answer, {zero} of them with 0: whether a device answers 0 or anything else for "
                "addresses that it does not use cannot be told"
            )
    return lines
