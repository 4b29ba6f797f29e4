"""Standard input in place of a file, wherever a command takes one: its name is `-`."""

import sys
from pathlib import Path

import click

from regscribe.cli.shared.output import refuse, remark

STDIN = STDOUT = "-"
"""In place of a file that is read or written. A file of this name is `./-`."""

KEY = f"{__name__}.text"


def is_stdin(path: Path | str) -> bool:
    """Whether a path stands for standard input."""
    return str(path) == STDIN


def input_text(name: str, most: int) -> str:
    """All of standard input as text, read once a run and called `name`; of more than `most` bytes the rest is left.

    A byte that is not UTF-8 becomes a surrogate, which whoever parses the text refuses at its place.
    """
    kept = click.get_current_context().meta
    if KEY not in kept:
        if sys.stdin.isatty():
            remark("reading standard input; Ctrl-D ends it")
        kept[KEY] = (name, input_bytes(most).decode("utf-8", "surrogateescape"))
    return str(kept[KEY][1])


def input_bytes(most: int) -> bytes:
    """All of standard input, at most `most` bytes and one. Raises click.UsageError where it cannot be read."""
    try:
        return sys.stdin.buffer.read(most + 1)
    except OSError as error:
        refuse(f"cannot read standard input: {error.strerror or error}")


def kept_text(name: str) -> str | None:
    """What was read of standard input and called `name`; None where nothing was."""
    context = click.get_current_context(silent=True)
    kept, text = context.meta.get(KEY, ("", "")) if context else ("", "")
    return text if name and kept == name else None
