"""`regscribe simulate`: serve one model of a map as a Modbus device."""

import asyncio
import re
import sys
from collections.abc import Sequence
from difflib import get_close_matches

import click

from regscribe.cli.locate import find_map
from regscribe.cli.terminal import show
from regscribe.cli.text import findings, tally
from regscribe.model import GivenKind, RegisterMap, Serial
from regscribe.pipeline import compile_map
from regscribe.simulate import Line, Server, Service, SimulatedDevice, SimulatorError, Transport, serve

MOST_CODES = 0x10000
"""A register has no more codes than this, so a longer range is a slip."""

PTY = "pty"
"""In place of a serial device: make a pseudo terminal and print its path."""


@click.command(
    name="simulate",
    epilog="Example: regscribe simulate athena/series-c --model 16C --tcp 127.0.0.1:5020\n\n"
    "Exit code 130: stopped by Ctrl-C, 1: errors in the map, port in use or serial device absent, 2: wrong usage.",
)
@click.argument("map_name", metavar="MAP")
@click.option("--model", metavar="M", required=True, help="The manual's name of the model.")
@click.option("--tcp", metavar="HOST:PORT", help="Serve Modbus TCP; port 0 takes any free one.")
@click.option("--rtu", metavar="DEVICE", help=f"Serve RTU on a serial device; `{PTY}` makes a pseudo terminal.")
@click.option("--unit", type=click.IntRange(0, 255), metavar="N", help="Unit id; without it the map's default.")
@click.option(
    "--given",
    "givens",
    multiple=True,
    metavar="ID=VALUE",
    help="A fact that the manual leaves to another: codes (1,4..6) or true or false. Repeat for several.",
)
def command(
    *, map_name: str, model: str, tcp: str | None, rtu: str | None, unit: int | None, givens: tuple[str, ...]
) -> int:
    """Serve one model of a map as a Modbus device, with its limits, refusals and silences, until Ctrl-C.

    MAP is a map file or the id of a map (fdc/series-100).
    """
    if (tcp is None) == (rtu is None):
        message = "choose one of --tcp HOST:PORT and --rtu DEVICE"
        raise click.UsageError(message)
    endpoint = None if tcp is None else _endpoint(tcp)
    compiled = compile_map(find_map(map_name))
    show(findings(compiled.diagnostics), stream=sys.stderr)
    if compiled.map is None:
        sys.stderr.write(f"nothing is served: {tally(compiled.diagnostics)}\n")
        return 1
    device = _device(compiled.map, model, unit, givens)
    service = _service(endpoint, rtu or "", compiled.map.protocol.serial)
    try:
        asyncio.run(serve([device], service, ready=lambda server: _announce(device, server)))
    except SimulatorError as error:
        raise click.ClickException(str(error)) from None
    return 0


def _endpoint(text: str) -> tuple[str, int]:
    host, colon, port = text.rpartition(":")
    if not colon or not re.fullmatch(r"[0-9]{1,5}", port) or int(port) > 0xFFFF:  # noqa: PLR2004 - the last port
        message = f"--tcp {text}: write HOST:PORT with a port from 0 to 65535, for example 127.0.0.1:5020"
        raise click.UsageError(message)
    return host.removeprefix("[").removesuffix("]") or "127.0.0.1", int(port)


def _service(endpoint: tuple[str, int] | None, device: str, serial: Serial) -> Service:
    if endpoint is not None:
        return Service(transport=Transport.TCP, host=endpoint[0], port=endpoint[1])
    if device == PTY:
        return Service(transport=Transport.PTY)
    line = Line(baud=serial.default_baud or Line().baud, format=serial.default_format or Line().format)
    return Service(transport=Transport.SERIAL, path=device, line=line)


def _device(register_map: RegisterMap, model: str, unit: int | None, givens: Sequence[str]) -> SimulatedDevice:
    names = [one.name for one in register_map.models]
    if model not in names:
        folded = {name.casefold(): name for name in names}
        near = get_close_matches(model.casefold(), folded, n=1)
        meant = f"; did you mean `{folded[near[0]]}`?" if near else ""
        message = f"{register_map.id} has no model `{model}`: it has {', '.join(names)}{meant}"
        raise click.UsageError(message)
    values = dict(given_value(one, register_map) for one in givens)
    try:
        return SimulatedDevice(register_map, model, unit=unit, givens=values)
    except SimulatorError as error:
        missing = [given.id for given in register_map.givens if given.id not in values]
        hint = f"\nOn the command line: --given {missing[0]}=VALUE" if missing else ""
        message = f"{error}{hint}"
        raise click.UsageError(message) from None


def given_value(text: str, register_map: RegisterMap) -> tuple[str, bool | frozenset[int]]:
    """Read one `--given ID=VALUE`: the given and its codes or its yes or no; click.UsageError for what is neither."""
    name, equals, value = text.partition("=")
    kinds = {given.id: given.kind for given in register_map.givens}
    if not equals or name not in kinds:
        message = f"--given {text}: write ID=VALUE; {register_map.id} has the givens {', '.join(kinds) or '(none)'}"
        raise click.UsageError(message)
    if kinds[name] is GivenKind.CODES:
        return name, _codes(name, value)
    if value not in {"true", "false"}:
        message = f"--given {text}: `{name}` is true or false"
        raise click.UsageError(message)
    return name, value == "true"


def _codes(name: str, value: str) -> frozenset[int]:
    codes: set[int] = set()
    for part in value.split(","):
        found = re.fullmatch(r"\s*(-?[0-9]{1,6})(?:\.\.(-?[0-9]{1,6}))?\s*", part)
        if not found or int(found[2] or found[1]) - int(found[1]) not in range(MOST_CODES):
            message = f"--given {name}={value}: `{part}` is neither a code nor a range of codes; for example 1,4..6"
            raise click.UsageError(message)
        codes.update(range(int(found[1]), int(found[2] or found[1]) + 1))
    return frozenset(codes)


def _announce(device: SimulatedDevice, server: Server) -> None:
    where = server.path or f"{server.host}:{server.port}"
    name = f"{device.register_map.title} {device.model.name}"
    sys.stdout.write(f"{name} answers as unit {device.unit} on {where}; Ctrl-C stops it\n")
    sys.stdout.flush()  # a script waits for this line
