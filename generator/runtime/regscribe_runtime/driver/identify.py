"""Which device answers: every known model is asked what shows its identity; several may fit, none is guessed."""

import importlib
import pkgutil
from collections.abc import Iterable, Iterator, Mapping
from importlib.metadata import entry_points
from importlib.util import find_spec
from types import ModuleType
from typing import Any, NamedTuple

from regscribe_runtime.driver.device import AsyncBareDevice, BareDevice
from regscribe_runtime.driver.executor import carry_out, carry_out_async
from regscribe_runtime.errors import LinkLost, RegscribeError
from regscribe_runtime.link.links import AsyncLink, Link
from regscribe_runtime.operations.read import read_request
from regscribe_runtime.operations.session import Operation, Task
from regscribe_runtime.registers import codec
from regscribe_runtime.registers.register import Register
from regscribe_runtime.values.views import View
from regscribe_runtime.wire.requests import Request, verify

DRIVERS = "regscribe.drivers"
"""The group of entry points by which a package says that it holds generated drivers."""
SHIPPED = "regscribe_devices"
"""The package of the drivers that come with regscribe, and of those that `regscribe generate` writes."""


Answer = tuple[int, ...] | RegscribeError
"""The words of a register, or why there are none."""


class Known(NamedTuple):
    """A model that drivers exist for."""

    map_id: str
    model: str
    driver: type[BareDevice]
    async_driver: type[AsyncBareDevice]


class Evidence(NamedTuple):
    """What one identity register of some models gave: words and value, or the error in place of them."""

    map_ids: tuple[str, ...]
    register: str
    address: int
    words: tuple[int, ...]
    value: Any
    error: RegscribeError | None


class Identification(NamedTuple):
    """The models that fit what was read (none, one, or several that the answers do not tell apart), with evidence."""

    models: tuple[Known, ...]
    evidence: tuple[Evidence, ...]

    @property
    def certain(self) -> bool:
        """Whether exactly one model fits."""
        return len(self.models) == 1


def known_models(*packages: ModuleType) -> tuple[Known, ...]:
    """The models of generated packages (by default of all that are installed) that have identity facts."""
    found = {}
    for module in _modules(packages or _installed()):
        for value in list(vars(module).values()):
            if isinstance(value, type) and issubclass(value, BareDevice) and value.identity:
                partner = getattr(module, f"Async{value.__name__}")
                found[value.map_id, value.model] = Known(value.map_id, value.model, value, partner)
    return tuple(found[key] for key in sorted(found))


def _installed() -> tuple[ModuleType, ...]:
    """`regscribe_devices`, if it is there, and what distributions declare as entry points of the group DRIVERS."""
    declared = {point.module for point in entry_points(group=DRIVERS)}
    names = sorted(declared | ({SHIPPED} if find_spec(SHIPPED) else set()))
    return tuple(map(importlib.import_module, names))


def _modules(packages: Iterable[ModuleType]) -> Iterator[ModuleType]:
    for package in packages:
        yield package
        for info in pkgutil.walk_packages(getattr(package, "__path__", []), f"{package.__name__}."):
            yield importlib.import_module(info.name)


def identify(link: Link, *, unit: int, packages: tuple[ModuleType, ...] = ()) -> Identification:
    """Ask the unit on an open link what it is; only reads are sent."""
    with link.lock.of(unit):
        return carry_out(_identify(known_models(*packages), unit), link, unit)


async def identify_async(link: AsyncLink, *, unit: int, packages: tuple[ModuleType, ...] = ()) -> Identification:
    """As `identify`, for asyncio."""
    async with link.lock.of(unit):
        return await carry_out_async(_identify(known_models(*packages), unit), link, unit)


def identity_of(*models: Known) -> Task[Identification]:
    """The question whether a device shows to be one of `models`, as an operation."""
    return lambda session: _identify(models, session.unit)


def _identify(models: tuple[Known, ...], unit: int) -> Operation[Identification]:
    answers: dict[Request, Answer] = {}
    evidence: dict[tuple[Request, str], Evidence] = {}
    fitting = []
    for known in models:
        state: dict[str, Any] = {}
        for path in dict.fromkeys(path for one in known.driver.identity for path in one.registers()):
            register = known.driver.registers[path]
            request = read_request(register, _view(register))
            if request not in answers:
                answers[request] = yield from _ask(request, unit, known)
            found = _seen(known, path, request, answers[request])
            _note(evidence, (request, path), found)
            if found.error is None:
                state[path] = found.value
        if _fits(known, state):
            fitting.append(known)
    return Identification(tuple(fitting), tuple(evidence.values()))


def _note(evidence: dict[tuple[Request, str], Evidence], key: tuple[Request, str], found: Evidence) -> None:
    """Keep what was seen last, for all maps that were asked about it."""
    before = evidence[key].map_ids if key in evidence else ()
    evidence[key] = found._replace(map_ids=tuple(dict.fromkeys((*before, *found.map_ids))))


def _fits(known: Known, state: Mapping[str, Any]) -> bool:
    return any(one.fits(state) for one in known.driver.identity if set(one.registers()) <= set(state))


def _view(register: Register[Any]) -> View:
    """The first view that may be read and needs no other register to be understood."""
    return next((view for view in register.views if view.readable and not view.needs()), register.read_view())


def _ask(request: Request, unit: int, known: Known) -> Operation[Answer]:
    try:
        reply = yield request
        return verify(request, reply, unit=unit, protocol=known.driver.protocol) if reply else ()
    except LinkLost:
        raise  # there is nobody left to ask
    except RegscribeError as error:
        return error


def _seen(known: Known, path: str, request: Request, answer: Answer) -> Evidence:
    if isinstance(answer, RegscribeError):
        return Evidence((known.map_id,), path, request.address, (), None, answer)
    value, error, register = None, None, known.driver.registers[path]
    try:
        value = codec.decode(register, _view(register), answer, {}, {})
    except RegscribeError as undecodable:
        error = undecodable
    return Evidence((known.map_id,), path, request.address, answer, value, error)
