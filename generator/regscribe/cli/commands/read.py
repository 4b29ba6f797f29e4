"""`regscribe read`: values of registers, groups and array elements, with their units."""

from collections.abc import Sequence
from typing import Any

import click

from regscribe.cli.shared.completion_values import complete_register
from regscribe.cli.shared.live_report import heading, plain, refused_if
from regscribe.cli.shared.output import hexadecimal, print_json, remark, show_table, tell
from regscribe.cli.shared.target_options import opened, target_options
from regscribe.tools.live import names
from regscribe.tools.live.errors import TargetError
from regscribe.tools.live.reading import readings
from regscribe.tools.live.target import Target
from regscribe.visible import safe
from regscribe_runtime import BareDevice, Computed, Register
from regscribe_runtime.operations import tasks


@click.command(
    epilog="Example: regscribe read oven process_value alarm segments[1]\n\n"
    "Exit code 0: every register has a value, 1: one has none (a fault, a refusal), 2: wrong usage, 3: nobody answers.",
)
@target_options
@click.argument("wanted", nargs=-1, required=True, metavar="NAME...", shell_complete=complete_register)
@click.option("--value", "bare", is_flag=True, help="Print nothing but the values, one a line, without units.")
@click.option("--raw", is_flag=True, help="Print the words of the view that is preferred, as they stand on the wire.")
def command(*, target: Target, as_json: bool, wanted: tuple[str, ...], bare: bool, raw: bool) -> int:
    """Read registers, groups, arrays (segments), their elements (segments[1]) and computed values in few requests."""
    choose = _with_words if raw else names.chosen
    with opened(target, check=lambda driver: choose(driver, wanted)) as device:
        if raw:
            _show_words(device, target, _with_words(type(device), wanted), as_json=as_json)
            return 0
        found = device.run(readings(names.chosen(type(device), wanted)))
    if as_json:
        print_json(**heading(device, target), registers={one.name: plain(one) for one in found})
    elif bare:
        tell("".join(f"{safe(one.text)}\n" for one in found))
        for one in found:
            if one.error is not None:
                remark(str(one.error))
    else:
        show_table(("REGISTER", "VALUE"), [(one.name, one.spelled) for one in found])
    return refused_if(any(one.error for one in found))


def _with_words(driver: names.Driver, wanted: Sequence[str]) -> list[Register[Any]]:
    found: list[Register[Any]] = []
    for one in names.chosen(driver, wanted):
        if isinstance(one, Computed):
            message = f"`{one.path}` has no words of its own: it is {names.computed_from(one)}"
            raise TargetError(message)
        found.append(one)
    return found


def _show_words(device: BareDevice, target: Target, registers: Sequence[Register[Any]], *, as_json: bool) -> None:
    words = {one.path: device.run(tasks.read_raw(one, None)) for one in registers}
    if as_json:
        print_json(**heading(device, target), registers={path: {"words": list(one)} for path, one in words.items()})
    else:
        show_table(("REGISTER", "WORDS"), [(path, hexadecimal(one)) for path, one in words.items()])
