"""The compiled maps that a command works on."""

from collections.abc import Iterable
from pathlib import Path

from regscribe.cli.shared.diagnostic_text import report
from regscribe.model import RegisterMap
from regscribe.pipeline import compile_map


def compiled_maps(paths: Iterable[Path], *, nothing: str, warned: bool = True) -> list[RegisterMap]:
    """Compile maps; where one has errors, say `nothing` (`nothing was exported`) and end the command with code 1.

    Not `warned`: warnings alone are not told, as standard error is for a program to read.
    """
    compiled = [compile_map(path) for path in paths]
    maps = [one.map for one in compiled if one.map is not None]
    diagnostics = [diagnostic for one in compiled for diagnostic in one.diagnostics]
    failed = len(maps) < len(compiled)
    if warned or failed:
        report(diagnostics, failed=failed, nothing=nothing)
    return maps
