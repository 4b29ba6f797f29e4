"""Points of one register as its entry: rows that say the same number, or the bits of one word."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import Any

from regscribe.draft import Entry, Remark
from regscribe.draft.ids import Taken, free_id
from regscribe.draft.labels import labelled
from regscribe.files import OneLine
from regscribe.importers.shared.points import Point, entry_of, field_of, keys_of, lost_in_fields
from regscribe.model import WireType
from regscribe.model.identifiers import snake

WORD_BITS = 16
UNSIGNED = {16: WireType.UINT16, 32: WireType.UINT32, 48: WireType.UINT48, 64: WireType.UINT64}
"""Types of words of bits by their bits."""

MEANINGS = frozenset({"enum", "flags", "fields", "kind", "range", "valid"})
"""Keys of which a register has one."""

ITS_OWN = frozenset({"id", "when"})
"""Keys that another row of the same register does not change."""


def number_of(points: Sequence[Point]) -> Entry:
    """Return the entry of a number; rows that say it again are told, and what they say besides is taken."""
    first, *others = points
    if not others:
        return entry_of(first)
    merged = first
    parts = [_row(first, first.remarks)]
    for one in others:
        more = {**_besides(one, merged), **merged.more}
        access = "rw" if {merged.access, one.access} != {merged.access} else merged.access
        merged = replace(merged, more=more, access=access, unit=merged.unit or one.unit)
        parts.append(_row(one, (*one.remarks, _again(first, one, more))))
    return replace(entry_of(replace(merged, remarks=())), parts=tuple(parts))


def called(entry: Entry, name: str) -> Entry:
    """Return the entry with its id, where the name alone does not say it."""
    keys = entry.keys or {}
    others = {key: value for key, value in keys.items() if key != "id"}
    own = {} if snake(keys["name"]) == name else {"id": name}
    return entry if entry.members else replace(entry, keys={**own, **others})


def _besides(one: Point, merged: Point) -> dict[str, Any]:
    """Further keys of a row that says a register again, which those before it leave open."""
    closed = ITS_OWN | (MEANINGS if MEANINGS & merged.more.keys() else frozenset())
    return {key: value for key, value in one.more.items() if key not in closed}


def _again(first: Point, one: Point, more: dict[str, Any]) -> Remark:
    contrary = [key for key, value in one.more.items() if more.get(key) != value and key not in ITS_OWN]
    contrary += ["unit"] if one.unit and one.symbol != first.symbol else []
    lost = f"; its {', '.join(contrary)} is not taken over" if contrary else ""
    message = f"the same register as `{first.name}` ({first.place}){lost}"
    return Remark("same-register", message, lossy=bool(contrary))


def word_name(points: Sequence[Point]) -> str:
    """Return what a word of bits is called: as its only part, or by its place."""
    first = points[0]
    return first.name if len(points) == 1 else f"Word {first.space} {first.at}"


def word_of(points: Sequence[Point], whole: str | None) -> Entry:
    """Return the entry of a word of bits; `whole` is the id of the number that is read again in another way."""
    first = points[0]
    remarks = [[*one.remarks] for one in points]
    merged = "rw" if {one.access for one in points} - {"r"} else "r"
    for one, own in zip(points, remarks, strict=True):
        own.extend(_of_access(one, merged, whole))
    keys = keys_of(replace(first, bits=None, type=UNSIGNED.get(first.length * WORD_BITS, first.type), more={}, unit=""))
    keys = {key: value for key, value in keys.items() if key not in {"multiply", "add", "decimals"}}
    keys |= {"name": word_name(points), "access": "r" if whole is not None else merged}
    keys |= {"when": first.more["when"]} if "when" in first.more else {}
    keys |= {"rereads": whole} if whole is not None else {}
    if all(one.bits and one.bits[0] == one.bits[1] and not _meaning(one) for one in points):
        keys["flags"] = labelled({one.bits[0]: one.name for one in points if one.bits}, "bit")
    else:
        keys["fields"] = _fields(points)
        for own, lost in zip(remarks, lost_in_fields(points), strict=True):
            own.extend(lost)
    parts = tuple(_row(one, own) for one, own in zip(points, remarks, strict=True))
    return Entry(name=keys["name"], place=first.place, keys=keys, group=first.group, parts=parts)


def _of_access(one: Point, merged: str, whole: str | None) -> Iterator[Remark]:
    """What of the access of a part is not that of its word."""
    if whole is not None and one.access != "r":
        yield Remark("write-dropped", f"read only: the word is written as `{whole}`")
    elif one.access != merged:
        yield Remark("access-changed", f"{merged} as the other bits of its word, not {one.access}")


def _meaning(point: Point) -> bool:
    """Whether a bit has more than a label."""
    return bool(set(point.more) - {"when"}) or point.multiply != 1 or bool(point.add or point.unit)


def _fields(points: Sequence[Point]) -> dict[str, Any]:
    taken: Taken = {}
    ids = [free_id(snake(one.name), {"at": (one.bits or (0,))[0]}, taken, "part") for one in points]
    return OneLine(zip(ids, map(field_of, points), strict=True))


def _row(point: Point, remarks: Iterable[Remark]) -> Entry:
    """A row whose facts stand in the keys of another entry."""
    return Entry(name=point.name, place=point.place, keys={}, remarks=tuple(remarks), group=point.group)
