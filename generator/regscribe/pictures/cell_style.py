"""Style of the cells of the address map: letter, outline and mark say what a cell shows, never colour alone."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from regscribe.emit.words import ACCESS, listed, span_words
from regscribe.model import Access, RegisterMap
from regscribe.pictures.address_use import AddressUse, groups
from regscribe.pictures.drawing import Box, Canvas, DrawnLine, Text
from regscribe.pictures.style import outline, tint
from regscribe.pictures.text_width import clean, shorten

SEVERAL = "+"
OTHERWISE = "*"
"""Marks for registers of several groups in one cell, and for other registers on other models."""

MOST_SETS = 20
"""Sets of models beyond this many share one mark."""

MANY = "…"

NARROW = 0.84
"""Two letters are this much smaller, so that they stay clear of the mark."""

TIP = 400
MOST_WORDS = 3
"""Width of a name in a tooltip, at font size 10, and how many registers it names."""


@dataclass(frozen=True, slots=True)
class Look:
    """What a cell shows: the number of its group, its access, whether it is an alias, and the mark in its corner."""

    group: int
    access: Access = Access.READ_WRITE
    alias: bool = False
    mark: str = ""


@dataclass(frozen=True, slots=True)
class Looks:
    """The groups of a map by id with their names, and the sets of models that have only some registers."""

    groups: dict[str, str]
    models: tuple[str, ...]
    sets: dict[tuple[str, ...], str]
    numbers: dict[str, int]

    def look(self, found: Sequence[AddressUse]) -> Look:
        """Return how a cell with these uses looks: the group with the most uses counts."""
        counted = Counter(use.group for use in found)
        access = {use.access for use in found}
        only = access.pop() if len(access) == 1 else Access.READ_WRITE
        group = max(counted, key=lambda id_: (counted[id_], -self.numbers[id_]))
        return Look(self.numbers[group], only, all(use.alias for use in found), self._mark(found))

    def _mark(self, found: Sequence[AddressUse]) -> str:
        if len({use.group for use in found}) > 1:
            return SEVERAL
        if len({(use.path, use.models) for use in found}) > 1 and len({use.models for use in found}) > 1:
            return OTHERWISE
        return self.sets.get(found[0].models, "")

    def tip(self, found: Sequence[AddressUse], first: int, last: int) -> str:
        """Return the words of a cell's tooltip: its addresses and what they hold."""
        shown = [self._words(use) for use in found[:MOST_WORDS]]
        more = [f"and {len(found) - MOST_WORDS} more"] if len(found) > MOST_WORDS else []
        return f"{span_words(first, last)}: {'; '.join([*shown, *more])}"

    def _words(self, use: AddressUse) -> str:
        parts = [use.name, f"alias of {use.path}" if use.alias else use.path, ACCESS[use.access]]
        parts.append(self.groups[use.group])
        if len(use.models) < len(self.models):
            parts.append(set_words(use.models, self.models))
        return ", ".join(shorten(clean(part), TIP, 10) for part in parts)


def looks(register_map: RegisterMap, found: Sequence[AddressUse]) -> Looks:
    """Number the groups and the sets of models of all uses of a map."""
    models = tuple(model.name for model in register_map.models)
    partial = dict.fromkeys(use.models for use in found if len(use.models) < len(models))
    sets = {names: str(number) if number <= MOST_SETS else MANY for number, names in enumerate(partial, start=1)}
    names = groups(register_map, found)
    return Looks(names, models, sets, {group: number for number, group in enumerate(names)})


def letters(number: int) -> str:
    """Return the letters of a group: A to Z, AA to ZZ and so on."""
    text = ""
    number += 1
    while number:
        number, rest = divmod(number - 1, 26)
        text = chr(ord("A") + rest) + text
    return text


def draw(canvas: Canvas, box: Box, look: Look, size: float, tip: str = "") -> None:
    """Draw a cell that fills `box`: filled if it can be written, an outline if not, dashed if it is an alias."""
    inset = 1.0 if look.access.writable else 2.0
    style = tint(look.group) if look.access.writable else outline(look.group)
    style, radius = (f"{style} alias", 7) if look.alias else (style, 1)
    wide, high = box.width - 2 * inset, box.height - 2 * inset
    canvas.add(Box(box.x + inset, box.y + inset, wide, high, style, tip, radius))
    right, bottom = box.x + box.width, box.y + box.height
    text = letters(look.group)
    font = size if len(text) == 1 else size * NARROW
    canvas.add(Text(box.x + box.width / 2, bottom - 8, text, font, "middle", "ink mark"))
    if look.mark:
        canvas.add(Text(right - 3.5, box.y + 8, look.mark, min(8, size - 2), "end", "ink mark"))
    if not look.access.readable:
        canvas.add(DrawnLine(((box.x + 4, bottom - 3.5), (right - 4, bottom - 3.5))))


def set_words(names: Sequence[str], models: Sequence[str]) -> str:
    """Return which models have something: `only A, B` or, if that is shorter, `all but C`."""
    missing = [name for name in models if name not in names]
    few = len(missing) < len(names)
    return f"all but {listed(missing, last='and')}" if few else f"only {listed(list(names), last='and')}"
