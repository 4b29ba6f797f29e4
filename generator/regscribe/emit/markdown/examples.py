"""The worked examples of the manual, as the compiler checks them at every build."""

from collections.abc import Iterable
from fractions import Fraction

from regscribe.emit.markdown.context import PageContext
from regscribe.emit.markdown.escape import Md, code, escape, lines, md
from regscribe.emit.markdown.page_values import Titled, table
from regscribe.emit.markdown.protocol import BIT_FUNCTIONS
from regscribe.emit.words import labels_of, listed, one_line
from regscribe.model import FrameExample, Outcome, TimingExample, ValueExample, show

WRITE_COIL = 5
"""The function that sets one bit: FF00 is on, 0000 off."""


def examples(context: PageContext) -> tuple[Titled, ...]:
    """Return a table for each kind of example that the map has."""
    found = context.map.examples
    tables = (
        Titled("Values", table(VALUES, [_value(context, item) for item in found if isinstance(item, ValueExample)])),
        Titled("Messages", table(FRAMES, [_frame(context, item) for item in found if isinstance(item, FrameExample)])),
        Titled("Times", table(TIMES, [_timing(item) for item in found if isinstance(item, TimingExample)])),
    )
    return tuple(item for item in tables if item.table.rows)


VALUES = ("Section", "Model", "Register", "View", "While", "Stored", "Words", "Words (hex)", "Reads as", "Remark")
FRAMES = ("Section", "Model", "Message", "From", "Meaning", "While")
TIMES = ("Section", "Line", "Request", "Silence before it (ms)", "Earliest answer (ms)", "Latest answer (ms)")


def _value(context: PageContext, item: ValueExample) -> tuple[str, ...]:
    return (
        one_line(item.source),
        one_line(item.model),
        context.register(item.register),
        code(item.view),
        _state(context, item.model, item.state),
        show(item.stored) if item.stored is not None else "",
        " ".join(map(str, item.words)),
        " ".join(f"{word & 0xFFFF:04X}" for word in item.words),
        _reading(item),
        "the words carry only part of it" if item.lossy else "",
    )


def _reading(item: ValueExample) -> str:
    if item.outcome is Outcome.SATURATED:
        return "saturated: no value"
    if item.flags is not None:
        return ", ".join(item.flags) or "no bit set"
    value = "" if item.value is None else show(item.value) if isinstance(item.value, Fraction) else one_line(item.value)
    return f"fault {value}" if item.outcome is Outcome.FAULT else value


def _state(context: PageContext, model: str, state: Iterable[tuple[str, Fraction]]) -> Md:
    """Return the values of registers, each with the label that the model's enum gives it."""
    owner = context.map.model(model) if context.map.has(model) else context.map.models[0]
    parts: list[Md] = []
    for path, value in state:
        try:
            label = labels_of(owner.register(path).enum).get(int(value))
        except KeyError:
            label = None
        words = f"{show(value)} ({one_line(label)})" if label else show(value)
        parts.append(md(context.register(path), f" = {words}"))
    return lines(*parts)


def _frame(context: PageContext, item: FrameExample) -> tuple[str, ...]:
    return (
        one_line(item.source),
        one_line(item.model),
        code(item.frame.hex(" ").upper() + ("" if item.crc else " + CRC")),
        "device" if item.answer else "master",
        _meaning(context, item),
        _state(context, item.model, item.state),
    )


def _meaning(context: PageContext, item: FrameExample) -> Md:
    facts = [f"unit {item.unit}", f"function {item.function:02d}"]
    facts += [f"address {item.address}"] if item.address is not None else []
    facts += (
        [f"{item.count} {'bits' if item.function in BIT_FUNCTIONS else 'registers'}"] if item.count is not None else []
    )
    writes = _state(context, item.model, item.writes)
    command = context.command(item.command) if item.command else Md()
    return lines(escape(", ".join(facts)), writes or escape(_words(item)), command)


def _words(item: FrameExample) -> str:
    if item.words is None:
        return ""
    if item.function == WRITE_COIL:
        return f"bit {listed(['on' if word else 'off' for word in item.words], last='and')}"
    return f"words {listed([str(word) for word in item.words], last='and')}"


def _timing(item: TimingExample) -> tuple[str, ...]:
    return (
        one_line(item.source),
        f"{item.baud} baud, {one_line(item.format)}",
        f"function {item.function:02d}, {item.words} words",
        *(show(time) for time in (item.gap, item.earliest, item.latest)),
    )
