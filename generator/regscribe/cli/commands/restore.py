"""`regscribe restore`: bring a device to the settings of a backup."""

from pathlib import Path

import click

from regscribe.cli.shared import settings_common
from regscribe.cli.shared.live_report import heading
from regscribe.cli.shared.long_work import shielded
from regscribe.cli.shared.output import print_json
from regscribe.cli.shared.settings_common import RestoreOptions, include_option
from regscribe.cli.shared.target_options import HELP, confirm_option, identity_option, opened, target_options
from regscribe.tools.live.target import Target


@click.command(
    help=f"""Bring a device to the settings in FILE, a backup: checked as a whole first, written in the map's order,
what the device holds already is skipped, everything is read back. When it breaks off, run it again: it goes on where it
was. Address, line, calibration and the like stay as they are unless included.\n\n{HELP}""",
    epilog="Example: regscribe restore oven oven.yaml --dry-run\n\n"
    "Exit code 0: done, 1: the file does not fit, or a value is refused; nothing was written, 2: wrong usage or file, "
    "3: nobody answers, 4: it broke off; the message says what was written, 130: Ctrl-C came too late to stop it.",
)
@target_options
@click.argument("path", type=click.Path(path_type=Path, dir_okay=False), metavar="FILE")
@click.option("--dry-run", is_flag=True, help="Show what would be written; write nothing.")
@click.option("--partial", is_flag=True, help="Write what fits, although the file is of another model or map.")
@include_option
@confirm_option
@identity_option
def command(
    *,
    target: Target,
    as_json: bool,
    path: Path,
    dry_run: bool,
    partial: bool,
    include: tuple[str, ...],
    confirm: bool,
    identity: bool,
) -> int:
    """Bring a device to the settings of a backup."""
    backup = settings_common.loaded(path)
    with opened(target, identity=identity) as device, shielded() as shield:
        options = RestoreOptions(include, partial, dry_run, confirm)
        done = settings_common.restored(f"restoring {target}", device, backup, options, shield)
        if as_json:
            plain = settings_common.plain_restored(device, done)
            print_json(**heading(device, target), file=str(path), dry_run=dry_run, **plain)
        else:
            settings_common.show_restored(device, done, dry_run=dry_run)
    return shield.code
