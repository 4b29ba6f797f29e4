"""`regscribe simulate`: serve models of maps as Modbus devices on one line."""

import asyncio
import re
import signal
import sys
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import TypedDict, Unpack

import click

from regscribe import simulate as simulator
from regscribe.cli.shared import simulated_devices
from regscribe.cli.shared.completion_values import complete_map
from regscribe.cli.shared.exit_codes import STOPPED
from regscribe.cli.shared.global_options import is_quiet
from regscribe.cli.shared.output import raised_as, refuse, tell
from regscribe.cli.shared.output_file import save
from regscribe.cli.shared.request_log import RequestLog, table
from regscribe.cli.shared.simulated_devices import WantedDevice
from regscribe.cli.shared.standard_input import STDOUT
from regscribe.cli.shared.target_options import base_option, given_option
from regscribe.simulate import Foreign, Server, Service, SimulatedDevice, SimulatorError, Transport
from regscribe.simulate.device import state_files
from regscribe.simulate.line.server_context import factor_of
from regscribe.simulate.line.serving import line_of
from regscribe.visible import safe
from regscribe_runtime.values.serial_line import ADDRESSINGS, SerialLine

PTY = "pty"
"""In place of a serial device: make a pseudo terminal and print its path."""

FRAMINGS = {"tcp": Transport.TCP, "rtu": Transport.RTU_OVER_TCP, "ascii": Transport.ASCII_OVER_TCP}


class Options(TypedDict):
    """The options of the command, beside those that name devices."""

    tcp: str | None
    rtu: str | None
    framing: str
    baud: int | None
    character: str | None
    paced: bool
    latency: str
    speed: float
    foreign: Foreign | None
    connections: int
    idle: float | None
    save: str | None


@click.command(
    epilog="Example: regscribe simulate athena/series-c --model 16C --tcp 127.0.0.1:5020 --process on\n\n"
    "Exit code 130: stopped by Ctrl-C, 1: errors in the map, port in use or serial device absent, 2: wrong usage.",
)
@click.argument("map_name", metavar="[MAP]", required=False, shell_complete=complete_map)
@click.option("--model", metavar="M", help="The manual's name of the model, where the map has several.")
@click.option("--unit", type=click.IntRange(0, 255), metavar="N", help="Unit id; without it the map's default.")
@given_option
@base_option
@click.option(
    "--device",
    "devices",
    multiple=True,
    metavar="MAP:MODEL:UNIT",
    help="One more device on the line, in place of MAP or beside it. Repeat for several.",
)
@click.option("--devices", "file", metavar="FILE", help="Devices from a YAML file (docs/simulate.md).")
@click.option("--tcp", metavar="HOST:PORT", help="Serve TCP; port 0 takes any free one.")
@click.option("--rtu", metavar="DEVICE", help=f"Serve RTU on a serial device; `{PTY}` makes a pseudo terminal.")
@click.option("--framing", type=click.Choice(list(FRAMINGS)), default="tcp", help="Of TCP.", show_default=True)
@click.option("--baud", type=click.IntRange(50, 4_000_000), metavar="N", help="Speed of the line; default: the map's.")
@click.option("--line-format", "character", metavar="8N1", help="Character format of the line; default: the map's.")
@click.option("--paced", is_flag=True, help=f"With `--rtu {PTY}`: bytes take their time at the speed of the line.")
@click.option("--latency", default="off", metavar="off|real|F", help="The manual's answer times, or F times them.")
@click.option("--addressing", type=click.Choice(ADDRESSINGS), default="modbus", help="Count addresses from 0 or 1.")
@click.option("--without", multiple=True, metavar="NAME", help="Leave out a register that not every device has.")
@click.option("--seed", type=int, default=0, metavar="N", help="Of everything that is left to chance.")
@click.option("--process", metavar="on|KEY=VALUE,..", help="Let the process value move: gain=500,time_constant=120,..")
@click.option(
    "--speed", type=click.FloatRange(0, 1e6), default=1.0, metavar="F", help="Simulated seconds in a real one."
)
@click.option("--state", default="", metavar="FILE", help="Begin with this state (or backup); - is standard input.")
@click.option("--save", metavar="FILE", help="Write the state of the device at the end.")
@click.option("--foreign", type=click.Choice(list(Foreign)), help="What a unit that is not here gets.")
@click.option("--connections", type=click.IntRange(1, 10_000), default=64, help="Clients at once.", show_default=True)
@click.option("--idle", type=click.FloatRange(min=0.1), metavar="S", help="Seconds until a silent client is dropped.")
def command(  # noqa: PLR0913 - one for each option that makes devices
    *,
    map_name: str | None,
    model: str | None,
    unit: int | None,
    givens: tuple[str, ...],
    bases: tuple[str, ...],
    devices: tuple[str, ...],
    file: str | None,
    addressing: str,
    seed: int,
    process: str | None,
    state: str,
    without: tuple[str, ...],
    **options: Unpack[Options],
) -> int:
    """Serve models of maps as Modbus devices, with their limits, refusals and silences, until Ctrl-C.

    MAP is a map file or the id of a map (fdc/series-100). Requests are shown by the names of the map: in a table on a
    terminal, else one a line; with --quiet not at all.
    """
    if (options["tcp"] is None) == (options["rtu"] is None):
        refuse("choose one of --tcp HOST:PORT and --rtu DEVICE")
    motion = simulated_devices.process_of(process)
    common = {"addressing": addressing, "seed": seed, "process": motion, "state": state}
    one = WantedDevice(map=map_name or "", model=model, unit=unit, givens=givens, bases=bases, without=without)
    wanted = [one] if map_name is not None else []
    wanted += [simulated_devices.wanted_device(text) for text in devices]
    wanted += simulated_devices.wanted_devices(Path(file)) if file is not None else []
    if not wanted:
        refuse("name a MAP (and which --model of several), or devices by --device MAP:MODEL:UNIT or --devices FILE")
    if len(wanted) > 1 and any((state, options["save"])):
        refuse(f"--state and --save are for one device, not for {len(wanted)}: give states in a file of --devices")
    if options["save"] == STDOUT:
        refuse("--save - : standard output tells the requests; name a file")
    service = _service(options)
    maps = simulated_devices.compiled_by_name(one.map for one in wanted)
    with raised_as(click.ClickException, SimulatorError):
        made = [simulated_devices.device_of(one.over(common), maps[one.map]) for one in wanted]
        return _run(made, service, options)


