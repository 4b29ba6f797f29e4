"""Points of a source as entries of a draft: bits of one word together, doubles and overlaps told with both places."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from regscribe.draft import Entry, Remark
from regscribe.draft.ids import Taken, free_id
from regscribe.importers.shared.points import Point
from regscribe.importers.shared.registers import called, number_of, word_name, word_of
from regscribe.model import Diagnostic, Related, Severity, Space, WireType
from regscribe.model.identifiers import snake

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
    name = word_name(place.points) if place.is_word else first.name
    return free_id(str(first.more.get("id") or snake(name)), {"at": first.at}, taken)


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
        word = word_of(place.points, None if whole is None else named[id(whole)])
        return called(word, named[id(place)]), *place.lost
    return called(number_of(place.points), named[id(place)]), *place.lost


def _is_wider(one: _Place, word: _Place) -> bool:
    """Whether a word of bits is another reading of what stands in a place."""
    others = not one.is_word or one.first.length > word.first.length
    return others and _covers(one, word) and not _conditional(one)


def _covers(whole: _Place, word: _Place) -> bool:
    one, other = whole.first, word.first
    return one.space is other.space and one.count == 1 and {*other.addresses} <= {*one.addresses}


def _conditional(place: _Place) -> bool:
    return "when" in place.first.more


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
