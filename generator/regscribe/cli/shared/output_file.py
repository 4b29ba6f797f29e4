"""What a command writes into a file that the user names; `-` is standard output."""

from pathlib import Path

import click

from regscribe import files
from regscribe.cli.shared.exit_codes import OUTPUT
from regscribe.cli.shared.failure import Failure, unwritten
from regscribe.cli.shared.output import detail, remark, tell, tell_bytes
from regscribe.cli.shared.standard_input import STDOUT

KILO = 1000


def none_for_stdout(_context: click.Context, _option: click.Parameter, value: Path | None) -> Path | None:
    """Callback of an option whose absence means standard output: `-` means it, too."""
    return None if str(value) == STDOUT else value


def make_folder(path: Path) -> None:
    """Make a folder and those above it. Raises Failure."""
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        message = f"cannot make the folder {path}: {error.strerror or error}"
        raise Failure(message, kind="file", code=OUTPUT) from None


def save(path: Path, content: str | bytes, *, new: bool = False) -> None:
    """Write a file (with `new`, where there is none) whole or not at all, told of with --verbose; print for `-`.

    Raises Failure where it cannot be written.
    """
    if str(path) != STDOUT:
        with unwritten(files.UnwrittenError):
            files.save(path, content, new=new)
        detail(f"wrote {path}")
    elif isinstance(content, str):
        tell(content)
    else:
        tell_bytes(content, "this")


def save_result(path: Path, content: str | bytes, *about: str) -> None:
    """As `save`, of what the command was asked for: a remark says what is in the file, and how large it is."""
    if str(path) == STDOUT:
        save(path, content)
    else:
        with unwritten(files.UnwrittenError):
            files.save(path, content)
        octets = len(content.encode() if isinstance(content, str) else content)
        size = f"{octets} bytes" if octets < KILO else f"{octets / KILO:.0f} kB"
        remark(f"wrote {path}: {', '.join((*about, size))}")
