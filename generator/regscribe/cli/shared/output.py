"""Everything that commands print passes through here; tables and colours on a terminal only."""

import os
import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, NoReturn, TextIO

import click

from regscribe.cli.shared.global_options import color, is_quiet, is_verbose
from regscribe.visible import json_text, safe, tame

if TYPE_CHECKING:
    from rich.console import Console

Piece = tuple[str, str]
"""A text and its style in the words of rich (`bold red`); an empty style is plain."""


def refuse(message: str) -> NoReturn:
    """End the command as wrongly used. Raises click.UsageError."""
    raise click.UsageError(message)


@contextmanager
def raised_as(kind: type[click.ClickException], *errors: type[Exception]) -> Iterator[None]:
    """Turn errors in the block into one that ends the command with the same message."""
    try:
        yield
    except errors as error:
        raise kind(str(error)) from None


def tell(text: str) -> None:
    """Write to standard output, with control characters spelled out."""
    sys.stdout.write(tame(text))


def tell_bytes(content: bytes, what: str) -> None:
    """Write what is no text to standard output as it is. Raises click.UsageError on a terminal, which would obey it."""
    if sys.stdout.isatty():
        refuse(f"{what} is no text: name a file with -o")
    sys.stdout.buffer.write(content)


def warn(text: str) -> None:
    """Write to standard error, with control characters spelled out."""
    sys.stderr.write(tame(text))


def show(pieces: Iterable[Piece], *, stream: TextIO | None = None) -> None:
    """Write styled texts to `stream` (standard output), with control characters spelled out and nothing in between."""
    out = sys.stdout if stream is None else stream
    tamed = [(tame(text), style) for text, style in pieces]
    if not in_colour(out):
        out.write("".join(text for text, _ in tamed))
        return
    from rich.text import Text  # noqa: PLC0415 - 60 ms that only a terminal needs

    console(out).print(Text.assemble(*tamed), end="", soft_wrap=True)


def in_colour(stream: TextIO) -> bool:
    """Whether `stream` gets colours: by --color, else NO_COLOR, FORCE_COLOR or CLICOLOR_FORCE, TERM, the terminal.

    See https://no-color.org, https://force-color.org and https://bixense.com/clicolors.
    """
    if color() != "auto":
        return color() == "always"
    if os.environ.get("NO_COLOR"):
        return False
    if os.environ.get("FORCE_COLOR") or os.environ.get("CLICOLOR_FORCE", "0") not in {"", "0"}:
        return True
    return stream.isatty() and os.environ.get("TERM") != "dumb"


def console(stream: TextIO) -> "Console":
    """What draws on `stream`, in colours as far as it gets any, whatever rich itself makes of the environment."""
    from rich.console import Console  # noqa: PLC0415 - 60 ms that only a terminal needs

    coloured = in_colour(stream)
    return Console(
        file=stream,
        highlight=False,
        no_color=not coloured,
        color_system="standard" if coloured else None,
        force_terminal=stream.isatty(),
    )


def show_table(columns: Sequence[str], rows: Iterable[Sequence[str]], *, title: str = "") -> None:
    """Print a table; cells are taken for neither markup nor control characters."""
    cells = [[safe(cell) for cell in row] for row in rows]
    if sys.stdout.isatty():
        _rich_table(columns, cells, title)
        return
    if title:
        show([(f"# {safe(title)}\n", "bold")])
    widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
    for row in cells:
        first, *others = (cell.ljust(width) for cell, width in zip(row, widths, strict=True))
        show([(first if any(map(str.strip, others)) else first.rstrip(), "cyan"), (_joined(others), ""), ("\n", "")])


def _joined(cells: Iterable[str]) -> str:
    """Cells behind the first of their row, without blanks at the end."""
    return "".join(f"  {cell}" for cell in cells).rstrip()


def _rich_table(columns: Sequence[str], rows: Sequence[Sequence[str]], title: str) -> None:
    from rich.table import Table  # noqa: PLC0415 - 60 ms that only a terminal needs
    from rich.text import Text  # noqa: PLC0415 - as above

    heading = Text(safe(title), style="bold") if title else None
    table = Table(box=None, title=heading, title_justify="left", pad_edge=False)
    for number, name in enumerate(columns):
        table.add_column(Text(name), style="" if number else "cyan", header_style="bold")
    for row in rows:
        table.add_row(*map(Text, row))
    console(sys.stdout).print(table)


def print_json(**members: Any) -> None:  # noqa: ANN401 - anything that JSON can hold
    """Print one object, with `format`, the version of its shape, as the first member."""
    tell(json_text({"format": 1, **members}, indent=2) + "\n")


def print_json_line(**members: Any) -> None:  # noqa: ANN401 - as above
    """Print one object on one line and flush: for output without an end."""
    tell(json_text({"format": 1, **members}) + "\n")
    sys.stdout.flush()


def alert(text: str) -> None:
    """Write a line that says what is wrong to standard error."""
    warn(f"{safe(text)}\n")


def remark(text: str) -> None:
    """Write a line for people, beside the result, to standard error; nothing with --quiet."""
    if not is_quiet():
        alert(text)


def detail(text: str) -> None:
    """Write which file, which configuration or how long to standard error; with --verbose only."""
    if is_verbose():
        alert(text)


def tell_done(text: str) -> None:
    """Write to standard output what was done, where that is not what was asked for; nothing with --quiet."""
    if not is_quiet():
        tell(text)


def hexadecimal(words: Iterable[int]) -> str:
    """Words of 16 bits as hexadecimal digits: `0FA0 0001`."""
    return " ".join(f"{word:04X}" for word in words)
