"""Points of a source as entries of a draft: bits of one word together, doubles and overlaps told with both places."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from regscribe.draft import Entry, Remark
from regscribe.draft.ids import Taken, free_id
from regscribe.draft.labels import labelled
from regscribe.files import OneLine
from regscribe.importers.shared.points import Point, entry_of, field_of, keys_of, lost_in_fields
from regscribe.model import Diagnostic, Related, Severity, Space, WireType
from regscribe.model.identifiers import snake

WORD_BITS = 16
UNSIGNED = {16: WireType.UINT16, 32: WireType.UINT32, 48: WireType.UINT48, 64: WireType.UINT64}
"""Types of words of bits by their bits."""

Item = Point | Entry
"""A point, or an entry that is left out already."""


@dataclass(slots=True)
class _Place:
    """What stands at some addresses: the points that say it, all of the same number or all bits of one word."""

    points: list[Point]
    lost: list[Entry] = field(default_factory=list)

    @property
    def first(self) -> Point:
        return self.points[0]

    @property
    def is_word(self) -> bool:
        return self.first.bits is not None


def collected(items: Sequence[Item]) -> tuple[tuple[Entry, ...], tuple[Diagnostic, ...]]:
    """Return the entries in the order of the source, and what it says twice or contrary."""
    places: list[_Place | Entry] = []
    findings: list[Diagnostic] = []
    by_key: dict[tuple[object, ...], _Place] = {}
    for item in items:
        if isinstance(item, Entry):
            places.append(item)
            continue
        own = by_key.get(_key(item)) or by_key.get(_key(item, always=True))
        if own is None:
            own = by_key[_key(item)] = _Place([])
            places.append(own)
        findings += _put(item, own)
    kept, contrary = _apart([one for one in places if isinstance(one, _Place)])
    taken: Taken = {}
    named = {id(one): _named(one, taken) for one in kept}
    entries = [one if isinstance(one, Entry) else _entry(one, kept, named, contrary.get(id(one))) for one in places]
    found = [diagnostic for _, diagnostic in contrary.values()]
    return tuple(entry for group in entries for entry in (group if isinstance(group, tuple) else (group,))), (
        *findings,
        *found,
    )


def _named(place: _Place, taken: Taken) -> str:
    """The id of a register; words of bits are called by the first of them, or by their place."""
    first = place.first
    name = _word_name(place) if place.is_word else first.name
    return free_id(str(first.more.get("id") or snake(name)), {"at": first.at}, taken)


def _word_name(place: _Place) -> str:
    first = place.first
    return first.name if len(place.points) == 1 else f"Word {first.space} {first.at}"


def _key(point: Point, *, always: bool = False) -> tuple[object, ...]:
    """Points of one key are one register: bits of the same words, or the same number, under the same condition."""
    when = repr(None if always else point.more.get("when"))
    if point.bits is not None:
        return point.space, point.at, point.length, point.orders, when, "bits"
    return (point.space, *point.facts, when)


def _put(point: Point, place: _Place) -> Iterator[Diagnostic]:
    """Put a point into the register that it is of; one whose bits another has is left out."""
    if place.points and point.bits is not None:
        low, high = point.bits
        for one in place.points:
            if one.bits is not None and one.bits[0] <= high and low <= one.bits[1]:
                message = f"bits {low}..{high} of {_where(point)} overlap `{one.name}` ({one.place})"
                place.lost.append(_left_out(point, message))
                yield _finding(point, one, message)
                return
    place.points.append(point)


def _apart(places: Sequence[_Place]) -> tuple[list[_Place], dict[int, tuple[Entry, Diagnostic]]]:
    """Return what can stand beside each other, and what overlaps something before it: left out, and told.

    Bits of a word stand beside the number that the word is: they are another reading of it.
    """
    kept: list[_Place] = []
    contrary: dict[int, tuple[Entry, Diagnostic]] = {}
    by_address: dict[tuple[Space, int], list[_Place]] = {}
    for place in sorted(places, key=lambda one: (one.is_word, -one.first.length * one.is_word)):
        addresses = [(place.first.space, at) for at in place.first.addresses]
        others = {id(one): one for at in addresses for one in by_address.get(at, ())}
        wrong = next((one for one in others.values() if not _agree(place, one)), None)
        if wrong is not None:
            said = (
                "says the same addresses otherwise than" if place.first.stretch == wrong.first.stretch else "overlaps"
            )
            message = f"{_where(place.first)} {said} `{wrong.first.name}` ({wrong.first.place})"
            contrary[id(place)] = _left_out(place.first, message), _finding(place.first, wrong.first, message)
            continue
        kept.append(place)
        for at in addresses:
            by_address.setdefault(at, []).append(place)
    return kept, contrary


def _agree(place: _Place, other: _Place) -> bool:
    """Whether two places may have the same addresses."""
    if all("when" in one.first.more for one in (place, other)):
        return True  # two that never exist together; `check` sees whether they do
    if {place.first.type, other.first.type} <= BYTES:
        return bool(place.first.more.get("byte", "low") != other.first.more.get("byte", "low"))
    return place.is_word and _covers(other, place) and not other.first.type.is_octets


BYTES = {WireType.UINT8, WireType.INT8}
"""Types of one byte of a word, of which two may share it."""


def _entry(
    place: _Place, kept: Sequence[_Place], named: dict[int, str], contrary: tuple[Entry, Diagnostic] | None
) -> tuple[Entry, ...]:
    if contrary is not None:
        remark = contrary[0].remarks[0]
        return tuple(_gone(point, remark) for point in place.points) + tuple(place.lost)
    if place.is_word:
        whole = next((one for one in kept if _is_wider(one, place)), None)
        return _called(_word(place, None if whole is None else named[id(whole)]), named[id(place)]), *place.lost
    return _number(place, named[id(place)]), *place.lost


def _is_wider(one: _Place, word: _Place) -> bool:
    """Whether a word of bits is another reading of what stands in a place."""
    others = not one.is_word or one.first.length > word.first.length
    return others and _covers(one, word) and not _conditional(one)


def _covers(whole: _Place, word: _Place) -> bool:
    one, other = whole.first, word.first
    return one.space is other.space and one.count == 1 and {*other.addresses} <= {*one.addresses}


def _conditional(place: _Place) -> bool:
    return "when" in place.first.more


def _number(place: _Place, name: str) -> Entry:
    """The entry of a number; rows that say the same number again are told, and what they say besides is taken."""
    first, *others = place.points
    if not others:
        entry = entry_of(first)
        return _called(entry, name)
    merged = first
    parts = [_row(first, first.remarks)]
    for one in others:
        more = {**_besides(one, merged), **merged.more}
        access = "rw" if {merged.access, one.access} != {merged.access} else merged.access
        merged = replace(merged, more=more, access=access, unit=merged.unit or one.unit)
        parts.append(_row(one, (*one.remarks, _again(first, one, more))))
    entry = entry_of(replace(merged, remarks=()))
    return replace(_called(entry, name), parts=tuple(parts))


def _called(entry: Entry, name: str) -> Entry:
    """The entry with its id, where the name alone does not say it."""
    keys = entry.keys or {}
    others = {key: value for key, value in keys.items() if key != "id"}
    own = {} if snake(keys["name"]) == name else {"id": name}
    return entry if entry.members else replace(entry, keys={**own, **others})


MEANINGS = frozenset({"enum", "flags", "fields", "kind", "range", "valid"})
"""Keys of which a register has one."""


def _besides(one: Point, merged: Point) -> dict[str, Any]:
    """Further keys of a row that says a register again, which those before it leave open."""
    closed = ITS_OWN | (MEANINGS if MEANINGS & merged.more.keys() else frozenset())
    return {key: value for key, value in one.more.items() if key not in closed}


ITS_OWN = frozenset({"id", "when"})
"""Keys that another row of the same register does not change."""


def _again(first: Point, one: Point, more: dict[str, Any]) -> Remark:
    contrary = [key for key, value in one.more.items() if more.get(key) != value and key not in ITS_OWN]
    contrary += ["unit"] if one.unit and one.symbol != first.symbol else []
    lost = f"; its {', '.join(contrary)} is not taken over" if contrary else ""
    message = f"the same register as `{first.name}` ({first.place}){lost}"
    return Remark("same-register", message, lossy=bool(contrary))


def _word(place: _Place, whole: str | None) -> Entry:
    """The entry of a word of bits; the bits of a number that is there as well are another reading of it."""
    first = place.points[0]
    points = place.points
    remarks = [[*one.remarks] for one in points]
    access = {one.access for one in points}
    merged = "rw" if access - {"r"} else "r"
    for one, own in zip(points, remarks, strict=True):
        if whole is not None and one.access != "r":
            own.append(Remark("write-dropped", f"read only: the word is written as `{whole}`"))
        elif one.access != merged:
            own.append(Remark("access-changed", f"{merged} as the other bits of its word, not {one.access}"))
    single = all(one.bits and one.bits[0] == one.bits[1] and not _meaning(one) for one in points)
    keys = keys_of(replace(first, bits=None, type=UNSIGNED.get(first.length * WORD_BITS, first.type), more={}, unit=""))
    keys = {key: value for key, value in keys.items() if key not in {"multiply", "add", "decimals"}}
    name = _word_name(place)
    keys |= {"name": name, "access": "r" if whole is not None else merged}
    keys |= {"when": first.more["when"]} if "when" in first.more else {}
    keys |= {"rereads": whole} if whole is not None else {}
    if single:
        keys["flags"] = labelled({one.bits[0]: one.name for one in points if one.bits}, "bit")
    else:
        keys["fields"] = _fields(points)
        for own, lost in zip(remarks, lost_in_fields(points), strict=True):
            own.extend(lost)
    parts = tuple(_row(one, tuple(own)) for one, own in zip(points, remarks, strict=True))
    return Entry(name=name, place=first.place, keys=keys, group=first.group, parts=parts)


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


def _where(point: Point) -> str:
    return (
        f"{point.space} {point.at}"
        if point.length * point.count == 1
        else (f"{point.space} {point.at}..{point.stretch[2] - 1}")
    )


def _left_out(point: Point, message: str) -> Entry:
    return _gone(point, Remark("address-taken", message))


def _gone(point: Point, remark: Remark) -> Entry:
    return Entry(name=point.name, place=point.place, remarks=(remark,), group=point.group)


def _finding(point: Point, other: Point, message: str) -> Diagnostic:
    related = (Related(f"`{other.name}` stands here", other.place),)
    return Diagnostic("import", f"`{point.name}`: {message}", point.place, severity=Severity.WARNING, related=related)
