"""`regscribe clone`: copy the settings of one device, or of a backup, to others."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import click

from regscribe import settings
from regscribe.cli.completing import complete_target
from regscribe.cli.failure import REFUSED, Failure
from regscribe.cli.failure import told as target_told
from regscribe.cli.output import print_json, remark
from regscribe.cli.restore import said, tell_rest
from regscribe.cli.settled import (
    confirm_option,
    include_option,
    is_file,
    loaded,
    show_changes,
    taken,
    telling,
    told,
)
from regscribe.cli.target import CONFIG, JSON, PACKAGE, opened, understood
from regscribe.live.target import Target
from regscribe.settings import Backup


class Options(NamedTuple):
    """How a clone writes."""

    include: tuple[str, ...]
    partial: bool
    dry_run: bool
    confirm: bool


@click.command(
    name="clone",
    epilog="Example: regscribe clone oven oven2 oven3 --dry-run\n\n"
    "Exit code 0: all done, 1: a device did not take them (each is told), 2: wrong usage or file, 3: the source is "
    "silent.",
)
@click.argument("source", shell_complete=complete_target)
@click.argument("targets", nargs=-1, required=True, metavar="TARGET...", shell_complete=complete_target)
@click.option("--dry-run", is_flag=True, help="Show what would be written; write nothing.")
@click.option("--partial", is_flag=True, help="Write what fits, although a device is of another model or map.")
@click.option("--stop", is_flag=True, help="Stop at the first device that does not take them.")
@include_option
@confirm_option
@PACKAGE
@CONFIG
@JSON
def command(  # noqa: PLR0913 - the options of the command
    *,
    source: str,
    targets: tuple[str, ...],
    dry_run: bool,
    partial: bool,
    stop: bool,
    include: tuple[str, ...],
    confirm: bool,
    packages: tuple[str, ...],
    config: str | None,
    as_json: bool,
) -> int:
    """Copy the settings of SOURCE, a device or a backup file, to each TARGET.

    Never the address, line, calibration and the like, unless included. A device that fails does not stop the others.
    """
    with target_told():
        wanted = [understood(text, config=config, packages=packages) for text in targets]
    backup = _source(source, packages, config)
    options = Options(include, partial, dry_run, confirm)
    results = []
    for result in _each(wanted, backup, options, quiet=as_json):
        results.append(result)
        if stop and "error" in result:
            break
    if as_json:
        print_json(source=source, dry_run=dry_run, devices=results)
    return REFUSED if len(results) < len(wanted) or any("error" in one for one in results) else 0


def _source(text: str, packages: tuple[str, ...], config: str | None) -> Backup:
    if is_file(text):
        return loaded(Path(text))
    with target_told():
        target = understood(text, config=config, packages=packages)
    with opened(target, identity=True) as device, told():
        return taken(device, str(target.link))


def _each(targets: list[Target], backup: Backup, options: Options, *, quiet: bool) -> Iterator[dict[str, Any]]:
    for target in targets:
        try:
            yield {"target": str(target), **_onto(target, backup, options, quiet=quiet)}
        except Failure as error:
            if not quiet:
                remark(f"{target}: {error.message}")
            yield {"target": str(target), "error": {"kind": error.kind, "message": error.message}}


def _onto(target: Target, backup: Backup, options: Options, *, quiet: bool) -> dict[str, Any]:
    with opened(target, identity=True) as device, told(), telling(f"cloning to {target}", backup) as tell:
        done = device.run(
            settings.restore(
                type(device),
                backup,
                include=options.include,
                partial=options.partial,
                dry_run=options.dry_run,
                confirm=options.confirm,
                tell=tell,
            )
        )
        if not quiet:
            remark(f"{target}:")
            show_changes(device, done.report.changes)
            tell_rest(done, dry_run=options.dry_run)
        return said(device, done)
