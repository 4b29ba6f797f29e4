"""`regscribe backup`: the settings of a device, kept in a file."""

from pathlib import Path

import click

from regscribe.cli.shared.error_report import REFUSED, USAGE, Failure
from regscribe.cli.shared.live_output import heading
from regscribe.cli.shared.output import print_json, remark, tell
from regscribe.cli.shared.settings_common import settings_reported, taken
from regscribe.cli.shared.target_options import HELP, checked_identity, opened, target_options
from regscribe.tools import settings
from regscribe.tools.live.target import Target


@click.command(
    name="backup",
    help=f"""Keep all settings of a device in FILE: values by name with their units, and the words that transmit them,
in readable YAML; without FILE on standard output.\n\n{HELP}""",
    epilog="Example: regscribe backup oven oven.yaml\n\n"
    "Exit code 0: kept, 1: the device refuses, 2: wrong usage or the file cannot be written, 3: nobody answers.",
)
@target_options
@click.argument("path", type=click.Path(path_type=Path, dir_okay=False), required=False, metavar="[FILE]")
@click.option("--force", is_flag=True, help="Replace a file that is there.")
@checked_identity
def command(*, target: Target, as_json: bool, path: Path | None, force: bool, identity: bool) -> int:
    """Keep all settings of a device in a file."""
    if not force:
        _refuse_existing(path)
    with opened(target, identity=identity) as device:
        found = taken(device, str(target.link))
    _keep(found, path, shown=not as_json)
    failed = {name: saved.error for name, saved in found.settings() if saved.value is None}
    count = sum(1 for _ in found.settings())
    if as_json:
        print_json(**heading(device, target), file=str(path or ""), settings=count, without_value=list(failed))
    elif path is not None:
        remark(f"{count} settings of {target} kept in {path}")
    for name, error in failed.items():
        remark(f"{name} holds no value: {error}")
    return REFUSED if 0 < len(failed) == count else 0


def _refuse_existing(path: Path | None) -> None:
    if path is not None and path.exists():
        message = f"{path} is there already: choose another name, or --force to replace it"
        raise Failure(message, kind="file", code=USAGE)


def _keep(found: settings.Backup, path: Path | None, *, shown: bool) -> None:
    """Write a backup to a file, or without one to standard output if it is to be shown."""
    with settings_reported():
        text = settings.to_text(found)
        if path is not None:
            settings.save(path, text)
        elif shown:
            tell(text)
