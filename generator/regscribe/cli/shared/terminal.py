"""The door to the terminal, through which all that commands print goes; styled text is in colour on a terminal only."""

import os
import sys
from collections.abc import Iterable
from typing import TextIO

from regscribe.visible import tame

Piece = tuple[str, str]
"""A text and its style, as rich names styles (`bold red`); an empty style is plain."""


def tell(text: str) -> None:
    """Write to standard output; nothing of the text is obeyed by a terminal."""
    sys.stdout.write(tame(text))


def warn(text: str) -> None:
    """As `tell`, to standard error."""
    sys.stderr.write(tame(text))


def show(pieces: Iterable[Piece], *, stream: TextIO | None = None) -> None:
    """Write the pieces to `stream` (standard output) as `tell` does; nothing is added between or after them."""
    out = sys.stdout if stream is None else stream
    tamed = [(tame(text), style) for text, style in pieces]
    if not in_colour(out):
        out.write("".join(text for text, _ in tamed))
        return
    from rich.console import Console  # noqa: PLC0415 - 60 ms that only a terminal needs
    from rich.text import Text  # noqa: PLC0415 - as above

    console = Console(file=out, highlight=False, soft_wrap=True)
    console.print(Text.assemble(*tamed), end="")


def in_colour(stream: TextIO) -> bool:
    """Whether `stream` is a terminal whose user wants colour (see no-color.org)."""
    return stream.isatty() and not os.environ.get("NO_COLOR") and os.environ.get("TERM") != "dumb"
