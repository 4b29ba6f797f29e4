"""A target: the text that names a device for every command; parsed here, and made a driver."""

import re
import sys
from collections.abc import Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, field, replace
from types import ModuleType
from typing import Any

from regscribe.tools.live import catalogue, givens, link_names
from regscribe.tools.live import config as configuration
from regscribe.tools.live.config import Config
from regscribe.tools.live.errors import TargetError, unknown
from regscribe.tools.live.link_names import LinkName
from regscribe_runtime import BareDevice, Link, LinkLost, NoAnswer, identify, tcp
from regscribe_runtime.driver.identify import Identification, Known, identity_of
from regscribe_runtime.link.connect import serial
from regscribe_runtime.link.links import Tracer

LAST_UNIT = 255
MOST_DIGITS = 9
USUAL_UNIT = 1
GIVEN = "given."
KEYS = ("unit", "model", "map")
"""What may stand behind the `?` of a link to name the device, besides `given.ID`."""
USUAL_BAUD = 9600
IDENTIFY_SECONDS = 1.0
"""How long an unknown device may take to answer; its manual is not known yet."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Target:
    """A device: the link to it, its unit, its model ("" until it was identified), its givens as texts.

    `name` is what the configuration calls it, `packages` are the user's packages of drivers. Its `map`, a file or an
    id, says among which models it is ("": among all).
    `trace` is told of every frame.
    """

    link: LinkName
    unit: int = USUAL_UNIT
    model: str = ""
    map: str = ""
    givens: Mapping[str, str] = field(default_factory=dict)
    name: str = ""
    packages: tuple[str, ...] = ()
    trace: Tracer | None = field(default=None, compare=False)

    def __str__(self) -> str:
        return self.name or f"unit {self.unit} on {self.link}"

    def known(self) -> Known:
        """The drivers of its model; TargetError if it has none, or none that is known."""
        if not self.model:
            message = f"{self}: its model is not known yet: add ?model=..., or let `identified` ask it"
            raise TargetError(message)
        inside = self.map and ":" not in self.model
        return catalogue.find(f"{self.map}:{self.model}" if inside else self.model, self.packages)


def parse(text: str, config: Config | None = None) -> Target:
    """The device that a text names: a link with `?unit=1&model=16C`, or a name of the configuration; TargetError."""
    configured = config or Config()
    if link_names.is_link(text):
        link, more = link_names.split(text)
        return _with(Target(link=link, packages=configured.packages), text, more)
    if text not in configured.devices:
        where = f"in {configured.path}" if configured.path else "and no configuration names devices (regscribe.yaml)"
        usual = "" if configured.devices else ": write tcp:HOST:PORT or rtu:/dev/ttyUSB0"
        hint = f"; of a link write tcp:{text}" if re.search(r"[\w\]]:[0-9]{1,5}(\?|$)", text) else usual
        raise TargetError(unknown("device", text, configured.devices, where=where) + hint)
    entry = configured.devices[text]
    link, more = link_names.split(entry.link)
    link = link_names.with_settings(link, {"timeout": entry.timeout} if entry.timeout else {})
    found = _with(Target(link=link, name=text, packages=configured.packages), entry.link, more)
    return override(found, unit=entry.unit, model=entry.model, map_name=entry.map, given=entry.givens)


def named(text: str, config: str | None = None, packages: Sequence[str] = ()) -> Target:
    """The device that a text names under a configuration, its model looked for in more packages; TargetError."""
    target = parse(text, configuration.load(config))
    return replace(target, packages=tuple(dict.fromkeys((*packages, *target.packages))))


def override(
    target: Target,
    *,
    unit: int | None = None,
    model: str = "",
    map_name: str = "",
    given: Mapping[str, str] | None = None,
) -> Target:
    """The target with the given parts replaced; TargetError for a unit id that is none."""
    if unit is not None and not 0 <= unit <= LAST_UNIT:
        message = f"unit {unit}: a unit id is 0 to {LAST_UNIT}"
        raise TargetError(message)
    return replace(
        target,
        unit=target.unit if unit is None else unit,
        model=model or target.model,
        map=map_name or target.map,
        givens={**target.givens, **(given or {})},
    )


def connect(target: Target) -> BareDevice:
    """A synchronous driver of the target, not opened yet; TargetError if its model or its givens are wrong."""
    driver: Any = target.known().driver
    link, given = target.link, givens.understood(driver, target.givens)
    make, place = (driver.rtu, link.device) if link.serial else (driver.tcp, link.host)
    try:
        device: BareDevice = make(
            place, unit=target.unit, timeout=link.timeout, trace=target.trace, **given, **link.settings()
        )
    except ValueError as error:
        message = f"{target}: {error}"
        raise TargetError(message) from None
    return device


def link_of(target: Target) -> Link:
    """A link to the target without a driver, not opened yet; 9600 8N1 where a line's settings are not given."""
    link, seconds = target.link, target.link.timeout or IDENTIFY_SECONDS
    if not link.serial:
        return tcp(link.host, timeout=seconds, trace=target.trace, **link.settings())
    line: dict[str, Any] = {"baud": USUAL_BAUD, **link.settings()}
    return serial(link.device, timeout=seconds, trace=target.trace, **line)


