"""Expressions of generated code, laid out as `ruff format` would: emitted formatted, never formatted afterwards."""

import re
import unicodedata
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

WIDTH = 120
INDENT = "    "
_NOT_ASCII = re.compile(r"[^\x00-\x7f]")


@dataclass(frozen=True, slots=True)
class Call:
    """A bracketed list: `opening` (a name and its bracket), items each with a prefix such as `unit=`, a bracket."""

    opening: str
    items: tuple[tuple[str, "Expression"], ...]
    closing: str = ")"


Expression = str | Call


def width(text: str) -> int:
    """The columns of a text as `ruff format` counts them: two for a wide character, none for a combining one."""
    return len(text) if text.isascii() else len(text) + sum(_columns(one) - 1 for one in _NOT_ASCII.findall(text))


@cache
def _columns(character: str) -> int:
    if unicodedata.category(character) in {"Mn", "Me", "Cf"}:
        return 0
    return 2 if unicodedata.east_asian_width(character) in "WF" else 1


def call(name: str, /, *positional: Expression, **keywords: Expression | None) -> Call:
    """A call; keyword arguments that are None are left out."""
    items = [("", item) for item in positional]
    items += [(f"{key}=", item) for key, item in keywords.items() if item is not None]
    return Call(f"{name}(", tuple(items))


def group(items: Sequence[Expression]) -> Call:
    """A tuple."""
    return Call("(", tuple(("", item) for item in items))


def mapping(items: Sequence[tuple[str, Expression]]) -> Call:
    """A dict display of (key, value)."""
    return Call("{", tuple((f"{key}: ", value) for key, value in items), "}")


def flat(expression: Expression) -> str:
    """The expression on one line."""
    if isinstance(expression, str):
        return expression
    inside = ", ".join(prefix + flat(item) for prefix, item in expression.items)
    comma = "," if expression.opening == "(" and len(expression.items) == 1 else ""
    return f"{expression.opening}{inside}{comma}{expression.closing}"


def lay(expression: Expression, *, head: str, tail: str = "", depth: int = 0) -> list[str]:
    """The lines of `head` + expression + `tail`, split from the outermost bracket inward where they are too long."""
    whole = f"{INDENT * depth}{head}{flat(expression)}{tail}"
    if width(whole) <= WIDTH or isinstance(expression, str) or not expression.items:
        return [whole]
    body = ", ".join(prefix + flat(item) for prefix, item in expression.items)
    display = len(expression.opening) == 1  # a tuple or dict is split one item a line, a call only where it must
    lines = [f"{INDENT * depth}{head}{expression.opening}"]
    if len(INDENT) * (depth + 1) + width(body) <= WIDTH and not display:
        lines.append(f"{INDENT * (depth + 1)}{body}")
    else:
        for prefix, item in expression.items:
            lines += lay(item, head=prefix, tail=",", depth=depth + 1)
    return [*lines, f"{INDENT * depth}{expression.closing}{tail}"]
