# ruff: noqa: N999 (a command is a module of its name, and this one is a keyword)
"""`regscribe import`: a map of what people have, and for each row of it what was taken, lost and left out."""

from pathlib import Path
from typing import Any

import click

from regscribe import plugins
from regscribe.cli.shared.draft_report import FORMS, report_of
from regscribe.cli.shared.import_run import Run, code_of
from regscribe.cli.shared.import_source import check_free, data_of, mapping_of, recognised
from regscribe.cli.shared.long_work import progress
from regscribe.cli.shared.output import raised_as, refuse, remark, tell, warn
from regscribe.cli.shared.output_file import none_for_stdout, save
from regscribe.cli.shared.plugin_options import PluginCommand, own_options
from regscribe.files import FileError
from regscribe.plugins import IMPORTERS, OptionError, PluginError
from regscribe.visible import safe


class ImportCommand(PluginCommand):
    """The command with the options of all importers; the format is recognised if it is not said."""

    group = IMPORTERS
    format_required = False


PATH = click.Path(path_type=Path)


@click.command(
    cls=ImportCommand,
    epilog="Example: regscribe import registers.xlsx --as acme/oven-3 -o maps/acme/oven-3.yaml\n\n"
    "Exit code 0: every row is in the map, 1: something was left out or kept as it was (the map is written all the "
    "same), or nothing can be imported, 2: wrong usage.",
)
@click.argument("source", metavar="SOURCE")
@click.option("--as", "map_id", metavar="MAKER/FAMILY", help="Id of the map; else by -o, the source, or its name.")
@click.option(
    "-o", "--out", type=PATH, callback=none_for_stdout, metavar="MAP", help="The map; else (or -) standard output."
)
@click.option("--mapping", type=PATH, metavar="FILE", help="Options, rows to skip and corrections from this file.")
@click.option("--save-mapping", type=PATH, metavar="FILE", help="Write them, for the next list, to this new file.")
@click.option("--merge", is_flag=True, help="Bring what the list changed since the last import into the map -o.")
@click.option("--report", type=click.Choice(FORMS), default="text", show_default=True, help="Form of the report.")
@click.option("--report-to", type=PATH, metavar="FILE", help="Where the report goes; else standard error.")
def command(  # noqa: PLR0913 - one for each option
    *,
    source: str,
    form: str | None,
    map_id: str | None,
    out: Path | None,
    mapping: Path | None,
    save_mapping: Path | None,
    merge: bool,
    report: str,
    report_to: Path | None,
    **parameters: Any,  # noqa: ANN401 - click's
) -> int:
    """Make a map of a table of registers or of another program's configuration.

    SOURCE is a file, or - for standard input. The map passes `regscribe check`; what is unclear stands in it as a
    comment TODO with the source's text. The report tells of each row whether it was taken whole, with a loss, or left
    out, and why (docs/import.md).
    """
    if merge and (out is None or mapping is None):
        refuse(
            "--merge needs the map that is to be changed, -o MAP, and the mapping of its last import, --mapping FILE"
        )
    data, name = data_of(source)
    with raised_as(click.ClickException, PluginError, FileError), raised_as(click.UsageError, OptionError):
        check_free(save_mapping, mapping)
        kept = mapping_of(mapping)
        form = form or kept.importer or recognised(data, name)
        given = own_options(plugins.importer(form), parameters, kept.options)
        run = Run(form, name, given, kept, mapping)
        with progress(2, f"reading {safe(name)}") as advance:
            run.read(data)
            advance(f"checking what {safe(name)} became")
            run.settle(map_id, out, merging=merge)
        if run.text is not None:
            _put(run, out, save_mapping, merging=merge)
        told = report_of(run.draft, run.found, source=name, form=form, report=report, notes=run.notes)
        warn(told) if report_to is None else save(report_to, told)
    return code_of(run)


def _put(run: Run, out: Path | None, save_mapping: Path | None, *, merging: bool) -> None:
    """Write the map, and the mapping where there is to be one."""
    if out is None:
        if save_mapping is not None:
            run.save_mapping(save_mapping, imported=False)
        tell(run.text or "")
        return
    run.save_map(out, merging=merging)
    remark(f"{out} is ready; then: regscribe check {out}")
    if save_mapping is not None:
        run.save_mapping(save_mapping, imported=True)
    elif run.mapping_path is not None:
        run.save_mapping(run.mapping_path, imported=True)