def unknown_device(target: Target) -> BareDevice:
    """A driver for the words of a target whose model is not known, not opened yet."""
    return BareDevice(link_of(target), unit=target.unit)


def packages_of(target: Target) -> tuple[ModuleType, ...]:
    """The packages whose models the target may be; TargetError if one cannot be imported."""
    if not target.map:
        return catalogue.modules(target.packages)
    found = catalogue.of_map(target.map, target.packages)
    return tuple(dict.fromkeys(sys.modules[known.driver.__module__] for known in found))


def identification(target: Target) -> Identification:
    """Identify the device: the models that fit (perhaps none) with the evidence; RegscribeError for the link."""
    with closing(link_of(target)) as link:
        link.open()
        return identify(link, unit=target.unit, packages=packages_of(target))


def identified(target: Target) -> Target:
    """The target with its model, as given or as identified; TargetError if that is unknown or ambiguous."""
    if target.model:
        return target
    if target.map and len(known := catalogue.of_map(target.map, target.packages)) == 1:
        return replace(target, model=known[0].model)
    found = identification(target)
    if found.certain:
        return replace(target, model=found.models[0].model if target.map else catalogue.full_name(found.models[0]))
    answered(found)
    if not found.models:
        seen = "; ".join(dict.fromkeys(str(one.error) for one in found.evidence if one.error)) or "no answer fits"
        message = f"{target}: the device is none that drivers exist for ({seen}): name its model with ?model=..."
        raise TargetError(message)
    names = " or ".join(f"model={one.model}" for one in found.models)
    message = f"{target}: its answers fit {len(found.models)} models alike: write ?{names}"
    raise TargetError(message)


def check_identity(device: BareDevice, target: Target) -> None:
    """Verify that the open device is the model of its driver; TargetError if it is another.

    A model passes if its manual gives it no identity.
    """
    known = target.known()
    if not known.driver.identity:
        return
    found = device.run(identity_of(known))
    answered(found)
    if found.certain:
        return
    seen = [f"{one.register} is {one.value if one.error is None else one.error}" for one in found.evidence]
    message = f"{target} does not show to be a {known.model}: {', '.join(seen)}"
    raise TargetError(message)


def answered(found: Identification) -> None:
    """Raise the error of the link if nothing was answered."""
    silent = [one.error for one in found.evidence if isinstance(one.error, (NoAnswer, LinkLost))]
    if silent and len(silent) == len(found.evidence):
        raise silent[0]


def _with(target: Target, text: str, more: Mapping[str, str]) -> Target:
    for key in more:
        if key not in KEYS and not key.startswith(GIVEN):
            message = f"{text}: {unknown('setting', key, [*KEYS, *link_names.KEYS, f'{GIVEN}ID'])}"
            raise TargetError(message)
    unit = more.get("unit", str(USUAL_UNIT))
    if not unit.isascii() or not unit.isdigit() or len(unit) > MOST_DIGITS or int(unit) > LAST_UNIT:
        message = f"{text}: unit={unit}: a unit id is 0 to {LAST_UNIT}"
        raise TargetError(message)
    given = {key.removeprefix(GIVEN): value for key, value in more.items() if key.startswith(GIVEN)}
    return override(target, unit=int(unit), model=more.get("model", ""), map_name=more.get("map", ""), given=given)


def given_texts(texts: Sequence[str]) -> dict[str, str]:
    """`ID=VALUE` of a command line, by id; TargetError."""
    found = {}
    for text in texts:
        name, equals, value = text.partition("=")
        if not name or not equals:
            message = f"--given {text}: write ID=VALUE, for example linear_inputs=1,4..6"
            raise TargetError(message)
        found[name] = value
    return found
