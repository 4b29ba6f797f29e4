"""Scans a line or a gateway for units that answer: bounded, reported as it goes, and only reads are sent."""

import re
from collections.abc import Iterator, Sequence
from contextlib import closing
from dataclasses import replace
from typing import NamedTuple

from regscribe.tools.live.errors import TargetError
from regscribe.tools.live.link_names import LinkName
from regscribe.tools.live.target import Target, link_of, packages_of
from regscribe_runtime import Link, LinkLost, NoAnswer, RegscribeError, identify
from regscribe_runtime.errors import STANDARD
from regscribe_runtime.values.protocol import Protocol
from regscribe_runtime.values.serial_line import SerialLine
from regscribe_runtime.wire.requests import READ_HOLDING, Request

FIRST_UNIT, LAST_UNIT = 1, 247
USUAL_BAUDS = (9600, 19200)
USUAL_FORMATS = ("8N1", "8E1")
SERIAL_SECONDS, TCP_SECONDS = 0.3, 1.0
"""How long a unit may take to answer where nothing else is said; over TCP a gateway with a timeout stands between."""

CHARACTERS, BITS = 13, 11
"""Characters of a request and of its answer besides the words, and the bits of the longest character."""

GATEWAY = frozenset({10, 11})
"""Exception codes that a gateway answers in place of a unit that is not there."""

_SPAN = re.compile(r"([0-9]{1,3})(?:-([0-9]{1,3}))?")
_FORMAT = re.compile(r"([78])([NEO])([12])")


class Probe(NamedTuple):
    """One request of a scan: its link and unit, the answer ("" if none came), and the models that the unit may be.

    `noise` is what came and is no answer.
    """

    link: LinkName
    unit: int
    answer: str = ""
    models: tuple[str, ...] = ()
    noise: str = ""


def units(text: str) -> tuple[int, ...]:
    """The unit ids of a list like `1-20,33`; TargetError."""
    found: list[int] = []
    for part in text.split(","):
        span = _SPAN.fullmatch(part.strip())
        first, last = (int(span[1]), int(span[2] or span[1])) if span else (0, 0)
        if not FIRST_UNIT <= first <= last <= LAST_UNIT:
            message = f"`{part.strip()[:40]}` names no units: write 1-247, or 1-20,33"
            raise TargetError(message)
        found += range(first, last + 1)
    return tuple(dict.fromkeys(found))


def settings(link: LinkName, bauds: Sequence[int], formats: Sequence[str]) -> tuple[LinkName, ...]:
    """The links to try: every speed with every character format (8N1); what the link states itself stays.

    TargetError for a format that is none, and for speeds over TCP.
    """
    if link.serial:
        named = any((link.parity, link.data_bits, link.stop_bits))
        own = "{data_bits}{parity}{stop_bits}".format_map(SerialLine()._asdict() | link.settings())
        shapes = formats or ((own,) if named else USUAL_FORMATS)
        speeds = bauds or ((link.baud,) if link.baud else USUAL_BAUDS)
        return tuple(_with_format(replace(link, baud=baud), shape) for baud in speeds for shape in shapes)
    if bauds or formats:
        message = f"{link}: TCP has no speed and no character format"
        raise TargetError(message)
    return (link,)


def seconds_for(link: LinkName, words: int = 1) -> float:
    """Seconds to wait for an answer of so many words: the link's timeout, else a default, and the characters' time."""
    if not link.serial:
        return link.timeout or TCP_SECONDS
    bits = (CHARACTERS + 2 * words) * BITS
    return (link.timeout or SERIAL_SECONDS) + bits / (link.baud or USUAL_BAUDS[0])


def longest(links: Sequence[LinkName], asked: Sequence[int]) -> float:
    """Seconds that a scan takes if no unit answers."""
    return sum(seconds_for(link) for link in links) * len(asked)


def scan(
    links: Sequence[LinkName],
    asked: Sequence[int],
    *,
    address: int = 0,
    packages: tuple[str, ...] = (),
    names: bool = True,
    every: bool = False,
) -> Iterator[Probe]:
    """Ask every unit on every link for one register; yields each probe.

    Once units answered with one setting of a line the others are not tried, unless `every` says so. With `names`, who
    answers is asked for its model. LinkLost if the port cannot be opened or vanishes.
    """
    for name in links:
        any_found = False
        target = Target(link=replace(name, timeout=seconds_for(name)), packages=packages)
        with closing(link_of(target)) as link:
            link.open()
            for unit in asked:
                probe = _probe(link, name, unit, address)
                if probe.answer and names:
                    probe = probe._replace(models=_models(link, unit, target))
                any_found = any_found or bool(probe.answer)
                yield probe
                if probe.noise and not name.serial:
                    break  # whoever listens there does not speak Modbus, whatever unit is asked
        if any_found and not every:
            return


def _with_format(link: LinkName, text: str) -> LinkName:
    found = _FORMAT.fullmatch(text.upper())
    if not found:
        message = f"`{text[:40]}` is no character format: write 8N1, 8E1, 8O1, 8N2, 7E1 ..."
        raise TargetError(message)
    return replace(link, data_bits=int(found[1]), parity=found[2], stop_bits=int(found[3]))


def _probe(link: Link, name: LinkName, unit: int, address: int) -> Probe:
    try:
        reply = link.call(unit, Request(READ_HOLDING, address))
    except NoAnswer:
        return Probe(name, unit)
    except LinkLost:
        raise
    except RegscribeError as error:
        return Probe(name, unit, noise=str(error))
    if reply.exception in GATEWAY:
        return Probe(name, unit)
    return Probe(name, unit, f"exception {reply.exception:02d}" if reply.exception is not None else "a value")


def _models(link: Link, unit: int, target: Target) -> tuple[str, ...]:
    try:
        found = identify(link, unit=unit, packages=packages_of(target)).models
    except LinkLost:
        raise
    except RegscribeError:
        return ()
    return tuple(known.model for known in found)


def exception_meaning(code: int, protocol: Protocol | None = None) -> str:
    """The name and the meaning of an exception code by the map of the device, else by the specification."""
    own = protocol.exception(code) if protocol else None
    name = (own.name if own else "") or STANDARD.get(code, "")
    return f"{name}: {own.meaning}" if own and own.meaning else name
