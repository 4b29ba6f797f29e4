"""Addresses in every notation: which one, and from what it counts, is decided once for the whole column."""

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace

from regscribe.importers.table.cells import Unclear, quoted
from regscribe.importers.table.cells.address_rules import LAST, Rule, decide
from regscribe.importers.table.cells.notations import Printed, printed, space_of
from regscribe.importers.table.cells.spaces import REGIONS
from regscribe.model import Space

__all__ = ["Address", "AddressColumn", "Column", "base_words", "parse_addresses"]


@dataclass(frozen=True, slots=True)
class Address:
    """One cell: the wire address, and what else the text says.

    `space` is None where the text does not say it; `count` is the registers of a range, 0 where none stands; `bits` are
    the lowest and the highest bit of `1234.5`.
    """

    at: int
    space: Space | None = None
    count: int = 0
    bits: tuple[int, int] | None = None


@dataclass(frozen=True, slots=True)
class Column:
    """A column of texts with its heading."""

    header: str
    texts: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class AddressColumn:
    """The addresses of all rows (None: the cell is empty).

    `notation` names how they are written, `evidence` says in a sentence why they are read so and how to say otherwise.
    `assumed`: nothing in the table shows from what the addresses count, so a person must check one of them. `words` are
    those of `base` by which the next version of the table is read alike; empty where the texts say it themselves.
    """

    notation: str
    evidence: str
    cells: tuple[Address | Unclear | None, ...]
    assumed: bool = False
    words: str = ""


Read = Printed | Unclear | None


def base_words() -> tuple[str, ...]:
    """The words that `base` of `parse_addresses` takes."""
    return ("0", "1", "modicon", "hex", "decimal")


def parse_addresses(columns: Sequence[Column], *, spaces: Sequence[Space | None] = (), base: str = "") -> AddressColumn:
    """Read one column of addresses, or several of the same registers (hexadecimal and decimal, or one apart).

    `spaces` are those that other columns say, row by row. `base` is what the user says: `0` or `1` (from what the
    numbers count), `modicon` (40001 is the first holding register), `hex` or `decimal`, several joined by commas.
    """
    said = {word.strip().casefold() for word in base.split(",")}
    first, *others = [_one_column(column, spaces, said) for column in columns]
    for other in others:
        first = _together(first, other)
    rule = first.rule
    words = "" if others else _words(rule)
    return AddressColumn(rule.notation, rule.evidence, first.cells, assumed=rule.assumed, words=words)


def _words(rule: Rule) -> str:
    if rule.notation == "regions":
        return ""
    return "modicon" if rule.regions else f"{rule.base},hex" if rule.digits == 16 else str(rule.base)  # noqa: PLR2004 - hex


@dataclass(frozen=True, slots=True)
class _Reading:
    """A column as it reads alone: its texts, the rule, the addresses that follow, and the printed numbers."""

    header: str
    texts: tuple[str, ...]
    rule: Rule
    cells: tuple[Address | Unclear | None, ...]
    numbers: tuple[int | None, ...]


def _one_column(column: Column, spaces: Sequence[Space | None], said: set[str]) -> _Reading:
    read = [printed(text) if text.strip(" -\t\n") else None for text in column.texts]
    if any(isinstance(one, Printed) and one.region is not None for one in read):
        read = [one.as_region if isinstance(one, Printed) else one for one in read]
    every = [one for one in read if isinstance(one, Printed)]
    if every and all(one.has_point_zero for one in every):  # numbers of a spreadsheet, no bits
        read = [replace(one, bits=None) if isinstance(one, Printed) else one for one in read]
    beside = [*spaces, *[None] * (len(read) - len(spaces))]
    rule = decide(read, column.header, beside, said)
    cells = tuple(
        _address(one, rule, space, text) if isinstance(one, Printed) else one
        for one, space, text in zip(read, beside, column.texts, strict=False)
    )
    numbers = tuple(one.number(rule.digits) if isinstance(one, Printed) and rule.reads(one) else None for one in read)
    return _Reading(column.header, column.texts, rule, cells, numbers)


