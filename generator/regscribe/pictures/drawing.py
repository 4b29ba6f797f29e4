"""A picture before it becomes SVG: boxes, lines and texts at positions in pixels."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from regscribe.pictures.text_width import ASCENT, DESCENT, clean, shorten, width, wrap

WIDTH = 900
"""Width of every picture."""

MARGIN = 16
SMALL = 9
PLAIN = 12
LARGE = 16
"""Font sizes."""


@dataclass(frozen=True, slots=True)
class Box:
    """A rectangle with classes of `style` and a tooltip."""

    x: float
    y: float
    width: float
    height: float
    style: str
    tip: str = ""
    radius: float = 0


@dataclass(frozen=True, slots=True)
class DrawnLine:
    """A line through points, drawn with classes of `style`."""

    points: tuple[tuple[float, float], ...]
    style: str = "line"


@dataclass(frozen=True, slots=True)
class Text:
    """One line of text: `x` is its start, middle or end by `anchor`, `y` its base line, `style` names classes."""

    x: float
    y: float
    text: str
    size: float = PLAIN
    anchor: str = "start"
    style: str = "ink"
    bold: bool = False
    tip: str = ""

    @property
    def box(self) -> Box:
        """Return the room that the text takes at most."""
        wide = width(self.text, self.size, bold=self.bold)
        left = {"start": self.x, "middle": self.x - wide / 2, "end": self.x - wide}[self.anchor]
        return Box(left, self.y - ASCENT * self.size, wide, (ASCENT + DESCENT) * self.size, "")


Item = Box | DrawnLine | Text


@dataclass(frozen=True, slots=True)
class Drawing:
    """A finished picture with its title and, for those who do not see it, a description."""

    title: str
    description: str
    height: float
    items: tuple[Item, ...]
    width: float = WIDTH


@dataclass(slots=True)
class Canvas:
    """A picture in the making; `y` is where the next part may begin."""

    items: list[Item] = field(default_factory=list)
    y: float = MARGIN

    def add(self, *items: Item) -> None:
        """Draw."""
        self.items += items

    def text(self, item: Text, room: float) -> None:
        """Draw text that is untrusted; if it is cut to `room`, the tooltip has all of it."""
        whole = clean(item.text)
        shown = shorten(whole, room, item.size, bold=item.bold)
        if shown:
            self.add(replace(item, text=shown, tip=item.tip or (whole if shown != whole else "")))

    def head(self, title: str, remarks: Sequence[str]) -> None:
        """Draw the title and lines of explanation at the top."""
        room = WIDTH - 2 * MARGIN
        self.y += LARGE
        self.text(Text(MARGIN, self.y, title, LARGE, bold=True), room)
        for line in (line for remark in remarks for line in wrap(clean(remark), room, PLAIN, lines=3)):
            self.y += 18
            self.text(Text(MARGIN, self.y, line, style="dim"), room)
        self.y += MARGIN

    def finish(self, title: str, description: str) -> Drawing:
        """Return the picture on its paper."""
        height = self.y + MARGIN
        paper = Box(0.5, 0.5, WIDTH - 1, height - 1, "paper", radius=8)
        return Drawing(clean(title), clean(description), height, (paper, *self.items))
