"""Setpoint programs as declarations: one constant for all drivers of models that have the same."""

from collections.abc import Sequence
from fractions import Fraction

from regscribe.emit.python.expressions import Specs
from regscribe.emit.python.formatting import Call, call, group
from regscribe.emit.python.literals import exact, literal
from regscribe.emit.words import one_line
from regscribe.model import (
    Model,
    ProgramAction,
    ProgramCounts,
    ProgramFinal,
    ProgramPart,
    ProgramSegments,
    ProgramStatus,
    ProgramTimeUnit,
    SetpointProgram,
    WhileRunning,
)


def programs(model: Model, specs: Specs) -> Call:
    """The programs of a model as a tuple."""
    return group([_program(one, specs) for one in model.programs])


def _program(program: SetpointProgram, specs: Specs) -> Call:
    paths = {
        key: literal(path)
        for key in ("cycles", "holdback", "power_failure", "end", "segment_now", "program_now", "setpoint_now")
        if (path := getattr(program, key))
    }
    actions = {
        key: _action(action)
        for key in ("start", "hold", "resume", "reset")
        if (action := getattr(program, key)) != ProgramAction()
    }
    told = program.while_running is not WhileRunning.NOT_STATED
    return call(
        "SetpointProgram",
        literal(program.id),
        literal(one_line(program.name)),
        _segments(program.segments),
        first=str(program.first) if program.programs else None,
        programs=str(program.programs) if program.programs else None,
        section=literal(program.section) if program.section else None,
        final=_final(program.final) if program.final else None,
        number_of_segments=literal(program.count) if program.count else None,
        counts=literal(program.counts.value) if program.counts is not ProgramCounts.ALL else None,
        **paths,
        forever=str(program.forever) if program.forever is not None else None,
        time_unit=_time_unit(program.time_unit) if program.time_unit else None,
        setpoint_limits=group([*map(literal, program.setpoint_limits)]) if program.setpoint_limits else None,
        enable=_values(program.enable) if program.enable else None,
        requires=specs.value(program.requires) if program.requires else None,
        status=_status(program.status) if program.status else None,
        **actions,
        while_running=literal(program.while_running.value) if told else None,
        order=group([literal(part.value) for part in program.order]) if program.order != tuple(ProgramPart) else None,
    )


def _segments(segments: ProgramSegments) -> Call:
    return call(
        "ProgramSegments",
        str(segments.first),
        str(segments.count),
        literal(segments.setpoint),
        literal(segments.ramp),
        soak=literal(segments.soak) if segments.soak else None,
        outputs=_outputs(segments.outputs) if segments.outputs else None,
        idle=group([*map(literal, segments.idle)]) if segments.idle else None,
    )


def _final(final: ProgramFinal) -> Call:
    outputs = _outputs(final.outputs) if final.outputs else None
    return call("ProgramFinal", literal(final.setpoint), outputs=outputs)


def _outputs(outputs: Sequence[tuple[str, str]]) -> Call:
    return group([group([literal(name), literal(path)]) for name, path in outputs])


def _values(values: Sequence[tuple[str, Fraction]]) -> Call:
    return group([group([literal(path), exact(number)]) for path, number in values])


def _time_unit(unit: ProgramTimeUnit) -> Call:
    codes = group([group([str(code), literal(symbol)]) for code, symbol in unit.codes])
    return group([literal(unit.register), codes])


def _status(status: ProgramStatus) -> Call:
    running, ended, held = ([str(code) for code in codes] for codes in (status.running, status.ended, status.held))
    states = (group(running), group(ended), *((group(held),) if held else ()))
    return call("ProgramStates", literal(status.register), *states)


def _action(action: ProgramAction) -> Call:
    if action.command:
        return call("ProgramAction", command=literal(action.command))
    return call("ProgramAction", _values(action.writes))
