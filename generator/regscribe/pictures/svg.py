"""A drawing as SVG text: valid XML whatever the map says, the same bytes every time."""

import html
from collections.abc import Iterator
from functools import singledispatch

from regscribe.pictures.drawing import Box, Drawing, DrawnLine, Text
from regscribe.pictures.style import PATTERNS, css
from regscribe.pictures.text_width import clean


def svg(drawing: Drawing, header: str) -> str:
    """Return the file of a drawing; `header` is the comment at its top."""
    used = {name for item in drawing.items for name in item.style.split()}
    patterns = used & {"unused", "reserved"}
    styles = css(used | {"hatch"} if patterns else used)
    size = f'width="{_number(drawing.width)}" height="{_number(drawing.height)}"'
    box = f'viewBox="0 0 {_number(drawing.width)} {_number(drawing.height)}"'
    return "\n".join(
        (
            f"<!-- {header.replace('--', '__')} -->",
            f'<svg xmlns="http://www.w3.org/2000/svg" {size} {box} role="img" aria-labelledby="title desc">',
            f'<title id="title">{_escape(drawing.title)}</title>',
            f'<desc id="desc">{_escape(drawing.description)}</desc>',
            f"<style>{styles}</style>",
            *((f"<defs>{PATTERNS}</defs>",) if patterns else ()),
            *(_item(item) for item in drawing.items),
            "</svg>\n",
        )
    )


@singledispatch
def _item(item: object) -> str:
    message = f"{item!r} is nothing that can be drawn"
    raise TypeError(message)


@_item.register
def _box(item: Box) -> str:
    numbers = {"x": item.x, "y": item.y, "width": item.width, "height": item.height}
    places = "".join(f' {name}="{_number(value)}"' for name, value in numbers.items())
    radius = f' rx="{_number(item.radius)}"' if item.radius else ""
    return _element("rect", f'{places}{radius} class="{item.style}"', item.tip, "")


@_item.register
def _line(item: DrawnLine) -> str:
    points = "L".join(f"{_number(x)} {_number(y)}" for x, y in item.points)
    return _element("path", f' d="M{points}" class="{item.style}"', "", "")


@_item.register
def _text(item: Text) -> str:
    return _element("text", "".join(_text_attributes(item)), item.tip, _escape(item.text))


def _text_attributes(item: Text) -> Iterator[str]:
    yield f' x="{_number(item.x)}" y="{_number(item.y)}" font-size="{_number(item.size)}"'
    if item.anchor != "start":
        yield f' text-anchor="{item.anchor}"'
    if item.bold:
        yield ' font-weight="bold"'
    yield f' class="{item.style}"'


def _element(name: str, attributes: str, tip: str, content: str) -> str:
    inside = (f"<title>{_escape(tip)}</title>" if tip else "") + content
    return f"<{name}{attributes}>{inside}</{name}>" if inside else f"<{name}{attributes}/>"


def _escape(text: str) -> str:
    return html.escape(clean(text), quote=False)


def _number(value: float) -> str:
    """Return a number with at most one decimal and no trailing zero."""
    return f"{value:.1f}".removesuffix(".0")
