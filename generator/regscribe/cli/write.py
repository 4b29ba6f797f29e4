"""`regscribe write`: one register, by name, in its own unit."""

from typing import Any

import click

from regscribe.cli.completing import complete_register, complete_value
from regscribe.cli.output import print_json, show_table
from regscribe.cli.read import heading
from regscribe.cli.requests import plain_requests, show_requests
from regscribe.cli.target import HELP, checked_identity, opened, target_options
from regscribe.live import names, values
from regscribe.live.dry import dry
from regscribe.live.errors import TargetError, unknown
from regscribe.live.target import Target
from regscribe.runtime import Register, ValueRefused, operations


@click.command(
    name="write",
    help=f"""Write one register: a number (150.5, or with its unit "150.5 °F", which must be the device's own), a member
of an enum by name, label or code, flags as names with commas.\n\n{HELP}""",
    epilog='Example: regscribe write oven setpoint "150.5 °F"\n\n'
    "Exit code 0: written, or held already, 1: refused (by range, access, condition, the device, or for want of "
    "--confirm), 2: wrong usage, 3: nobody answers, 4: it broke off and what the device holds is unknown.",
    context_settings={"ignore_unknown_options": True},
)
@target_options
@click.argument("name", shell_complete=complete_register)
@click.argument("value", shell_complete=complete_value)
@click.option("--confirm", is_flag=True, help="Write where the map calls it dangerous, too.")
@click.option("--rounded", is_flag=True, help="Round a value that is finer than the device can hold.")
@click.option("--view", metavar="VIEW", help="Transmit it in this view of the map instead of the preferred one.")
@click.option("--dry-run", is_flag=True, help="Check everything and show the words; write nothing.")
@checked_identity
def command(  # noqa: PLR0913 - the options of the command
    *,
    target: Target,
    as_json: bool,
    name: str,
    value: str,
    confirm: bool,
    rounded: bool,
    view: str | None,
    dry_run: bool,
    identity: bool,
) -> int:
    """Write one register."""
    with opened(target, identity=identity) as device:
        register = names.register_named(type(device), name)
        _known_view(register, view)
        if register.access == "r":
            raise ValueRefused(name, "the register is read-only")
        unsent = dry(device).written if dry_run else []
        unit = device.run(operations.read_unit(register))
        meant = values.parse(register, value, current_unit=unit)
        device.run(operations.write(register, meant, view=view, rounded=rounded, confirm=confirm))
    said = {"register": name, "value": values.show(register, meant), "unit": unit, "written": not dry_run}
    if as_json:
        print_json(**heading(device, target), **said, **({"requests": plain_requests(unsent)} if dry_run else {}))
    elif dry_run:
        show_requests(unsent)
    else:
        show_table(("REGISTER", "VALUE"), [(name, f"{values.as_text(register, meant)} {unit}".rstrip())])
    return 0


def _known_view(register: Register[Any], view: str | None) -> None:
    if view is not None and view not in register.view_names:
        raise TargetError(unknown("view", view, register.view_names, where=f"of {register.path}"))
