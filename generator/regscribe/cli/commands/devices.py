"""`regscribe devices`: the models that drivers or maps here exist for, and what one of them has."""

from typing import Any

import click

from regscribe.cli.shared.completion_values import complete_model
from regscribe.cli.shared.live_report import refused_if, remark_broken_maps, reported
from regscribe.cli.shared.output import print_json, remark, show_table
from regscribe.cli.shared.target_options import driver_options
from regscribe.tools.live import catalogue, givens, names, value_text
from regscribe.tools.live import config as configuration
from regscribe.tools.live.map_drivers import origin_of
from regscribe_runtime import Computed, Register
from regscribe_runtime.driver.identify import Known

ACCESS = {"r": "read", "w": "write", "rw": "read, write"}


@click.command(epilog="Example: regscribe devices athena\n\nExit code 0: found, 1: nothing found, 2: wrong usage.")
@click.argument("search", nargs=-1, metavar="[WORD]...", shell_complete=complete_model)
@click.option("--registers", is_flag=True, help="List registers, computed values, groups and commands of the model.")
@driver_options
def command(
    *, search: tuple[str, ...], registers: bool, packages: tuple[str, ...], config: str | None, as_json: bool
) -> int:
    """List all models that drivers exist for, and those of the maps in maps/ here.

    With words, those that all words fit. A word fits a part of the model's name, its map, its maker or its description.
    """
    with reported():
        everywhere = (*packages, *configuration.load(config).packages)
        found = [known for known in catalogue.models(everywhere) if _fits(known, search)]
        if registers and len(found) != 1:
            found = [catalogue.find(" ".join(search), everywhere)]
    if registers:
        _show_registers(found[0], as_json=as_json)
    elif as_json:
        print_json(devices=[_plain(known) for known in found])
    else:
        show_table(("MODEL", "MAP", "WHAT IT IS"), [_row(known) for known in found])
    remark_broken_maps()
    if not found:
        remark(f"no model fits `{' '.join(search)}`")
    return refused_if(not found)


def _fits(known: Known, search: tuple[str, ...]) -> bool:
    text = f"{catalogue.full_name(known)} {catalogue.title(known)} {known.driver.__name__}".casefold()
    return all(word.casefold() in text for word in search)


def _row(known: Known) -> tuple[str, str, str]:
    needs = ", ".join(f"--given {one.id}={one.example}" for one in givens.givens_of(known.driver))
    own = origin_of(known.driver)
    title = f"{catalogue.title(known)}{f' ({own})' if own else ''}"
    return known.model, known.map_id, f"{title}{f' (needs {needs})' if needs else ''}"


def _plain(known: Known) -> dict[str, Any]:
    own = origin_of(known.driver)
    return {
        "model": known.model,
        "map": known.map_id,
        "title": catalogue.title(known),
        **({"file": str(own)} if own else {"driver": f"{known.driver.__module__}.{known.driver.__name__}"}),
        "registers": len(known.driver.registers),
        "identifiable": bool(known.driver.identity),
        "givens": [one.id for one in givens.givens_of(known.driver)],
    }


def _show_registers(known: Known, *, as_json: bool) -> None:
    driver = known.driver
    groups, commands, computed = names.groups_of(driver), names.commands_of(driver), names.computed_of(driver)
    if as_json:
        print_json(
            **_plain(known) | {"registers": [_register(one) for one in driver.registers.values()]},
            computed=[_computed(one) for one in computed.values()],
            groups={name: {"name": group.name, "members": list(group.members)} for name, group in groups.items()},
            commands={name: {"danger": one.danger} for name, one in commands.items()},
        )
        return
    rows = [(one.path, ACCESS[one.access], one.kind, _units(one), one.section) for one in driver.registers.values()]
    show_table(("REGISTER", "ACCESS", "KIND", "UNIT", "SECTION"), rows, title=f"{known.model}: registers")
    if computed:
        of_each = [(one.path, one.unit, ", ".join(one.needs)) for one in computed.values()]
        show_table(("VALUE", "UNIT", "COMPUTED FROM"), of_each, title="computed values")
    show_table(("GROUP", "NAME"), [(name, one.name) for name, one in groups.items()], title="groups")
    show_table(("COMMAND", "DANGER"), [(name, one.danger) for name, one in commands.items()], title="commands")


def _units(register: Register[Any]) -> str:
    """The units that a register may have: `°F`, or `°F/°C` where another register decides."""
    return "/".join(dict.fromkeys(unit for _, unit in register.unit if unit))


def _register(register: Register[Any]) -> dict[str, Any]:
    view = register.write_view() if register.access == "w" else register.read_view()
    return {
        "name": register.path,
        "access": ACCESS[register.access],
        "kind": register.kind,
        "unit": _units(register),
        "choices": list(value_text.choices(register)),
        **view.space.facts(view.address(register.at)),
        "block": register.block,
        "space": view.space,
        "words": view.words,
        "section": register.section,
    }


def _computed(one: Computed) -> dict[str, Any]:
    return {"name": one.path, "unit": one.unit, "computed_from": list(one.needs)}