def _run(devices: list[SimulatedDevice], service: Service, options: Options) -> int:
    usual = line_of(devices)
    line = SerialLine.of("", options["baud"] or usual.baud, options["character"] or usual.format)
    shown, terminal = not is_quiet(), sys.stdout.isatty()
    requests = RequestLog(devices, printed=not terminal)
    service = replace(service, line=line, watcher=requests.note if shown else None)
    try:
        return asyncio.run(_serve(devices, service, requests if shown and terminal else None))
    finally:
        if options["save"]:
            save(Path(options["save"]), state_files.as_text(devices[0].snapshot()))


async def _serve(devices: list[SimulatedDevice], service: Service, drawn: RequestLog | None) -> int:
    """Serve until Ctrl-C (which is raised) or TERM; SimulatorError as `serve`."""
    loop = asyncio.get_running_loop()
    serving = loop.create_task(simulator.serve(devices, service, ready=lambda server: _announce(devices, server)))
    with suppress(NotImplementedError):  # on Windows, which ends a program without asking it
        loop.add_signal_handler(signal.SIGTERM, serving.cancel)
    tasks = [serving, *([loop.create_task(table(drawn))] if drawn is not None else [])]
    try:
        await asyncio.wait([serving])
        if not serving.cancelled():
            serving.result()
    finally:
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)
    return STOPPED


def _service(options: Options) -> Service:
    """The service that the options describe, but for its line; UsageError where they contradict each other."""
    with raised_as(click.UsageError, SimulatorError, ValueError):
        factor_of(options["latency"])
        SerialLine.of("", options["baud"] or SerialLine().baud, options["character"] or SerialLine().format)
    if options["paced"] and options["rtu"] != PTY:
        refuse(f"--paced goes with --rtu {PTY} only: a serial device has its own speed, TCP has none")
    service = Service(
        latency=options["latency"],
        paced=options["paced"],
        speed=options["speed"],
        foreign=options["foreign"],
        connections=options["connections"],
        patience=None if options["idle"] is None else simulator.Patience(idle=options["idle"]),
    )
    if options["tcp"] is not None:
        host, port = _endpoint(options["tcp"])
        return replace(service, transport=FRAMINGS[options["framing"]], host=host, port=port)
    if options["rtu"] == PTY:
        return replace(service, transport=Transport.PTY)
    return replace(service, transport=Transport.SERIAL, path=options["rtu"] or "")


def _endpoint(text: str) -> tuple[str, int]:
    host, colon, port = text.rpartition(":")
    if not colon or not re.fullmatch(r"[0-9]{1,5}", port) or int(port) > 0xFFFF:  # noqa: PLR2004 - the last port
        refuse(f"--tcp {text}: write HOST:PORT with a port from 0 to 65535, for example 127.0.0.1:5020")
    return host.removeprefix("[").removesuffix("]") or "127.0.0.1", int(port)


def _announce(devices: list[SimulatedDevice], server: Server) -> None:
    where = server.path or f"{server.host}:{server.port}"
    for device in devices:
        name = f"{device.register_map.title} {device.model.name}"
        tell(safe(f"{name} answers as unit {device.unit} on {where}; Ctrl-C stops it") + "\n")
    sys.stdout.flush()  # a script waits for this line
