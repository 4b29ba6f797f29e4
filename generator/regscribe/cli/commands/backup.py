"""`regscribe backup`: the settings of a device, kept in a file."""

from pathlib import Path

import click

from regscribe.cli.shared.diagnostic_text import count
from regscribe.cli.shared.exit_codes import USAGE
from regscribe.cli.shared.failure import Failure
from regscribe.cli.shared.live_report import heading, refused_if
from regscribe.cli.shared.output import alert, print_json, remark, tell
from regscribe.cli.shared.output_file import none_for_stdout, save
from regscribe.cli.shared.settings_common import settings_reported, taken
from regscribe.cli.shared.target_options import HELP, identity_option, opened, target_options
from regscribe.tools import settings
from regscribe.tools.live.target import Target


@click.command(
    help=f"""Keep all settings of a device in FILE: values by name with their units, and the words that transmit them,
in readable YAML; without FILE, or with -, on standard output.\n\n{HELP}""",
    epilog="Example: regscribe backup oven oven.yaml\n\n"
    "Exit code 0: kept, 1: the device refuses, 2: wrong usage, 3: nobody answers, "
    "74: the file cannot be written.",
)
@target_options
@click.argument(
    "path", type=click.Path(path_type=Path, dir_okay=False), required=False, metavar="[FILE]", callback=none_for_stdout
)
@click.option("--force", is_flag=True, help="Replace a file that is there.")
@identity_option
def command(*, target: Target, as_json: bool, path: Path | None, force: bool, identity: bool) -> int:
    """Keep all settings of a device in a file."""
    _refuse_present(path, force=force)
    with opened(target, identity=identity) as device:
        backup = taken(device, str(target.link))
    with settings_reported():
        text = settings.to_text(backup)
    if path is not None:
        save(path, text)
    failed = {name: saved.error for name, saved in backup.settings() if saved.value is None}
    number = len(list(backup.settings()))
    if as_json:
        print_json(**heading(device, target), file=str(path or ""), settings=number, without_value=list(failed))
    elif path is None:
        tell(text)
    else:
        remark(f"{count(number, 'setting')} of {target} kept in {path}")
    for name, error in failed.items():
        alert(f"{name} holds no value: {error}")
    return refused_if(0 < len(failed) == number)


def _refuse_present(path: Path | None, *, force: bool) -> None:
    if path is not None and path.exists() and not force:
        message = f"{path} is there already: choose another name, or --force to replace it"
        raise Failure(message, kind="file", code=USAGE)
