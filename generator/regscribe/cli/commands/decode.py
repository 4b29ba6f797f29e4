"""`regscribe decode`: frames in the names of a map, without a device."""

import sys
from collections.abc import Iterable, Sequence
from typing import Any

import click

from regscribe.cli.shared.completion_values import complete_model
from regscribe.cli.shared.diagnostic_text import count
from regscribe.cli.shared.live_report import refused_if, reported
from regscribe.cli.shared.output import print_json, raised_as, remark, tell
from regscribe.cli.shared.standard_input import STDIN
from regscribe.cli.shared.target_options import base_option, driver_options
from regscribe.tools.live import capture, catalogue, givens, names, stated_words, target, value_text
from regscribe.tools.live import config as configuration
from regscribe.tools.live.decode import Decoded, DecodedItem, Decoder
from regscribe.tools.live.errors import TargetError
from regscribe.visible import safe
from regscribe_runtime import BareDevice
from regscribe_runtime.values.blocks import bases_in
from regscribe_runtime.values.serial_line import ADDRESSINGS, FRAMINGS
from regscribe_runtime.values.wire_types import address_facts

ARROWS = {"request": "->", "response": "<-"}
PAIR = 2


@click.command(
    epilog="Example: regscribe decode 16C 01 03 0F A0 00 01 87 3C\n\n"
    "Exit code 0: all frames are sound, 1: one is not, or there is none, 2: wrong usage.",
)
@click.argument("model", shell_complete=complete_model)
@click.argument("digits", nargs=-1, metavar="[HEX|ADDRESS=WORD]...")
@click.option("--log", type=click.File(encoding="utf-8", errors="replace"), help="A captured log; - is standard input.")
@click.option("--framing", type=click.Choice(FRAMINGS), help="Take all frames for this kind, whatever they look like.")
@click.option("--addressing", type=click.Choice(ADDRESSINGS), default="modbus", help="jbus: counted from 1.")
@click.option("--with", "state", multiple=True, metavar="NAME=VALUE", help="What a register holds that others need.")
@base_option
@click.option("--given", "given", multiple=True, metavar="ID=VALUE", help="A fact that the manual leaves to another.")
@driver_options
def command(  # noqa: PLR0913 - the options of the command
    *,
    model: str,
    digits: tuple[str, ...],
    log: Iterable[str] | None,
    framing: str | None,
    addressing: str,
    state: tuple[str, ...],
    given: tuple[str, ...],
    bases: tuple[str, ...],
    packages: tuple[str, ...],
    config: str | None,
    as_json: bool,
) -> int:
    """Say in names what frames mean: RTU, TCP or ASCII, as hexadecimal digits, or in a log of any program.

    MODEL is one that `regscribe devices` lists. Digits: one frame in pairs, or a frame in each argument. In a log, each
    line is searched for a frame; answers are held against the requests before them. Without HEX and --log, or with -
    in their place, standard input is read.

    4095=0x24 tells what a word means that was read at an address (or setpoint=1505, of a register); a value of
    several words has them with commas, 8004=0x4316,0x8000.
    """
    with reported():
        driver = catalogue.find(model, (*packages, *configuration.load(config).packages)).driver
        decoder = _decoder(driver, state, given, bases, first=int(addressing == "jbus"))
        stated = _stated(decoder, digits)
    lines = _lines(digits) if digits and digits != (STDIN,) else log or sys.stdin
    decoded = stated or [
        (part.line, decoder.feed(frame, part.direction))
        for part in capture.captured(lines, framing)
        for frame in part.frames
    ]
    if as_json:
        print_json(model=driver.model, map=driver.map_id, frames=[_plain(line, one) for line, one in decoded])
    else:
        _show(decoded)
    if not decoded:
        remark("there is no frame in it: write pairs of hexadecimal digits")
    return refused_if(not decoded or any(one.complaint for _, one in decoded))


def _decoder(
    driver: type[BareDevice], state: Sequence[str], given: Sequence[str], bases: Sequence[str], *, first: int
) -> Decoder:
    known = {}
    for text in state:
        name, equals, value = text.partition("=")
        if not equals:
            message = f"--with {text}: write NAME=VALUE, for example input_type=RTD"
            raise TargetError(message)
        known[name] = value_text.parse(names.register_named(driver, name), value)
    texts = target.given_texts(given)
    stated = givens.understood(driver, texts) if texts else {}
    with raised_as(click.UsageError, ValueError):
        blocks = [block._replace(chain=None) for block in driver._blocks]  # noqa: SLF001 (its facts)
        known_bases = bases_in(driver.map_id, blocks, bases)
    return Decoder(driver, givens=stated, state=known, first=first, bases=known_bases)


def _stated(decoder: Decoder, texts: Sequence[str]) -> list[tuple[int, Decoded]]:
    """What words mean that are given with their addresses; nothing where none is. TargetError where only some are."""
    if not any("=" in text for text in texts):
        return []
    if frames := [text for text in texts if "=" not in text]:
        message = f"`{frames[0][:40]}` is no ADDRESS=WORD: give frames in a command of their own"
        raise TargetError(message)
    found = []
    for line, text in enumerate(texts, 1):
        asked, answered = stated_words.exchange(decoder.driver, text, decoder.first)
        decoder.feed(asked)
        found.append((line, decoder.feed(answered)))
    return found


def _lines(digits: Sequence[str]) -> list[str]:
    """Join the pairs of digits of one frame; arguments that are longer are a frame each."""
    return [" ".join(digits)] if all(len(one) <= PAIR for one in digits) else list(digits)


def _show(frames: Iterable[tuple[int, Decoded]]) -> None:
    """A line for each frame: `unit 1 -> read holding 4000: controller_type`; several values stand below it."""
    for _, frame in frames:
        values = [item.spelled for item in frame.items if item.words]
        beside, below = (values, []) if len(values) == 1 else ([], values)
        asked = "" if values else ", ".join(item.name for item in frame.items)
        what = ": ".join(filter(None, (frame.what, asked, *beside)))
        wrong = f"  [{frame.complaint}]" if frame.complaint else ""
        head = f"unit {frame.unit} {ARROWS[frame.kind]} {what or count(len(values), 'value')}{wrong}"
        tell(f"{safe(head)}\n")
        tell("".join(f"    {safe(value)}\n" for value in below))


def _plain(line: int, one: Decoded) -> dict[str, Any]:
    return {
        "line": line,
        "kind": one.kind,
        "unit_id": one.unit,
        "function": one.function,
        "what": one.what,
        **({"address": None} if one.address is None else address_facts(one.function, one.address)),
        "exception": one.exception or None,
        "registers": [_plain_item(item) for item in one.items],
        "complaint": one.complaint or None,
    }


def _plain_item(item: DecodedItem) -> dict[str, Any]:
    named = {"name": item.name, "view": item.view}
    if not item.words:
        return named
    return {**named, "words": list(item.words), "value": item.value, "unit": item.unit, "problem": item.problem or None}
