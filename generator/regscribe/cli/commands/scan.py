"""`regscribe scan`: which units answer on a line, at which speed, and what they are; or which addresses of one."""

import math
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import click
from click.core import ParameterSource

from regscribe.cli.shared.diagnostic_text import count
from regscribe.cli.shared.exit_codes import INTERRUPTED
from regscribe.cli.shared.live_report import failure, refused_if, reported
from regscribe.cli.shared.long_work import progress
from regscribe.cli.shared.output import alert, print_json, refuse, remark, show_table
from regscribe.cli.shared.register_scan_run import ScanFiles, run_scan
from regscribe.cli.shared.target_options import driver_options, silence_loggers
from regscribe.tools.live import catalogue, scan
from regscribe.tools.live.addresses import is_address, raw_place
from regscribe.tools.live.link_names import LinkName
from regscribe.tools.live.register_scan import SPACES, ScanLimits, spaces_of, spans_of
from regscribe.tools.live.target import Target, named, override
from regscribe_runtime import LinkLost
from regscribe_runtime.values.wire_types import Space

MEANINGS = {1: "the unit does not read holding registers", 2: "the unit has no holding register at that address"}
"""What exceptions say that a unit answers to a scan."""

PATH = click.Path(path_type=Path, dir_okay=False)
SPACES_HELP = f"Spaces of the addresses: {', '.join(SPACES)}."


@click.command(
    epilog="Example: regscribe scan rtu:/dev/ttyUSB0 --bauds 9600,19200 --formats 8N1,8E1\n\n"
    "regscribe scan tcp:10.0.0.7?unit=3 --registers 0..9999 --space holding,input --csv found.csv\n\n"
    "Exit code 0: somebody (an address) answers, 1: nobody, 2: wrong usage, 3: the port cannot be opened or vanished, "
    "130: Ctrl-C (what was found is printed, and kept by --resume).",
)
@click.argument("link", metavar="LINK")
@click.option("--units", default="1-247", show_default=True, metavar="LIST", help="Units to ask: 1-20,33.")
@click.option("--registers", default="", metavar="LIST", help="Scan these addresses of one unit: 0..9999,0x8000.")
@click.option("--space", "spaces", default="holding", show_default=True, metavar="LIST", help=SPACES_HELP)
@click.option(
    "--block", type=click.IntRange(1, 125), default=32, show_default=True, help="Addresses of one request at most."
)
@click.option("--pause", type=click.FloatRange(0, 60), default=0.0, metavar="SECONDS", help="Between two requests.")
@click.option("--max-requests", type=click.IntRange(1), default=10_000, show_default=True, help="End after so many.")
@click.option("--resume", type=PATH, metavar="FILE", help="Keep what is known in this file, and go on from it.")
@click.option("--csv", "table", type=PATH, metavar="FILE", help="Write what answers as a table for `regscribe import`.")
@click.option(
    "--bauds", default="", metavar="LIST", help="Speeds to try on a line; without it the link's, else 9600,19200."
)
@click.option(
    "--formats", default="", metavar="LIST", help="Character formats to try; without it the link's, else 8N1,8E1."
)
@click.option(
    "--address",
    default="0",
    metavar="ADDRESS",
    help="The holding register that is asked for: 4049, 0xFD1, holding:4049.",
)
@click.option("--all", "every", is_flag=True, help="Try the other speeds, too, when units answered at one.")
@click.option("--names/--no-names", default=True, help="Ask those that answer what they are (on).")
@driver_options
def command(  # noqa: PLR0913 - the options of the command
    *,
    link: str,
    units: str,
    registers: str,
    spaces: str,
    block: int,
    pause: float,
    max_requests: int,
    resume: Path | None,
    table: Path | None,
    bauds: str,
    formats: str,
    address: str,
    every: bool,
    names: bool,
    packages: tuple[str, ...],
    config: str | None,
    as_json: bool,
) -> int:
    """Ask every unit on a line (or behind a gateway over TCP) whether it is there; only reads are sent.

    LINK is rtu:/dev/ttyUSB0, ascii:/dev/ttyUSB0, tcp:HOST:PORT or a name of the configuration; ?timeout=0.2 says how
    long each unit is waited for.

    With --registers the addresses of one unit (of LINK, or --units 3) are asked for: a block that is refused is halved
    until the addresses are known that do not answer. Nothing tells whether an address that answers 0 is used.
    """
    silence_loggers()
    if not registers and (resume or table):
        refuse("--resume and --csv belong to a scan of addresses: say which by --registers 0..9999")
    with reported():
        target = named(link, config, packages)
        if registers:
            wanted = dict.fromkeys(spaces_of(spaces), spans_of(registers))
            limits = ScanLimits(block=block, pause=pause, most=max_requests)
            return run_scan(_one_unit(target, units), wanted, limits, ScanFiles(resume, table), as_json=as_json)
        catalogue.models(target.packages)  # a package that is none is told before the line is asked for minutes
        asked, place = scan.units(units), _holding(address)
        links = scan.settings(target.link, _numbers(bauds), [one for one in formats.split(",") if one])
        probes = scan.scan(links, asked, address=place, packages=target.packages, names=names, every=every)
    return _run(probes, links, asked, as_json=as_json)


