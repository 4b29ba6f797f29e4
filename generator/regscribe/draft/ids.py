"""Ids for entries whose names give none, one that Python or the driver has, or one that another entry has."""

import keyword
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from regscribe.checks.identifiers import RUNTIME_NAMES, normalised
from regscribe.draft import Draft, Entry, Part
from regscribe.model.identifiers import snake

LONGEST = 80
"""Characters of an id."""

FALLBACK = "register"

Taken = dict[str, list[Mapping[str, Any]]]
"""The keys of the entries that have an id, by its letters and digits: readers mistake `a_1` for `a1`."""


def named(draft: Draft) -> Draft:
    """Return the draft with an id for each register whose name alone would be refused or mean another register too."""
    return replace(draft, entries=_named(draft.entries))


def _named(entries: tuple[Entry, ...]) -> tuple[Entry, ...]:
    taken: Taken = {}
    for entry in entries:
        if entry.keys is not None and "id" in entry.keys:
            taken.setdefault(normalised(str(entry.keys["id"])), []).append(entry.keys)
    return tuple(_one(entry, taken) for entry in entries)


def _one(entry: Entry, taken: Taken) -> Entry:
    if entry.keys is None or entry.part is not Part.REGISTERS or "name" not in entry.keys:
        return entry
    members = _named(entry.members)
    if "id" in entry.keys or "set" in entry.keys:
        return replace(entry, members=members)
    usual = snake(str(entry.keys["name"]))
    own = free_id(usual, entry.keys, taken)
    if own == usual and not members:  # an array always says its id
        return replace(entry, members=members)
    first = {key: value for key, value in entry.keys.items() if key in {"at", "name"}}
    return replace(entry, keys={**first, "id": own, **entry.keys}, members=members)


def free_id(usual: str, keys: Mapping[str, Any], taken: Taken, fallback: str = FALLBACK) -> str:
    """Return the usual id if it can be one and no other entry of the same models has it, else one like it; note it."""
    base = usual[:LONGEST].rstrip("_")
    if not base[:1].isalpha():
        base = f"{fallback}_{base or keys.get('at', '')}"[:LONGEST].rstrip("_")
    if keyword.iskeyword(base) or keyword.issoftkeyword(base) or base in RUNTIME_NAMES:
        base = f"{base}_{fallback}"
    found, number = base, 2
    while any(_together(keys, other) for other in taken.get(normalised(found), ())):
        ending = f"_{number}"
        found, number = f"{base[: LONGEST - len(ending)]}{ending}", number + 1
    taken.setdefault(normalised(found), []).append(keys)
    return found


def _together(one: Mapping[str, Any], other: Mapping[str, Any]) -> bool:
    """Whether some model may have both."""
    models, others = one.get("models"), other.get("models")
    return not (isinstance(models, list) and isinstance(others, list)) or bool({*models} & {*others})
