"""An array as a picture: what an element holds, the addresses of the first elements and the last, and the formulas."""

from collections.abc import Iterator

from regscribe.emit.markdown import alt_text
from regscribe.emit.outline import Branch, Leaf, formula, leaves
from regscribe.emit.words import one_line, span_words
from regscribe.model import RegisterMap
from regscribe.pictures.cell_style import set_words
from regscribe.pictures.drawing import MARGIN, PLAIN, WIDTH, Box, Canvas, Drawing, DrawnLine, Text, TextStyle
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
"""What is drawn at most."""

BOLD = TextStyle(bold=True)
DIM = TextStyle(NOTE, style="dim")
INDEX = TextStyle(PLAIN, "middle", bold=True)


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
        canvas.text(f"and {len(found) - MOST_LEVELS} more arrays", MARGIN, canvas.y + LINE, NAMES, DIM)
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
    head = f"{level.path}, {level.letter} = {level.array.first} to {level.last}"
    canvas.text(head, left, canvas.y, WIDTH - MARGIN - left, BOLD)
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
        canvas.text(f"and {len(level.branch.children) - MOST_ROWS} more members", left, canvas.y, NAMES - left, DIM)
    canvas.y += 14


def _x(level: Level, column: int) -> float:
    """Return where an element begins; the last may stand behind a gap."""
    return CELLS + CELL * column + (GAP if level.gap and column == SHOWN else 0)


def _heads(canvas: Canvas, level: Level) -> None:
    """Draw the index of each element, the arrow to the next one, and what the columns beside them are."""
    canvas.y += 16
    step = level.step
    if step is not None:
        _arrow(canvas, f"{step:+d}", canvas.y)
    canvas.y += 25
    for column, element in enumerate(level.elements):
        canvas.text(f"[{level.array.first + element}]", _x(level, column) + CELL / 2, canvas.y, CELL - 4, INDEX)
    if level.gap:
        canvas.add(Text(_x(level, SHOWN) - GAP / 2, canvas.y, "…", PLAIN, "middle"))
    if level.start is not None:
        canvas.add(Text(OFFSETS, canvas.y, "offset", NOTE, "end", "dim"))
    canvas.add(Text(FORMULAS, canvas.y, "address", NOTE, "start", "dim"))
    canvas.y += 8


def _arrow(canvas: Canvas, text: str, y: float) -> None:
    start, end = CELLS + CELL / 2, CELLS + CELL * 1.5
    canvas.text(text, (start + end) / 2, y + 2, CELL, TextStyle(NOTE, "middle", "dim"))
    canvas.add(DrawnLine(((start, y + 10), (start, y + 6), (end, y + 6), (end, y + 10))))
    canvas.add(DrawnLine(((end - 3, y + 6.5), (end, y + 10), (end + 3, y + 6.5))))


def _member(canvas: Canvas, level: Level, child: Leaf | Branch, number: int, left: float) -> None:
    """Draw one member: its name, its offset, its address in each element, and the formula of each view."""
    rules = tuple(_rules(child))
    name, note = _names(child, level)
    room = NAMES - left - 12
    names = wrap(clean(name), room, PLAIN, lines=3)
    height = max(len(names) + 1, len(rules)) * LINE + 6
    for line, part in enumerate(names):
        canvas.text(part, left + 12, canvas.y + 13 + LINE * line, room)
    canvas.text(note, left + 12, canvas.y + 13 + LINE * len(names), room, DIM)
    if level.start is not None:
        offset = TextStyle(PLAIN, "end")
        canvas.text(f"+{level.span(child, 0)[0] - level.start}", OFFSETS, canvas.y + 13, 44, offset)
    for column, element in enumerate(level.elements):
        canvas.add(Box(_x(level, column) + 1, canvas.y + 1, CELL - 4, height - 4, tint(number), radius=2))
        words = span_words(*level.span(child, element), "..")
        size = PLAIN if ".." not in words else NOTE
        like = TextStyle(size, "middle")
        canvas.text(words, _x(level, column) + CELL / 2 - 1, canvas.y + height / 2 + 3, CELL - 6, like)
    for line, rule in enumerate(rules):
        like = TextStyle(PLAIN - 1) if line == 0 else DIM
        canvas.text(rule, FORMULAS, canvas.y + 13 + LINE * line, WIDTH - MARGIN - FORMULAS, like)
    canvas.y += height


def _names(child: Leaf | Branch, level: Level) -> tuple[str, str]:
    """Return the name of a member and, as a note, how a program names it and which models have it."""
    shared = child.register if isinstance(child, Leaf) else child.array
    every = level.branch.array.models
    only = set_words(shared.models, every) if len(shared.models) < len(every) else ""
    if isinstance(child, Leaf):
        return lettered_name(child.register.first.name), ", ".join(filter(None, (f".{child.register.first.id}", only)))
    inner = child.array.first
    return f"{inner.name} {inner.first} to {inner.first + inner.count - 1}", ", ".join(
        filter(None, (f".{inner.id}", only))
    )


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
