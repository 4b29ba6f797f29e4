"""Files of a scan of addresses: the record that a scan goes on from, and the table that `regscribe import` reads."""

import csv
import io
import json
from pathlib import Path
from typing import Any

from regscribe import files
from regscribe.model.address_text import hexadecimal
from regscribe.tools.live.errors import TargetError
from regscribe.tools.live.register_scan import NOISE, SILENT, SPACES, ScanRecord
from regscribe_runtime.values.wire_types import WIRE, Space

FORMAT = 1
COLUMNS = ("Space", "PDU Address", "Name", "Type", "Access", "Description")


def load(path: Path, link: str, unit: int) -> ScanRecord:
    """The record in a file, an empty one if there is no file; TargetError for another file, and for another unit."""
    try:
        text = path.read_text(encoding="utf-8")
    except FileNotFoundError:
        return ScanRecord()
    except (OSError, ValueError) as error:
        message = f"{path} cannot be read: {getattr(error, 'strerror', None) or 'it is no text'}"
        raise TargetError(message) from None
    try:
        plain = json.loads(text)
        record = _record(plain)
        before = (str(plain["link"]), int(plain["unit_id"]))
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        message = f"{path} is no record of a scan: name another file for --resume"
        raise TargetError(message) from None
    if before != (link, unit):
        message = f"{path} is the record of unit {before[1]} on {before[0]}: name another file for --resume"
        raise TargetError(message)
    return record


def save(path: Path, record: ScanRecord, link: str, unit: int) -> None:
    """Keep a record, all of it or nothing. Raises FileError."""
    head = {"format": FORMAT, "link": link, "unit_id": unit, "longest": record.longest}
    files.save(path, json.dumps({**head, "words": record.words, "refusals": record.refusals}) + "\n")


def _record(plain: dict[str, Any]) -> ScanRecord:
    if plain["format"] != FORMAT:
        raise ValueError
    found = ScanRecord()
    for name, by_address in plain["words"].items():
        space = _space(name)
        words = {_within(int(address)): _within(word) for address, word in by_address.items()}
        found.answered(space).update(words)
    for name, refusals in plain["refusals"].items():
        codes = {_within(int(address)): _refusal(text) for address, text in refusals.items()}
        found.refused(_space(name)).update(codes)
    for name, size in plain["longest"].items():
        found.longest[_space(name)] = max(1, min(int(size), _space(name).most))
    return found


def _space(name: str) -> Space:
    if name not in SPACES:
        raise ValueError
    return Space(name)


def _within(number: object) -> int:
    if not isinstance(number, int) or not 0 <= number <= WIRE:
        raise ValueError
    return number


def _refusal(text: object) -> str:
    known = text in {SILENT, NOISE} or (isinstance(text, str) and text.isascii() and text.isdigit() and int(text) < 256)  # noqa: PLR2004 (a byte)
    if not known:
        raise ValueError
    return str(text)


def as_table(record: ScanRecord) -> str:
    """The addresses that answered as a table in CSV: what each holds is not known, which its description says."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(COLUMNS)
    for space, words in record.words.items():
        for address, word in sorted(words.items()):
            read = str(word) if space.is_bits else f"{word} ({hexadecimal(word)})"
            said = f"TODO: found by a scan, which read {read}; what it means is not known"
            kind = "bit" if space.is_bits else "uint16"
            writer.writerow((space, hexadecimal(address), f"{space.title()} {address}", kind, "r", said))
    return out.getvalue()
