"""Rows that are about bits of one word become one register with flags, or with fields of several bits."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any

from regscribe.draft import Entry, Remark
from regscribe.files import OneLine
from regscribe.importers.table.registers import Made
from regscribe.model.identifiers import label_id

WORD_BITS = 16
OWN = ("enum", "unit", "range", "multiply", "add", "decimals", "description")
"""Keys that a field has as a register has them."""

Key = tuple[str, int]


def gathered(made: Sequence[Made]) -> tuple[Entry, ...]:
    """The entries, those of bits put into the register of their word, which is made where no row is about it."""
    words: dict[Key, list[Made]] = {}
    for one in made:
        if one.bits is not None and one.entry.keys is not None:
            words.setdefault((str(one.space), one.at), []).append(one)
    parents = {
        (str(one.space), one.at): one
        for one in made
        if one.bits is None and one.entry.keys is not None and (str(one.space), one.at) in words
    }
    return tuple(_entries(made, words, parents))


def _entries(made: Sequence[Made], words: dict[Key, list[Made]], parents: dict[Key, Made]) -> Iterator[Entry]:
    done: set[Key] = set()
    for one in made:
        key = str(one.space), one.at
        if one.bits is not None and one.entry.keys is not None:
            if key not in parents and key not in done:
                done.add(key)
                yield _word(_parent(words[key]), words[key])
        elif parents.get(key) is one:
            yield _word(one.entry, words[key])
        else:
            yield one.entry


def _parent(bits: Sequence[Made]) -> Entry:
    """A register for bits whose word no row is about."""
    first = bits[0].entry
    keys = first.keys or {}
    access = {str((one.entry.keys or {}).get("access", "r")) for one in bits}
    own = {
        "at": bits[0].at,
        "name": f"Bits of {bits[0].space} {bits[0].at}" if len(bits) > 1 else keys["name"],
        **({"space": keys["space"]} if "space" in keys else {}),
        "access": access.pop() if len(access) == 1 else "rw",
    }
    return replace(first, name=str(own["name"]), keys=own, remarks=())


def _word(parent: Entry, bits: Sequence[Made]) -> Entry:
    """The register of a word with its bits."""
    remarks = [remark for one in bits for remark in one.entry.remarks]
    kept: list[Made] = []
    for one in bits:
        clash = next((other for other in kept if _overlap(one, other)), None)
        if clash is None:
            kept.append(one)
        else:
            message = (
                f"{one.entry.where}: {one.entry.name}: its bits are those of {clash.entry.name} ({clash.entry.where})"
            )
            remarks.append(Remark("bit-doubled", message))
    places = ", ".join(one.entry.where for one in kept[:6]) + (f" and {len(kept) - 6} more" if len(kept) > 6 else "")  # noqa: PLR2004
    if [one.entry.where for one in kept] != [parent.where]:
        remarks.append(Remark("bits", f"its bits stand in {places}", lossy=False))
    single = all(one.bits is not None and one.bits[0] == one.bits[1] for one in kept)
    held = {"flags": _flags(kept)} if single and not any(_more(one) for one in kept) else {"fields": _fields(kept)}
    keys = {key: value for key, value in (parent.keys or {}).items() if key not in {"enum", "flags", "unit", "range"}}
    return replace(parent, keys={**keys, **held}, remarks=(*parent.remarks, *remarks))


def _overlap(one: Made, other: Made) -> bool:
    assert one.bits is not None  # noqa: S101 - only such are gathered
    assert other.bits is not None  # noqa: S101 - as above
    return one.bits[0] <= other.bits[1] and other.bits[0] <= one.bits[1]


def _more(one: Made) -> bool:
    return any(key in (one.entry.keys or {}) for key in OWN if key != "description")


def _flags(bits: Sequence[Made]) -> OneLine:
    found: dict[Any, Any] = {}
    ids: set[str] = set()
    for one in sorted(bits, key=lambda one: one.bits or (0, 0)):
        keys = one.entry.keys or {}
        number = (one.bits or (0, 0))[0]
        text = {"description": keys["description"]} if "description" in keys else {}
        own = label_id(one.entry.name)
        if own in ids or not own:
            text["id"] = f"{own or 'bit'}_{number}"
        ids.add(own)
        found[number] = OneLine(label=one.entry.name, **text) if text else one.entry.name
    return OneLine(found)


def _fields(bits: Sequence[Made]) -> OneLine:
    found: dict[str, Any] = {}
    for one in sorted(bits, key=lambda one: one.bits or (0, 0)):
        low, high = one.bits or (0, 0)
        keys = one.entry.keys or {}
        own = label_id(one.entry.name) or f"bit_{low}"
        own = own if own not in found else f"{own}_{low}"
        place = {"bit": low} if low == high else {"bits": f"{low}..{high}"}
        found[own] = OneLine(**place, label=one.entry.name, **{key: keys[key] for key in OWN if key in keys})
    return OneLine(found)
