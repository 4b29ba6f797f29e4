"""`regscribe browse`: all registers of maps as one HTML file, with a search and a calculator."""

from pathlib import Path

import click

from regscribe import register_browser
from regscribe.cli.shared.compiled_maps import compiled_maps
from regscribe.cli.shared.completion_values import complete_map
from regscribe.cli.shared.diagnostic_text import count
from regscribe.cli.shared.map_arguments import find_maps
from regscribe.cli.shared.map_builds import counts_of
from regscribe.cli.shared.output import tell
from regscribe.cli.shared.output_file import none_for_stdout, save_result


@click.command(
    epilog="Example: regscribe browse fdc/series-100 -o registers.html\n\n"
    "Exit code 0: done, 1: errors in a map (nothing is written), 2: wrong usage.",
)
@click.argument("maps", nargs=-1, metavar="[MAP]...", shell_complete=complete_map)
@click.option(
    "-o",
    "--out",
    type=click.Path(path_type=Path),
    callback=none_for_stdout,
    metavar="FILE",
    help="Where it goes; else standard output.",
)
def command(*, maps: tuple[str, ...], out: Path | None) -> int:
    """Make one HTML file that shows the registers of maps: search, details, and a calculator raw <-> value.

    MAP is a map file, a folder that is searched for *.yaml, or the id of a map (fdc/series-100). Without MAP: maps/.
    The file needs no server and no network; any browser opens it from disk.
    """
    register_maps = compiled_maps(find_maps(maps), nothing="nothing was written")
    text = register_browser.page(register_maps)
    if out is None:
        tell(text)
    else:
        registers = sum(counts_of(one).registers for one in register_maps)
        save_result(out, text, count(len(register_maps), "map"), count(registers, "register"))
    return 0
