"""`regscribe clone`: copy the settings of one device, or of a backup, to others."""

from typing import Any

import click

from regscribe.cli.shared import settings_common
from regscribe.cli.shared.completion_values import complete_target
from regscribe.cli.shared.exit_codes import REFUSED, UNKNOWN_STATE
from regscribe.cli.shared.failure import Failure
from regscribe.cli.shared.live_report import refused_if, reported
from regscribe.cli.shared.long_work import Shield, shielded
from regscribe.cli.shared.output import alert, print_json
from regscribe.cli.shared.settings_common import RestoreOptions, include_option
from regscribe.cli.shared.target_options import confirm_option, driver_options, opened
from regscribe.tools.live.target import Target, named
from regscribe.tools.settings import Backup


@click.command(
    epilog="Example: regscribe clone oven oven2 oven3 --dry-run\n\n"
    "Exit code 0: all done, 1: a device did not take them (each is told), 2: wrong usage or file, 3: the source is "
    "silent, 4: it broke off in a device (the message says what was written), 130: Ctrl-C between two devices.",
)
@click.argument("source", shell_complete=complete_target)
@click.argument("targets", nargs=-1, required=True, metavar="TARGET...", shell_complete=complete_target)
@click.option("--dry-run", is_flag=True, help="Show what would be written; write nothing.")
@click.option("--partial", is_flag=True, help="Write what fits, although a device is of another model or map.")
@click.option("--stop", is_flag=True, help="Stop at the first device that does not take them.")
@include_option
@confirm_option
@driver_options
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

    Never the address, line, calibration and the like, unless included. A device that fails does not stop the others;
    Ctrl-C does.
    """
    with reported():
        wanted = [named(text, config, packages) for text in targets]
    backup, _ = settings_common.backup_of(source, packages, config)
    options = RestoreOptions(include, partial, dry_run, confirm)
    with shielded() as shield:
        results = _results(wanted, backup, options, shield, stop=stop, quiet=as_json)
    if as_json:
        print_json(source=source, dry_run=dry_run, devices=results)
    return _code(results, shield)


def _results(
    targets: list[Target], backup: Backup, options: RestoreOptions, shield: Shield, *, stop: bool, quiet: bool
) -> list[dict[str, Any]]:
    """The result of each device; after Ctrl-C, or with `stop` after a failure, the rest is not begun."""
    results: list[dict[str, Any]] = []
    for target in targets:
        if shield.interrupted or (stop and results and "error" in results[-1]):
            results.append(_error(target, "not begun: it holds what it held", "not-begun", REFUSED, quiet=quiet))
            stop = True
            continue
        try:
            results.append(_write(target, backup, options, shield, quiet=quiet))
        except Failure as error:
            results.append(_error(target, error.message, error.kind, error.exit_code, quiet=quiet))
    return results


def _error(target: Target, message: str, kind: str, code: int, *, quiet: bool) -> dict[str, Any]:
    if not quiet:
        for line in message.splitlines():
            alert(f"{target}: {line}")
    return {"target": str(target), "error": {"kind": kind, "message": message, "exit_code": code}}


def _code(results: list[dict[str, Any]], shield: Shield) -> int:
    """The exit code of the worst result."""
    codes = {one["error"]["exit_code"] for one in results if "error" in one}
    if UNKNOWN_STATE in codes:
        return UNKNOWN_STATE
    return shield.code or refused_if(codes)


def _write(target: Target, backup: Backup, options: RestoreOptions, shield: Shield, *, quiet: bool) -> dict[str, Any]:
    with opened(target, identity=True) as device:
        done = settings_common.restored(f"cloning to {target}", device, backup, options, shield)
        if not quiet:
            alert(f"{target}:")
            settings_common.show_restored(device, done, dry_run=options.dry_run)
        return {"target": str(target), **settings_common.plain_restored(device, done)}
