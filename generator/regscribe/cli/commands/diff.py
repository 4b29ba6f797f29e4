"""`regscribe diff`: what differs between devices, backups and the manual's defaults."""

import sys

import click

from regscribe.cli.shared.completion_values import complete_target
from regscribe.cli.shared.exit_codes import USAGE
from regscribe.cli.shared.failure import Failure
from regscribe.cli.shared.live_report import refused_if, reported
from regscribe.cli.shared.output import alert, print_json, remark, show_table
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
    sides = [Side.of(*backup_of(text, packages, config)) for text in (left, right) if text != FACTORY]
    if not sides:
        message = "compare the factory's defaults with a device or a file"
        raise Failure(message, kind="usage", code=USAGE)
    factory, blind = FACTORY in (left, right), list[str]()
    if factory:
        defaults = _factory(sides[0], packages)
        sides.insert((left, right).index(FACTORY), defaults)
        blind = [each.path for each in settings.differences(*sides, stays=stays) if each.path not in defaults.settings]
    one, other = sides
    found = settings.differences(one, other, stays=stays, missing=not factory)
    if as_json:
        plain = [{"register": each.path, "left": _json(each.left), "right": _json(each.right)} for each in found]
        print_json(left=one.name, right=other.name, differences=plain, not_compared=blind)
    else:
        _show(one, other, found, blind)
    return refused_if(found)


def _factory(side: Side, packages: tuple[str, ...]) -> Side:
    with reported():
        driver = catalogue.find(f"{side.map_id}:{side.model}", packages).driver
    defaults = settings.factory(driver, side.settings)
    if not defaults:
        message = f"the manual of the {side.model} gives no defaults: compare with a backup of a device as delivered"
        raise Failure(message, kind="no-defaults", code=USAGE)
    return Side(f"{side.model} as delivered", side.map_id, side.model, defaults)


def _show(one: Side, other: Side, found: tuple[SettingDifference, ...], blind: list[str]) -> None:
    if (one.map_id, one.model) != (other.map_id, other.model):
        remark(f"{one.name} is a {one.model} ({one.map_id}), {other.name} a {other.model} ({other.map_id})")
    rows = [(each.path, _text(each.left), _text(each.right)) for each in found]
    if rows:
        columns = ("REGISTER", one.name, other.name)
        heads = [] if sys.stdout.isatty() else [columns]  # which value is whose is told on a pipe, too
        show_table(columns, [*heads, *rows])
    else:
        remark("nothing differs")
    if blind:
        alert(f"not compared, for the manual gives no default: {', '.join(blind)}")


def _text(saved: Saved | None) -> str:
    return "-" if saved is None else saved.spelled


def _json(saved: Saved | None) -> dict[str, object] | None:
    if saved is None:
        return None
    return {"value": saved.value, "unit": saved.unit} if saved.value is not None else {"error": saved.error}
