"""The model of the truth: what each register may hold, who may have sent what, and whether a driver's word holds."""

import contextlib
import itertools
from collections import Counter, defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

from regscribe.simulate.line.line_faults import LineFault
from regscribe_runtime import (
    ExceptionAnswer,
    NotApplied,
    NotConfigured,
    NotWritten,
    RegscribeError,
    ValueRefused,
    WriteFailed,
    WriteUnknown,
)
from regscribe_runtime.report import Fate

from .world import STALL, UNITS, Far, Op, Outcome, Written, furnace

Words = tuple[int, ...]
Place = tuple[int, str]
PATHS = tuple(furnace()[1].FurnaceOne.registers)
READABLE = tuple(path for path in PATHS if path != "horn")
COMMANDS = {"commit": (91, 170), "unlock_trim": (90, 85), "advance": (92, 1)}
HELPERS = {"span_low": "commit", "span_high": "commit", "trim_low": "unlock_trim"}
VALUED = frozenset({"write", "change", "configure", "broadcast"})
HARMLESS = (ValueRefused, ExceptionAnswer, NotWritten)
"""Errors of a write that say that the device holds what it held."""


@dataclass
class Tally:
    """What a run was like."""

    operations: Counter[str] = field(default_factory=Counter)
    faults: Counter[LineFault] = field(default_factory=Counter)
    errors: Counter[str] = field(default_factory=Counter)
    wrong: list[str] = field(default_factory=list)
    exchanges: int = 0
    stalls: int = 0
    machines: Counter[str] = field(default_factory=Counter)

    def lines(self) -> list[str]:
        """The report."""
        operations, faults, errors = (sum(one.values()) for one in (self.operations, self.faults, self.errors))
        found = [
            f"{operations} operations, {self.exchanges} requests, {faults} faults injected, {errors} errors raised"
        ]
        for name in ("machines", "operations", "faults", "errors"):
            counts: Counter[str] = getattr(self, name)
            found += [f"{name}:", *(f"  {count:7}  {kind}" for kind, count in counts.most_common())]
        found.append(f"not judged, because this machine stood still too long: {self.stalls}")
        return [*found, f"wrong values: {len(self.wrong)}", *self.wrong]


TALLY = Tally()


