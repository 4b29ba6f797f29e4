# ruff: noqa: N999 (a command is a module of its name, and this one is a keyword)
"""`regscribe import`: a map of what people have, and for each row of it what was taken, lost and left out."""

import re
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import click

from regscribe import plugins
from regscribe.cli.shared.draft_report import FORMS, report_of
from regscribe.cli.shared.map_heads import head_of, is_part, parts_of
from regscribe.cli.shared.output import raised_as, refuse, tell, warn
from regscribe.cli.shared.plugin_options import PluginCommand, own_options
from regscribe.draft import Draft, Outcome
from regscribe.draft.settle import settle
from regscribe.draft.text import Written
from regscribe.files import FileError, save
from regscribe.model import Diagnostic, Severity
from regscribe.model.identifiers import snake
from regscribe.pipeline import compile_map
from regscribe.plugins import IMPORTERS, OptionError, PluginError
from regscribe.visible import safe

STDIN = "-"
MOST_BYTES = 64 * 1024 * 1024
"""Far beyond any list of registers."""


class ImportCommand(PluginCommand):
    """The command with the options of all importers; the format is recognised if it is not said."""

    group = IMPORTERS
    format_required = False


@click.command(
    cls=ImportCommand,
    epilog="Example: regscribe import registers.xlsx --as acme/oven-3 -o maps/acme/oven-3.yaml\n\n"
    "Exit code 0: every row is in the map, 1: something was left out (the map is written all the same), or nothing "
    "can be imported, 2: wrong usage.",
)
@click.argument("source", metavar="SOURCE")
@click.option("--as", "map_id", metavar="MAKER/FAMILY", help="Id of the map; else by -o, the source, or its name.")
@click.option("-o", "--out", type=click.Path(path_type=Path), metavar="MAP", help="The map; else standard output.")
@click.option("--report", type=click.Choice(FORMS), default="text", show_default=True, help="Form of the report.")
@click.option(
    "--report-to", type=click.Path(path_type=Path), metavar="FILE", help="Where the report goes; else standard error."
)
def command(
    *,
    source: str,
    form: str | None,
    map_id: str | None,
    out: Path | None,
    report: str,
    report_to: Path | None,
    **parameters: Any,  # noqa: ANN401 - click's
) -> int:
    """Make a map of a table of registers or of another program's configuration.

    SOURCE is a file, or - for standard input. The map passes `regscribe check`; what is unclear stands in it as a
    comment TODO with the source's text. The report tells of each row whether it was taken whole, with a loss, or left
    out, and why (docs/import.md).
    """
    data, name = _data(source)
    with raised_as(click.ClickException, PluginError, FileError), raised_as(click.UsageError, OptionError):
        form = form or _recognised(data, name)
        draft = plugins.read(form, data, name, own_options(plugins.importer(form), parameters))
        head = head_of(map_id or _id_for(draft, out, name), title=draft.title, maker=draft.maker)
        written, found = None, draft.findings
        if not draft.failed:
            draft, written, checked = settle(draft, head, _check)
            found = (*draft.findings, *(one for one in checked if one.severity is Severity.ERROR))
            if not draft.failed and len(found) == len(draft.findings):
                _put(written, out)
        told = report_of(draft, found, source=name, form=form, report=report)
        warn(told) if report_to is None else save(report_to, told)
    failed = any(one.severity is Severity.ERROR for one in found)
    return int(failed or any(entry.outcome is Outcome.LEFT_OUT for entry in draft.each))


def _data(source: str) -> tuple[bytes, str]:
    """Return the bytes of the source and what messages call it."""
    try:
        if source == STDIN:
            data, name = sys.stdin.buffer.read(MOST_BYTES + 1), "stdin"
        else:
            with Path(source).open("rb") as file:
                data, name = file.read(MOST_BYTES + 1), source
    except (OSError, ValueError) as error:
        refuse(f"cannot read {source}: {getattr(error, 'strerror', None) or error}")
    if len(data) > MOST_BYTES:
        refuse(f"{name} has more than {MOST_BYTES} bytes, which no list of registers has")
    return data, name


def _recognised(data: bytes, name: str) -> str:
    found = plugins.recognise(data, name)
    if len(found) == 1:
        return found[0]
    known = ", ".join(plugins.names(IMPORTERS))
    if found:
        message = f"{name} may be {' or '.join(found)}: say with --format which"
    else:
        message = f"nothing here reads {name}: say with --format what it is, of {known}"
    raise OptionError(message)


def _id_for(draft: Draft, out: Path | None, name: str) -> str:
    """The id of a map that nobody named: by the path of the map, what the source says, or the name of its file."""
    if out is not None and is_part(out.parent.name) and is_part(out.stem):
        return f"{out.parent.name}/{out.stem}"
    family = _part(draft.title) or _part(Path(name).stem) or "device"
    return "/".join(parts_of(f"{_part(draft.maker) or 'imported'}/{family}"))


def _part(text: str) -> str:
    found = re.sub(r"_+", "-", snake(text))[:40].strip("-")
    return found if is_part(found) else ""


def _check(text: str) -> Sequence[Diagnostic]:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "map.yaml"
        path.write_text(text, encoding="utf-8")
        return compile_map(path).diagnostics


def _put(written: Written, out: Path | None) -> None:
    if out is None:
        tell(written.text)
        return
    if out.exists():
        message = f"{out} exists; nothing was changed. Choose another name for the map"
        raise OptionError(message)
    try:
        out.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        message = f"cannot write {out}: {error.strerror or error}"
        raise FileError(message) from None
    save(out, written.text)
    warn(f"{safe(str(out))} is ready; then: regscribe check {safe(str(out))}\n")
