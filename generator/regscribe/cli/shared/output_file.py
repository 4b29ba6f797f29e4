"""What a command writes into a file that the user names; `-` is standard output."""

from pathlib import Path

import click

from regscribe import files
from regscribe.cli.shared.output import detail, tell, tell_bytes
from regscribe.cli.shared.standard_input import STDOUT


def none_for_stdout(_context: click.Context, _option: click.Parameter, value: Path | None) -> Path | None:
    """Callback of an option whose absence means standard output: `-` means it, too."""
    return None if str(value) == STDOUT else value


def save(path: Path, content: str | bytes) -> None:
    """Write a file whole or not at all, and tell of it with --verbose; print for `-`. Raises FileError."""
    if str(path) != STDOUT:
        files.save(path, content)
        detail(f"wrote {path}")
    elif isinstance(content, str):
        tell(content)
    else:
        tell_bytes(content, "this")
