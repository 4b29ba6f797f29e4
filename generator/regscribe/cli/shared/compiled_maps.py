"""The compiled maps that a command works on."""

from collections.abc import Iterable
from pathlib import Path
from time import perf_counter

from regscribe.cli.shared.diagnostic_text import report
from regscribe.cli.shared.output import detail
from regscribe.cli.shared.standard_input import STDIN, input_text, is_stdin
from regscribe.model import RegisterMap
from regscribe.pipeline import Compiled, compile_map
from regscribe.source import display_name
from regscribe.source.load import MAX_BYTES


def compiled(path: Path, *, name: Path = Path(STDIN)) -> Compiled:
    """Compile one map, and tell of it with --verbose; `-` is standard input, as if it were the file `name`."""
    started = perf_counter()
    text = input_text(display_name(name), MAX_BYTES) if is_stdin(path) else None
    made = compile_map(path) if text is None else compile_map(name, {name: text})
    for file in (path, *(file for file, _ in made.files if file != made.path)):
        detail(f"read {file}")
    detail(f"compiled {path} in {perf_counter() - started:.2f} s")
    return made


def compiled_maps(paths: Iterable[Path], *, nothing: str, warned: bool = True) -> list[RegisterMap]:
    """Compile maps; where one has errors, say `nothing` (`nothing was exported`) and end the command with code 1.

    Not `warned`: warnings alone are not told, as standard error is for a program to read.
    """
    made = [compiled(path) for path in paths]
    maps = [one.map for one in made if one.map is not None]
    diagnostics = [diagnostic for one in made for diagnostic in one.diagnostics]
    failed = len(maps) < len(made)
    if warned or failed:
        report(diagnostics, failed=failed, nothing=nothing)
    return maps
