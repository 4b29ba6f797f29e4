"""The keys of a map that follow from its entries: a model where the source names none, functions, and its own units."""

from collections.abc import Iterator, Mapping
from contextlib import suppress
from typing import Any

from regscribe.draft import Draft, Part
from regscribe.files import OneLine
from regscribe.model import Space
from regscribe.model.units import KNOWN_UNITS

MODEL = "Basic"
"""The name of the one model of a source that names none."""

USUAL = frozenset({3, 6, 16})
"""The functions that a map has which states none."""


def completed(draft: Draft) -> dict[str, Any]:
    """Return the head of a draft with what it lacks: `models`, `protocol.functions` for its spaces, unknown `units`."""
    head = dict(draft.head)
    protocol: Mapping[str, Any] = head.get("protocol", {})
    needed = frozenset(_functions(draft))
    if "functions" not in protocol and not needed <= USUAL:
        head["protocol"] = {**protocol, "functions": sorted(needed)}
    known = {*KNOWN_UNITS, *head.get("units", {})}
    if own := [unit for unit in dict.fromkeys(_units(draft)) if unit not in known]:
        head["units"] = {**head.get("units", {}), **{unit: OneLine() for unit in own}}
    return {"models": {MODEL: OneLine()}, **head}


def _units(draft: Draft) -> Iterator[str]:
    """The units of registers and of parts of words, where they stand under no condition."""
    for entry in draft.each_kept:
        keys: Mapping[str, Any] = entry.keys or {}
        fields = keys.get("fields", {})
        parts = [one for one in fields.values() if isinstance(one, Mapping)] if isinstance(fields, Mapping) else []
        yield from (str(one["unit"]) for one in (keys, *parts) if isinstance(one.get("unit"), str))


def _functions(draft: Draft) -> Iterator[int]:
    """The functions that read and write the registers of the draft, in the spaces that they name."""
    for entry in draft.each_kept:
        if entry.keys is None or entry.part is not Part.REGISTERS or "at" not in entry.keys:
            continue
        with suppress(ValueError):  # a space that is none is for `check` to tell
            space = Space(entry.keys.get("space", Space.HOLDING))
            access = entry.keys.get("access", "r")
            yield from (space.read_function,) if access != "w" else ()
            way = entry.keys.get("write", {})
            written = Space(way.get("space", space)) if isinstance(way, Mapping) else space
            yield from written.write_functions if access != "r" else ()
