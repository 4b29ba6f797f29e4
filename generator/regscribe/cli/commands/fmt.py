"""`regscribe fmt`: lay out maps in their canonical form."""

import sys
from dataclasses import dataclass
from pathlib import Path

import click

from regscribe import files, source
from regscribe.cli.shared.diagnostic_text import count, findings
from regscribe.cli.shared.map_arguments import find_maps
from regscribe.cli.shared.output import raised_as, refuse, show, tell, tell_bytes, warn
from regscribe.cli.shared.output_file import save
from regscribe.cli.shared.standard_input import STDIN, input_bytes
from regscribe.emit.write import difference
from regscribe.map_format import FormatError, formatted
from regscribe.source import Document
from regscribe.source.load import MAX_BYTES
from regscribe.visible import safe, safe_lines


@dataclass(slots=True)
class Tally:
    """How many files became other ones, stayed, or are no maps."""

    changed: int = 0
    same: int = 0
    refused: int = 0


@click.command(
    epilog="Example: regscribe fmt maps/ --check\n\n"
    "Exit code 0: done, 1: a file that is no YAML or cannot be written, or with --check a difference, 2: wrong usage.",
)
@click.argument("paths", nargs=-1, metavar="[PATH]...")
@click.option("--check", is_flag=True, help="Write nothing; show what would change and exit 1 if anything would.")
@click.option(
    "--stdin-filename", metavar="NAME", default="stdin", help="What messages call the text of standard input."
)
def command(*, paths: tuple[str, ...], check: bool, stdin_filename: str) -> int:
    """Lay out maps and libraries in their canonical form.

    PATH is a map file, a folder that is searched for *.yaml, or the id of a map (fdc/series-100); `-` reads standard
    input and prints. Without PATH: maps/.

    Indentation, blanks, needless quotes, the columns of comments and rows that are too wide are settled. Values,
    comments, the order of keys, what stands in brackets and where lines end stay. What is no YAML stays as it is.
    """
    if STDIN in paths:
        if len(paths) > 1:
            refuse("`-` is standard input alone: name no other files beside it")
        return _standard_input(stdin_filename, check=check)
    done = Tally()
    with raised_as(click.ClickException, files.FileError):
        for path in find_maps(paths, libraries=True):
            _file(path, done, check=check)
    said = f"{done.changed} {'to format' if check else 'formatted'}, {done.same} unchanged"
    refused = f", {done.refused} that cannot be read" if done.refused else ""
    tell(f"{count(done.changed + done.same + done.refused, 'file')}: {said}{refused}\n")
    return int(bool(done.refused or (check and done.changed)))


def _file(path: Path, done: Tally, *, check: bool) -> None:
    """Format one file, or with `check` show what would change."""
    document, diagnostics = source.load(path)
    show(findings(diagnostics), stream=sys.stderr)
    text = _formatted(document) if document else None
    if text is None:
        done.refused += 1
        return
    before = path.read_bytes()
    if text.encode() == before:
        done.same += 1
        return
    done.changed += 1
    if check:
        tell(safe_lines(difference(path.as_posix(), before, text.encode())))
        return
    save(path, text)
    tell(safe(f"{path} formatted") + "\n")


def _standard_input(name: str, *, check: bool) -> int:
    """Print the canonical form of standard input, or with `check` what would change."""
    before = input_bytes(MAX_BYTES)
    document, diagnostics = source.parse(before, name=name)
    show(findings(diagnostics), stream=sys.stderr)
    text = _formatted(document) if document else None
    if text is None:
        return 1
    if check:
        tell(safe_lines(difference(name, before, text.encode())))
        return int(text.encode() != before)
    if sys.stdout.isatty():
        tell(text)
    else:
        tell_bytes(text.encode(), name)
    return 0


def _formatted(document: Document) -> str | None:
    """Return the canonical form; None, after a message, where there is none."""
    try:
        return formatted(document)
    except FormatError as error:
        warn(f"{safe(document.name)}: {error}; it was left as it is. Please report it with the file\n")
        return None
