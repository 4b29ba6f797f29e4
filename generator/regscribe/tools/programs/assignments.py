"""Assigns the settings of a program to registers, and finds those that a device has no register for; without I/O."""

from collections.abc import Mapping
from decimal import Decimal
from typing import Any, NamedTuple

from regscribe.tools.live.errors import unknown
from regscribe.tools.live.value_text import choices, text_of
from regscribe.tools.programs.program import FOREVER, Amount, Program, Segment, Setting
from regscribe.tools.programs.slot import ProgramSlot
from regscribe_runtime import Register
from regscribe_runtime.values.programs import ProgramCounts

Where = tuple[str | int, ...]
"""A place in a program: `("segments", 2, "to")` is that of the third segment."""


class Problem(NamedTuple):
    """A mistake in a program: where (as in a file), and what; `label` names the place as the device does."""

    where: Where
    label: str
    message: str

    def __str__(self) -> str:
        return f"{self.label}: {self.message}" if self.label else self.message


class ProgramAssignment(NamedTuple):
    """A register and its setting, before it is converted with what the device holds."""

    part: str
    register: Register[Any]
    setting: Setting
    where: Where
    time: bool = False


class Assignments:
    """The registers of a program with their settings, and problems with its structure; no device is asked."""

    def __init__(self, place: ProgramSlot, program: Program) -> None:
        self.place, self.program = place, program
        self.assignments: list[ProgramAssignment] = []
        self.problems: list[Problem] = []
        self._time_unit()
        self._optional("power_failure", self.program.power_failure, self.place.spec.power_failure)
        self._optional("end", self.program.end, self.place.spec.end)
        self._optional("holdback", self.program.holdback, self.place.spec.holdback)
        self._cycles()
        self._segments()
        self._final()
        self._count()
        for path, code in self.place.spec.enable:
            self._assign(path, _amount(code), ("enable", path))

    def report(self, where: Where, message: str) -> None:
        """Add a problem, labelled with the device's own number of the segment."""
        label = ".".join(map(str, where))
        if len(where) > 1 and where[0] == "segments":
            rest = ".".join(map(str, where[2:]))
            number = self.place.spec.segments.first + int(where[1])
            label = f"segment {number}{f', {rest}' if rest else ''}"
        self.problems.append(Problem(where, label, message))

    def _register(self, path: str, where: Where) -> Register[Any]:
        segment = self.place.spec.segments.first + int(where[1]) if where[0] == "segments" else 0
        return self.place.register(path, segment)

    def _assign(self, path: str, setting: Setting, where: Where, *, time: bool = False) -> None:
        part = "count" if where[0] == "number_of_segments" else str(where[0])
        self.assignments.append(ProgramAssignment(part, self._register(path, where), setting, where, time))  # pyright: ignore[reportArgumentType] # a register is a descriptor, but no attribute of this tuple

    def _lacks(self, key: str) -> None:
        self.report((key,), f"the {self.place.model} has no such setting: remove `{key}`")

    def _optional(self, key: str, setting: Setting | None, path: str) -> None:
        if setting is None:
            return
        if path:
            self._assign(path, setting, (key,))
        else:
            self._lacks(key)

    def _time_unit(self) -> None:
        unit, spec = self.program.time_unit, self.place.spec.time_unit
        if spec is None:
            return  # its times have a unit of their own, so the key says nothing about the device
        codes = {symbol: code for code, symbol in spec.codes}
        if unit is None:
            self.report(("time_unit",), f"it is missing: say in what the times count, one of {', '.join(codes)}")
        elif unit not in codes:
            self.report(("time_unit",), unknown("unit of time", unit, codes, where=f"in the {self.place.model}"))
        else:
            self._assign(spec.register, _amount(codes[unit]), ("time_unit",))

    def _cycles(self) -> None:
        cycles, spec = self.program.cycles, self.place.spec
        if cycles is None:
            return
        if not spec.cycles:
            self._lacks("cycles")
        elif cycles == FOREVER and spec.forever is None:
            self.report(("cycles",), f"the {self.place.model} has no program without end: give a number")
        elif cycles == FOREVER:
            self._assign(spec.cycles, _amount(spec.forever or 0), ("cycles",))
        elif cycles == spec.forever:
            self.report(("cycles",), f"{cycles} stands for a program without end: write `{FOREVER}` if that is meant")
        else:
            self._assign(spec.cycles, _amount(cycles), ("cycles",))

    def _segments(self) -> None:
        segments, given = self.place.spec.segments, self.program.segments
        if not given:
            self.report(("segments",), "there are none: a program has at least one")
        if len(given) > segments.many:
            message = f"{len(given)} segments, but the {self.place.model} has {segments.many}: leave some out"
            self.report(("segments",), f"{message} ({segments.first} to {segments.first + segments.many - 1})")
        for index, segment in enumerate(given[: segments.many]):
            self._segment(("segments", index), segment)
        if segments.idle:
            for index in range(len(given), segments.many):
                self._idle(("segments", index))

    def _segment(self, where: Where, segment: Segment) -> None:
        spec = self.place.spec.segments
        self._assign(spec.setpoint, segment.to, (*where, "to"))
        self._assign(spec.ramp, segment.ramp, (*where, "ramp"), time=True)
        if spec.soak:
            soak = _amount(0, "s") if segment.soak is None else segment.soak
            self._assign(spec.soak, soak, (*where, "soak"), time=True)
        elif segment.soak is not None:
            advice = "a further segment to the same setpoint keeps it"
            self.report(
                (*where, "soak"), f"the segments of the {self.place.model} have no time of their own to stay: {advice}"
            )
        self._outputs(dict(spec.outputs), segment.outputs, (*where, "outputs"))

    def _idle(self, where: Where) -> None:
        """Make a segment that is behind the last one do nothing."""
        spec = self.place.spec.segments
        for path in spec.idle:
            self._assign(path, _amount(0, "s"), where, time=True)
        for name, path in spec.outputs:
            state = _default(self._register(path, where))
            if state:
                self._assign(path, state, (*where, "outputs", name))

    def _outputs(self, paths: Mapping[str, str], given: Mapping[str, str], where: Where) -> None:
        for name in given:
            if name not in paths:
                message = unknown("output", name, paths, where=f"in the {self.place.model}")
                self.report((*where, name), message)
        for name, path in paths.items():
            register = self._register(path, where)
            state = given.get(name) or _default(register)
            if state:
                self._assign(path, state, (*where, name))
            else:
                states = ", ".join(choices(register))
                self.report(where, f"`{name}` is missing, and the manual has no default: give one of {states}")

    def _final(self) -> None:
        spec, final = self.place.spec.final, self.program.final
        if spec is None:
            if final is not None:
                self._lacks("final")
        elif final is None:
            self.report(("final",), "it is missing: say what setpoint and outputs stay behind the last segment")
        else:
            self._assign(spec.setpoint, final.to, ("final", "to"))
            self._outputs(dict(spec.outputs), final.outputs, ("final", "outputs"))

    def _count(self) -> None:
        spec, given, have = self.place.spec, self.program.number_of_segments, len(self.program.segments)
        if not spec.number_of_segments:
            if given is not None:
                self._lacks("number_of_segments")
            return
        counted = have if spec.counts is ProgramCounts.ALL else have - 1
        if spec.counts is ProgramCounts.NOT_STATED and given != counted:
            self.report(("number_of_segments",), self._open_count(given, have))
        elif given is not None and given != counted:
            self.report(
                ("number_of_segments",), f"{given}, but {have} segments are {counted} as the device counts them"
            )
        elif counted > 0 and have <= spec.segments.many:
            self._assign(spec.number_of_segments, _amount(counted), ("number_of_segments",))

    def _open_count(self, given: int | None, have: int) -> str:
        first = self.place.spec.segments.first
        why = "the manual does not say whether this number counts the first segment, so all that may run must be given"
        if given is None:
            return f"it is missing; {why}: write {have - 1} for the {have} segments {first} to {first + have - 1}"
        advice = f"give {given + 1} segments ({first} to {first + given}), or write {have - 1}"
        return f"{given} for {have} segments; {why}: {advice}"


def _amount(number: object, unit: str = "") -> Amount:
    return Amount(Decimal(str(number)), unit)


def _default(register: Register[Any]) -> str:
    """The default of an output as a name; empty if the manual gives none."""
    return "" if register.default is None else text_of(register.default)
