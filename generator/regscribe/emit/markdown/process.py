"""What a device changes by itself: followers, shadows, effects of commands, and the process that it controls."""

from collections.abc import Iterator, Mapping

from regscribe.emit.common_values import models_by
from regscribe.emit.markdown.context import PageContext
from regscribe.emit.markdown.escape import Md, code, join, lines, md
from regscribe.emit.markdown.page_values import PageTable, table
from regscribe.emit.words import one_line
from regscribe.model import Alarm, Condition, Effect, Model, Output, Process, Register, TripKind, show

TRIPS = {
    TripKind.HIGH: "above",
    TripKind.LOW: "below",
    TripKind.DEVIATION_HIGH: "above the setpoint by more than",
    TripKind.DEVIATION_LOW: "below the setpoint by more than",
    TripKind.INSIDE: "nearer to the setpoint than",
    TripKind.OUTSIDE: "farther from the setpoint than",
}

Row = tuple[str, str]


def follows(context: PageContext, model: Model, register: Register) -> Md:
    """Return the registers that a register, and the conditions that its bits, follow."""
    cases = (md(context.register(case.then), _when(context, case.when, model)) for case in register.follows)
    bits = (
        md(code(field.id), " is set when ", context.condition(field.follows, model))
        for field in register.fields
        if field.follows is not None
    )
    return lines(join("; ", cases), *bits)


def effects(context: PageContext, model: Model, found: tuple[Effect, ...]) -> Md:
    """Return the changes of a command in a sentence; empty if the map does not say."""
    parts: list[Md] = []
    for effect in found:
        when = _when(context, effect.when, model)
        for path, value in effect.sets:
            text = value if isinstance(value, str) else show(value)
            parts.append(md(_subject(context, model, path), " to ", code(text), when))
        if effect.defaults:
            parts.append(md(f"{len(effect.defaults)} registers to their defaults", when))
        if effect.unlatch:
            parts.append(md("latched alarms are released", when))
    return md("It changes: ", join("; ", parts), ".") if parts else Md()


def process(context: PageContext) -> PageTable:
    """Return the roles of registers in controlling the process value, by model where they differ."""
    rows = models_by(
        (model.name, row)
        for model in context.map.models
        if model.process
        for row in _roles(context, model, model.process)
    )
    shown = ((role, md(text), context.covers(models)) for (role, text), models in rows.items())
    return table(("Role", "Register", "Models"), shown)


def assumptions(context: PageContext) -> tuple[Md, ...]:
    """Return the assumptions of the simulator about the process, with their reasons, each once."""
    found = dict.fromkeys(pair for model in context.map.models if model.process for pair in model.process.assumed)
    return tuple(md(one_line(what), " (", one_line(why), ")") for what, why in found)


def _roles(context: PageContext, model: Model, found: Process) -> Iterator[Row]:
    yield "process value", _subject(context, model, found.value)
    yield "setpoint", _subject(context, model, found.setpoint)
    if found.ramp:
        parts = {"up ": found.ramp.rises, "down ": found.ramp.falls, "shown by ": found.ramp.shows}
        yield "ramp of the setpoint", md(join(", ", _named(context, model, parts)), f", per {found.ramp.seconds} s")
    for role, condition in (("manual mode", found.manual), ("outputs off", found.off)):
        if condition is not None:
            yield role, md("when ", context.condition(condition, model))
    ends = {"highest value": found.highest, "lowest value": found.lowest, "broken sensor": found.fault}
    yield from ((role, _subject(context, model, path)) for role, path in ends.items() if path)
    for number, output in enumerate(found.outputs, start=1):
        yield f"output {number}", _output(context, model, output)
    for alarm in found.alarms:
        yield "alarm", _alarm(context, model, alarm)


def _output(context: PageContext, model: Model, output: Output) -> Md:
    pid, on_off = output.pid, output.on_off
    named = {
        "band ": pid.band if pid else "",
        "integral ": pid.integral if pid else "",
        "derivative ": pid.derivative if pid else "",
        "bias ": pid.bias if pid else "",
        "hysteresis ": on_off.hysteresis if on_off else "",
        "by hand ": output.manual,
        "with a broken sensor ": output.failsafe,
        "at least ": output.low,
        "at most ": output.high,
        "told by ": output.active,
    }
    cools = md("cools", _when(context, output.cools, model)) if output.cools is not None else Md()
    return lines(_subject(context, model, output.percent), *_named(context, model, named), cools)


def _alarm(context: PageContext, model: Model, alarm: Alarm) -> Md:
    bits = join(", ", (_subject(context, model, path) for path in alarm.active))
    trips = (
        md(TRIPS[trip.kind], " ", _subject(context, model, trip.limit), _when(context, trip.when, model))
        for trip in alarm.trips
    )
    named = {"hysteresis ": alarm.hysteresis, "delay ": alarm.delay, "not in the first seconds ": alarm.inhibit}
    latched = md("latched", _when(context, alarm.latched, model)) if alarm.latched is not None else Md()
    return lines(bits, *trips, *_named(context, model, named), latched)


def _named(context: PageContext, model: Model, paths: Mapping[str, str]) -> Iterator[Md]:
    """Yield each register that there is behind its word."""
    return (md(word, _subject(context, model, path)) for word, path in paths.items() if path)


def _when(context: PageContext, condition: Condition, model: Model) -> Md:
    return Md() if condition.always else md(" when ", context.condition(condition, model))


def _subject(context: PageContext, model: Model, path: str) -> Md:
    """Return a register, or a bit of one, with a link."""
    if any(register.path == path for register in model.registers):
        return context.register(path)
    owner, _, bit = path.rpartition(".")
    return md(context.register(owner), " ", code(bit))