def _one_unit(target: Target, units: str) -> Target:
    """The target with the one unit that `--units` names, if it is given."""
    asked = scan.units(units)
    if len(asked) == 1:
        return override(target, unit=asked[0])
    source = click.get_current_context().get_parameter_source("units")
    if source is not ParameterSource.DEFAULT:
        refuse("--registers scans the addresses of one unit: write --units 3, or ?unit=3 behind the link")
    return target


def _run(probes: Iterator[scan.Probe], links: Sequence[LinkName], asked: Sequence[int], *, as_json: bool) -> int:
    found: list[scan.Probe] = []
    noise: dict[str, str] = {}
    ended = ""
    code = 0
    most = math.ceil(scan.longest(links, asked))
    remark(f"asking {count(len(asked), 'unit')} with {count(len(links), 'setting')}: at most {most} s")
    try:
        with progress(len(links) * len(asked), "scanning") as advance:
            for probe in probes:
                found += [probe] if probe.answer else []
                noise |= {str(probe.link): probe.noise} if probe.noise else {}
                advance(f"unit {probe.unit} on {probe.link}, {len(found)} found")
    except KeyboardInterrupt:
        ended, code = "stopped before the end", INTERRUPTED
    except LinkLost as error:
        lost = failure(error)
        ended, code = lost.message, lost.exit_code
    _show(found, noise, ended, as_json=as_json)
    return code or refused_if(not found)


def _show(found: Sequence[scan.Probe], noise: Mapping[str, str], ended: str, *, as_json: bool) -> None:
    if as_json:
        plain = [
            {"unit_id": one.unit, "link": str(one.link), "answer": one.answer, "models": list(one.models)}
            for one in found
        ]
        print_json(complete=not ended, ended=ended or None, found=plain, noise=noise)
    else:
        rows = [(str(one.unit), str(one.link), one.answer, " or ".join(one.models) or "?") for one in found]
        show_table(("UNIT", "LINK", "ANSWER", "MODEL"), rows)
        for code, meaning in MEANINGS.items():
            if any(one.answer == f"exception {code:02d}" for one in found):
                remark(f"exception {code:02d}: {meaning}; it is there all the same (--address asks for another)")
    for link, said in noise.items():
        alert(f"what comes on {link} is no Modbus (another speed, format or framing?): {said}")
    if ended:
        alert(ended)
    elif not found:
        remark("nobody answers")


def _holding(text: str) -> int:
    """The wire address of a holding register that is written in any notation."""
    place = raw_place(text) if is_address(text) else None
    if place is None or place.space is not Space.HOLDING:
        refuse(f"--address {text}: write that of a holding register, for example 4049, 0xFD1 or holding:4049")
    return place.address


def _numbers(text: str) -> list[int]:
    parts = [one.strip() for one in text.split(",") if one.strip()]
    wrong = next((one for one in parts if not (one.isascii() and one.isdigit() and len(one) < 9)), "")  # noqa: PLR2004
    if wrong:
        refuse(f"--bauds: `{wrong[:40]}` is no speed; write 9600,19200")
    return [int(one) for one in parts]
