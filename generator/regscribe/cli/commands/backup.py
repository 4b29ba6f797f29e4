"""`regscribe backup`: the settings of a device, kept in a file."""

from pathlib import Path

import click

from regscribe.cli.commands.read import heading
from regscribe.cli.shared.error_report import REFUSED, USAGE, Failure
from regscribe.cli.shared.output import print_json, remark
from regscribe.cli.shared.settings_common import taken, told
from regscribe.cli.shared.target_options import HELP, checked_identity, opened, target_options
from regscribe.cli.shared.terminal import tell
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
    if path is not None and path.exists() and not force:
        message = f"{path} is there already: choose another name, or --force to replace it"
        raise Failure(message, kind="file", code=USAGE)
    with opened(target, identity=identity) as device, told():
        found = taken(device, str(target.link))
    with told():
        text = settings.to_text(found)
    if path is None and not as_json:
        tell(text)
    elif path is not None:
        with told():
            settings.save(path, text)
    failed = [name for name, saved in found.settings() if saved.value is None]
    count = sum(1 for _ in found.settings())
    if as_json:
        print_json(**heading(device, target), file=str(path or ""), settings=count, without_value=failed)
    elif path is not None:
        remark(f"{count} settings of {target} kept in {path}")
    for name in failed:
        remark(f"{name} holds no value: {dict(found.settings())[name].error}")
    return REFUSED if failed and len(failed) == count else 0
