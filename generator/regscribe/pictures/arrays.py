"""Picture of an array: members of an element, addresses of the first elements and the last, and formulas."""

from collections.abc import Iterator

from regscribe.emit.markdown import alt_text
from regscribe.emit.outline import Branch, Leaf, formula, leaves
from regscribe.emit.words import one_line, span_words
from regscribe.model import RegisterMap, Space
from regscribe.pictures.cell_style import set_words
from regscribe.pictures.drawing import MARGIN, PLAIN, WIDTH, Box, Canvas, Drawing, DrawnLine, Text
from regscribe.pictures.structure import SHOWN, Level, lettered_name, levels
from regscribe.pictures.style import tint
from regscribe.pictures.text_width import clean, wrap

INDENT = 22
"""How far an inner array is moved to the right."""

CELLS = MARGIN + 252
CELL = 76
GAP = 26
FORMULAS = CELLS + 4 * CELL + GAP + 14
"""Where the elements begin, how wide one is, the gap before the last, and where the formulas begin."""

OFFSETS = CELLS - 12
NAMES = OFFSETS - 48
"""Where the offsets and the names of members end."""

LINE = 14
NOTE = 10
"""Height of a line in a row and font size of its remarks."""

MOST_ROWS = 40
MOST_LEVELS = 12
MOST_DEPTH = 4
MOST_VIEWS = 6
"""Most rows, levels, depth and views that are drawn."""


def array(register_map: RegisterMap, branch: Branch) -> Drawing:
    """Draw an array and the arrays in it."""
    canvas = Canvas()
    title = f"{branch.array.first.name}: the array {branch.array.first.id}"
    canvas.head(title, tuple(_remarks(register_map, branch)))
    found = [level for level in levels(branch) if level.depth < MOST_DEPTH]
    knees: dict[tuple[str, ...], tuple[float, float]] = {}
    for level in found[:MOST_LEVELS]:
        _level(canvas, level, knees)
    if len(found) > MOST_LEVELS:
        rest = f"and {len(found) - MOST_LEVELS} more arrays"
        canvas.text(Text(MARGIN, canvas.y + LINE, rest, NOTE, style="dim"), NAMES)
        canvas.y += LINE
    return canvas.finish(f"{title}, {one_line(register_map.title)}", alt_text.array(branch))


def _remarks(register_map: RegisterMap, branch: Branch) -> Iterator[str]:
    yield "Wire addresses in decimal. A column is an element; the arrow tells how far the next one is."
    having = branch.array.models
    every = [model.name for model in register_map.models]
    if len(having) < len(every):
        yield f"The array exists on some models: {set_words(having, every)}."
    shapes = {(item.first, item.count, item.stride) for _, item in branch.array.versions}
    spots = [leaf.register.states(lambda _, register: register.address) for leaf in leaves((branch,))]
    if len(shapes) > 1 or any(len(spot) > 1 for spot in spots):
        yield f"Models differ in it; it is drawn as on {having[0]}."


def _level(canvas: Canvas, level: Level, knees: dict[tuple[str, ...], tuple[float, float]]) -> None:
    """Draw one array as a table of members and elements, tied to its row in the outer table."""
    left = MARGIN + INDENT * level.depth
    canvas.y += 16
    if level.key in knees:
        x, y = knees[level.key]
        canvas.add(DrawnLine(((x + 6, y), (x, y), (x, canvas.y - 4), (left - 4, canvas.y - 4))))
    head = f"{level.path}, {level.letter} = {level.array.first} to {level.array.first + level.array.count - 1}"
    canvas.text(Text(left, canvas.y, head, bold=True), WIDTH - MARGIN - left)
    _heads(canvas, level)
    top = canvas.y
    children = level.branch.children[:MOST_ROWS]
    frames = len(canvas.items)
    for number, child in enumerate(children):
        if isinstance(child, Branch):
            knees[*level.key, child.array.first.id] = (left + 3, canvas.y + 12)
        _member(canvas, level, child, number, left)
    height = canvas.y - top + 2
    boxes = [
        Box(_x(level, column) - 1, top - 2, CELL, height, "empty", radius=3) for column, _ in enumerate(level.elements)
    ]
    canvas.items[frames:frames] = boxes  # behind the members
    if len(level.branch.children) > MOST_ROWS:
        canvas.y += LINE
        rest = f"and {len(level.branch.children) - MOST_ROWS} more members"
        canvas.text(Text(left, canvas.y, rest, NOTE, style="dim"), NAMES - left)
    canvas.y += 14


