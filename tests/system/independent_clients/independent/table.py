"""The table at the end of `make test-wire`: who agreed, on which family and kind, how often."""

from collections import Counter
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from independent.families import COLUMNS

PROPERTY = "agreed"


class Agreed(NamedTuple):
    """`count` agreements of a client on a family: `what` is a column with ` r` or ` w` behind it, or `exceptions`."""

    client: str
    family: str
    what: str
    count: int


def table(agreements: Iterable[Agreed]) -> list[str]:
    """Lay out a row for each client and family: a cell is `reads/writes`, the last are exceptions and silences."""
    counts: Counter[tuple[str, str, str]] = Counter()
    for each in agreements:
        counts[each.client, each.family, each.what] += each.count
    rows = sorted({key[:2] for key in counts})
    kinds = [kind for kind in COLUMNS if any(what[:-2] == kind for _, _, what in counts)]
    head = ["client", "family", *kinds, "exceptions", "silences"]
    body = [[*row, *(_pair(counts, row, kind) for kind in kinds), *_faults(counts, row)] for row in rows]
    total = f"{sum(counts.values())} agreements of {len({client for client, _, _ in counts})} clients"
    return [
        "each cell: values read / values written and seen alike by client, driver and device",
        *_aligned([head, *body]),
        total,
    ]


def _pair(counts: Counter[tuple[str, str, str]], row: tuple[str, str], kind: str) -> str:
    read, wrote = counts[*row, f"{kind} r"], counts[*row, f"{kind} w"]
    return f"{read}/{wrote}" if read or wrote else "."


def _faults(counts: Counter[tuple[str, str, str]], row: tuple[str, str]) -> list[str]:
    return [str(counts[*row, what] or ".") for what in ("exceptions", "silences")]


def _aligned(lines: Sequence[Sequence[str]]) -> list[str]:
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    return ["  ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)).rstrip() for line in lines]
