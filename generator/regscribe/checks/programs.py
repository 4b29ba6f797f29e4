"""Setpoint programs: their registers must be able to hold what a program is made of."""

from collections import Counter
from collections.abc import Iterator

from regscribe.checks.held_values import NUMBERS
from regscribe.checks.rule import Finding, RuleScope, model_rule
from regscribe.model import Kind, Number, ProgramCounts, Register, Related, SetpointProgram, numbered

WHOLE = frozenset({Kind.INTEGER, Kind.RAW})
CHOICES = frozenset({Kind.ENUM, Kind.BOOLEAN})
ANY = CHOICES | NUMBERS
ENUM = frozenset({Kind.ENUM})
UNITS = ("s", "min", "h", "d")

ProgramRole = tuple[str, str, frozenset[Kind]]
"""What a register is in a program, its path, and the kinds that can be it."""


def _written(program: SetpointProgram) -> Iterator[ProgramRole]:
    """The registers that hold a program."""
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


def _acting(program: SetpointProgram) -> Iterator[ProgramRole]:
    """The registers that are written to make a program run."""
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


def _register(path: str, program: SetpointProgram, scope: RuleScope) -> Register | None:
    """The register of the first program and its first segment, which stands for those of all others."""
    return scope.registers.get(numbered(path, program.numbers[0], program.segments.first)) if path else None


def _at(program: SetpointProgram, scope: RuleScope, message: str, help_text: str, *related: Related) -> Finding:
    notes = scope.model.program_notes[scope.model.programs.index(program)]
    return Finding(program.id, notes.span, f"program `{program.id}` {message}", help_text, related)


def _here(register: Register) -> Related:
    return Related(f"`{register.path}` stands here", register.span)


@model_rule(
    "RS0408", "Program in registers that cannot be written", "A program is written, and read back to be verified."
)
def not_writable(scope: RuleScope) -> Iterator[Finding]:
    """Look at the access of all registers that a program names."""
    for program in scope.model.programs:
        for role, path, _ in (*_written(program), *_acting(program)):
            register = _register(path, program, scope)
            if register and not (register.access.writable and register.access.readable):
                message = f"has `{role}` in `{register.path}`, which has access {register.access}"
                yield _at(
                    program, scope, message, "name a register with access rw, or correct its access", _here(register)
                )
        for role, path, _ in _watched(program):
            register = _register(path, program, scope)
            if register and not register.access.readable:
                message = f"has `{role}` in `{register.path}`, which can only be written"
                yield _at(program, scope, message, "name a register that can be read", _here(register))


@model_rule(
    "RS0409", "Program in registers of the wrong kind", "A setpoint is a number, and a state is one of some codes."
)
def wrong_kind(scope: RuleScope) -> Iterator[Finding]:
    """Compare the kind of each register with what it is in the program."""
    for program in scope.model.programs:
        for role, path, kinds in (*_written(program), *_acting(program), *_watched(program)):
            register = _register(path, program, scope)
            if register and register.kind not in kinds:
                message = f"has `{role}` in `{register.path}`, which is of kind {register.kind}"
                wanted = " or ".join(sorted(kinds))
                yield _at(program, scope, message, f"name a register of kind {wanted}", _here(register))


@model_rule("RS0416", "State of a program not told apart", "In every state a program runs, is held or does neither.")
def states(scope: RuleScope) -> Iterator[Finding]:
    """Compare the codes of the states with the members of the register that tells them."""
    for program in scope.model.programs:
        status = program.status
        register = _register(status.register, program, scope) if status else None
        if status is None or register is None or register.enum is None:
            continue
        told = Counter((*status.running, *status.held, *status.ended))
        labels = {member.code: member.label for member in register.enum.members}
        for code, label in labels.items():
            if told[code] != 1:
                how = "in no state" if not told[code] else "in two states"
                message = f"has {code} ({label}) of `{register.path}` {how}"
                yield _at(
                    program, scope, message, "list it under one of `running`, `held` and `ended`", _here(register)
                )


@model_rule("RS0417", "Times of a program without a unit", "Thirty seconds and thirty hours are not the same program.")
def times(scope: RuleScope) -> Iterator[Finding]:
    """Look for the unit of each time: its own, or one for every member of the register that sets it."""
    for program in scope.model.programs:
        yield from _without_code(program, scope) if program.time_unit else _without_unit(program, scope)


def _without_code(program: SetpointProgram, scope: RuleScope) -> Iterator[Finding]:
    """Members of the register that sets the unit of time, of which the program does not say what they stand for."""
    unit = program.time_unit
    register = _register(unit.register, program, scope) if unit else None
    if unit and register and register.enum:
        lacking = [one.label for one in register.enum.members if one.code not in dict(unit.codes)]
        if lacking:
            message = f"has no unit of time for {', '.join(lacking)} of `{register.path}`"
            yield _at(program, scope, message, "list every member under `time_unit.codes`", _here(register))


def _without_unit(program: SetpointProgram, scope: RuleScope) -> Iterator[Finding]:
    for path in (program.segments.ramp, program.segments.soak):
        time = _register(path, program, scope)
        if time and not all(case.then in UNITS for case in time.unit):
            message = f"has times in `{time.path}`, which has no unit of time"
            advice = f"give the register a `unit` of {', '.join(UNITS)}, or the program a `time_unit`"
            yield _at(program, scope, message, advice, _here(time))


@model_rule(
    "RS0418", "More segments than there are", "A number of segments beyond the last one was misread, or the array."
)
def too_many(scope: RuleScope) -> Iterator[Finding]:
    """Compare the range of the number of segments with the array."""
    for program in scope.model.programs:
        register = _register(program.number_of_segments, program, scope)
        if register is None:
            continue
        ends = (one.high for case in register.range for one in case.then.intervals)
        most = max((int(end) for end in ends if isinstance(end, Number)), default=0)
        room = program.segments.many - (program.counts is ProgramCounts.AFTER_FIRST)
        if most > room:
            message = f"may have {most} segments by the range of `{register.path}`, but there are {room}"
            yield _at(program, scope, message, "correct the range, or `repeat` of the array", _here(register))
