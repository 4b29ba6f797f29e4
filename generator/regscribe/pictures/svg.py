"""A drawing as SVG text: valid XML whatever the map says, the same bytes every time."""

import html

from regscribe.pictures.drawing import Drawing, DrawnLine, Item, Text
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


def _item(item: Item) -> str:
    if isinstance(item, DrawnLine):
        points = "L".join(f"{_number(x)} {_number(y)}" for x, y in item.points)
        return _element("path", f'd="M{points}" class="{item.style}"', "")
    place = f'x="{_number(item.x)}" y="{_number(item.y)}"'
    tip = f"<title>{_escape(item.tip)}</title>" if item.tip else ""
    if isinstance(item, Text):
        anchor = f' text-anchor="{item.anchor}"' if item.anchor != "start" else ""
        weight = ' font-weight="bold"' if item.bold else ""
        attributes = f'{place} font-size="{_number(item.size)}"{anchor}{weight} class="{item.style}"'
        return _element("text", attributes, tip + _escape(item.text))
    size = f'width="{_number(item.width)}" height="{_number(item.height)}"'
    radius = f' rx="{_number(item.radius)}"' if item.radius else ""
    return _element("rect", f'{place} {size}{radius} class="{item.style}"', tip)


def _element(name: str, attributes: str, inside: str) -> str:
    return f"<{name} {attributes}>{inside}</{name}>" if inside else f"<{name} {attributes}/>"


def _escape(text: str) -> str:
    return html.escape(clean(text), quote=False)


def _number(value: float) -> str:
    """Return a number with at most one decimal and no trailing zero."""
    return f"{value:.1f}".removesuffix(".0")
