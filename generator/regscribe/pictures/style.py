"""Colours for light and dark: the picture brings its own paper, since a page need not follow the reader's choice.

Every tint carries the ink at a contrast of 7 or more, every edge stands out from its paper by 4.5 or more.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Paint:
    """A colour on light and on dark paper."""

    light: str
    dark: str


PAPER = Paint("#ffffff", "#0d1117")
INK = Paint("#1f2328", "#e6edf3")
DIM = Paint("#57606a", "#9da7b3")
FAINT = Paint("#d0d7de", "#30363d")
HATCH = Paint("#8c959f", "#6e7681")

TINTS = (
    Paint("#afd5fe", "#154470"),
    Paint("#fdc495", "#623606"),
    Paint("#ace1ad", "#1e4e22"),
    Paint("#fdbbd9", "#642c49"),
    Paint("#d9c6fe", "#4a366b"),
    Paint("#85e4e3", "#0d4c4c"),
    Paint("#e3d18c", "#4f4105"),
    Paint("#ffbfb8", "#6a2c29"),
    Paint("#c9da97", "#3d4900"),
    Paint("#c4cefc", "#353d72"),
    Paint("#8bdffa", "#0a4a5a"),
    Paint("#f0bdf2", "#5a305c"),
    Paint("#e1effd", "#172d43"),
    Paint("#fde9d9", "#3d250f"),
    Paint("#dff4df", "#1a321b"),
    Paint("#fee5f0", "#3e202f"),
    Paint("#f0e9ff", "#2f2540"),
    Paint("#d3f5f4", "#003333"),
)
"""Fills, neighbours far apart in hue: twelve of equal lightness, and six that are paler (on dark paper deeper)."""

EDGES = (
    Paint("#0465af", "#59aaf8"),
    Paint("#915006", "#e38d3d"),
    Paint("#107823", "#67bb6b"),
    Paint("#9e366f", "#e57db1"),
    Paint("#724aab", "#b28fef"),
    Paint("#017272", "#16bbbc"),
    Paint("#756208", "#c0a320"),
    Paint("#a83634", "#f07f77"),
    Paint("#5b6c09", "#9ab140"),
    Paint("#4d57b7", "#8c9cfb"),
    Paint("#046f87", "#09b7dc"),
    Paint("#8c3f91", "#d084d5"),
    Paint("#054980", "#a3cffd"),
    Paint("#6c3900", "#fbbb87"),
    Paint("#15561d", "#a1dca2"),
    Paint("#712a50", "#fdb0d4"),
    Paint("#523779", "#d3befd"),
    Paint("#095252", "#73dfdf"),
)
"""Outlines: the same hues as TINTS."""


def tint(index: int) -> str:
    """Return the class of a filled box in the colour of a number; colours repeat, so they never stand alone."""
    return f"f{index % len(TINTS)}"


def outline(index: int) -> str:
    """Return the class of a box that is only outlined, in the same colour."""
    return f"o{index % len(EDGES)}"


PAINTS = {
    "paper": {"fill": PAPER, "stroke": FAINT},
    "ink": {"fill": INK},
    "dim": {"fill": DIM},
    "empty": {"fill": PAPER, "stroke": FAINT},
    "line": {"stroke": DIM},
    "grid": {"stroke": FAINT},
    "curve": {"stroke": EDGES[0]},
    "hatch": {"stroke": HATCH},
    "unused": {"stroke": HATCH},
    "reserved": {"stroke": HATCH},
    **{f"f{index}": {"fill": paint, "stroke": EDGES[index]} for index, paint in enumerate(TINTS)},
    **{f"o{index}": {"fill": PAPER, "stroke": paint} for index, paint in enumerate(EDGES)},
}
"""The colours of each class."""

SHAPES = {
    "line": "fill:none;stroke-width:1",
    "grid": "fill:none;stroke-width:1",
    "curve": "fill:none;stroke-width:2.5;stroke-linejoin:round",
    "dashed": "stroke-dasharray:6 5",
    "hatch": "fill:none;stroke-width:1",
    "unused": "fill:url(#unused)",
    "reserved": "fill:url(#reserved)",
    "alias": "stroke-dasharray:4 3",
    "mark": "pointer-events:none",
    **{f"o{index}": "stroke-width:2.5" for index in range(len(EDGES))},
}
"""Declarations of classes beside their colours."""

PATTERNS = (
    '<pattern id="unused" width="6" height="6" patternUnits="userSpaceOnUse">'
    '<path class="hatch" d="M-1 1L1 -1M0 6L6 0M5 7L7 5"/></pattern>'
    '<pattern id="reserved" width="6" height="6" patternUnits="userSpaceOnUse">'
    '<path class="hatch" d="M0 0L6 6M0 6L6 0"/></pattern>'
)
"""Hatching: lines one way for unused, crossed for reserved."""


def css(used: Iterable[str]) -> str:
    """Return the rules of the classes that a picture uses, first for light, then for dark."""
    names = [name for name in {**PAINTS, **SHAPES} if name in set(used)]
    light = "".join(f".{name}{{{';'.join(_rules(name, dark=False))}}}" for name in names)
    dark = "".join(f".{name}{{{';'.join(_rules(name, dark=True))}}}" for name in names if name in PAINTS)
    return f"text{{font-family:sans-serif}}{light}@media(prefers-color-scheme:dark){{{dark}}}"


def _rules(name: str, *, dark: bool) -> Iterator[str]:
    yield from (f"{key}:{paint.dark if dark else paint.light}" for key, paint in PAINTS.get(name, {}).items())
    if not dark and name in SHAPES:
        yield SHAPES[name]
