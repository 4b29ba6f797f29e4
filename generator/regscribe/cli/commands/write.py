"""`regscribe write`: one register, by name, in its own unit."""

from functools import partial
from typing import Any

import click

from regscribe.cli.shared.completion_values import complete_register, complete_value
from regscribe.cli.shared.live_report import Unsent, heading, plain_requests, show_requests
from regscribe.cli.shared.long_work import shielded
from regscribe.cli.shared.output import print_json, remark, show_table
from regscribe.cli.shared.target_options import HELP, confirm_option, identity_option, opened, target_options
from regscribe.tools.live import names, value_text
from regscribe.tools.live.changed_parts import change_parts, names_parts, part_text
from regscribe.tools.live.dry_run import dry
from regscribe.tools.live.errors import TargetError, unknown
from regscribe.tools.live.reading import held_of
from regscribe.tools.live.target import Target
from regscribe_runtime import BareDevice, Register, ValueRefused
from regscribe_runtime.operations import tasks

SINCE = {"restart": "after its next restart", "apply": "once its settings are applied"}
"""From when a setting of the line counts, as far as it is not at once."""


@click.command(
    help=f"""Write one register: a number (150.5, or with its unit "150.5 °F", which must be the device's own), a member
of an enum by name, label or code. Of a word of flags or fields those that are named are changed, the others stay as
they are: `HEATER,FAN=off`, `mode=2,limit=3` (a number is the whole word, `none` clears all flags); one of them is a
name of its own, too: `status.fan off`. NAME may be the address that a register begins at.\n\n{HELP}""",
    epilog='Example: regscribe write oven setpoint "150.5 °F"\n\n'
    "Exit code 0: written, or held already, 1: refused (by range, access, condition, the device, or for want of "
    "--confirm), 2: wrong usage, 3: nobody answers, 4: it broke off and what the device holds is unknown.",
    context_settings={"ignore_unknown_options": True},
)
@target_options
@click.argument("name", shell_complete=complete_register)
@click.argument("value", shell_complete=complete_value)
@confirm_option
@click.option("--rounded", is_flag=True, help="Round a value that is finer than the device can hold.")
@click.option("--view", metavar="VIEW", help="Transmit it in this view of the map instead of the preferred one.")
@click.option("--dry-run", is_flag=True, help="Check everything and show the words; write nothing.")
@click.option(
    "--verify/--no-verify",
    default=None,
    help="Read it back, or not; without either, what the device keeps as its configuration is.",
)
@identity_option
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
    verify: bool | None,
    identity: bool,
) -> int:
    """Write one register."""
    find = partial(_writable, name=name, value=value, view=view)
    with opened(target, identity=identity, check=find) as device, shielded() as shield:
        register, value, view = find(type(device))
        name = register.path
        unit = device.run(tasks.read_unit(register))
        parts = names_parts(register, value)
        meant = None if parts else value_text.parse(register, value, current_unit=unit)
        if rounded and not parts:
            meant = device.run(held_of(register, meant, view))
        unsent: Unsent | None
        if dry_run and register.governs is not None:
            planned = device.run(tasks.configure({name: meant}, dry_run=True, confirm=confirm, rounded=rounded))
            unsent = planned.requests
        else:
            unsent, verify = (dry(device).written, None) if dry_run else (None, verify)
            if parts:
                meant = device.run(change_parts(register, value, view=view, confirm=confirm, verify=verify))
            else:
                device.run(tasks.write(register, meant, view=view, rounded=rounded, confirm=confirm, verify=verify))
        spared = device.session.wear.spared > 0
    if as_json:
        written = {"value": value_text.show(register, meant), "unit": unit, "written": not (dry_run or spared)}
        print_json(**heading(device, target), register=name, **written, **plain_requests(unsent))
    elif unsent is not None:
        show_requests(unsent)
    else:
        show_table(("REGISTER", "VALUE"), [(name, f"{value_text.as_text(register, meant)} {unit}".rstrip())])
        if spared:
            remark("the device holds it already: its EEPROM was spared")
        elif register.governs is not None:
            since = SINCE.get(register.governs.since, "from now on")
            remark(f"the device talks otherwise {since}: its name must say so then")
    return shield.code


def _writable(
    driver: type[BareDevice], name: str, value: str, view: str | None
) -> tuple[Register[Any], str, str | None]:
    """The register that a name means, what to write to it, and in which view."""
    choice = names.to_write(driver, name)
    register, view = driver.registers[choice.path], view or choice.view or None
    if view is not None and view not in register.view_names:
        raise TargetError(unknown("view", view, register.view_names, where=f"of {register.path}"))
    if register.access == "r":
        raise ValueRefused(register.path, "the register is read-only")
    try:
        register.write_view(view)
    except ValueError as error:  # its functions do not write
        raise TargetError(str(error)) from None
    return register, part_text(register, choice.part, value) if choice.part else value, view
