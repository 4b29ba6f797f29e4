"""Other planners, by their documented rules: fixed-gap readers, and the optimisations of Telegraf's Modbus input.

Written from the behaviour that Telegraf's README describes, and from no code of it. Each gets what it does not know:
the stretches that a device lets be read, whole steps of alignment, and the device's limit instead of 125; so every plan
is one that the device takes. Where a mode works on consecutive fields, the user may list all registers of the device
and mark what is not wanted as omitted, or list only what is wanted: the cheaper of both counts.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import groupby
from typing import NamedTuple

from regscribe_runtime.planning.address_ranges import RegisterSpan
from regscribe_runtime.planning.plan import Terms

Requests = tuple[RegisterSpan, ...]
GAPS = range(126)
MAX_INSERT = 50
"""Telegraf's own default of `optimization_max_register_fill`."""


class Field(NamedTuple):
    """One address range that a user lists; `omit`: it fills a gap, nobody wants it."""

    item: RegisterSpan
    omit: bool = False


class Task(NamedTuple):
    """What is to be read, and all that the device has: sorted, aligned, distinct."""

    wanted: tuple[RegisterSpan, ...]
    known: tuple[RegisterSpan, ...]
    terms: Terms

    @classmethod
    def of(cls, wanted: Iterable[RegisterSpan], known: Iterable[RegisterSpan], terms: Terms) -> "Task":
        """Widen and sort; what cannot be read is left out of `known`."""
        wide = {terms.ground.widened(item) for item in wanted}
        rest = {terms.ground.widened(item) for item in known if terms.ground.stretch(item)}
        return cls(tuple(sorted(wide)), tuple(sorted(rest | wide)), terms)

    def cost(self, requests: Requests) -> int:
        """Nanoseconds of a plan."""
        return sum(self.terms.cost.tariff(one.space).of(one.words) for one in requests)


def stretches(items: Sequence[RegisterSpan], terms: Terms) -> Iterator[list[RegisterSpan]]:
    """Items in runs that one request could cover as far as the device is concerned."""
    for _, run in groupby(items, key=lambda item: (item.space, terms.ground.stretch(item))):
        yield list(run)


def hull(items: Sequence[RegisterSpan]) -> RegisterSpan:
    """The request that covers items of one space."""
    start = min(item.address for item in items)
    return RegisterSpan(items[0].space, start, max(item.end for item in items) - start)


def chunks(items: Sequence[RegisterSpan], terms: Terms, gap: int) -> Iterator[list[RegisterSpan]]:
    """Each item joins the request before it if the gap is at most `gap` and the limit allows it."""
    for run in stretches(items, terms):
        most = terms.limits.most(run[0].space)
        chunk = [run[0]]
        end = run[0].end
        for item in run[1:]:
            if item.address - end <= gap and max(end, item.end) - chunk[0].address <= most:
                chunk.append(item)
            else:
                yield chunk
                chunk = [item]
                end = item.end
            end = max(end, item.end)
        yield chunk


def fixed_gap(task: Task, gap: int) -> Requests:
    """The usual planner of drivers: bridge gaps up to a fixed length."""
    return tuple(hull(chunk) for chunk in chunks(task.wanted, task.terms, gap))


def none(task: Task) -> Requests:
    """Telegraf `none`: consecutive fields up to the limit, omitted ones too, where something in them is wanted."""
    return _cheaper(task, lambda known: tuple(hull(one) for one in _useful(task, known)))


def shrink(task: Task) -> Requests:
    """Telegraf `shrink`: as `none`, without omitted fields at the ends of a request."""
    wanted = set(task.wanted)
    return _cheaper(
        task, lambda known: tuple(hull([item for item in one if item in wanted]) for one in _useful(task, known))
    )


def rearrange(task: Task) -> Requests:
    """Telegraf `rearrange`: within consecutive fields the fewest requests, and of such plans the fewest addresses."""
    return _cheaper(task, lambda known: tuple(_fewest(task, _consecutive(task, known))))


def aggressive(task: Task) -> Requests:
    """Telegraf `aggressive`: as `rearrange`, over any gap."""
    return tuple(_fewest(task, stretches(task.wanted, task.terms)))


def max_insert(task: Task) -> Requests:
    """Telegraf `max_insert`: holes up to its default are filled."""
    return fixed_gap(task, MAX_INSERT)


MODES: dict[str, Callable[[Task], Requests]] = {
    "none": none,
    "shrink": shrink,
    "rearrange": rearrange,
    "aggressive": aggressive,
    "max_insert": max_insert,
}


def _cheaper(task: Task, make: Callable[[tuple[RegisterSpan, ...]], Requests]) -> Requests:
    return min((make(task.wanted), make(task.known)), key=task.cost)


def _useful(task: Task, known: tuple[RegisterSpan, ...]) -> Iterator[list[RegisterSpan]]:
    wanted = set(task.wanted)
    return (chunk for chunk in chunks(known, task.terms, 0) if not wanted.isdisjoint(chunk))


def _consecutive(task: Task, known: tuple[RegisterSpan, ...]) -> Iterator[list[RegisterSpan]]:
    """The wanted items of each row of addresses without a gap, however long."""
    wanted = set(task.wanted)
    for run in stretches(known, task.terms):
        row, end = [run[0]], run[0].end
        for item in run[1:]:
            if item.address > end:
                yield [one for one in row if one in wanted]
                row = []
            row.append(item)
            end = max(end, item.end)
        yield [one for one in row if one in wanted]


def _fewest(task: Task, rows: Iterable[list[RegisterSpan]]) -> Iterator[RegisterSpan]:
    """Part each row into the fewest requests that the limit allows, with the fewest addresses."""
    for row in rows:
        if not row:
            continue
        most = task.terms.limits.most(row[0].space)
        best: list[tuple[int, int, int]] = [(0, 0, 0)]
        for last in range(len(row)):
            found = []
            for first in range(last, -1, -1):
                words = max(item.end for item in row[first : last + 1]) - row[first].address
                if words > most and first < last:
                    break
                requests, addresses, _ = best[first]
                found.append((requests + 1, addresses + words, first))
            best.append(min(found))
        place = len(row)
        while place:
            first = best[place][2]
            yield hull(row[first:place])
            place = first
