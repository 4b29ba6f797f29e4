"""Plans of every model against other planners: expected milliseconds on serial lines and over TCP.

Usage: python tests/system/bench/planning.py        prints the whole table; exit 1 if a plan of ours is dearer
"""

import random
import sys
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

from measure import Row, at_least
from rich.console import Console
from rich.table import Table
from rivals import GAPS, MODES, Task, fixed_gap

from regscribe.cli.shared.map_arguments import find_maps
from regscribe.pipeline import compile_map
from regscribe.planned_model import PlannedModel
from regscribe_runtime.planning.cost import Cost, milliseconds
from regscribe_runtime.planning.plan import blocks
from regscribe_runtime.planning.read_places import read_places

MAPS = Path(__file__).parents[3] / "maps"
SEED = 20240611
SHARES = (0.03, 0.1, 0.3, 0.6)
"""Parts of a model's registers that the random subsets have."""
BAUDS = (9600, 19200)


class Duel(NamedTuple):
    """One set of registers on one line: the cost of each plan in nanoseconds."""

    what: str
    ours: int
    gaps: tuple[int, ...]
    modes: dict[str, int]

    @property
    def greedy(self) -> int:
        """The cheapest of the fixed gaps, whichever it is for this set and line."""
        return min(self.gaps)

    @property
    def worst(self) -> float:
        """The cheapest rival by ours: below 1 a rival would be cheaper."""
        return min(self.greedy, *self.modes.values()) / self.ours


def subjects(*maps: str) -> Iterator[tuple[str, PlannedModel]]:
    """Every model of the maps of these ids, or of all."""
    for path in find_maps([str(MAPS / f"{one}.yaml") for one in maps] or [str(MAPS)]):
        found = compile_map(path).map
        assert found is not None
        for model in found.models:
            yield f"{found.maker.split()[0]} {model.name}", PlannedModel.of(found, model.name, {})


def lines(subject: PlannedModel) -> dict[str, Cost]:
    """The lines of the comparison."""
    serial = {f"{baud} baud": Cost.serial(subject.protocol, baud=baud) for baud in BAUDS}
    return serial | {"TCP": Cost.tcp(subject.protocol)}


def sets(subject: PlannedModel) -> Iterator[tuple[str, list[str]]]:
    """All registers, the group that only shows the state, the largest other one, and random subsets."""
    readable = subject.readable
    yield "all", readable
    groups = {group.id: [path for path in readable if path in set(group.members)] for group in subject.model.groups}
    groups = {name: paths for name, paths in groups.items() if paths}
    status = max(groups, key=lambda name: _shown(subject, groups[name]))
    yield "status", groups.pop(status)
    if groups:
        yield "one group", max(groups.values(), key=len)
    chance = random.Random(f"{SEED} {subject.model.name}")  # noqa: S311 (no secret: a sample)
    for share in SHARES:
        yield f"random {share:.0%}", sorted(chance.sample(readable, max(2, round(share * len(readable)))))


def _shown(subject: PlannedModel, paths: Sequence[str]) -> float:
    shown = [path for path in paths if subject.registers[path].access == "r"]
    return len(shown) / len(paths) + len(shown) / 1000


def duels(subject: PlannedModel, cost: Cost, gaps: Sequence[int] = GAPS) -> Iterator[Duel]:
    """Our plan and those of the others for each set of registers; all read the same registers at the same places."""
    terms = subject.terms(cost)
    known = [read_places(subject.registers[path])[0].span for path in subject.readable]
    for what, paths in sets(subject):
        wanted = [read_places(subject.registers[path])[0].span for path in paths]
        made = blocks(wanted, terms)
        task = Task.of(wanted, known, terms)
        ours = sum(terms.cost.tariff(block.space).of(block.quantity) for block in made)
        fixed = tuple(task.cost(fixed_gap(task, gap)) for gap in gaps)
        yield Duel(what, ours, fixed, {name: task.cost(mode(task)) for name, mode in MODES.items()})


class Result(NamedTuple):
    """A model on a line."""

    name: str
    line: str
    duels: tuple[Duel, ...]


def results() -> list[Result]:
    """Every model on every line."""
    return [
        Result(name, line, tuple(duels(subject, cost)))
        for name, subject in subjects()
        for line, cost in lines(subject).items()
    ]


def table(found: Sequence[Result]) -> Table:
    """A row a model and line: our time for all registers, and how many times ours the others' are (least to most)."""
    made = Table(
        *("model", "line", "all, ms", "best fixed gap", *MODES),
        title="plans: expected time of the others in times of ours, least to most over all, status, one group and "
        "random subsets; none to max_insert are Telegraf's",
        box=None,
    )
    for one in found:
        rows = [_span([duel.greedy / duel.ours for duel in one.duels])]
        rows += [_span([duel.modes[name] / duel.ours for duel in one.duels]) for name in MODES]
        made.add_row(one.name, one.line, f"{milliseconds(one.duels[0].ours):.0f}", *rows)
    return made


def _span(ratios: Sequence[float]) -> str:
    low, high = f"{min(ratios):.2f}", f"{max(ratios):.2f}"
    return low if low == high else f"{low} .. {high}"


def rows() -> Iterator[Row]:
    """The table, and as lines of the whole bench the worst cases: no rival may be cheaper."""
    found = results()
    Console(width=160).print(table(found))
    every = [duel for one in found for duel in one.duels]
    yield _row("the best of 126 fixed gaps, chosen anew for each set and line", every, lambda duel: duel.greedy)
    single = min(GAPS, key=lambda gap: max(duel.gaps[gap] / duel.ours for duel in every))
    yield _row(f"the best single gap for all, {single}", every, lambda duel: duel.gaps[single])
    for name in MODES:
        yield _row(f"Telegraf {name}", every, lambda duel, name=name: duel.modes[name])  # type: ignore[misc]


def _row(who: str, every: Sequence[Duel], cost: Callable[[Duel], int]) -> Row:
    ratios = [cost(duel) / duel.ours for duel in every]
    mean = sum(ratios) / len(ratios)
    return at_least(f"plans of {len(every)} sets ({who})", "1", f"{mean:.2f}, up to {max(ratios):.2f}", min(ratios), 1)


def main() -> int:
    """Print everything; 1 if a plan of ours is dearer than any other."""
    found = list(rows())
    for row in found:
        sys.stdout.write(f"{row.what}: on the mean {row.theirs} times ours; at least {row.ratio:.3f}\n")
    return 0 if all(row.kept for row in found) else 1


if __name__ == "__main__":
    sys.exit(main())
