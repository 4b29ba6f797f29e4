"""openHAB's binding as its documentation and source describe it, in a few lines, reads what the cases say by an export.

openHAB itself does not run here; this model of it knows data things and items alone, and nothing of maps.
"""

import re
import struct
from decimal import Decimal
from fractions import Fraction
from typing import Any

import pytest

from regscribe.export.openhab import TARGET
from regscribe.export.openhab.items import items_of
from regscribe.export.openhab.things import Link
from regscribe.export.openhab.values import data_of, why_read_only, write_type

from .exported import Asked, code_of, compiled_cases, label_of, reads, writes
from .suite import Built, Case

PROFILE = re.compile(r'gain="(-?[\d.]+)[^"]*", pre-gain-offset="(-?[\d.]+)"')
FLOAT_DIGITS = 9
"""Decimal digits that tell a float of 32 bits from every other."""


LEAST = Fraction(1, 10**37)
"""Below this a float of 32 bits has too few digits to be compared."""


@pytest.fixture(scope="module")
def built() -> list[tuple[Case, Built]]:
    return compiled_cases()


def extracted(start: str, kind: str, first: int, words: list[int]) -> Fraction | None:
    """What the binding extracts from the registers (or bits) of a poller that begins at `first`; None: no number."""
    index, _, part = start.partition(".")
    at = int(index) - first
    if kind == "bit":
        return Fraction(words[at] >> int(part or 0) & 1)
    if kind in {"int8", "uint8"}:
        byte = words[at] >> 8 * int(part) & 0xFF
        return Fraction(byte - 256 if kind == "int8" and byte > 127 else byte)
    plain = kind.removesuffix("_swap")
    size = int(re.sub(r"\D", "", plain)) // 16
    taken = words[at : at + size][:: -1 if plain != kind else 1]
    raw = struct.pack(f">{size}H", *taken)
    if plain == "float32":
        (number,) = struct.unpack(">f", raw)
        return Fraction(Decimal(f"{number:.{FLOAT_DIGITS}g}")) if abs(number) < float("inf") else None
    return Fraction(int.from_bytes(raw, "big", signed=plain.startswith("int")))


def shown(one: Asked, link: Link, words: list[int]) -> Fraction | None:
    """The state of the item, after the profile if it has one."""
    found = extracted(link.datum.start, link.datum.type, one.point.address, words)
    *_, item = items_of(one.device, [link])
    profile = PROFILE.search(item)
    if found is None or not profile:
        return found
    return (found + Fraction(profile[2])) * Fraction(profile[1])


def links(one: Asked) -> list[Link]:
    return [
        Link(point=one.point, datum=datum, id=datum.suffix or "x", channel="c", writable=False)
        for datum in data_of(one.point)
    ]


def test_the_items_show_what_the_cases_say(built: list[tuple[Case, Built]]) -> None:
    rows = [one for case, found in built for one in reads(TARGET, case, found)]
    known = [
        one for one in rows if not {"no_value", "fault", "unknown", "fields"} & one.row.keys() and not _stands(one)
    ]
    wrong = [f"{one.case}: {one.row}: {states(one)}" for one in known if not _agrees(one, states(one))]
    assert wrong == []
    assert len(known) > 500


def _stands(one: Asked) -> bool:
    """Whether the row is a special value that stands for another number, which openHAB does not know and is told."""
    others = [each for each in one.point.special_numbers if each.code != each.value]
    return any(one.row.get("value") == each.value for each in others)


def states(one: Asked) -> dict[str, Fraction | None]:
    return {link.id: shown(one, link, one.words) for link in links(one)}


def _agrees(one: Asked, found: dict[str, Fraction | None]) -> bool:
    row = one.row
    if "flags" in row:
        return {name for name, bit in found.items() if bit} == set(row["flags"]) & found.keys()
    value = found["x"]
    if "member" in row:
        return value == code_of(one)
    if "special" in row:
        codes = [each.code for each in one.point.special_numbers if each.label == label_of(one)]
        return value is not None and any(_near(one, value, code) for code in codes)
    return value is not None and _near(one, value, row["value"])


def _near(one: Asked, value: Fraction, said: Any) -> bool:
    """Whether a state is a number of a row: floats, and scales without a finite decimal, have only some digits."""
    if isinstance(said, str):
        return True  # a version, told to be the number that packs it
    wanted = Fraction(said)
    if value == wanted or abs(wanted) < LEAST:
        return True
    rough = one.point.wire.type.is_float or any(loss.fact == "scale-rounded" for loss in one.device.losses)
    return rough and abs(value - wanted) <= abs(wanted) * Fraction(1, 10**6)


def written(one: Asked, value: Fraction) -> list[int]:
    """The registers that the binding writes for a command: it divides by the gain and takes the offset away."""
    (link,) = links(one)[:1]
    *_, item = items_of(one.device, [link])
    profile = PROFILE.search(item)
    raw = value / Fraction(profile[1]) - Fraction(profile[2]) if profile else value
    if one.point.wire.space.is_bits:
        return [int(raw != 0)]
    kind = write_type(one.point)
    plain = kind.removesuffix("_swap")
    size = int(re.sub(r"\D", "", plain)) // 16
    if plain == "float32":
        data = struct.pack(">f", float(raw))
    else:
        data = (int(raw) % (1 << 16 * size)).to_bytes(2 * size, "big")  # cut, as Java casts
    words = list(struct.unpack(f">{size}H", data))
    return words[::-1] if plain != kind else words


def test_commands_write_what_the_cases_say(built: list[tuple[Case, Built]]) -> None:
    rows = [one for case, found in built for one in writes(TARGET, case, found)]
    protocol = rows[0].device.register_map.protocol
    sent = [
        one
        for one in rows
        if "words" in one.row
        and one.point.write is not None
        and not why_read_only(protocol, one.point)
        and isinstance(_command(one), Fraction)
        and not _stands(one)
    ]
    wrong = [
        f"{one.case}: {one.row}: {written(one, _command(one))}"
        for one in sent
        if written(one, _command(one)) != one.words
    ]
    assert wrong == []
    assert len(sent) > 300


def _command(one: Asked) -> Any:
    if "member" in one.row:
        return Fraction(code_of(one))
    if "special" in one.row:
        return next(each.code for each in one.point.special_numbers if each.label == label_of(one))
    value = one.row["value"]
    return Fraction(value) if not isinstance(value, str) else value