def _address(one: Printed, rule: Rule, beside: Space | None, text: str) -> Address | Unclear:
    """The address of one cell by the rule of its column."""
    if not rule.reads(one):
        return Unclear(f"{quoted(text)} has letters, and the other addresses are decimal")
    if why := rule.doubt(one):
        return Unclear(f"{quoted(text)} {why}")
    number, space = one.number(rule.digits), space_of(one, by_function=bool(rule.by_function))
    if (of := rule.modicon(one)) is not None:
        space, number = REGIONS[of[0]], of[1]
    if space and beside and space is not beside:
        return Unclear(f"{quoted(text)} is an address of {space} registers, and another column says {beside}")
    at = number - rule.base_of(one)
    if not 0 <= at <= LAST:
        return Unclear(f"{quoted(text)} is {at} as a wire address, which goes from 0 to {LAST}")
    count = one.end(rule.digits) - one.number(rule.digits) + 1 if one.last else 0
    return Address(at, space, count, one.bits)


ONE_APART = 1
MOST_OTHERS = 5
"""One of so many rows may disagree, and is unclear then; if more do, the columns do not belong together."""


def _together(first: _Reading, other: _Reading) -> _Reading:
    """Two columns of the same registers as one: what they differ by shows from what they count."""
    pairs = [
        None if one is None or two is None else one - two for one, two in zip(first.numbers, other.numbers, strict=True)
    ]
    known = Counter(pair for pair in pairs if pair is not None)
    if not known:
        return first
    regions = {pair for pair in known if _is_modicon(abs(pair))}
    (usual, _), *_ = known.most_common()
    agreeing = regions if usual in regions else {usual}
    wrong = sum(known.values()) - sum(known[pair] for pair in agreeing)
    both = f"`{first.header.strip()}` and `{other.header.strip()}`"
    if wrong * MOST_OTHERS > sum(known.values()):
        return replace(first, cells=tuple(_apart(first, other, at, both) for at in range(len(pairs))))
    chosen = _base_of_two(first, other, usual, both)
    return replace(
        chosen,
        cells=tuple(
            _apart(first, other, at, both) if pair is not None and pair not in agreeing else cell
            for at, (pair, cell) in enumerate(zip(pairs, chosen.cells, strict=True))
        ),
    )


_REGION_APART = re.compile(r"(?P<region>[0134])(?:0000[01]|000[01])")


def _is_modicon(distance: int) -> bool:
    """Whether a number of Modicon's notation is so much above its wire address, or above its number in the region."""
    return _REGION_APART.fullmatch(str(distance)) is not None


def _region_of(distance: int) -> Space | None:
    """The space of a number that is so much above its wire address."""
    found = _REGION_APART.fullmatch(str(distance))
    return REGIONS[int(found["region"])] if found else None


def _apart(first: _Reading, other: _Reading, at: int, both: str) -> Unclear | None:
    one, two = first.texts[at], other.texts[at]
    if not one.strip() and not two.strip():
        return None
    return Unclear(f"{both} disagree: {quoted(one)} and {quoted(two)}, where other rows differ otherwise")


def _base_of_two(first: _Reading, other: _Reading, usual: int, both: str) -> _Reading:
    """The column to go by, counted as the difference shows."""
    lower, upper = (first, other) if usual < 0 else (other, first)
    distance = abs(usual)
    if distance == ONE_APART:
        return _counted(lower, upper, 0, f"{both} differ by 1, so the lower one is the wire address")
    if _is_modicon(distance):
        base = 0 if str(distance).endswith("1") else 1
        return _counted(lower, upper, base, f"{both} differ as Modicon's numbers do from those that count from {base}")
    if distance == 0 and first.rule.assumed and not other.rule.assumed:
        return other
    said = "agree" if distance == 0 else f"differ by {distance} in each row, and the first is read"
    return replace(first, rule=replace(first.rule, evidence=f"{first.rule.evidence}; {both} {said}"))


def _counted(lower: _Reading, upper: _Reading, base: int, evidence: str) -> _Reading:
    """The lower column as one that counts from `base`, with the spaces that the upper one says."""
    rule = replace(lower.rule, base=base, evidence=evidence, assumed=False, regions=False, unclear=None)
    cells: list[Address | Unclear | None] = []
    for number, high, old, also in zip(lower.numbers, upper.numbers, lower.cells, upper.cells, strict=True):
        if number is None:
            cells.append(old if old is not None else also)
            continue
        told = [cell for cell in (old, also) if isinstance(cell, Address)]
        apart = _region_of(high - number) if high is not None else None
        space = apart or next((cell.space for cell in reversed(told) if cell.space), None)
        bits = next((cell.bits for cell in told if cell.bits), None)
        count = next((cell.count for cell in told if cell.count), 0)
        cells.append(
            Address(number - base, space, count, bits) if number >= base else Unclear(f"{number} is below {base}")
        )
    return replace(lower, rule=rule, cells=tuple(cells))
