"""How a cell of the address map looks: what it shows is told by letter, outline and mark, never by colour alone."""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from regscribe.emit.words import ACCESS, listed, span_words
from regscribe.model import Access, RegisterMap
from regscribe.pictures.address_use import AddressUse, groups, places
from regscribe.pictures.drawing import Box, Canvas, DrawnLine, Item, Text
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
"""Width of a name in a tooltip, at font size 10."""


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
        """Return how a cell with these places looks: the group with the most places counts."""
        counted = Counter(place.group for place in found)
        access = {place.access for place in found}
        only = access.pop() if len(access) == 1 else Access.READ_WRITE
        group = max(counted, key=lambda id_: (counted[id_], -self.numbers[id_]))
        return Look(self.numbers[group], only, all(place.alias for place in found), self._mark(found))

    def _mark(self, found: Sequence[AddressUse]) -> str:
        if len({place.group for place in found}) > 1:
            return SEVERAL
        if len({(place.path, place.models) for place in found}) > 1 and len({place.models for place in found}) > 1:
            return OTHERWISE
        return self.sets.get(found[0].models, "")


def looks(register_map: RegisterMap) -> Looks:
    """Number the groups and the sets of models."""
    found = places(register_map)
    models = tuple(model.name for model in register_map.models)
    partial = dict.fromkeys(place.models for place in found if len(place.models) < len(models))
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
    classes = f"{style} alias" if look.alias else style
    canvas.add(
        Box(
            box.x + inset,
            box.y + inset,
            box.width - 2 * inset,
            box.height - 2 * inset,
            classes,
            tip,
            radius=7 if look.alias else 1,
        )
    )
    canvas.add(*_inside(box, look, size))


def _inside(box: Box, look: Look, size: float) -> Iterable[Item]:
    middle = box.x + box.width / 2
    text = letters(look.group)
    yield Text(middle, box.y + box.height - 8, text, size if len(text) == 1 else size * NARROW, "middle", "ink mark")
    if look.mark:
        yield Text(box.x + box.width - 3.5, box.y + 8, look.mark, min(8, size - 2), "end", "ink mark")
    if not look.access.readable:
        low = box.y + box.height - 3.5
        yield DrawnLine(((box.x + 4, low), (box.x + box.width - 4, low)))


def tip(found: Sequence[AddressUse], first: int, last: int, names: Mapping[str, str], models: Sequence[str]) -> str:
    """Return the words of a cell's tooltip: its addresses and what they hold."""
    shown = [_words(place, names, models) for place in found[:3]]
    more = [f"and {len(found) - 3} more"] if len(found) > 3 else []  # noqa: PLR2004 - as many as are shown
    return f"{span_words(first, last)}: {'; '.join([*shown, *more])}"


def _words(place: AddressUse, names: Mapping[str, str], models: Sequence[str]) -> str:
    parts = [place.name, f"alias of {place.path}" if place.alias else place.path, ACCESS[place.access]]
    parts += [names[place.group]]
    if len(place.models) < len(models):
        parts.append(set_words(place.models, models))
    return ", ".join(_short(part) for part in parts)


def _short(text: str) -> str:
    return shorten(clean(text), TIP, 10)


def set_words(names: Sequence[str], models: Sequence[str]) -> str:
    """Return which models have something: `only A, B` or, if that is shorter, `all but C`."""
    missing = [name for name in models if name not in names]
    few = len(missing) < len(names)
    return f"all but {listed(missing, last='and')}" if few else f"only {listed(list(names), last='and')}"
