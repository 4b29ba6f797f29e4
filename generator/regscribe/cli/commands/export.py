"""`regscribe export`: what maps say in the form of an exporter, a plug-in with options of its own."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import click

from regscribe import plugins
from regscribe.cli.shared.compiled_maps import compiled_maps
from regscribe.cli.shared.completion_values import complete_map
from regscribe.cli.shared.failure import unwritten
from regscribe.cli.shared.loss_report import FORMS, report_of
from regscribe.cli.shared.map_arguments import find_maps
from regscribe.cli.shared.output import raised_as, tell, tell_bytes, warn
from regscribe.cli.shared.output_file import none_for_stdout, save, save_result
from regscribe.cli.shared.plugin_options import PluginCommand, own_options
from regscribe.emit.write import UnwrittenFilesError, WriteError, write
from regscribe.files import FileError
from regscribe.losses import Exported
from regscribe.plugins import OptionError, PluginError


@click.command(
    cls=PluginCommand,
    epilog="Example: regscribe export fdc/series-100 --format csv > series-100.csv\n\n"
    "regscribe export athena/series-c --format collectd --model 16C --at 10.0.0.7:502 > modbus.conf\n\n"
    "Exit code 0: done, 1: errors in a map or a broken exporter (nothing is printed to standard output), or losses "
    "with --strict, 2: wrong usage.",
)
@click.argument("maps", nargs=-1, metavar="[MAP]...", shell_complete=complete_map)
@click.option(
    "-o",
    "--out",
    type=click.Path(path_type=Path),
    callback=none_for_stdout,
    metavar="FILE|DIR",
    help="Where it goes: a file, or the folder for formats that make several; else standard output.",
)
@click.option("--strict", is_flag=True, help="Fail, and write nothing, if the format cannot say all of it.")
@click.option("--report", type=click.Choice(FORMS), default="text", show_default=True, help="Form of the loss report.")
@click.option(
    "--report-to", type=click.Path(path_type=Path), metavar="FILE", help="Where the report goes; else standard error."
)
def command(
    *,
    maps: tuple[str, ...],
    form: str,
    out: Path | None,
    strict: bool,
    report: str,
    report_to: Path | None,
    **parameters: Any,  # noqa: ANN401 - click's
) -> int:
    """Print what maps say in the form of another program, and what that form cannot say.

    MAP is a map file, a folder that is searched for *.yaml, or the id of a map (fdc/series-100). Without MAP: maps/.
    Formats that configure a program for one device take one MAP and a --model. What a form cannot carry is listed on
    standard error, the worst first (docs/export.md). Plug-ins bring further formats (docs/plugins.md).
    """
    with raised_as(click.ClickException, PluginError, FileError), raised_as(click.UsageError, OptionError):
        _refuse_one_place(out, report_to)
        options = own_options(plugins.exporter(form), parameters)
        warned = report == "text" or report_to is not None
        register_maps = compiled_maps(find_maps(maps), nothing="nothing was exported", warned=warned)
        made = plugins.export(form, register_maps, options)
        refused = strict and bool(made.losses)
        if not refused:
            _put(form, made, out, told=warned)
        _tell_losses(report_of(made, register_maps, form=form, report=report, refused=refused), report_to)
    return int(refused)


def _refuse_one_place(out: Path | None, report_to: Path | None) -> None:
    if (
        out is not None
        and report_to is not None
        and out.absolute() == report_to.absolute()
        and not out.is_char_device()
    ):
        message = f"--out and --report-to are both {out}: the report would replace the export; name another file"
        raise OptionError(message)


def _tell_losses(text: str, path: Path | None) -> None:
    if path is None:
        warn(text)
    else:
        save(path, text)


def _put(form: str, made: Exported, out: Path | None, *, told: bool) -> None:
    """Print the one text, or write it to the file `out` (`told` in a remark); write several below the folder `out`."""
    files = {path: text for path, text in made.texts.items() if path}
    one = made.texts.get("")
    if files and out is None:
        message = f"the format {form} makes files: say with --out in which folder"
        raise OptionError(message)
    if files and out is not None:
        _write_folder(form, files, out)
    if one is None:
        return
    if out is None or files:
        _print(form, one)
    elif out.is_dir():
        message = f"--out {out}: the format {form} makes one file, and this is a folder: name a file in it"
        raise OptionError(message)
    else:
        (save_result if told else save)(out, one)


def _write_folder(form: str, files: Mapping[str, str | bytes], out: Path) -> None:
    try:
        with unwritten(UnwrittenFilesError):
            write(files, out)
    except WriteError as error:
        message = f"the exporter {form}: {error}"
        raise PluginError(message) from None


def _print(form: str, one: str | bytes) -> None:
    if isinstance(one, str):
        tell(one)
    else:
        tell_bytes(one, f"the format {form}")
