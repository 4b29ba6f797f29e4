"""Styled text to a stream: in colour on a terminal, plain everywhere else."""

import os
import sys
from collections.abc import Iterable
from typing import TextIO

Piece = tuple[str, str]
"""A text and its style, as rich names styles (`bold red`); an empty style is plain."""


def show(pieces: Iterable[Piece], *, stream: TextIO | None = None) -> None:
    """Write the pieces to `stream` (standard output); nothing is added between or after them."""
    out = sys.stdout if stream is None else stream
    if not in_colour(out):
        out.write("".join(text for text, _ in pieces))
        return
    from rich.console import Console  # noqa: PLC0415 - 60 ms that only a terminal needs
    from rich.text import Text  # noqa: PLC0415 - as above

    console = Console(file=out, highlight=False, soft_wrap=True)
    console.print(Text.assemble(*pieces), end="")


def in_colour(stream: TextIO) -> bool:
    """Whether `stream` is a terminal whose user wants colour (see no-color.org)."""
    return stream.isatty() and not os.environ.get("NO_COLOR") and os.environ.get("TERM") != "dumb"
