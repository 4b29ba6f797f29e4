"""The maps that a command works on: compiled, and what is wrong in them told on standard error."""

import sys
from collections.abc import Iterable
from pathlib import Path

import click

from regscribe.cli.shared.diagnostic_text import findings, tally
from regscribe.cli.shared.output import show, warn
from regscribe.model import RegisterMap
from regscribe.pipeline import compile_map


def compiled_maps(paths: Iterable[Path], *, nothing: str) -> list[RegisterMap]:
    """Compile maps; where one has errors, say `nothing` (`nothing was exported`) and end the command with code 1."""
    compiled = [compile_map(path) for path in paths]
    found = [diagnostic for one in compiled for diagnostic in one.diagnostics]
    show(findings(found), stream=sys.stderr)
    maps = [one.map for one in compiled if one.map is not None]
    if len(maps) < len(compiled):
        warn(f"{nothing}: {tally(found)}\n")
        raise click.exceptions.Exit(1)
    return maps
