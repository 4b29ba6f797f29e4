"""`regscribe diff`: what differs between devices, backups and the manual's defaults."""

import click

from regscribe.cli.shared.completion_values import complete_target
from regscribe.cli.shared.live_report import REFUSED, USAGE, Failure, reported
from regscribe.cli.shared.output import print_json, remark, show_table
from regscribe.cli.shared.settings_common import backup_of
from regscribe.cli.shared.target_options import driver_options
from regscribe.tools import settings
from regscribe.tools.live import catalogue
from regscribe.tools.settings import Saved, SettingDifference, Side

FACTORY = "factory"


@click.command(
    epilog="Example: regscribe diff oven oven.yaml; regscribe diff old.yaml new.yaml; regscribe diff oven factory\n\n"
    "Exit code 0: nothing differs, 1: something does, 2: wrong usage or file, or a manual without defaults, 3: nobody "
    "answers.",
)
@click.argument("left", shell_complete=complete_target)
@click.argument("right", shell_complete=complete_target)
@click.option("--all", "stays", is_flag=True, help="Compare address, line, calibration and the like, too.")
@driver_options
def command(*, left: str, right: str, stays: bool, packages: tuple[str, ...], config: str | None, as_json: bool) -> int:
    """Show what differs between LEFT and RIGHT.

    Each is a backup file, a device (a link such as tcp:10.0.0.7:502?unit=1&model=16C, or a name of the configuration),
    or the word `factory` for the defaults that the manual gives.
    """
    if left == right == FACTORY:
        message = "compare the factory's defaults with a device or a file"
        raise Failure(message, kind="usage", code=USAGE)
    factory = FACTORY in (left, right)
    first = settings.Side.of(*backup_of(right if left == FACTORY else left, packages, config))
    second = _factory(first, packages) if factory else settings.Side.of(*backup_of(right, packages, config))
    one, other = (second, first) if left == FACTORY else (first, second)
    found = settings.differences(one, other, stays=stays, missing=not factory)
    blind: list[str] = []
    if factory:
        undefined = {path: one for path, one in first.settings.items() if path not in second.settings}
        blind = [path for path, one in undefined.items() if stays or not one.stays]
    if as_json:
        plain = [{"register": each.path, "left": _json(each.left), "right": _json(each.right)} for each in found]
        print_json(left=one.name, right=other.name, differences=plain, not_compared=blind)
    else:
        _show(one, other, found)
        if blind:
            remark(f"not compared, for the manual gives no default: {', '.join(blind)}")
    return REFUSED if found else 0


def _factory(side: Side, packages: tuple[str, ...]) -> Side:
    with reported():
        driver = catalogue.find(f"{side.map_id}:{side.model}", packages).driver
    defaults = settings.factory(driver)
    if not defaults:
        message = f"the manual of the {side.model} gives no defaults: compare with a backup of a device as delivered"
        raise Failure(message, kind="no-defaults", code=USAGE)
    return Side(f"{side.model} as delivered", side.map_id, side.model, defaults)


def _show(one: Side, other: Side, found: tuple[SettingDifference, ...]) -> None:
    if (one.map_id, one.model) != (other.map_id, other.model):
        remark(f"{one.name} is a {one.model} ({one.map_id}), {other.name} a {other.model} ({other.map_id})")
    if not found:
        remark("nothing differs")
        return
    show_table(("REGISTER", one.name, other.name), [(each.path, _text(each.left), _text(each.right)) for each in found])


def _text(saved: Saved | None) -> str:
    return "-" if saved is None else saved.spelled


def _json(saved: Saved | None) -> dict[str, object] | None:
    if saved is None:
        return None
    return {"value": saved.value, "unit": saved.unit} if saved.value is not None else {"error": saved.error}
