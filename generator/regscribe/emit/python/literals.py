"""Text of a map as Python: literals, docstrings and names. A map is untrusted; nothing of it is pasted as it is."""

import re
import textwrap
from enum import Enum
from fractions import Fraction

from regscribe.emit.python.formatting import INDENT, WIDTH, width
from regscribe.model import Number, show


def literal(text: str) -> str:
    """A string literal in the quotes that `ruff format` prefers."""
    quoted = repr(str(text))
    if quoted[0] == "'" and '"' not in text:
        return f'"{quoted[1:-1]}"' if "'" not in text else '"' + quoted[1:-1].replace("\\'", "'") + '"'
    if "'" in text and '"' in text and text.count('"') <= text.count("'"):
        return '"' + quoted[1:-1].replace("\\'", "'").replace('"', '\\"') + '"'
    return quoted


def exact(number: Number) -> str:
    """A number without loss: an int or a fraction."""
    return str(number.numerator) if number.denominator == 1 else f"Fraction({literal(show(number))})"


def member(value: Enum) -> str:
    """A member of an enum of the runtime; a row that is made when it is asked for, by its value."""
    name = type(value).__name__
    return f"{name}.{value.name}" if value.name in type(value).__members__ else f"{name}({literal(value.value)})"


def plain(number: Fraction) -> str:
    """A number as people write it: an int or a float literal."""
    return str(number.numerator) if number.denominator == 1 else repr(float(number))


def camel(identifier: str) -> str:
    """`input_type` as `InputType`; characters that no identifier may have are dropped."""
    return "".join(part[:1].upper() + part[1:] for part in re.split(r"[^A-Za-z0-9]+", identifier))


def docstring(text: str, depth: int, more: str = "") -> list[str]:
    """The lines of a docstring of one paragraph, escaped and wrapped; `more` is a second paragraph."""
    indent = INDENT * depth
    room = WIDTH - len(indent) - 3
    safe = _safe(text)
    if width(safe) <= room - 3 and not more:
        return [f'{indent}"""{safe}"""']
    first, *rest = textwrap.wrap(safe, room, break_long_words=False, break_on_hyphens=False)
    if not rest and width(safe) > room - 3:  # nor do the closing quotes go alone on the second line
        first, *rest = textwrap.wrap(safe, min(room, len(safe)) - 3, break_long_words=False, break_on_hyphens=False)
    if not rest and not more:
        return [f'{indent}"""{safe}"""']
    below = [*rest, *(["", *textwrap.wrap(_safe(more), WIDTH - len(indent), break_long_words=False)] if more else [])]
    return [f'{indent}"""{first}', *(f"{indent}{line}" if line else "" for line in below), f'{indent}"""']


def _safe(text: str) -> str:
    printable = text
    if not text.isprintable():
        printable = "".join(character if character.isprintable() else " " for character in text)
    return " ".join(printable.split()).replace("\\", "/").replace('"', "'")