class Truth:
    """What the registers of all units may hold, and how often each word may have been written."""

    def __init__(self, far: Far, *, judging: bool, timed: bool) -> None:
        self.far, self.judging, self.timed = far, judging, timed
        self.registers: Any = furnace()[1].FurnaceOne.registers
        self.held: dict[Place, set[Words]] = {}
        self.allowed: Counter[Written] = Counter()
        self.maybe: dict[Place, set[Words]] = defaultdict(set)
        self.look()

    def look(self) -> None:
        """Take what the units hold now for the truth."""
        for unit, path in itertools.product(UNITS, READABLE):
            self.held[unit, path] = {self.far.words(unit, path)}

    # --- before

    def expect(self, ops: Iterable[Op]) -> None:
        """Take note of what operations may do."""
        self.maybe.clear()
        self.far.lag = 0.0
        for op in ops:
            if op.verb == "command":
                self._expect_command(op.unit, op.paths[0])
            places_first = sorted(op.values, key=lambda one: one[0] != "places")
            for path, value in places_first if op.verb in VALUED else ():
                self._expect_value(op, path, value)

    def _expect_value(self, op: Op, path: str, value: Any) -> None:
        for unit in (op.unit,) if op.unit else UNITS:
            wanted = self._encoded(unit, path, value)
            self.maybe[unit, path] |= wanted
            before = self.held.get((unit, path), set()) if op.verb == "configure" else set()
            for words in wanted:
                self._allow(op.unit, path, words, 1)
            for words in before:
                self._allow(op.unit, path, words, 2)
        if path in HELPERS:
            self._expect_command(op.unit, HELPERS[path])
            self._expect_command(op.unit, HELPERS[path])  # once more, to undo

    def _expect_command(self, unit: int, name: str) -> None:
        self.allowed[unit, "holding", *COMMANDS[name]] += 1

    def _allow(self, unit: int, path: str, words: Words, times: int) -> None:
        register = self.registers[path]
        view = register.view()
        for at, word in enumerate(words):
            self.allowed[unit, view.space, view.address(register.at) + at, word] += times

    def _encoded(self, unit: int, path: str, value: Any) -> set[Words]:
        found = set()
        for places in self._places(unit):
            with contextlib.suppress(ValueRefused):
                found.add(self.registers[path].encode(value, state={"places": places}))
        return found

    def _places(self, unit: int) -> set[int]:
        words = self.held[unit, "places"] | self.maybe.get((unit, "places"), set())
        return {one[0] for one in words}

    def _decoded(self, unit: int, path: str) -> list[Any]:
        words = self.held[unit, path] | self.maybe.get((unit, path), set())
        states = ({"places": places} for places in self._places(unit))
        return [self.registers[path].decode(one, state=state) for one, state in itertools.product(words, states)]

    # --- after

    def judge(self, outcomes: Sequence[Outcome]) -> None:
        """Hold what the driver says against the truth; AssertionError where it is wrong."""
        for outcome in outcomes:
            self._documented(outcome)
        if self.timed and self.far.lag > STALL:
            TALLY.stalls += 1
            self._union()
            return
        if self.judging:
            for outcome in outcomes:
                self._values(outcome)
            for outcome in outcomes:
                self._effects(outcome)
            self._settle(outcomes)
        else:  # a falsified value may be taken for what was there before, and given back when undoing
            self._union()
        counted = self.far.executed if self.judging else self.allowed.keys() & self.far.executed.keys()
        twice = {key: count for key in counted if (count := self.far.executed[key]) > self.allowed[key]}
        assert not twice, f"written more often than asked for: {twice}"

    def _documented(self, outcome: Outcome) -> None:
        error = outcome.error
        if error is None:
            return
        TALLY.errors[type(error).__name__] += 1
        if outcome.cancelled and outcome.op.cancel:
            return
        assert isinstance(error, RegscribeError), f"{outcome.op} ended in {error!r}"

    def _union(self) -> None:
        for place, words in self.maybe.items():
            self.held.setdefault(place, set()).update(words)

    def _right(self, outcome: Outcome, unit: int, path: str, value: Any) -> None:
        able = self._decoded(unit, path)
        if value not in able:
            wrong = f"{path} of unit {unit} is {able}, {outcome.op.verb} says {value!r}"
            TALLY.wrong.append(wrong)
            raise AssertionError(wrong)

    def _values(self, outcome: Outcome) -> None:
        op = outcome.op
        if outcome.error is not None:
            return
        if op.verb == "read":
            self._right(outcome, op.unit, op.paths[0], outcome.value)
        if op.verb == "read_many":
            assert set(outcome.value) == set(op.paths)
            for path, value in outcome.value.entries.items():
                if not isinstance(value, RegscribeError):
                    self._right(outcome, op.unit, path, value)
        if op.verb == "loopback":
            assert outcome.value == op.values[0][1]
        if op.verb == "change":
            assert outcome.value == op.values[0][1]

    def _effects(self, outcome: Outcome) -> None:
        """What registers hold now, by the word of the driver."""
        op, error = outcome.op, outcome.error
        if op.verb in {"write", "change"} and op.paths[0] != "horn":
            self._written((op.unit, op.paths[0]), error)
        if op.verb == "configure":
            self._configured(outcome)
        if op.verb == "broadcast" and op.paths[0] != "horn":
            for unit in UNITS:
                self.held[unit, op.paths[0]] |= self.maybe[unit, op.paths[0]]

    def _written(self, place: Place, error: BaseException | None) -> None:
        if error is None or isinstance(error, NotApplied):
            assert self.maybe[place], f"{place} was written with a value that it cannot hold"
            self.held[place] = set(self.maybe[place])
        elif isinstance(error, HARMLESS) or (isinstance(error, RegscribeError) and not isinstance(error, WriteFailed)):
            return  # an error on the line before the write was sent
        else:
            assert isinstance(error, WriteUnknown) or not isinstance(error, RegscribeError), repr(error)
            self.held[place] |= self.maybe[place]

    def _configured(self, outcome: Outcome) -> None:
        error, unit = outcome.error, outcome.op.unit
        if outcome.cancelled:
            for path in outcome.op.paths:
                self.held[unit, path] |= self.maybe[unit, path]
            return
        if error is not None and not isinstance(error, NotConfigured):
            assert not isinstance(error, WriteFailed), repr(error)
            return
        report = outcome.value if error is None else error.report
        for change in report.changes:
            place = (unit, change.register)
            assert change.fate in {Fate.EQUAL, Fate.WRITTEN} or error is not None, report.told
            assert change.fate not in {Fate.DIFFERS, Fate.PLANNED}, report.told
            if change.fate in {Fate.WRITTEN, Fate.EQUAL}:
                assert change.sent in self.maybe[place] | self.held[place]
                self.held[place] = {change.sent}
            elif change.fate is Fate.UNKNOWN:
                self.held[place] |= {change.sent}

    def _settle(self, outcomes: Sequence[Outcome]) -> None:
        """Where an answer came, all that was sent before has arrived: what a unit holds is one of the possible."""
        for unit in UNITS:
            mine = [one for one in outcomes if one.op.unit in {unit, 0}]
            heard = [one for one in mine if one.error is None and one.op.unit and one.op.verb not in {"open", "close"}]
            if not heard or any(one.cancelled or not one.op.unit for one in mine):
                continue
            for path in READABLE:
                there = self.far.words(unit, path)
                claimed = self.held[unit, path]
                assert there in claimed, f"{path} of unit {unit} holds {there}; by the driver's word {claimed}"
                self.held[unit, path] = {there}
