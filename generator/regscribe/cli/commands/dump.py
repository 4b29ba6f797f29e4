"""`regscribe dump`: everything that a device holds, group by group."""

from collections.abc import Mapping, Sequence
from itertools import chain
from typing import Any

import click

from regscribe.cli.shared.diagnostic_text import count
from regscribe.cli.shared.live_report import heading, plain
from regscribe.cli.shared.output import print_json, remark, show_table
from regscribe.cli.shared.target_options import opened, target_options
from regscribe.tools.live import names
from regscribe.tools.live.errors import TargetError, unknown
from regscribe.tools.live.reading import RegisterReading, readings
from regscribe.tools.live.target import Target
from regscribe_runtime import BareDevice, Computed, Register

UNGROUPED = "other"
"""The group of registers that are in none of the manual's."""


@click.command(
    epilog="Example: regscribe dump oven --group alarm --json\n\n"
    "Exit code 0: read (a sensor's fault is part of it), 2: wrong usage, 3: nobody answers.",
)
@target_options
@click.option("--group", "wanted", multiple=True, metavar="GROUP", help="Only this group. Repeat for several.")
def command(*, target: Target, as_json: bool, wanted: tuple[str, ...]) -> int:
    """Read everything that a device holds, group by group as the manual has it, and what is computed from it."""
    with opened(target, check=lambda driver: _groups(driver, wanted)) as device:
        groups = _groups(type(device), wanted)
        registers = {one.path: one for members in groups.values() for one in members}
        computed = [] if wanted else names.computable(type(device))
        found = {one.name: one for one in device.run(readings([*registers.values(), *computed]))}
    if as_json:
        by_group = {name: {one.path: plain(found[one.path]) for one in members} for name, members in groups.items()}
        more = {one.path: plain(found[one.path]) for one in computed}
        print_json(**heading(device, target), groups=by_group, **({"computed": more} if more else {}))
    else:
        _show(device, groups, computed, found)
    return 0


def _groups(driver: type[BareDevice], wanted: tuple[str, ...]) -> dict[str, list[Register[Any]]]:
    known = {name: group.registers(driver) for name, group in names.groups_of(driver).items()}
    others = {one.path: one for one in names.readable(driver)}
    for one in chain(*known.values()):
        others.pop(one.path, None)
    known |= {UNGROUPED: list(others.values())} if others else {}
    for name in wanted:
        if name not in known:
            raise TargetError(unknown("group", name, known, where=f"in {driver.model}"))
    return {name: known[name] for name in dict.fromkeys(wanted or known)}


def _show(
    device: BareDevice,
    groups: Mapping[str, list[Register[Any]]],
    computed: Sequence[Computed],
    found: Mapping[str, RegisterReading],
) -> None:
    titles = {name: group.name for name, group in names.groups_of(type(device)).items()}
    for name, members in groups.items():
        rows = [(one.path, found[one.path].spelled) for one in members]
        show_table(("REGISTER", "VALUE"), rows, title=f"{titles.get(name, 'Other registers')} ({name})")
    if computed:
        show_table(("VALUE", ""), [(one.path, found[one.path].spelled) for one in computed], title="Computed values")
    without = sum(one.error is not None for one in found.values())
    if without:
        remark(f"{without} of {count(len(found), 'value')} cannot be had; each says why")
