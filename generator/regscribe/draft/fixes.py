"""What a mapping file says of single rows: which are passed over, and which keys are other than the source says."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

from regscribe.draft import Draft, Entry, Remark
from regscribe.draft.mapping import Row
from regscribe.model import Diagnostic, Severity, Span
from regscribe.model.identifiers import snake

SETTLES: Mapping[str, frozenset[str]] = {
    "scale": frozenset({"decimals", "multiply", "divide", "add", "exponent", "scale"}),
    "codes": frozenset({"enum", "flags"}),
    "values": frozenset({"enum", "flags"}),
    "bits": frozenset({"flags", "fields"}),
    "order": frozenset({"word_order", "byte_order"}),
}
"""Keys that settle a remark, by the first word of its code; another word is a key itself."""

CODE = "fixed"


def fixed(draft: Draft, skip: Sequence[Row], fixes: Sequence[Row], name: str) -> Draft:
    """Return the draft without the rows to skip and with the keys that are set; `name` is the file that says so."""
    unused = [row for row in (*skip, *fixes) if not any(_is(row, entry) for entry in draft.entries)]
    dropped = [entry for entry in draft.entries if any(_is(row, entry) for row in skip)]
    kept = tuple(_fixed(entry, fixes) for entry in draft.entries if not any(entry is one for one in dropped))
    stated = (f"{_count(dropped)} skipped, as {name} says",) if dropped else ()
    return replace(
        draft,
        entries=kept,
        stated=(*draft.stated, *stated),
        findings=(*draft.findings, *_unused(unused, name)),
    )


def _count(entries: Sequence[Entry]) -> str:
    return "1 row is" if len(entries) == 1 else f"{len(entries)} rows are"


def _unused(rows: Sequence[Row], name: str) -> Iterator[Diagnostic]:
    for row in rows:
        message = f"the source has no row {row}, which is to be skipped or fixed"
        yield Diagnostic("import/no-row", message, Span(name), "correct it or take it out", severity=Severity.WARNING)


def _is(row: Row, entry: Entry) -> bool:
    """Whether a person means this entry: all that is said of it is right."""
    keys = entry.keys or {}
    if row.row and row.row != (entry.where or str(entry.place)):
        return False
    if row.at is not None and (row.at != keys.get("at") or (row.space or "holding") != keys.get("space", "holding")):
        return False
    if row.name and row.name.strip() != entry.name and snake(row.name) != keys.get("id"):
        return False
    return bool(row.row or row.name or row.at is not None)


def _fixed(entry: Entry, fixes: Sequence[Row]) -> Entry:
    for row in fixes:
        if _is(row, entry):
            entry = _set(entry, row)
    return entry


def _set(entry: Entry, row: Row) -> Entry:
    """The entry with the keys that a person sets, without the remarks that these settle."""
    before: Mapping[str, Any] = entry.keys if entry.keys is not None else {"name": entry.name}
    merged: dict[str, Any] = {**before, **row.set}
    if set(row.set) & SETTLES["scale"] and "decimals" not in row.set and merged.get("decimals") == "not_stated":
        del merged["decimals"]
    first = {key: merged[key] for key in ("at", "name") if key in merged}
    keys: Mapping[str, Any] = {key: value for key, value in (first | merged).items() if value is not None}
    said = Remark(CODE, f"{', '.join(row.set)} as you say{f' ({row.reason})' if row.reason else ''}", lossy=False)
    left_out = entry.keys is None
    remarks = tuple(one for one in entry.remarks if not (left_out or _settled(one, row.set)))
    return replace(entry, keys=keys, name=str(keys.get("name", entry.name)), remarks=(*remarks, said))


def _settled(remark: Remark, keys: Mapping[str, Any]) -> bool:
    word = remark.code.partition("-")[0]
    return bool(SETTLES.get(word, frozenset({word})) & keys.keys())
