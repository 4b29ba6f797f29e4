"""`regscribe compare`: hold a map against a second transcription, or against another map."""

import sys
from pathlib import Path

import click

from regscribe.cli.shared.comparison_text import as_csv, as_json, as_text
from regscribe.cli.shared.compiled_maps import compiled
from regscribe.cli.shared.completion_values import complete_map
from regscribe.cli.shared.diagnostic_text import findings, tally
from regscribe.cli.shared.map_arguments import find_map
from regscribe.cli.shared.output import raised_as, refuse, show, tell, warn
from regscribe.cli.shared.standard_input import input_bytes, is_stdin
from regscribe.evidence.compare import compare_maps, compare_table
from regscribe.evidence.table import MOST_BYTES, Table, TableError, read
from regscribe.model import RegisterMap

MAPS = {".yaml", ".yml"}
TABLES = {".csv", ".tsv", ".txt"}


@click.command(
    epilog="Example: regscribe compare athena/series-c second.csv --columns address,access,default=factory\n\n"
    "Exit code 0: nothing differs, 1: something does (or the map has errors), 2: wrong usage, or a table that is none.",
)
@click.argument("map_name", metavar="MAP", shell_complete=complete_map)
@click.argument("other", metavar="TABLE.csv|MAP")
@click.option("--columns", metavar="A,B,...", help="Compare only these; A=HEADER where the table calls it otherwise.")
@click.option("--model", default="", metavar="M", help="Only this model; the one of a table without column `model`.")
@click.option("--pair", "pairs", multiple=True, metavar="A=B", help="Two maps: these models belong together. Repeat.")
@click.option("--loose", is_flag=True, help="Ignore case and punctuation of texts; section 4.14 is that of 4.14.2.")
@click.option("--partial", is_flag=True, help="The table need not have every register.")
@click.option("--format", "form", type=click.Choice(["text", "json", "csv"]), default="text", show_default=True)
def command(
    *,
    map_name: str,
    other: str,
    columns: str | None,
    model: str,
    pairs: tuple[str, ...],
    loose: bool,
    partial: bool,
    form: str,
) -> int:
    """Hold a map against a second transcription in CSV, or against another map, and list what differs.

    MAP is a map file or the id of a map (fdc/series-100). The table has columns of `regscribe export`, any number of
    them; docs/evidence.md tells more. One of the two may be - for standard input.
    """
    wanted = _columns(columns)
    if is_stdin(map_name) and is_stdin(other):
        refuse("standard input can be the map or the table, not both")
    with raised_as(click.UsageError, TableError):
        table = None if _is_map(other) else _table(other)
        _refuse_foreign(table, model=model, pairs=pairs, partial=partial)
        names = [map_name] if table else [map_name, other]
        maps = [one for name in names if (one := _compiled(name))]
        if len(maps) < len(names):
            return 1
        if table:
            found = compare_table(maps[0], table, columns=wanted, model=model, loose=loose, partial=partial)
        else:
            found = compare_maps(maps[0], maps[1], pairs=_pairs(pairs, maps), columns=wanted, loose=loose)
    if form == "text":
        show(as_text(found))
    else:
        tell(as_json(found) if form == "json" else as_csv(found))
    return int(not found.equal)


def _columns(text: str | None) -> list[str]:
    if text is not None and not text.strip(" ,"):
        refuse("--columns names no column: leave it out to compare all that the table has")
    return [item.strip() for item in (text or "").split(",") if item.strip()]


def _is_map(other: str) -> bool:
    """Whether the second argument names a map: a YAML file, or neither a file nor a name with the ending of a table."""
    path = Path(other)
    if is_stdin(other):
        return False
    try:
        return path.suffix in MAPS or (path.suffix.lower() not in TABLES and not path.exists())
    except OSError:  # a name that is too long
        return True


def _table(other: str) -> Table:
    if is_stdin(other):
        return read(input_bytes(MOST_BYTES), "standard input")
    path = Path(other)
    if path.is_dir():
        refuse(f"{other} is a folder: name one table (CSV) or one map")
    try:
        return read(path.read_bytes(), other)
    except OSError as error:
        refuse(f"cannot read {other}: {error.strerror or error}")


def _refuse_foreign(table: Table | None, *, model: str, pairs: tuple[str, ...], partial: bool) -> None:
    """Refuse options for tables with two maps, and those for two maps with a table."""
    if table and pairs:
        refuse("--pair is for two maps; which models a table is about stands in its column `model`, or is --model")
    if not table and (model or partial):
        refuse(f"--{'model' if model else 'partial'} is for a table; of two maps choose the models with --pair A=B")


def _compiled(name: str) -> RegisterMap | None:
    made = compiled(find_map(name))
    show(findings(made.diagnostics), stream=sys.stderr)
    if made.map is None:
        warn(f"nothing was compared: {tally(made.diagnostics)} in {made.path}\n")
    return made.map


def _pairs(pairs: tuple[str, ...], maps: list[RegisterMap]) -> dict[str, str]:
    found: dict[str, str] = {}
    for pair in pairs:
        names = [name.strip() for name in pair.split("=")]
        if len(names) != len(maps):
            refuse(f"--pair {pair}: write one model of each map, for example --pair 16C=CN8200")
        for one, name in zip(maps, names, strict=True):
            if not one.has(name):
                refuse(f"--pair {pair}: {one.id} has no model `{name}`: it has {', '.join(m.name for m in one.models)}")
        if names[0] in found or names[1] in found.values():
            refuse(f"--pair {pair}: one of these models has its partner already")
        found[names[0]] = names[1]
    return found
