"""The bits of a word as a picture: boxes from the most significant on, a line from each field to its meaning."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import chain, pairwise

from regscribe.emit.common_values import Merged, models_by
from regscribe.emit.markdown import alt_text
from regscribe.emit.outline import Leaf, formula, lettered
from regscribe.emit.words import bits_words, listed, one_line
from regscribe.model import BitField, Register, RegisterMap, Space
from regscribe.pictures.address_rows import gaps
from regscribe.pictures.cell_style import set_words
from regscribe.pictures.drawing import MARGIN, PLAIN, SMALL, WIDTH, Box, Canvas, Drawing, DrawnLine, Text
from regscribe.pictures.structure import lettered_name
from regscribe.pictures.style import tint
from regscribe.pictures.text_width import clean, width, wrap

NAMES = {
    Space.HOLDING: "Holding register",
    Space.INPUT: "Input register",
    Space.COIL: "Coil",
    Space.DISCRETE: "Discrete input",
    Space.STATUS: "Exception status (function 07)",
    Space.FILE: "File record",
    Space.QUEUE: "FIFO queue",
    Space.IDENTIFICATION: "Object of the identification",
    Space.ENRON: "Register of 32 bits",
}

WORD = 16
"""Bits of a strip."""

BIT = 32
HEIGHT = 30
"""Size of the box of one bit."""

RIGHT = MARGIN + WORD * BIT
"""Where bit 0 ends."""

LABELS = RIGHT + 26
ROOM = WIDTH - MARGIN - LABELS
"""Where the meanings stand, and how wide they may be."""

MOST_CODE_LINES = 12
LINE = 16


@dataclass(frozen=True, slots=True)
class Slot:
    """One field; `models` have it, where not all that have the register do."""

    field: BitField
    models: str = ""


@dataclass(frozen=True, slots=True)
class Strip:
    """The fields of a word on the models that `title` names (empty: all)."""

    title: str
    width: int
    slots: tuple[Slot, ...]


def bits(register_map: RegisterMap, leaf: Leaf) -> Drawing:
    """Draw the fields of a register of bits."""
    register = leaf.register.first
    canvas = Canvas()
    canvas.head(
        f"{lettered_name(register.name)} ({lettered(register.path)})",
        (f"{_where(leaf)}. Bit 0 is the least significant; hatched bits have no name in the manual.",),
    )
    for strip in strips(leaf.register):
        if strip.title:
            canvas.y += 12
            canvas.text(Text(MARGIN, canvas.y, strip.title, bold=True), WIDTH - 2 * MARGIN)
            canvas.y += 10
        highest = max([strip.width - 1, *(slot.field.high for slot in strip.slots)])
        for low in range(highest // WORD * WORD, -1, -WORD):
            _word(canvas, strip, low, min(low + WORD - 1, highest))
    return canvas.finish(f"Bits of {one_line(register.name)}, {one_line(register_map.title)}", alt_text.bits(leaf))


def _where(leaf: Leaf) -> str:
    facts = leaf.register.states(
        lambda _, register: (register.base.space, formula(register.base, register.at, leaf.arrays))
    )
    spots = dict.fromkeys(fact.value for fact in facts)
    return listed([f"{NAMES[space]}{'' if space is Space.STATUS else f' {address}'}" for space, address in spots])


def strips(shared: Merged[Register]) -> tuple[Strip, ...]:
    """Return one strip of the fields of all models, unless they cut the word differently: then one for each cut."""
    cuts = shared.states(lambda _, register: (register.bits, register.fields))
    widths = {cut.value[0] for cut in cuts}
    if len(widths) == 1 and _alike(chain(*(cut.value[1] for cut in cuts))):
        models = models_by((model.name, part) for model, register in shared.versions for part in register.fields)
        every = shared.models
        slots = (
            Slot(part, set_words(names, every) if len(names) < len(every) else "") for part, names in models.items()
        )
        return (Strip("", widths.pop(), tuple(slots)),)
    return tuple(
        Strip(f"On {listed(cut.models, last='and')}", cut.value[0], tuple(map(Slot, cut.value[1]))) for cut in cuts
    )


def _alike(fields: Iterable[BitField]) -> bool:
    """Whether fields of several models take the same bits or none of the same."""
    spans = sorted({(part.low, part.high) for part in fields})
    return all(one[1] < other[0] for one, other in pairwise(spans))


def _word(canvas: Canvas, strip: Strip, low: int, high: int) -> None:
    """Draw bits `low` to `high`, numbers above, boxes, then the meanings, the lowest bit's first."""
    canvas.y += 12
    for bit in range(low, high + 1):
        canvas.add(Text(_x(bit, low) + BIT / 2, canvas.y, str(bit), SMALL, "middle", "dim"))
    canvas.y += 5
    slots: dict[tuple[int, int], list[Slot]] = {}
    for slot in strip.slots:
        if slot.field.low <= high and low <= slot.field.high:
            slots.setdefault((max(slot.field.low, low), min(slot.field.high, high)), []).append(slot)
    spans = sorted(slots)
    for number, (first, last) in enumerate(spans):
        canvas.add(Box(_x(last, low) + 1, canvas.y, BIT * (last - first + 1) - 2, HEIGHT, tint(number), radius=2))
    for first, last in gaps(spans, low, high):
        wide = BIT * (last - first + 1)
        canvas.add(Box(_x(last, low) + 1, canvas.y, wide - 2, HEIGHT, "unused", "no name in the manual", radius=2))
    bottom = canvas.y + HEIGHT
    canvas.y = bottom + 6
    for span in spans:
        _meanings(canvas, slots[span], (_x(span[1], low) + _x(span[0], low) + BIT) / 2, bottom)
    canvas.y += 10


def _x(bit: int, low: int) -> float:
    return RIGHT - BIT * (bit - low + 1)


def _meanings(canvas: Canvas, slots: Sequence[Slot], middle: float, bottom: float) -> None:
    """Draw what a field means, on as many lines as it takes, and the line that leads to each."""
    for slot in slots:
        canvas.y += LINE
        y = canvas.y - 4
        canvas.add(DrawnLine(((middle, bottom), (middle, y), (LABELS - 6, y))))
        number = f"{bits_words(slot.field)} "
        canvas.add(Text(LABELS, canvas.y, number.strip(), PLAIN, bold=True))
        indent = width(number, PLAIN, bold=True) + 4
        for index, line in enumerate(wrap(clean(slot.field.label), ROOM - indent, PLAIN, lines=3)):
            canvas.y += LINE if index else 0
            canvas.text(Text(LABELS + indent, canvas.y, line), ROOM - indent)
        for line in _remarks(slot):
            canvas.y += LINE - 2
            canvas.text(Text(LABELS + indent, canvas.y, line, SMALL + 2, style="dim"), ROOM - indent)


def _remarks(slot: Slot) -> Iterator[str]:
    if slot.models:
        yield from wrap(clean(slot.models), ROOM - 50, SMALL + 2, lines=3)
    members = slot.field.enum.members if slot.field.enum else ()
    most = MOST_CODE_LINES if len(members) <= MOST_CODE_LINES else MOST_CODE_LINES - 1
    yield from (f"{member.code} = {one_line(member.label)}" for member in members[:most])
    if len(members) > most:
        yield f"and {len(members) - most} more codes"
