"""`regscribe export`: every value of every model as CSV or JSON, or a poll of one model for collectd."""

import re
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from difflib import get_close_matches

import click

from regscribe.cli.shared.assumed_state import surroundings
from regscribe.cli.shared.diagnostic_text import findings, tally
from regscribe.cli.shared.map_by_id import find_map, find_maps
from regscribe.cli.shared.terminal import show, tell, warn
from regscribe.emit.export import BAUD, EVERY, Poll, collectd_text, csv_text, json_text
from regscribe.model import Model, RegisterMap
from regscribe.pipeline import compile_map

FIRST_UNIT = 1
LAST_PORT = 0xFFFF
NAME = r"[A-Za-z0-9][A-Za-z0-9._-]{0,39}"
"""What collectd can make a folder of."""


@dataclass(frozen=True, slots=True)
class _Asked:
    """The options that a poll needs and no other format takes."""

    model: str | None
    place: str | None
    name: str | None
    unit: int | None
    every: int | None
    state: tuple[str, ...]
    givens: tuple[str, ...]


@click.command(
    name="export",
    epilog="Example: regscribe export fdc/series-100 --format csv > series-100.csv\n\n"
    "regscribe export athena/series-c --format collectd --model 16C --at 10.0.0.7:502 > modbus.conf\n\n"
    "Exit code 0: done, 1: errors in a map (nothing is printed to standard output), 2: wrong usage.",
)
@click.argument("maps", nargs=-1, metavar="[MAP]...")
@click.option("--format", "form", type=click.Choice(["csv", "json", "collectd"]), required=True)
@click.option("--model", metavar="M", help="collectd: the manual's name of the model.")
@click.option("--at", "place", metavar="HOST:PORT|DEVICE", help="collectd: where it answers, on TCP or a serial line.")
@click.option("--name", metavar="NAME", help="collectd: what to call it; else by its model and unit.")
@click.option("--unit", type=click.IntRange(1, 255), metavar="N", help="collectd: unit id; else the map's default.")
@click.option("--every", type=click.IntRange(1), metavar="SECONDS", help="collectd: how often; else every 10.")
@click.option("--with", "state", multiple=True, metavar="PATH=VALUE", help="collectd: what a register holds for good.")
@click.option("--given", "givens", multiple=True, metavar="ID=VALUE", help="collectd: what the manual does not say.")
def command(*, maps: tuple[str, ...], form: str, **options: object) -> int:
    """Print every value of every model to standard output, arrays expanded.

    MAP is a map file, a folder that is searched for *.yaml, or the id of a map (fdc/series-100). Without MAP: maps/.
    The format collectd takes one MAP and a --model, and prints a configuration of its modbus plugin.
    """
    asked = _Asked(**options)  # type: ignore[arg-type]  # click has checked the types
    if form == "collectd":
        _demand_options(maps, asked)
    else:
        _refuse_options(asked, form)
    paths = [find_map(maps[0])] if form == "collectd" else find_maps(maps)
    compiled = [compile_map(path) for path in paths]
    found = [diagnostic for one in compiled for diagnostic in one.diagnostics]
    show(findings(found), stream=sys.stderr)
    register_maps = [one.map for one in compiled if one.map is not None]
    if len(register_maps) < len(compiled):
        warn(f"nothing was exported: {tally(found)}\n")
        return 1
    tell(_text(form, register_maps, asked))
    return 0


def _text(form: str, register_maps: Sequence[RegisterMap], asked: _Asked) -> str:
    if form == "collectd":
        (register_map,) = register_maps
        model = _model(register_map, asked.model or "")
        known = surroundings(register_map, model, asked.state, asked.givens)
        return collectd_text(register_map, model, _poll(register_map, model, asked), known)
    return csv_text(register_maps) if form == "csv" else json_text(register_maps)


def _demand_options(maps: Sequence[str], asked: _Asked) -> None:
    if len(maps) != 1 or asked.model is None or asked.place is None:
        message = "--format collectd polls one device: name one MAP, its --model, and where it answers (--at)"
        raise click.UsageError(message)


def _refuse_options(asked: _Asked, form: str) -> None:
    names: dict[str, object] = {"model": asked.model, "at": asked.place, "name": asked.name, "unit": asked.unit}
    names |= {"every": asked.every, "with": asked.state or None, "given": asked.givens or None}
    given = [f"--{name}" for name, value in names.items() if value is not None]
    if given:
        message = f"{', '.join(given)}: only --format collectd takes that; {form} prints all models in every state"
        raise click.UsageError(message)


def _model(register_map: RegisterMap, name: str) -> Model:
    if register_map.has(name):
        return register_map.model(name)
    names = [one.name for one in register_map.models]
    near = get_close_matches(name, names, n=1, cutoff=0.3)
    meant = f"; did you mean `{near[0]}`?" if near else ""
    message = f"{register_map.id} has no model `{name}`: it has {', '.join(names)}{meant}"
    raise click.UsageError(message)


def _poll(register_map: RegisterMap, model: Model, asked: _Asked) -> Poll:
    protocol = register_map.protocol
    unit = asked.unit or protocol.default_unit or max(FIRST_UNIT, protocol.unit_ids[0])
    every, place, name = asked.every or EVERY, asked.place or "", asked.name or f"{model.class_name}-{unit}"
    if not re.fullmatch(NAME, name):
        message = f"--name {name}: at most 40 letters, digits, points, hyphens and underscores"
        raise click.UsageError(message)
    if place.startswith("/"):
        baud = protocol.serial.default_baud or BAUD
        return Poll(name=name, unit=unit, every=every, device=place, baud=baud)
    found = re.fullmatch(r"([^:\s]+):([0-9]{1,5})", place)
    if not found or not 1 <= int(found[2]) <= LAST_PORT:
        message = f"--at {place}: write HOST:PORT, for example 10.0.0.7:502, or a serial device such as /dev/ttyUSB0"
        raise click.UsageError(message)
    return Poll(name=name, unit=unit, every=every, host=found[1], port=int(found[2]))
