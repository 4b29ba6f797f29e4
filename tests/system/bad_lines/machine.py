"""A program that does anything with drivers on a bad line, as hypothesis thinks it up."""

import threading
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, rule

from regscribe.simulate.line.line_faults import USUAL, LineFault

from .judge import READABLE, TALLY, Truth
from .world import SIDES, TIMEOUT, UNITS, Far, Op, Outcome, SyncSide, furnace

LAMPS: Any = furnace()[1].Lamps
VALUES: dict[str, st.SearchStrategy[Any]] = {
    "setpoint": st.integers(-2000, 2000),
    "second_setpoint": st.integers(-2000, 2000),
    "rate": st.integers(0, 999),
    "places": st.integers(0, 3),
    "heat": st.integers(0, 99).map(lambda number: number / 10),
    "lamps": st.sampled_from([0, 1, 2, 3, 128, 131]).map(LAMPS),
    "horn": st.integers(0, 500),
    "band": st.integers(0, 1000),
    "cycle": st.integers(1, 1200),
    "filter": st.integers(0, 500),
    "slope": st.integers(0, 500),
    "batches": st.integers(0, 2_000_000),
    "gain": st.integers(-4000, 4000).map(lambda number: number / 4),
    "span_low": st.integers(-999, 999),
    "span_high": st.integers(-999, 999),
    "trim_low": st.integers(-99, 99),
    "fan": st.booleans(),
    "pump": st.booleans(),
    "door_lock": st.booleans(),
}
TO_ALL = ("setpoint", "rate", "places", "fan")
CHANGED = tuple(path for path in VALUES if path != "horn")
units = st.sampled_from(UNITS)
moments = st.sampled_from([0, 0, 0, 1, 2, 3, 4, 6, 9])
READS = st.builds(lambda unit, path: Op("read", unit, ((path, None),)), units, st.sampled_from(READABLE))


def valued(paths: Sequence[str]) -> st.SearchStrategy[tuple[str, Any]]:
    return st.sampled_from(paths).flatmap(lambda path: st.tuples(st.just(path), VALUES[path]))


WRITES = st.builds(lambda unit, one: Op("write", unit, (one,)), units, valued(tuple(VALUES)))
MANY = st.lists(st.sampled_from(READABLE), min_size=2, max_size=12, unique=True)
SEVERAL = st.lists(valued(CHANGED), min_size=1, max_size=6, unique_by=lambda one: one[0])


def descriptors() -> int:
    return len(list(Path("/proc/self/fd").iterdir()))


class UnderFire(RuleBasedStateMachine):
    """Drivers of two units on one line; subclasses say which line, which kind of driver, which faults."""

    transport, kind = "tcp", "sync"
    rate = 0.12
    kinds: tuple[LineFault, ...] = USUAL
    judging = True

    def __init__(self) -> None:
        super().__init__()
        self.before = (descriptors(), threading.active_count())
        self.far: Far | None = None

    @initialize(seed=st.integers(0, 1 << 32))
    def begin(self, seed: int) -> None:
        self.far = Far(self.transport, seed=seed, rate=self.rate, kinds=self.kinds)
        self.side: SyncSide = SIDES[self.kind](self.far, self.transport)
        self.truth = Truth(self.far, judging=self.judging, timed=self.transport != "tcp")
        TALLY.machines[f"{self.kind} over {self.transport}"] += 1

    def do(self, *ops: Op) -> list[Outcome]:
        TALLY.operations.update(op.verb for op in ops)
        self.truth.expect(ops)
        found = self.side.together(ops) if len(ops) > 1 else [self.side.perform(ops[0])]
        self.truth.judge(found)
        return found

    @rule(op=READS, cancel=moments)
    def read(self, op: Op, cancel: int) -> None:
        self.do(op._replace(cancel=cancel))

    @rule(unit=units, paths=MANY, cancel=moments)
    def read_many(self, unit: int, paths: list[str], cancel: int) -> None:
        self.do(Op("read_many", unit, tuple((path, None) for path in paths), cancel))

    @rule(op=WRITES, cancel=moments)
    def write(self, op: Op, cancel: int) -> None:
        self.do(op._replace(cancel=cancel))

    @rule(unit=units, one=valued(CHANGED), cancel=moments)
    def change(self, unit: int, one: tuple[str, Any], cancel: int) -> None:
        self.do(Op("change", unit, (one,), cancel))

    @rule(unit=units, values=SEVERAL, cancel=moments)
    def configure(self, unit: int, values: list[tuple[str, Any]], cancel: int) -> None:
        self.do(Op("configure", unit, tuple(values), cancel))

    @rule(unit=units, cancel=moments)
    def command(self, unit: int, cancel: int) -> None:
        self.do(Op("command", unit, (("advance", None),), cancel))

    @rule(unit=units, word=st.integers(0, 0xFFFF))
    def loopback(self, unit: int, word: int) -> None:
        self.do(Op("loopback", unit, (("", word),)))

    @rule(one=valued(TO_ALL), cancel=moments)
    def broadcast(self, one: tuple[str, Any], cancel: int) -> None:
        self.do(Op("broadcast", 0, (one,), cancel))

    @rule(first=READS, second=WRITES, third=READS, cancel=moments)
    def at_once(self, first: Op, second: Op, third: Op, cancel: int) -> None:
        self.do(first, second._replace(cancel=cancel), third)

    @rule(op=READS)
    def reopen(self, op: Op) -> None:
        self.do(Op("close"))
        self.do(op)
        self.do(Op("open"))

    @rule()
    def recover(self) -> None:
        """Without faults, the first read of each unit is good."""
        assert self.far is not None
        rate = self.far.faults.rate
        self._all_good()
        self.far.faults.rate = rate

    def _all_good(self) -> None:
        assert self.far is not None
        self.far.faults.calm()
        for unit in UNITS:
            (found,) = self.do(Op("read", unit, (("band", None),)))
            assert found.error is None or self.far.lag > TIMEOUT / 2, (
                f"the line is good again, but unit {unit}: {found.error!r}"
            )

    def teardown(self) -> None:
        if self.far is None:
            return
        try:
            self._all_good()
        finally:
            TALLY.faults.update(self.far.faults.injected)
            TALLY.exchanges += self.far.faults.exchanges
            self.side.close()
            self.far.close()
        after = (descriptors(), threading.active_count())
        assert after == self.before, f"descriptors and threads were {self.before}, are {after}"


def machine(kind: str, transport: str, **more: Any) -> type[UnderFire]:
    """The program for one kind of driver on one kind of line."""
    return type(f"{kind}_{transport}", (UnderFire,), {"kind": kind, "transport": transport, **more})
