"""`regscribe identify`: ask a device what it is."""

from typing import Any

import click

from regscribe.cli.shared.live_report import refused_if, remark_broken_maps, reported
from regscribe.cli.shared.output import print_json, remark, show_table
from regscribe.cli.shared.target_options import target_options
from regscribe.tools.live import catalogue
from regscribe.tools.live.target import Target, answered, identification
from regscribe_runtime.driver.identify import Evidence


@click.command(
    epilog="Example: regscribe identify tcp:10.0.0.7:502?unit=1\n\n"
    "Exit code 0: one model fits, or several alike, 1: none, 2: wrong usage, 3: nobody answers.",
)
@target_options
def command(*, target: Target, as_json: bool) -> int:
    """Ask a device what it is; only reads are sent."""
    with reported():
        found = identification(target)
        answered(found)
    titles = [(one.model, one.map_id, catalogue.title(one)) for one in found.models]
    if as_json:
        print_json(
            device=str(target),
            certain=found.certain,
            models=[dict(zip(("model", "map", "title"), one, strict=True)) for one in titles],
            evidence=[_plain(one) for one in found.evidence],
            lacking=[{"model": known.model, "map": known.map_id, **_plain(one)} for known, one in found.lacking],
        )
    else:
        show_table(("MODEL", "MAP", "WHAT IT IS"), titles)
        _remarks(len(found.models), [one for one in found.evidence if one.error is None])
        for known, one in found.lacking:
            remark(f"{known.model} is ruled out: {one.register} at address {one.address}, which each has, is refused")
    remark_broken_maps()
    return refused_if(not found.models)


def _remarks(fitting: int, seen: list[Evidence]) -> None:
    for one in seen:
        remark(f"{one.register} at address {one.address} is {one.value} ({', '.join(one.map_ids)})")
    if fitting > 1:
        remark(f"{fitting} models answer alike: name the right one with model=...")
    elif not fitting:
        remark("no driver exists for what answers there")


def _plain(one: Evidence) -> dict[str, Any]:
    return {
        "maps": list(one.map_ids),
        "register": one.register,
        "address": one.address,
        "words": list(one.words),
        "value": None if one.value is None else str(one.value),
        "error": None if one.error is None else str(one.error),
    }
