"""`regscribe command`: make a device act, or list what it can be told to do."""

from functools import partial

import click

from regscribe.cli.shared.completion_values import complete_command
from regscribe.cli.shared.live_report import heading, plain_requests, reported, show_requests
from regscribe.cli.shared.long_work import shielded
from regscribe.cli.shared.output import print_json, remark, show_table
from regscribe.cli.shared.target_options import identity_option, opened, target_options
from regscribe.tools.live import names, value_text
from regscribe.tools.live.dry_run import dry
from regscribe.tools.live.target import Target, identified
from regscribe_runtime import AnyCommand
from regscribe_runtime.operations import tasks


@click.command(
    epilog="Example: regscribe command oven clear_latched_alarms\n\n"
    "Exit code 0: done, 1: refused (also for want of --confirm), 2: wrong usage, 3: nobody answers, 4: the "
    "answer was lost, and nobody knows whether it was carried out.",
)
@target_options
@click.argument("name", required=False, shell_complete=complete_command)
@click.argument("arguments", nargs=-1, metavar="[ARGUMENT=VALUE]...")
@click.option("--confirm", is_flag=True, help="Send a dangerous command, too.")
@click.option("--dry-run", is_flag=True, help="Show the requests, send none that writes.")
@identity_option
def command(
    *,
    target: Target,
    as_json: bool,
    name: str | None,
    arguments: tuple[str, ...],
    confirm: bool,
    dry_run: bool,
    identity: bool,
) -> int:
    """Send a command of the map; without NAME list them (nothing is sent then)."""
    if name is None:
        with reported():
            _list(identified(target), as_json=as_json)
        return 0
    find = partial(names.command_named, name=name)
    with opened(target, identity=identity, check=find) as device, shielded() as shield:
        unsent = dry(device).written if dry_run else None
        found = find(type(device))
        device.run(tasks.run(found, confirm=confirm, values=_values(found, arguments)))
    if as_json:
        print_json(**heading(device, target), command=name, sent=not dry_run, **plain_requests(unsent))
    elif unsent is not None:
        show_requests(unsent)
    else:
        remark(f"{name}: done")
    return shield.code


def _values(command: AnyCommand, arguments: tuple[str, ...]) -> dict[str, object]:
    """The values of arguments; one that the command does not have keeps its text, and is refused."""
    given: dict[str, object] = {}
    for one in arguments:
        name, _, text = one.partition("=")
        given[name] = value_text.parse(command.arguments[name], text) if name in command.arguments else text
    return given


def _list(target: Target, *, as_json: bool) -> None:
    driver = target.known().driver
    commands = names.commands_of(driver)
    if as_json:
        print_json(
            model=driver.model,
            map=driver.map_id,
            commands={key: {"danger": one.danger, "arguments": list(one.arguments)} for key, one in commands.items()},
        )
    else:
        rows = [
            (" ".join((key, *(f"{name}=..." for name in one.arguments))), one.danger) for key, one in commands.items()
        ]
        show_table(("COMMAND", "NEEDS --confirm, FOR"), rows)
    if not commands:
        remark(f"the manual of {driver.model} has no commands")
