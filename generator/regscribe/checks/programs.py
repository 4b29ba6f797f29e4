"""Setpoint programs: their registers must be able to hold what a program is made of."""

from collections import Counter
from collections.abc import Callable, Iterator
from functools import partial

from regscribe.checks.held_values import NUMBERS
from regscribe.checks.rule import Finding, RuleScope, rule_of_models
from regscribe.model import Kind, Number, ProgramCounts, Register, Related, SetpointProgram, numbered

WHOLE = frozenset({Kind.INTEGER, Kind.RAW})
CHOICES = frozenset({Kind.ENUM, Kind.BOOLEAN})
ANY = CHOICES | NUMBERS
ENUM = frozenset({Kind.ENUM})
UNITS = ("s", "min", "h", "d")

ProgramRole = tuple[str, str, frozenset[Kind]]
"""Name of a role in a program, path of the register that plays it, and the kinds that can."""


def _written(program: SetpointProgram) -> Iterator[ProgramRole]:
    """The registers that hold a program, then those that are written to make it run."""
    segments, final = program.segments, program.final
    yield "segments.setpoint", segments.setpoint, NUMBERS
    yield "segments.ramp", segments.ramp, NUMBERS
    yield "segments.soak", segments.soak, NUMBERS
    yield from ((f"segments.outputs.{name}", path, CHOICES) for name, path in segments.outputs)
    yield "final.setpoint", final.setpoint if final else "", NUMBERS
    yield from ((f"final.outputs.{name}", path, CHOICES) for name, path in (final.outputs if final else ()))
    yield "count", program.number_of_segments, WHOLE
    yield "cycles", program.cycles, WHOLE
    yield "time_unit", program.time_unit.register if program.time_unit else "", ENUM
    yield "holdback", program.holdback, NUMBERS
    yield "power_failure", program.power_failure, CHOICES
    yield "end", program.end, CHOICES
    yield from (("enable", path, ANY) for path, _ in program.enable)
    for name in ("start", "hold", "resume", "reset"):
        yield from ((name, path, ANY) for path, _ in getattr(program, name).writes)


def _watched(program: SetpointProgram) -> Iterator[ProgramRole]:
    """The registers that are only read."""
    yield "status", program.status.register if program.status else "", ENUM
    yield "segment_now", program.segment_now, WHOLE
    yield "program_now", program.program_now, WHOLE
    yield "setpoint_now", program.setpoint_now, NUMBERS
    yield from (("setpoint_limits", path, NUMBERS) for path in program.setpoint_limits or ())


Lookup = Callable[[str], Register | None]
ProgramProblems = Iterator[tuple[Register, str, str]]
"""Each problem of a program: the register concerned, message and help."""

ProgramCheck = Callable[[SetpointProgram, Lookup], ProgramProblems]


def program_rule(rule_id: str, title: str) -> Callable[[ProgramCheck], ProgramCheck]:
    """Declare a rule whose function looks at one program, and looks up the registers that it names."""

    def walk(check: ProgramCheck, scope: RuleScope) -> Iterator[Finding]:
        for program, notes in zip(scope.model.programs, scope.model.program_notes, strict=True):
            for register, message, help_text in check(program, partial(_register, program, scope)):
                related = Related(f"`{register.path}` stands here", register.span)
                yield Finding(program.id, notes.span, f"program `{program.id}` {message}", help_text, related)

    return rule_of_models(rule_id, title, walk)


def _register(program: SetpointProgram, scope: RuleScope, path: str) -> Register | None:
    """The register of the first program and its first segment, which stands for those of all others."""
    return scope.registers.get(numbered(path, program.numbers[0], program.segments.first)) if path else None


@program_rule("RS0408", "Program in registers that cannot be written")
def not_writable(program: SetpointProgram, look_up: Lookup) -> ProgramProblems:
    """A program is written, and read back to be verified."""
    for role, path, _ in _written(program):
        register = look_up(path)
        if register and not (register.access.writable and register.access.readable):
            message = f"has `{role}` in `{register.path}`, which has access {register.access}"
            yield register, message, "name a register with access rw, or correct its access"
    for role, path, _ in _watched(program):
        register = look_up(path)
        if register and not register.access.readable:
            message = f"has `{role}` in `{register.path}`, which can only be written"
            yield register, message, "name a register that can be read"


@program_rule("RS0409", "Program in registers of the wrong kind")
def wrong_kind(program: SetpointProgram, look_up: Lookup) -> ProgramProblems:
    """A setpoint is a number, and a state is one of some codes."""
    for role, path, kinds in (*_written(program), *_watched(program)):
        register = look_up(path)
        if register and register.kind not in kinds:
            message = f"has `{role}` in `{register.path}`, which is of kind {register.kind}"
            yield register, message, f"name a register of kind {' or '.join(sorted(kinds))}"


@program_rule("RS0416", "State of a program not told apart")
def states(program: SetpointProgram, look_up: Lookup) -> ProgramProblems:
    """In every state a program runs, is held or does neither."""
    status = program.status
    register = look_up(status.register) if status else None
    if status is None or register is None or register.enum is None:
        return
    listed = Counter((*status.running, *status.held, *status.ended))
    labels = {member.code: member.label for member in register.enum.members}
    for code, label in labels.items():
        if listed[code] != 1:
            how = "in no state" if not listed[code] else "in two states"
            message = f"has {code} ({label}) of `{register.path}` {how}"
            yield register, message, "list it under one of `running`, `held` and `ended`"


@program_rule("RS0417", "Times of a program without a unit")
def times(program: SetpointProgram, look_up: Lookup) -> ProgramProblems:
    """Thirty seconds and thirty hours are not the same program."""
    unit = program.time_unit
    if unit is None:
        for time in filter(None, map(look_up, (program.segments.ramp, program.segments.soak))):
            if not all(case.then in UNITS for case in time.unit):
                message = f"has times in `{time.path}`, which has no unit of time"
                yield time, message, f"give the register a `unit` of {', '.join(UNITS)}, or the program a `time_unit`"
        return
    register = look_up(unit.register)
    if register and register.enum:
        lacking = [one.label for one in register.enum.members if one.code not in dict(unit.codes)]
        if lacking:
            message = f"has no unit of time for {', '.join(lacking)} of `{register.path}`"
            yield register, message, "list every member under `time_unit.codes`"


@program_rule("RS0418", "More segments than there are")
def too_many(program: SetpointProgram, look_up: Lookup) -> ProgramProblems:
    """A number of segments beyond the last one was misread, or the array."""
    register = look_up(program.number_of_segments)
    if register is None:
        return
    ends = (one.high for case in register.range for one in case.then.intervals)
    most = max((int(end) for end in ends if isinstance(end, Number)), default=0)
    room = program.segments.many - (program.counts is ProgramCounts.AFTER_FIRST)
    if most > room:
        message = f"may have {most} segments by the range of `{register.path}`, but there are {room}"
        yield register, message, "correct the range, or `repeat` of the array"
