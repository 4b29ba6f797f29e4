"""Two columns of addresses of the same registers: what they differ by shows from what they count."""

import re
from collections import Counter
from dataclasses import replace

from regscribe.importers.table.cells import Unclear, quoted
from regscribe.importers.table.cells.address_values import Address, Reading
from regscribe.importers.table.cells.spaces import REGIONS
from regscribe.model import Space

ONE_APART = 1
MOST_OTHERS = 5
"""One of so many rows may disagree, and is unclear then; if more do, the columns do not belong together."""


def together(first: Reading, other: Reading) -> Reading:
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


def _apart(first: Reading, other: Reading, at: int, both: str) -> Unclear | None:
    one, two = first.texts[at], other.texts[at]
    if not one.strip() and not two.strip():
        return None
    return Unclear(f"{both} disagree: {quoted(one)} and {quoted(two)}, where other rows differ otherwise")


def _base_of_two(first: Reading, other: Reading, usual: int, both: str) -> Reading:
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


def _counted(lower: Reading, upper: Reading, base: int, evidence: str) -> Reading:
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
