"""A draft as the YAML text of a map, with comments where a person must decide, and the entry of each line."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from textwrap import indent
from typing import Any

from regscribe.checks.identifiers import normalised
from regscribe.draft import Draft, Entry, Part
from regscribe.draft.head import completed
from regscribe.files import OneLine, dump
from regscribe.model.identifiers import snake
from regscribe.visible import safe

GROUP_ID = "group"
"""Begins the id of a group whose name begins with no letter."""


@dataclass(frozen=True, slots=True)
class Written:
    """The text of a map, and the entry of each line that says something of one."""

    text: str
    owners: Mapping[int, Entry]


class _Lines:
    """Text that grows, with the entry that each line belongs to."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.owners: dict[int, Entry] = {}

    def add(self, text: str, entry: Entry | None = None) -> None:
        for line in text.splitlines():
            self.lines.append(line)
            if entry is not None:
                self.owners[len(self.lines)] = entry


def text_of(draft: Draft, head: Mapping[str, Any]) -> Written:
    """Write a draft; `head` are the keys `format` and `map`, which come first."""
    out = _Lines()
    for remark in draft.stated:
        out.add(f"# {safe(remark)}")
    out.add(dump({**head, **completed(draft)}))
    _add_groups(out, draft)
    for part in (Part.COMMANDS, Part.COMPUTED):
        of_part = [entry for entry in draft.entries if entry.part is part and entry.keys is not None]
        if of_part:
            out.add(f"{part}:")
            _add_entries(out, of_part, "  ")
    return Written("\n".join(out.lines) + "\n", out.owners)


def _add_groups(out: _Lines, draft: Draft) -> None:
    by_group: dict[str, list[Entry]] = {}
    for entry in draft.entries:
        if entry.part is Part.REGISTERS and entry.keys is not None:
            by_group.setdefault(entry.group, []).append(entry)
    if by_group:
        out.add("groups:")
    ids: set[str] = set()
    for name, entries in by_group.items():
        own = {"id": group_id(name, ids), "name": name, **draft.groups.get(name, {})}
        ids.add(own["id"])
        out.add(_item(dump(own), "  "))
        out.add("    registers:")
        _add_entries(out, entries, "      ")


def group_id(name: str, taken: set[str] | frozenset[str] = frozenset()) -> str:
    """An id of a group by its name, that none of `taken` is."""
    plain = snake(name)[:60] or GROUP_ID
    plain = plain if plain[0].isalpha() else f"{GROUP_ID}_{plain}"
    number = 2
    found = plain
    known = set(map(normalised, taken))
    while normalised(found) in known:
        found, number = f"{plain}_{number}", number + 1
    return found


def _add_entries(out: _Lines, entries: Sequence[Entry], margin: str) -> None:
    for entry in entries:
        for comment in _comments(entry):
            out.add(f"{margin}# {comment}", entry)
        keys = entry.keys or {}
        members = [member for member in entry.members if member.keys is not None]
        if not members:
            out.add(_item(_one_line(keys), margin), entry)
            continue
        out.add(_item(dump(dict(keys)), margin), entry)
        out.add(f"{margin}  registers:", entry)
        _add_entries(out, members, f"{margin}    ")


def _comments(entry: Entry) -> Iterator[str]:
    yield from (f"TODO {safe(remark.message)}" for remark in entry.remarks if remark.todo)
    for part in entry.parts:
        yield from (f"TODO {safe(part.name)}: {safe(remark.message)}" for remark in part.remarks if remark.todo)


def _one_line(keys: Mapping[str, Any]) -> str:
    whole = {"x": OneLine(_flat(keys))}
    return dump(whole).removeprefix("x: ")


def _flat(value: Any) -> Any:  # noqa: ANN401 - plain values of YAML
    """The value with all its mappings on one line."""
    if isinstance(value, Mapping):
        return OneLine({key: _flat(inner) for key, inner in value.items()})
    return [_flat(inner) for inner in value] if isinstance(value, list | tuple) else value


def _item(text: str, margin: str) -> str:
    """A text as an item of a list."""
    return f"{margin}- {indent(text, f'{margin}  ').lstrip()}"
