"""Setpoint programs: which registers make one, what its states are, and how it is run."""

from collections.abc import Callable, Iterable
from fractions import Fraction
from functools import partial

from regscribe.emit.common_values import Merged, merge
from regscribe.emit.markdown.context import PageContext, by_model, conclusions, only, source
from regscribe.emit.markdown.escape import Md, code, escape, join, lines, link, md, prose
from regscribe.emit.markdown.page_values import RegisterEntry, Titled, table
from regscribe.emit.outline import lettered, pattern
from regscribe.emit.words import labels_of, one_line
from regscribe.model import (
    Model,
    ProgramAction,
    ProgramCounts,
    ProgramPart,
    SetpointProgram,
    WhileRunning,
    numbered,
    show,
)
from regscribe_runtime.values.programs import PROGRAM

COUNTS = {
    ProgramCounts.ALL: "counts all segments",
    ProgramCounts.AFTER_FIRST: "counts the segments after the first",
    ProgramCounts.NOT_STATED: "the manual does not say whether it counts the first segment",
}
RUNNING = {
    WhileRunning.REFUSED: "refused by the controller",
    WhileRunning.ALLOWED: "allowed",
    WhileRunning.NOT_STATED: "the manual says nothing; tools refuse it unless told otherwise",
}


def programs(context: PageContext) -> tuple[RegisterEntry, ...]:
    """Return the setpoint programs of all models."""
    found = merge(context.map.models, lambda model: model.programs, lambda program: program.id)
    return tuple(_entry(context, shared) for shared in found)


def _entry(context: PageContext, shared: Merged[SetpointProgram]) -> RegisterEntry:
    first = shared.first
    notes = [model.program_notes[model.programs.index(program)] for model, program in shared.versions]
    rows = ((label, by_model(shared, partial(_fact, context, words))) for label, words in FACTS.items())
    facts = table(("Part", "Where and what"), [row for row in rows if row[1]])
    return RegisterEntry(
        marks=Md("###"),
        anchor=context.anchor("program", shared.key),
        name=one_line(first.name),
        summary=join(" · ", (code(first.id), source(first.section), only(context, shared.models))),
        paragraphs=(prose(notes[0].description),) if notes[0].description else (),
        tables=(Titled("What makes it", facts),),
        remarks=conclusions(item for one in notes for item in one.inferred),
    )


def _fact(context: PageContext, words: Callable[["_Words"], Md], model: Model, program: SetpointProgram) -> Md:
    return words(_Words(context, model, program))


class _Words:
    """The parts of one program of one model in words, with links to their registers."""

    def __init__(self, context: PageContext, model: Model, program: SetpointProgram) -> None:
        self.context, self.model, self.program = context, model, program

    def register(self, path: str) -> Md:
        """A register as a link; in arrays with letters for the indices."""
        if not path:
            return Md()
        numbers = self.program.numbers
        paths = [self._first(path)]
        if len(numbers) > 1 and PROGRAM in path.replace(f"[{PROGRAM}]", ""):  # a register of its own for each program
            paths.append(numbered(path, numbers[-1]))
        anchors = [self.context.anchor("register", pattern(one)) for one in paths]
        return join(" to ", [link(code(lettered(one)), anchor) for one, anchor in zip(paths, anchors, strict=True)])

    def label(self, path: str, number: int | Fraction) -> Md:
        """A code of a register with its label."""
        found = next((one for one in self.model.registers if one.path == self._first(path)), None)
        names = labels_of(found.enum) if found else {}
        special = next((one.label for one in found.specials if one.value == number), "") if found else ""
        label = names.get(int(number), special)
        return md(show(Fraction(number)), " (", one_line(label), ")") if label else md(show(Fraction(number)))

    def labels(self, path: str, numbers: Iterable[int]) -> Md:
        """Several codes of a register with their labels."""
        return Md(", ".join(self.label(path, number) for number in numbers))

    def values(self, values: Iterable[tuple[str, int | Fraction]]) -> Md:
        """Registers with the values that are written to them."""
        return join(", ", [md(self.register(path), " = ", self.label(path, number)) for path, number in values])

    def outputs(self, outputs: Iterable[tuple[str, str]]) -> Md:
        """Outputs by name."""
        return join(", ", [md(name, ": ", self.register(path)) for name, path in outputs])

    def _first(self, path: str) -> str:
        return numbered(path, self.program.numbers[0], self.program.segments.first)