def _x(level: Level, column: int) -> float:
    """Return where an element begins; the last may stand behind a gap."""
    return CELLS + CELL * column + (GAP if level.gap and column == SHOWN else 0)


def _heads(canvas: Canvas, level: Level) -> None:
    """Draw the index of each element, the arrow to the next one, and the heads of the other columns."""
    canvas.y += 16
    if level.step is not None:
        y, start, end = canvas.y, CELLS + CELL / 2, CELLS + CELL * 1.5
        canvas.text(Text((start + end) / 2, y + 2, f"{level.step:+d}", NOTE, "middle", "dim"), CELL)
        canvas.add(DrawnLine(((start, y + 10), (start, y + 6), (end, y + 6), (end, y + 10))))
        canvas.add(DrawnLine(((end - 3, y + 6.5), (end, y + 10), (end + 3, y + 6.5))))
    canvas.y += 25
    for column, element in enumerate(level.elements):
        index = f"[{level.array.first + element}]"
        canvas.text(Text(_x(level, column) + CELL / 2, canvas.y, index, PLAIN, "middle", bold=True), CELL - 4)
    if level.gap:
        canvas.add(Text(_x(level, SHOWN) - GAP / 2, canvas.y, "…", PLAIN, "middle"))
    if level.start is not None:
        canvas.add(Text(OFFSETS, canvas.y, "offset", NOTE, "end", "dim"))
    canvas.add(Text(FORMULAS, canvas.y, "address", NOTE, "start", "dim"))
    canvas.y += 8


def _member(canvas: Canvas, level: Level, child: Leaf | Branch, number: int, left: float) -> None:
    """Draw one member: its name, its offset, its address in each element, and the formula of each view."""
    rules = tuple(_rules(child))
    name, note = _names(child, level)
    room = NAMES - left - 12
    names = wrap(clean(name), room, PLAIN, lines=3)
    height = max(len(names) + 1, len(rules)) * LINE + 6
    for line, part in enumerate(names):
        canvas.text(Text(left + 12, canvas.y + 13 + LINE * line, part), room)
    canvas.text(Text(left + 12, canvas.y + 13 + LINE * len(names), note, NOTE, style="dim"), room)
    if level.start is not None:
        offset = f"+{level.span(child, 0)[0] - level.start}"
        canvas.text(Text(OFFSETS, canvas.y + 13, offset, PLAIN, "end"), 44)
    for column, element in enumerate(level.elements):
        canvas.add(Box(_x(level, column) + 1, canvas.y + 1, CELL - 4, height - 4, tint(number), radius=2))
        first, last = map(_space(child).spelled, level.span(child, element))
        words = span_words(first, last, "..")
        middle, size = _x(level, column) + CELL / 2 - 1, PLAIN if ".." not in words else NOTE
        canvas.text(Text(middle, canvas.y + height / 2 + 3, words, size, "middle"), CELL - 6)
    for line, rule in enumerate(rules):
        size, style = (NOTE, "dim") if line else (PLAIN - 1, "ink")
        canvas.text(Text(FORMULAS, canvas.y + 13 + LINE * line, rule, size, style=style), WIDTH - MARGIN - FORMULAS)
    canvas.y += height


def _names(child: Leaf | Branch, level: Level) -> tuple[str, str]:
    """Return the name of a member and, as a note, how a program names it and which models have it."""
    shared = child.register if isinstance(child, Leaf) else child.array
    every = level.branch.array.models
    only = set_words(shared.models, every) if len(shared.models) < len(every) else ""
    note = f".{shared.first.id}, {only}" if only else f".{shared.first.id}"
    if isinstance(child, Leaf):
        return lettered_name(child.register.first.name), note
    inner = child.array.first
    return f"{inner.name} {inner.first} to {inner.first + inner.count - 1}", note


def _rules(child: Leaf | Branch) -> Iterator[str]:
    if isinstance(child, Branch):
        yield "see below"
        return
    register = child.register.first
    views = register.views
    for view in views[:MOST_VIEWS]:
        text = formula(view, register.at, child.arrays)
        yield f"{view.name}: {text}" if len(views) > 1 else text
    if len(views) > MOST_VIEWS:
        yield f"and {len(views) - MOST_VIEWS} more views"


def _space(node: Leaf | Branch) -> Space:
    return next(leaves((node,))).register.first.base.space
