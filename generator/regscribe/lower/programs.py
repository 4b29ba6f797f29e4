"""Setpoint programs: the names of registers become paths in which the numbers of program and segment are left open."""

from regscribe.lower.conditions import condition_of, write_condition
from regscribe.lower.node import Value
from regscribe.lower.program_registers import ProgramPlace, numbers_of
from regscribe.lower.registers import inferred_of
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


def programs_of(root: Value, scope: Scope) -> tuple[tuple[SetpointProgram, ProgramNotes], ...]:
    """The setpoint programs that a model has, each with its notes."""
    found = []
    for _, node in root.items_of("programs"):
        if scope.has(node):
            description, inferred = node.text_of("description"), inferred_of(node)
            notes = ProgramNotes(description=description, inferred=inferred, span=node.key_span)
            found.append((_program(node, scope), notes))
    return tuple(found)


def _program(node: Value, scope: Scope) -> SetpointProgram:
    array = node.child("array")
    numbers = numbers_of(array, array.text(), scope) if array else []
    place = ProgramPlace(scope, tuple(numbers) or (0,), f"{array.text()}[{{i}}]." if array and numbers else "")
    count, final, limits = node.mapping_of("count"), node.child("final"), node.child("setpoint_limits")
    cycles, forever = place.path(node, "cycles"), node.child("forever")
    return SetpointProgram(
        id=node.key,
        name=node.line_of("name") or node.key,
        segments=_segments(node.mapping_of("segments"), place),
        **place.paths(node, "holdback", "power_failure", "end", "segment_now", "program_now", "setpoint_now"),
        first=place.numbers[0],
        programs=len(numbers),
        section=node.text_of("source"),
        final=ProgramFinal(setpoint=place.path(final, "setpoint"), outputs=place.outputs(final)) if final else None,
        number_of_segments=place.path(count, "register"),
        counts=count.choice_of("counts", ProgramCounts.ALL),
        cycles=cycles,
        forever=place.code(forever, cycles) if forever and cycles else None,
        time_unit=_time_unit(node.child("time_unit"), place),
        setpoint_limits=(place.path(limits, "from"), place.path(limits, "to")) if limits else None,
        order=_order(node.elements_of("write_order")),
        enable=place.values(node.child("enable")),
        requires=write_condition(node.child("requires"), scope),
        status=_status(node.child("status"), place),
        start=_action(node.child("start"), place),
        hold=_action(node.child("hold"), place),
        resume=_action(node.child("resume"), place),
        reset=_action(node.child("reset"), place),
        when=condition_of(node, scope),
        while_running=node.choice_of("while_running", WhileRunning.NOT_STATED),
    )


def _order(stated: list[Value]) -> tuple[ProgramPart, ...]:
    """The parts in the order of writing, those first that the map does not name."""
    last = tuple(part.choice(ProgramPart.SEGMENTS) for part in stated)
    return (*(part for part in ProgramPart if part not in last), *last)


def _segments(node: Value, around: ProgramPlace) -> ProgramSegments:
    array = node.child("array") or node
    name = array.text() if array.is_text else ""
    path = f"{numbered(around.prefix, around.numbers[0])}{name}"
    inner = bool(around.prefix) and any(entry.startswith(f"{path}[") for entry in around.scope.entries)
    numbers = numbers_of(array, path if inner else name, around.scope) or [0]
    prefix = around.prefix if inner else ""
    place = ProgramPlace(around.scope, around.numbers, around.prefix, f"{prefix}{name}[{{j}}].", numbers[0])
    return ProgramSegments(
        first=numbers[0],
        many=len(numbers),
        **place.paths(node, "setpoint", "ramp", "soak"),
        outputs=place.outputs(node),
        idle=tuple(place.found(one, one.text()) for one in node.elements_of("idle")),
    )


def _time_unit(node: Value | None, place: ProgramPlace) -> ProgramTimeUnit | None:
    if node is None:
        return None
    path = place.path(node, "register")
    units = node.items_of("codes")
    codes = [(place.code(Value(one.context, one.path, member), path), one.text()) for member, one in units]
    return ProgramTimeUnit(register=path, codes=tuple(codes))


def _status(node: Value | None, place: ProgramPlace) -> ProgramStates | None:
    if node is None:
        return None
    path = place.path(node, "register")
    states = ("running", "held", "ended")
    codes = {key: tuple(place.code(one, path) for one in node.elements_of(key)) for key in states}
    return ProgramStates(register=path, **codes)


def _action(node: Value | None, place: ProgramPlace) -> ProgramAction:
    if node is None or not node.is_text:
        return ProgramAction(writes=place.values(node))
    return ProgramAction(command=place.scope.command(node))
