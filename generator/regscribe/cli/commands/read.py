"""`regscribe read`: values of registers, groups and array elements, with their units."""

from collections.abc import Sequence
from datetime import UTC, datetime
from typing import Any

import click

from regscribe.cli.shared.completion_values import complete_register
from regscribe.cli.shared.error_report import REFUSED, kind_of
from regscribe.cli.shared.output import print_json, remark, show_table
from regscribe.cli.shared.target_options import HELP, opened, target_options
from regscribe.cli.shared.terminal import tell
from regscribe.tools.live import names
from regscribe.tools.live.reading import RegisterReading, readings
from regscribe.tools.live.target import Target
from regscribe.visible import safe
from regscribe_runtime import BareDevice, RegscribeError
from regscribe_runtime.operations import tasks


@click.command(
    name="read",
    help=f"Read registers, groups, arrays (segments) and their elements (segments[1]) in few requests.\n\n{HELP}",
    epilog="Example: regscribe read oven process_value alarm segments[1]\n\n"
    "Exit code 0: every register has a value, 1: one has none (a fault, a refusal), 2: wrong usage, 3: nobody answers.",
)
@target_options
@click.argument("wanted", nargs=-1, required=True, metavar="NAME...", shell_complete=complete_register)
@click.option("--value", "bare", is_flag=True, help="Print nothing but the values, one a line, without units.")
@click.option("--raw", is_flag=True, help="Print the words of the view that is preferred, as they stand on the wire.")
def command(*, target: Target, as_json: bool, wanted: tuple[str, ...], bare: bool, raw: bool) -> int:
    """Read registers, groups, arrays and their elements in few requests."""
    with opened(target, check=lambda driver: names.chosen(driver, wanted)) as device:
        registers = names.chosen(type(device), wanted)
        if raw:
            words = {one.path: device.run(tasks.read_raw(one, None)) for one in registers}
            _show_words(words, device, target, as_json=as_json)
            return 0
        found = device.run(readings(registers))
    if as_json:
        print_json(**heading(device, target), registers={one.name: plain(one) for one in found})
    elif bare:
        tell("".join(f"{safe(one.text) if one.error is None else ''}\n" for one in found))
        _complain(found)
    else:
        show_table(("REGISTER", "VALUE"), [(one.name, one.spelled) for one in found])
    return REFUSED if any(one.error for one in found) else 0


def heading(device: BareDevice, target: Target) -> dict[str, Any]:
    """What every JSON object of a live command begins with: which device, and when (RFC 3339, UTC)."""
    return {"device": str(target), "unit_id": target.unit, "model": device.model, "map": device.map_id, "time": now()}


def now() -> str:
    """The time in UTC as RFC 3339 has it, with milliseconds."""
    return datetime.now(UTC).isoformat(timespec="milliseconds").replace("+00:00", "Z")


def plain(one: RegisterReading) -> dict[str, Any]:
    """A reading in JSON: value and unit, or the error in place of it."""
    if one.error is not None:
        return {"error": error_object(one.error)}
    return {"value": one.value, "unit": one.unit}


def error_object(error: RegscribeError) -> dict[str, str]:
    """An error in JSON."""
    return {"kind": kind_of(error), "message": str(error)}


def _complain(found: Sequence[RegisterReading]) -> None:
    for one in found:
        if one.error is not None:
            remark(str(one.error))


def _show_words(words: dict[str, tuple[int, ...]], device: BareDevice, target: Target, *, as_json: bool) -> None:
    if as_json:
        print_json(**heading(device, target), registers={path: {"words": list(one)} for path, one in words.items()})
    else:
        show_table(
            ("REGISTER", "WORDS"), [(path, " ".join(f"{word:04X}" for word in one)) for path, one in words.items()]
        )
