"""Takes out of a draft what `check` refuses, so that the map which is written passes; each thing with the reason."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

from regscribe import source
from regscribe.draft import Draft, Entry, Remark
from regscribe.draft.ids import named
from regscribe.draft.text import Written, text_of
from regscribe.model import Diagnostic, Severity

MOST_ROUNDS = 40
"""Each round takes out something, and the findings of a later phase show in a later round."""

CODE = "refused"

Check = Callable[[str], Sequence[Diagnostic]]
"""Compiles the text of a map and returns what is found."""

REMOVABLE = frozenset(
    {"unit", "range", "valid", "default", "delivered", "special", "enum", "flags", "description", "symbol", "printed"}
    | {"source", "aliases", "poll", "good_for", "static", "mandatory", "settle", "persistence", "endurance", "stays"}
    | {"danger"}
)
"""Keys without which a register's number is still right; where any other is refused, the whole entry is."""


def settle(draft: Draft, head: Mapping[str, Any], check: Check) -> tuple[Draft, Written, tuple[Diagnostic, ...]]:
    """Return the draft without what is refused, its text, and what `check` still says of that text.

    An error on the line of an entry takes the key that it points at out of the entry, or else the entry. An error that
    stands elsewhere is left: the caller tells it.
    """
    draft = named(draft)
    written = text_of(draft, head)
    found = tuple(check(written.text))
    for _ in range(MOST_ROUNDS):
        wrong = _by_entry(written, found)
        if not wrong:
            break
        draft = replace(draft, entries=tuple(_mended(entry, wrong) for entry in draft.entries))
        written = text_of(draft, head)
        found = tuple(check(written.text))
    return draft, written, found


def _by_entry(written: Written, found: Sequence[Diagnostic]) -> dict[int, tuple[Diagnostic, str]]:
    """The first error of each entry, by the entry's identity, with the key that it points at."""
    lines = written.text.splitlines()
    wrong: dict[int, tuple[Diagnostic, str]] = {}
    for one in found:
        owner = written.owners.get(one.span.line)
        if one.severity is Severity.ERROR and owner is not None:
            wrong.setdefault(id(owner), (one, _key_at(owner, lines[one.span.line - 1], one.span.column)))
    return wrong


def _key_at(entry: Entry, line: str, column: int) -> str:
    """The key of the entry whose value stands at a column; empty if it cannot be told, or if the number hangs on it."""
    document, _ = source.parse(line.strip(), name="line")
    node = document.root.child(0) if document else None
    margin = len(line) - len(line.lstrip())
    places = {place.column + margin: key for key, place in ((node and node.keys) or {}).items()}
    before = [place for place in places if place < column]
    key = places[max(before)] if before else ""
    return key if key in REMOVABLE and key in (entry.keys or {}) else ""


def _mended(entry: Entry, wrong: Mapping[int, tuple[Diagnostic, str]]) -> Entry:
    members = tuple(_mended(member, wrong) for member in entry.members)
    if id(entry) not in wrong:
        return replace(entry, members=members) if members != entry.members else entry
    one, key = wrong[id(entry)]
    message = one.message
    mended = replace(entry, members=members)
    if key and entry.keys is not None:
        left = {name: value for name, value in entry.keys.items() if name != key}
        text = f"{key} `{_shown(entry.keys[key])}` is left out: {message} ({one.rule})"
        return mended.told(Remark(CODE, text, todo=True), keys=left)
    return mended.told(Remark(CODE, f"left out: {message} ({one.rule})"), keys=None)


def _shown(value: object) -> str:
    text = str(value)
    return text if len(text) <= 60 else f"{text[:57]}..."  # noqa: PLR2004 - a part of a line
