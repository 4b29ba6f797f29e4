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

KEYS = ("default", "delivered", "range", "valid", "unit", "special", "enum", "flags")
"""Those that are tried, in this order, where an error points at an entry and not at a key of it."""

Wrong = dict[int, tuple[Diagnostic, str]]
"""The first error of each entry, by the entry's identity, with the key that it points at."""


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
        wrong |= _tried(draft, wrong, head, check)
        draft = replace(draft, entries=tuple(_mended(entry, wrong) for entry in draft.entries))
        written = text_of(draft, head)
        found = tuple(check(written.text))
    return draft, written, found


def _tried(draft: Draft, wrong: Wrong, head: Mapping[str, Any], check: Check) -> Wrong:
    """The entries whose error points at no key but is gone without one: each key is tried for all of them at once."""
    settled: Wrong = {}
    for key in KEYS:
        left = {
            id(one) for one in draft.entries if id(one) in wrong and not wrong[id(one)][1] and key in (one.keys or {})
        }
        left -= settled.keys()
        if not left:
            continue
        entries = tuple(_without(entry, key) if id(entry) in left else entry for entry in draft.entries)
        written = text_of(replace(draft, entries=entries), head)
        still = _by_entry(written, check(written.text))
        for before, after in zip(draft.entries, entries, strict=True):
            own = wrong.get(id(before))
            if id(before) in left and own and (id(after) not in still or still[id(after)][0].rule != own[0].rule):
                settled[id(before)] = own[0], key
    return settled


def _without(entry: Entry, key: str) -> Entry:
    return replace(entry, keys={name: value for name, value in (entry.keys or {}).items() if name != key})


def _by_entry(written: Written, found: Sequence[Diagnostic]) -> Wrong:
    """The first error of each entry, by the entry's identity, with the key that it points at."""
    lines = written.text.splitlines()
    wrong: Wrong = {}
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


def _mended(entry: Entry, wrong: Wrong) -> Entry:
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