def _numbers(words: _Words) -> Md:
    one = words.program
    return escape(f"{one.programs}, numbered from {one.first}") if one.programs else Md()


def _segments(words: _Words) -> Md:
    one = words.program.segments
    return lines(
        escape(f"{one.first} to {one.first + one.many - 1}"),
        md("setpoint: ", words.register(one.setpoint)),
        md("time of the ramp: ", words.register(one.ramp)),
        md("time of the soak: ", words.register(one.soak)) if one.soak else Md(),
    )


def _idle(words: _Words) -> Md:
    idle = words.program.segments.idle
    return md(Md(" and ".join(words.register(path) for path in idle)), " are 0") if idle else Md()


def _final(words: _Words) -> Md:
    final = words.program.final
    return lines(md("setpoint: ", words.register(final.setpoint)), words.outputs(final.outputs)) if final else Md()


def _count(words: _Words) -> Md:
    one = words.program
    return md(words.register(one.number_of_segments), "; ", COUNTS[one.counts]) if one.number_of_segments else Md()


def _cycles(words: _Words) -> Md:
    one = words.program
    endless = md("; ", words.label(one.cycles, one.forever), " is without end") if one.forever is not None else Md()
    return md(words.register(one.cycles), endless) if one.cycles else Md()


def _time_unit(words: _Words) -> Md:
    unit = words.program.time_unit
    if unit is None:
        return Md()
    codes = ", ".join(md(words.label(unit.register, code_of), ": ", symbol) for code_of, symbol in unit.codes)
    return md(words.register(unit.register), "; ", Md(codes))


def _limits(words: _Words) -> Md:
    limits = words.program.setpoint_limits
    return md(words.register(limits[0]), " to ", words.register(limits[1])) if limits else Md()


def _enable(words: _Words) -> Md:
    needed = words.program.requires
    condition = words.context.condition(needed.when, words.model) if needed else Md()
    return lines(words.values(words.program.enable), md(condition, " (", needed.reason, ")") if needed else Md())


def _status(words: _Words) -> Md:
    status = words.program.status
    if status is None:
        return Md()
    codes = {"runs": status.running, "is held": status.held, "does not run": status.ended}
    states = [md(name, ": ", words.labels(status.register, numbers)) for name, numbers in codes.items() if numbers]
    return lines(words.register(status.register), *states)


def _now(words: _Words) -> Md:
    one = words.program
    paths = {"program": one.program_now, "segment": one.segment_now, "setpoint": one.setpoint_now}
    return lines(*(md(name, ": ", words.register(path)) for name, path in paths.items() if path))


def _action(words: _Words, action: ProgramAction) -> Md:
    if action.command:
        return words.context.command(action.command)
    return words.values(action.writes) or Md("no way is told")


def _order(words: _Words) -> Md:
    fields = {ProgramPart.COUNT: "number_of_segments"}
    parts = [part for part in words.program.order if getattr(words.program, fields.get(part, part.value))]
    return escape(", ".join(part.value.replace("_", " ") for part in parts))


FACTS: dict[str, Callable[[_Words], Md]] = {
    "Programs": _numbers,
    "Segments": _segments,
    "Outputs of a segment": lambda words: words.outputs(words.program.segments.outputs),
    "Segment not in use": _idle,
    "Final segment": _final,
    "Number of segments": _count,
    "Cycles": _cycles,
    "Times count in": _time_unit,
    "Holdback": lambda words: words.register(words.program.holdback),
    "After a power failure": lambda words: words.register(words.program.power_failure),
    "At the end": lambda words: words.register(words.program.end),
    "Setpoints lie between": _limits,
    "Runs only if": _enable,
    "State": _status,
    "What runs": _now,
    "Start": lambda words: _action(words, words.program.start),
    "Hold": lambda words: _action(words, words.program.hold),
    "Resume": lambda words: _action(words, words.program.resume),
    "Reset": lambda words: _action(words, words.program.reset),
    "Written while it runs": lambda words: escape(RUNNING[words.program.while_running]),
    "Order of writing": _order,
}
"""The rows of the table; one that is empty for every model is left out."""
