"""No plan is dearer than that of a fixed-gap planner or of Telegraf's optimisations, on the real maps."""

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from regscribe_runtime.planning.address_ranges import AddressRanges, RegisterSpan
from regscribe_runtime.planning.cost import Cost
from regscribe_runtime.planning.plan import RequestLimits, Terms
from regscribe_runtime.planning.read_places import read_places
from regscribe_runtime.values.serial_line import SerialLine
from regscribe_runtime.values.wire_types import Space

BENCH = Path(__file__).parents[2] / "system" / "bench"
GAPS = (0, 1, 2, 4, 8, 11, 16, 32, 64, 125)


@pytest.fixture(scope="module")
def bench() -> Iterator[Any]:
    """The planners of the benchmark; its modules import each other by their plain names."""
    sys.path.insert(0, str(BENCH))
    try:
        import planning  # type: ignore[import-not-found] # noqa: PLC0415 (only importable from here on)

        yield planning
    finally:
        sys.path.remove(str(BENCH))


@pytest.fixture(scope="module")
def subjects(bench: Any) -> dict[str, Any]:
    """Models of three very different families by name."""
    maps = ("athena/platinum-m5000", "athena/series-c", "fdc/series-100")
    return {subject.model.name: subject for _, subject in bench.subjects(*maps)}


def test_no_plan_for_a_real_model_is_dearer_than_those_of_others(bench: Any, subjects: dict[str, Any]) -> None:
    seen = 0
    for name in ("M5000", "C21", "16C"):
        subject = subjects[name]
        for line, cost in bench.lines(subject).items():
            for duel in bench.duels(subject, cost, GAPS):
                assert duel.worst >= 1, (name, line, duel)
                seen += 1
    assert seen == 3 * 3 * 7


def test_every_rival_reads_all_that_is_wanted_and_keeps_to_the_device(bench: Any, subjects: dict[str, Any]) -> None:
    subject = subjects["M5000"]
    terms = subject.terms(Cost.serial(subject.protocol))
    known = [read_places(subject.registers[path])[0].span for path in subject.readable]
    task = bench.Task.of(known[::3], known, terms)

    plans = {name: mode(task) for name, mode in bench.MODES.items()} | {"gap": bench.fixed_gap(task, 3)}

    for name, requests in plans.items():
        for item in task.wanted:
            held = [one for one in requests if one.space == item.space and one.address <= item.address]
            assert any(item.end <= one.end for one in held), (name, item)
        for one in requests:
            assert terms.ground.stretch(one), (name, one)
            assert one.words <= terms.limits.most(one.space), (name, one)


def test_the_rules_of_the_rivals_are_those_of_their_documentation(bench: Any) -> None:
    everywhere = AddressRanges({Space.HOLDING: [(0, 200)]}, holes=True)
    terms = Terms(RequestLimits(), everywhere, Cost(SerialLine()))

    def at(*addresses: int) -> list[RegisterSpan]:
        return [RegisterSpan(Space.HOLDING, address, 1) for address in addresses]

    row = bench.Task.of(at(2, 5, 9), at(*range(1, 8), 9), terms)
    wide = bench.Task.of(at(2, 60, 190), at(2, 60, 190), terms)

    def spans(name: str, task: Any) -> list[tuple[int, int]]:
        return sorted((one.address, one.words) for one in bench.MODES[name](task))

    assert spans("shrink", row) == [(2, 4), (9, 1)]
    assert spans("aggressive", row) == [(2, 8)]
    assert spans("max_insert", wide) == [(2, 1), (60, 1), (190, 1)]
    assert spans("aggressive", wide) == [(2, 59), (190, 1)]
