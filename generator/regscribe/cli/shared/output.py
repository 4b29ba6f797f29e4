"""How live commands print: tables (by rich on a terminal, aligned text when piped), JSON objects, remarks."""

import sys
from collections.abc import Iterable, Sequence
from typing import Any

from regscribe.cli.shared.terminal import tell, warn
from regscribe.visible import json_text, safe

GAP = "  "


def show_table(columns: Sequence[str], rows: Iterable[Sequence[str]], *, title: str = "") -> None:
    """Print a table; nothing of a cell is taken for markup or for control of the terminal."""
    cells = [[safe(cell) for cell in row] for row in rows]
    if sys.stdout.isatty():
        _rich_table(columns, cells, title)
    else:
        _plain_table(cells, title)


def _plain_table(rows: Sequence[Sequence[str]], title: str) -> None:
    if title:
        tell(f"# {safe(title)}\n")
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)] if rows else []
    for row in rows:
        line = GAP.join(cell.ljust(width) for cell, width in zip(row, widths, strict=True))
        tell(f"{line.rstrip()}\n")


def _rich_table(columns: Sequence[str], rows: Sequence[Sequence[str]], title: str) -> None:
    from rich.console import Console  # noqa: PLC0415 - 60 ms that only a terminal needs
    from rich.table import Table  # noqa: PLC0415 - as above
    from rich.text import Text  # noqa: PLC0415 - as above

    heading = Text(safe(title), style="bold") if title else None
    table = Table(box=None, title=heading, title_justify="left", pad_edge=False)
    for number, name in enumerate(columns):
        table.add_column(Text(name), style="" if number else "cyan", header_style="bold")
    for row in rows:
        table.add_row(*map(Text, row))
    Console(highlight=False).print(table)


def print_json(**what: Any) -> None:  # noqa: ANN401 - anything that JSON can hold
    """Print one object; every command's has `format`, the version of its shape."""
    tell(json_text({"format": 1, **what}, indent=2) + "\n")


def print_json_line(**what: Any) -> None:  # noqa: ANN401 - as above
    """Print one object in one line, at once: for what goes on and on."""
    tell(json_text({"format": 1, **what}) + "\n")
    sys.stdout.flush()


def remark(text: str) -> None:
    """Tell a person something beside the result."""
    warn(f"{safe(text)}\n")


def hexadecimal(words: Iterable[int]) -> str:
    """Words of 16 bits as they stand on the wire: `0FA0 0001`."""
    return " ".join(f"{word:04X}" for word in words)
