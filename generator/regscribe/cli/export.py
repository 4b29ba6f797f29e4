"""`regscribe export`: every value of every model as CSV or JSON."""

import sys

import click

from regscribe.cli.locate import find_maps
from regscribe.cli.terminal import show
from regscribe.cli.text import findings, tally
from regscribe.emit.export import csv_text, json_text
from regscribe.pipeline import compile_map


@click.command(
    name="export",
    epilog="Example: regscribe export fdc/series-100 --format csv > series-100.csv\n\n"
    "Exit code 0: done, 1: errors in a map (nothing is printed to standard output), 2: wrong usage.",
)
@click.argument("maps", nargs=-1, metavar="[MAP]...")
@click.option("--format", "form", type=click.Choice(["csv", "json"]), required=True)
def command(*, maps: tuple[str, ...], form: str) -> int:
    """Print every value of every model to standard output, arrays expanded.

    MAP is a map file, a folder that is searched for *.yaml, or the id of a map (fdc/series-100). Without MAP: maps/.
    """
    compiled = [compile_map(path) for path in find_maps(maps)]
    found = [diagnostic for one in compiled for diagnostic in one.diagnostics]
    show(findings(found), stream=sys.stderr)
    register_maps = [one.map for one in compiled if one.map is not None]
    if len(register_maps) < len(compiled):
        sys.stderr.write(f"nothing was exported: {tally(found)}\n")
        return 1
    sys.stdout.write(csv_text(register_maps) if form == "csv" else json_text(register_maps))
    return 0
