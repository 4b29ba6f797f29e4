"""What devices do by themselves: followers, shadows, effects of commands, and roles in the process."""

from collections.abc import Iterator

from regscribe.checks.held_values import impossible, impossible_part, shown
from regscribe.checks.rule import Finding, RuleScope, model_rule, register_rule
from regscribe.model import Alarm, BitField, Effect, Kind, Output, Process, Register, Related, WireType

RAM = "ram"
NO_NUMBERS = frozenset({Kind.STRING, Kind.FLAGS, Kind.FIELDS, Kind.VERSION})
HELP_BIT = "name a bit: `register.flag`, or a register of type bit"
HELP_NUMBER = "name a register that holds a number"
ProcessRole = tuple[str, str, bool]
"""What a register is in the process, its path (perhaps of a bit), and whether it must be a bit."""


def _sources(register: Register) -> set[str]:
    """The registers that decide what a register, or one of its bits, is."""
    followed = {case.then for case in register.follows}
    conditions = [case.when for case in register.follows]
    conditions += [field.follows for field in register.fields if field.follows is not None]
    shadowed = {register.shadows} if register.shadows else set()
    return followed | shadowed | {path for condition in conditions for path in condition.registers}


@model_rule("RS0431", "Registers follow or shadow each other", "Each would wait for the other to tell what it is.")
def follows_itself(scope: RuleScope) -> Iterator[Finding]:
    """Walk from each register along what it follows and shadows, and look for a way back."""
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


@register_rule(
    "RS0433",
    "Register that cannot take another's value",
    "A text is no number, memory that loses its contents restores nothing, and a condition is yes or no.",
)
def cannot_take(register: Register, scope: RuleScope) -> Iterator[Finding]:
    """Compare the kinds of a follower and of what it follows, and the memory of a shadow and of its origin."""
    for path in dict.fromkeys((*(case.then for case in register.follows), register.shadows)):
        other = scope.registers.get(path)
        if other is not None and (register.kind is Kind.STRING) != (other.kind is Kind.STRING):
            related = Related(f"`{other.path}` is of kind {other.kind}", other.span)
            yield Finding.at(register, f"takes its value from `{other.path}`, of another kind", "correct one", related)
    for field in register.fields:
        if field.follows is not None and field.width > 1:
            message = f"has the field `{field.id}` of {field.width} bits follow a condition"
            yield Finding.at(register, message, "let single bits follow conditions, or a register another one")
    yield from _cannot_shadow(register, scope)


def _cannot_shadow(register: Register, scope: RuleScope) -> Iterator[Finding]:
    origin = scope.registers.get(register.shadows)
    if origin is not None and origin.persistence == RAM:
        related = Related(f"`{origin.path}` is kept in RAM", origin.span)
        message = f"shadows `{origin.path}`, which is lost without power, too"
        yield Finding.at(register, message, "name the register of lasting memory", related)
    if register.shadows and register.delivered is not None:
        message = f"shadows `{register.shadows}` and has a delivered value, but takes the other's when power comes"
        yield Finding.at(register, message, "give `delivered` to the register of lasting memory")


@model_rule(
    "RS0434", "Role in the process that the register cannot play", "A bit tells yes or no, and a value is a number."
)
def roles(scope: RuleScope) -> Iterator[Finding]:
    """Compare what each register is in the process with what it can be."""
    process = scope.model.process
    for name, path, bit in _roles(process) if process is not None else ():
        found = _found(path, scope)
        if found is None or process is None:
            continue
        what = _no_bit(*found) if bit else _no_number(*found)
        if what:
            message = f"`process` has `{path}` as `{name}`, which is {what}"
            related = Related(f"`{found[0].path}` stands here", found[0].span)
            yield Finding("process", process.span, message, HELP_BIT if bit else HELP_NUMBER, (related,))


def _no_bit(register: Register, field: BitField | None) -> str:
    """What a register or a field is that is no bit; empty if it is one."""
    if field is not None:
        return "" if field.width == 1 else f"no bit but {field.width} bits"
    return "" if register.base.type is WireType.BIT else f"no bit but of kind {register.kind}"


def _no_number(register: Register, field: BitField | None) -> str:
    """What a register or a field is that is no number; empty if it is one."""
    if field is not None:
        return f"no number but {field.width} bits"
    return f"no number but of kind {register.kind}" if register.kind in NO_NUMBERS else ""


def _found(path: str, scope: RuleScope) -> tuple[Register, BitField | None] | None:
    if path in scope.registers:
        return scope.registers[path], None
    owner, _, name = path.rpartition(".")
    register = scope.registers.get(owner)
    field = next((each for each in register.fields if each.id == name), None) if register else None
    return (register, field) if register and field else None


def _roles(process: Process) -> Iterator[ProcessRole]:
    yield from (("value", process.value, False), ("setpoint", process.setpoint, False))
    yield from (("highest", process.highest, False), ("lowest", process.lowest, False), ("fault", process.fault, True))
    if process.ramp:
        yield from ((f"ramp.{name}", getattr(process.ramp, name), False) for name in ("rises", "falls", "shows"))
    for output in process.outputs:
        yield from _output(output)
    for alarm in process.alarms:
        yield from _alarm(alarm)


def _output(output: Output) -> Iterator[ProcessRole]:
    for name in ("percent", "manual", "failsafe", "low", "high"):
        yield f"outputs.{name}", getattr(output, name), False
    yield "outputs.active", output.active, True
    if output.pid:
        yield from (
            (f"pid.{name}", getattr(output.pid, name), False) for name in ("band", "integral", "derivative", "bias")
        )
        yield from (("pid.span", path, False) for path in output.pid.ends or ())
    if output.on_off:
        yield "on_off.hysteresis", output.on_off.hysteresis, False


def _alarm(alarm: Alarm) -> Iterator[ProcessRole]:
    yield from (("alarms.active", path, True) for path in alarm.active)
    yield from ((f"trips.{trip.kind}", trip.limit, False) for trip in alarm.trips)
    yield from ((f"alarms.{name}", getattr(alarm, name), False) for name in ("hysteresis", "delay", "inhibit"))


@model_rule(
    "RS0497",
    "Effect that a register cannot take",
    "A register without a default cannot return to it, and none can be set to what its words cannot spell.",
)
def impossible_effect(scope: RuleScope) -> Iterator[Finding]:
    """Look at the defaults of all registers that an effect names, and at what it sets; ranges limit masters only."""
    for command in scope.model.commands:
        for effect in command.effects:
            for register, problem in _impossible(effect, scope):
                related = Related(f"`{register.path}` stands here", register.span)
                message = f"command `{command.id}` {problem}"
                yield Finding(command.id, command.span, message, "correct the effect, or the register", (related,))


def _impossible(effect: Effect, scope: RuleScope) -> Iterator[tuple[Register, str]]:
    for path in effect.defaults:
        register = scope.registers.get(path)
        if register is not None and register.default is None:
            yield register, f"returns `{path}` to its default, which it has not"
    for path, value in effect.sets:
        found = _found(path, scope)
        if found is None:
            continue
        register, field = found
        problem = impossible_part(field, value) if field is not None else impossible(register, value)
        if problem:
            yield register, f"sets `{path}` to {shown(value)}, {problem}"
