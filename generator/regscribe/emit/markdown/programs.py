"""Setpoint programs: which registers make one, what its states are, and how it is run."""

from collections.abc import Iterable, Iterator
from fractions import Fraction

from regscribe.emit.common_values import Merged, merge
from regscribe.emit.markdown.context import PageContext, conclusions, fact_table, only, source
from regscribe.emit.markdown.escape import Md, code, escape, join, lines, link, md, prose
from regscribe.emit.markdown.page_values import RegisterEntry, Titled
from regscribe.emit.outline import lettered, pattern
from regscribe.emit.words import labels_of, one_line
from regscribe.model import Model, ProgramCounts, ProgramPart, SetpointProgram, WhileRunning, numbered, show
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
    facts = fact_table(
        ("Part", "Where and what"), shared, lambda model, program: _facts(_Words(context, model, program))
    )
    return RegisterEntry(
        marks=Md("###"),
        anchor=context.anchor("program", shared.key),
        name=one_line(first.name),
        summary=join(" · ", (code(first.id), source(first.section), only(context, shared.models))),
        paragraphs=(prose(notes[0].description),) if notes[0].description else (),
        tables=(Titled("What makes it", facts),),
        remarks=conclusions(item for one in notes for item in one.inferred),
    )


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


def _facts(words: _Words) -> Iterator[tuple[str, Md]]:
    program = words.program
    yield "Exists only if", Md() if program.when.always else words.context.condition(program.when, words.model)
    yield from _segments(words)
    yield from _settings(words)
    yield from _states(words)
    actions = {"Start": program.start, "Hold": program.hold, "Resume": program.resume, "Reset": program.reset}
    for label, action in actions.items():
        command = words.context.command(action.command) if action.command else Md()
        yield label, command or words.values(action.writes) or md("no way is told")
    yield "Written while it runs", escape(RUNNING[program.while_running])
    fields = {ProgramPart.COUNT: "number_of_segments"}
    parts = [part for part in program.order if getattr(program, fields.get(part, part.value))]
    yield "Order of writing", escape(", ".join(part.value.replace("_", " ") for part in parts))


def _segments(words: _Words) -> Iterator[tuple[str, Md]]:
    program, segments, final = words.program, words.program.segments, words.program.final
    yield "Programs", escape(f"{program.programs}, numbered from {program.first}" if program.programs else "")
    yield (
        "Segments",
        lines(
            escape(f"{segments.first} to {segments.first + segments.many - 1}"),
            md("setpoint: ", words.register(segments.setpoint)),
            md("time of the ramp: ", words.register(segments.ramp)),
            md("time of the soak: ", words.register(segments.soak)) if segments.soak else Md(),
        ),
    )
    yield "Outputs of a segment", words.outputs(segments.outputs)
    idle = join(" and ", map(words.register, segments.idle))
    yield "Segment not in use", md(idle, " are 0") if idle else Md()
    outputs = words.outputs(final.outputs) if final else Md()
    yield "Final segment", lines(md("setpoint: ", words.register(final.setpoint)), outputs) if final else Md()
    count = words.register(program.number_of_segments)
    yield "Number of segments", md(count, "; ", COUNTS[program.counts]) if count else Md()


def _settings(words: _Words) -> Iterator[tuple[str, Md]]:
    program, unit, needed = words.program, words.program.time_unit, words.program.requires
    cycles, endless = words.register(program.cycles), program.forever
    forever = md("; ", words.label(program.cycles, endless), " is without end") if endless is not None else Md()
    yield "Cycles", md(cycles, forever) if cycles else Md()
    codes = [md(words.label(unit.register, number), ": ", symbol) for number, symbol in unit.codes] if unit else []
    yield "Times count in", md(words.register(unit.register), "; ", join(", ", codes)) if unit else Md()
    yield "Holdback", words.register(program.holdback)
    yield "After a power failure", words.register(program.power_failure)
    yield "At the end", words.register(program.end)
    yield "Setpoints lie between", join(" to ", map(words.register, program.setpoint_limits or ()))
    condition = md(words.context.condition(needed.when, words.model), " (", needed.reason, ")") if needed else Md()
    yield "Runs only if", lines(words.values(program.enable), condition)


def _states(words: _Words) -> Iterator[tuple[str, Md]]:
    program, status = words.program, words.program.status
    states: list[Md] = []
    if status:
        codes = {"runs": status.running, "is held": status.held, "does not run": status.ended}
        states = [md(name, ": ", words.labels(status.register, numbers)) for name, numbers in codes.items() if numbers]
    yield "State", lines(words.register(status.register), *states) if status else Md()
    now = {"program": program.program_now, "segment": program.segment_now, "setpoint": program.setpoint_now}
    yield "What runs", lines(*(md(name, ": ", words.register(path)) for name, path in now.items() if path))
