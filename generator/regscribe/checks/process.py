"""What devices do by themselves: followers, shadows, effects of commands, and roles in the process."""

from collections.abc import Iterator, Sequence

from regscribe.checks.held_values import impossible, impossible_part, shown
from regscribe.checks.rule import Finding, Problem, RuleScope, model_rule, register_rule
from regscribe.model import BitField, Effect, Kind, Process, Register, Related, WireType, registers_of
from regscribe_runtime.values.kinds import OCTETS

RAM = "ram"
NO_NUMBERS = OCTETS | {Kind.FLAGS, Kind.FIELDS, Kind.VERSION}
HELP_BIT = "name a bit: `register.flag`, or a register of type bit"
HELP_NUMBER = "name a register that holds a number"
ProcessRole = tuple[str, str, bool]
"""Name of a role in the process, path of the register or bit that plays it, and whether it must be a bit."""


def _sources(register: Register) -> set[str]:
    """The registers that decide what a register, or one of its bits, is."""
    shadowed = {register.shadows} if register.shadows else set()
    conditions = [field.follows for field in register.fields if field.follows is not None]
    of_bits = {path for condition in conditions for path in condition.registers}
    return {case.then for case in register.follows}.union(registers_of(register.follows), of_bits, shadowed)


@model_rule("RS0431", "Registers follow or shadow each other")
def follows_itself(scope: RuleScope) -> Iterator[Finding]:
    """Each would wait for the other to tell what it is."""
    edges = {register.path: _sources(register) for register in scope.model.registers}
    for register in scope.model.registers:
        seen: set[str] = set()
        ahead = set(edges[register.path])
        while ahead - seen:
            path = (ahead - seen).pop()
            seen.add(path)
            ahead |= edges.get(path, set())
        if register.path in seen:
            yield Finding.at(register, "follows or shadows itself", "let one of the registers on the way do neither")


@register_rule("RS0433", "Register that cannot take another's value")
def cannot_take(register: Register, scope: RuleScope) -> Iterator[Problem]:
    """A text is no number, memory that loses its contents restores nothing, and a condition is yes or no."""
    for other in scope.named((*(case.then for case in register.follows), register.shadows)):
        if {register.kind, other.kind} & OCTETS and _octets(register) != _octets(other):
            related = Related(f"`{other.path}` is of kind {other.kind}", other.span)
            yield f"takes its value from `{other.path}`, of another kind", "correct one", related
    for field in register.fields:
        if field.follows is not None and field.width > 1:
            message = f"has the field `{field.id}` of {field.width} bits follow a condition"
            yield message, "let single bits follow conditions, or a register another one"
    yield from _cannot_shadow(register, scope)


def _octets(register: Register) -> tuple[object, ...]:
    """What decides about the bytes of a text, an address or a date."""
    return register.kind, register.text, register.layout


def _cannot_shadow(register: Register, scope: RuleScope) -> Iterator[Problem]:
    origin = scope.registers.get(register.shadows)
    if origin is not None and origin.persistence == RAM:
        related = Related(f"`{origin.path}` is kept in RAM", origin.span)
        message = f"shadows `{origin.path}`, which is lost without power, too"
        yield message, "name the register of lasting memory", related
    if register.shadows and (register.delivered is not None or register.delivered_cases):
        message = f"shadows `{register.shadows}` and has a delivered value, but takes the other's when power comes"
        yield message, "give `delivered` to the register of lasting memory"


@model_rule("RS0434", "Role in the process that the register cannot play")
def roles(scope: RuleScope) -> Iterator[Finding]:
    """A bit tells yes or no, and a value is a number."""
    process = scope.model.process
    for name, path, bit in _roles(process) if process else ():
        for register, field in _resolve(path, scope):
            problem = _why_unfit(register, field, bit=bit)
            if process and problem:
                message = f"`process` has `{path}` as `{name}`, which is {problem}"
                related = Related(f"`{register.path}` stands here", register.span)
                yield Finding("process", process.span, message, HELP_BIT if bit else HELP_NUMBER, related)


def _resolve(path: str, scope: RuleScope) -> Sequence[tuple[Register, BitField | None]]:
    """The register of a path, or the register and its bit field; empty if the model has neither."""
    if path in scope.registers:
        return [(scope.registers[path], None)]
    owner, _, name = path.rpartition(".")
    return [(register, field) for register in scope.named([owner]) for field in register.fields if field.id == name][:1]


def _why_unfit(register: Register, field: BitField | None, *, bit: bool) -> str:
    """Why a register or a field is no bit, or else no number; empty if it is one."""
    wanted = "bit" if bit else "number"
    if field is not None:
        return "" if bit and field.width == 1 else f"no {wanted} but {field.width} bits"
    fits = register.base.type is WireType.BIT if bit else register.kind not in NO_NUMBERS
    return "" if fits else f"no {wanted} but of kind {register.kind}"


def _roles(process: Process) -> Iterator[ProcessRole]:
    yield from _numbers(process, "", "value", "setpoint", "highest", "lowest")
    yield "fault", process.fault, True
    yield from _numbers(process.ramp, "ramp.", "rises", "falls", "shows")
    for output in process.outputs:
        yield from _numbers(output, "outputs.", "percent", "manual", "failsafe", "low", "high")
        yield "outputs.active", output.active, True
        yield from _numbers(output.pid, "pid.", "band", "integral", "derivative", "bias")
        yield from (("pid.span", path, False) for path in (output.pid and output.pid.ends) or ())
        yield from _numbers(output.on_off, "on_off.", "hysteresis")
    for alarm in process.alarms:
        yield from (("alarms.active", path, True) for path in alarm.active)
        yield from ((f"trips.{trip.kind}", trip.limit, False) for trip in alarm.trips)
        yield from _numbers(alarm, "alarms.", "hysteresis", "delay", "inhibit")


def _numbers(part: object, prefix: str, *names: str) -> Iterator[ProcessRole]:
    """The roles of a part of the process that are numbers; none if the process lacks the part."""
    return ((f"{prefix}{name}", getattr(part, name), False) for name in names if part is not None)


@model_rule("RS0497", "Effect that a register cannot take")
def impossible_effect(scope: RuleScope) -> Iterator[Finding]:
    """A register without a default cannot return to it, and none can be set to what its words cannot spell."""
    for command in scope.model.commands:
        for register, problem in (each for effect in command.effects for each in _effect_problems(effect, scope)):
            related = Related(f"`{register.path}` stands here", register.span)
            message = f"command `{command.id}` {problem}"
            yield Finding(command.id, command.span, message, "correct the effect, or the register", related)


def _effect_problems(effect: Effect, scope: RuleScope) -> Iterator[tuple[Register, str]]:
    for register in scope.named(effect.defaults):
        if register.default is None and not register.default_cases:
            yield register, f"returns `{register.path}` to its default, which it has not"
    for path, value in effect.sets:
        for register, field in _resolve(path, scope):
            problem = impossible_part(field, value) if field is not None else impossible(register, value)
            if problem:
                yield register, f"sets `{path}` to {shown(value)}, {problem}"
