"""Setpoint programs: the names of registers become paths in which the numbers of program and segment are left open."""

from regscribe.lower.commands import CommandScope
from regscribe.lower.conditions import write_condition
from regscribe.lower.node import Value, choice_of, elements_of, items_of, line_of, text_of
from regscribe.lower.program_registers import ProgramPlace, numbers_of
from regscribe.lower.registers import inferred_of
from regscribe.lower.rules import UNKNOWN_COMMAND
from regscribe.lower.scope import Scope
from regscribe.model import (
    ProgramAction,
    ProgramCounts,
    ProgramFinal,
    ProgramNotes,
    ProgramPart,
    ProgramSegments,
    ProgramStates,
    ProgramTimeUnit,
    SetpointProgram,
    WhileRunning,
    numbered,
)


def programs_of(root: Value, device: CommandScope) -> tuple[tuple[SetpointProgram, ProgramNotes], ...]:
    """The setpoint programs that a model has, each with its notes."""
    scope = device.scope
    return tuple(
        (_program(name, node, scope), _notes(node)) for name, node in items_of(root, "programs") if scope.has(node)
    )


def _notes(node: Value) -> ProgramNotes:
    return ProgramNotes(
        description=text_of(node, "description"),
        inferred=inferred_of(node.child("inferred")),
        span=node.key_span,
    )


def _program(name: str, node: Value, scope: Scope) -> SetpointProgram:
    array = node.child("array")
    numbers = numbers_of(array, array.text(), scope) if array else []
    place = ProgramPlace(scope, tuple(numbers) or (0,), f"{array.text()}[{{i}}]." if array and numbers else "")
    made = SetpointProgram(
        id=name,
        name=line_of(node, "name") or name,
        segments=_segments(node.child("segments") or node, place),
        first=numbers[0] if numbers else 0,
        programs=len(numbers),
        section=text_of(node, "source"),
    )
    return _run(node, place, _made(node, place, made))


def _made(node: Value, place: ProgramPlace, program: SetpointProgram) -> SetpointProgram:
    """The program with what it is made of beside its segments."""
    count, cycles, forever = node.child("count"), place.path(node, "cycles"), node.child("forever")
    final, limits = node.child("final"), node.child("setpoint_limits")
    return program._replace(
        final=ProgramFinal(setpoint=place.path(final, "setpoint"), outputs=place.outputs(final)) if final else None,
        number_of_segments=place.path(count, "register"),
        counts=choice_of(count, "counts", ProgramCounts.ALL) if count else ProgramCounts.ALL,
        cycles=cycles,
        forever=place.code(forever, cycles) if forever and cycles else None,
        time_unit=_time_unit(node.child("time_unit"), place),
        holdback=place.path(node, "holdback"),
        power_failure=place.path(node, "power_failure"),
        end=place.path(node, "end"),
        setpoint_limits=(place.path(limits, "from"), place.path(limits, "to")) if limits else None,
        order=_order(node),
    )


def _run(node: Value, place: ProgramPlace, program: SetpointProgram) -> SetpointProgram:
    """The program with how it is run and watched."""
    return program._replace(
        enable=place.values(node.child("enable")),
        requires=write_condition(node.child("requires"), place.scope),
        status=_status(node.child("status"), place),
        segment_now=place.path(node, "segment_now"),
        program_now=place.path(node, "program_now"),
        setpoint_now=place.path(node, "setpoint_now"),
        start=_action(node.child("start"), place),
        hold=_action(node.child("hold"), place),
        resume=_action(node.child("resume"), place),
        reset=_action(node.child("reset"), place),
        while_running=choice_of(node, "while_running", WhileRunning.NOT_STATED),
    )


def _order(node: Value) -> tuple[ProgramPart, ...]:
    told = tuple(one.choice(ProgramPart.SEGMENTS) for one in elements_of(node, "write_order"))
    return (*(part for part in ProgramPart if part not in told), *told)


def _segments(node: Value, around: ProgramPlace) -> ProgramSegments:
    array = node.child("array") or node
    name = array.text() if array.is_text else ""
    first = [f"{numbered(prefix, around.numbers[0])}{name}" for prefix in dict.fromkeys((around.prefix, ""))]
    inner = bool(around.prefix) and any(path.startswith(f"{first[0]}[") for path in around.scope.entries)
    numbers = numbers_of(array, first[0] if inner else name, around.scope) or [0]
    prefix = around.prefix if inner else ""
    place = ProgramPlace(around.scope, around.numbers, around.prefix, f"{prefix}{name}[{{j}}].", numbers[0])
    return ProgramSegments(
        first=numbers[0],
        many=len(numbers),
        setpoint=place.path(node, "setpoint"),
        ramp=place.path(node, "ramp"),
        soak=place.path(node, "soak"),
        outputs=place.outputs(node),
        idle=tuple(place.found(one, one.text()) for one in elements_of(node, "idle")),
    )


def _time_unit(node: Value | None, place: ProgramPlace) -> ProgramTimeUnit | None:
    if node is None:
        return None
    path = place.path(node, "register")
    units = items_of(node, "codes")
    codes = [(place.code(Value(one.context, one.path, member), path), one.text()) for member, one in units]
    return ProgramTimeUnit(register=path, codes=tuple(codes))


def _status(node: Value | None, place: ProgramPlace) -> ProgramStates | None:
    if node is None:
        return None
    path = place.path(node, "register")
    states = ("running", "held", "ended")
    codes = {key: tuple(place.code(one, path) for one in elements_of(node, key)) for key in states}
    return ProgramStates(register=path, **codes)


def _action(node: Value | None, place: ProgramPlace) -> ProgramAction:
    if node is None or not node.is_text:
        return ProgramAction(writes=place.values(node))
    place.scope.named(node, "commands", rule=UNKNOWN_COMMAND, what="command")
    return ProgramAction(command=node.text())
