"""The keys of a map that follow from its entries: a model where the source names none, and the functions it needs."""

from collections.abc import Iterator, Mapping
from contextlib import suppress
from typing import Any

from regscribe.draft import Draft, Part
from regscribe.files import OneLine
from regscribe.model import Space

MODEL = "Basic"
"""The name of the one model of a source that names none."""

USUAL = frozenset({3, 6, 16})
"""The functions that a map has which states none."""


def completed(draft: Draft) -> dict[str, Any]:
    """Return the head of a draft with what it lacks: `models`, and `protocol.functions` for the spaces it uses."""
    head = dict(draft.head)
    protocol: Mapping[str, Any] = head.get("protocol", {})
    needed = frozenset(_functions(draft))
    if "functions" not in protocol and not needed <= USUAL:
        head["protocol"] = {**protocol, "functions": sorted(needed)}
    return {"models": {MODEL: OneLine()}, **head}


def _functions(draft: Draft) -> Iterator[int]:
    """The functions that read and write the registers of the draft, in the spaces that they name."""
    for entry in draft.each:
        if entry.keys is None or entry.part is not Part.REGISTERS or "at" not in entry.keys:
            continue
        with suppress(ValueError):  # a space that is none is for `check` to tell
            space = Space(entry.keys.get("space", Space.HOLDING))
            access = entry.keys.get("access", "r")
            yield from (space.read_function,) if access != "w" else ()
            yield from space.write_functions if access != "r" else ()
