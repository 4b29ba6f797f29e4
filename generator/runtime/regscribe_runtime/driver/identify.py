"""Identification of a device by the identity registers of all known models; several models may fit."""

import importlib
import pkgutil
from collections.abc import Iterable, Iterator
from importlib.metadata import entry_points
from importlib.util import find_spec
from itertools import chain
from types import ModuleType
from typing import Any, NamedTuple

from regscribe_runtime.driver.device import AsyncBareDevice, BareDevice
from regscribe_runtime.driver.executor import carry_out, carry_out_async
from regscribe_runtime.errors import ExceptionAnswer, LinkLost, RegscribeError
from regscribe_runtime.link.links import AsyncLink, Link
from regscribe_runtime.operations.locate import located
from regscribe_runtime.operations.read import read_request
from regscribe_runtime.operations.session import Operation, Session, Task
from regscribe_runtime.registers import codec
from regscribe_runtime.registers.register import Register
from regscribe_runtime.values.blocks import RegisterBlock
from regscribe_runtime.values.protocol import Protocol
from regscribe_runtime.values.views import View
from regscribe_runtime.values.wire_types import WIRE
from regscribe_runtime.wire.requests import Request, verify

DRIVERS = "regscribe.drivers"
"""The group of entry points of packages with generated drivers."""
SHIPPED = "regscribe_devices"
"""The package of the drivers that come with regscribe, and of those that `regscribe generate` writes."""

MOST_TRIED = 4
"""Of the registers that each device of a model has, those that are asked for besides what the model is known by."""

Answer = tuple[int, ...] | RegscribeError
"""The words of a register, or the error in their place."""


class Known(NamedTuple):
    """A model that drivers exist for."""

    map_id: str
    model: str
    driver: type[BareDevice]
    async_driver: type[AsyncBareDevice]


class Evidence(NamedTuple):
    """Words and value of one identity register of some models, or the error in their place."""

    map_ids: tuple[str, ...]
    register: str
    address: int
    words: tuple[int, ...]
    value: Any
    error: RegscribeError | None


class Identification(NamedTuple):
    """The models that fit what was read (none, one or several), with the evidence.

    `lacking` would fit, but for a register that each of their devices has and this one refuses.
    """

    models: tuple[Known, ...]
    evidence: tuple[Evidence, ...]
    lacking: tuple[tuple[Known, Evidence], ...] = ()

    @property
    def certain(self) -> bool:
        """Whether exactly one model fits."""
        return len(self.models) == 1


def known_models(*packages: ModuleType) -> tuple[Known, ...]:
    """The models with identity facts in generated packages.

    Without `packages` in `regscribe_devices`, if it is installed, and in the modules of entry points of DRIVERS.
    The first of several that have a model provides it.
    """
    if not packages:
        declared = {point.module for point in entry_points(group=DRIVERS)}
        names = sorted(declared | ({SHIPPED} if find_spec(SHIPPED) else set()))
        packages = tuple(map(importlib.import_module, names))
    found: dict[tuple[str, str], Known] = {}
    for module in _modules(packages):
        for value in list(vars(module).values()):
            if isinstance(value, type) and issubclass(value, BareDevice) and value.identity:
                partner = getattr(module, f"Async{value.__name__}")
                found.setdefault((value.map_id, value.model), Known(value.map_id, value.model, value, partner))
    return tuple(found[key] for key in sorted(found))


def _modules(packages: Iterable[ModuleType]) -> Iterator[ModuleType]:
    for package in packages:
        yield package
        for info in pkgutil.walk_packages(getattr(package, "__path__", []), f"{package.__name__}."):
            yield importlib.import_module(info.name)


def identify(link: Link, *, unit: int, packages: tuple[ModuleType, ...] = ()) -> Identification:
    """Identify the unit on an open link; only reads are sent."""
    with link.lock.of(unit):
        return carry_out(_identify(known_models(*packages), unit), link, unit)


async def identify_async(link: AsyncLink, *, unit: int, packages: tuple[ModuleType, ...] = ()) -> Identification:
    """As `identify`, for asyncio."""
    async with link.lock.of(unit):
        return await carry_out_async(_identify(known_models(*packages), unit), link, unit)


def identity_of(*models: Known) -> Task[Identification]:
    """The operation that identifies a device among `models`."""
    return lambda session: _identify(models, session.unit)


def _identify(models: tuple[Known, ...], unit: int) -> Operation[Identification]:
    asked, fitting = _Asked(unit, _protocol(models)), []
    for known in models:
        state: dict[str, Any] = {}
        for path in dict.fromkeys(chain.from_iterable(one.registers() for one in known.driver.identity)):
            found = yield from asked.about(known, path)
            if found.error is None:
                state[path] = found.value
        if any(one.fits(state) for one in known.driver.identity if set(one.registers()) <= set(state)):
            fitting.append(known)
    lacking = {}
    for known in fitting:
        if missed := (yield from asked.lacks(known, fitting)):
            lacking[known] = missed
    left = tuple(known for known in fitting if known not in lacking)
    return Identification(left, tuple(asked.evidence.values()), tuple(lacking.items()))


def _protocol(models: tuple[Known, ...]) -> Protocol:
    """In whose words refusals are told: those of the one map; a device of several may be none of them."""
    return models[0].driver.protocol if len({known.map_id for known in models}) == 1 else Protocol()


class _Asked:
    """What one unit was asked, and what it answered; nothing is asked twice."""

    def __init__(self, unit: int, protocol: Protocol) -> None:
        self.unit = unit
        self.protocol = protocol
        self.evidence: dict[tuple[Request, str], Evidence] = {}
        self._answers: dict[Request, Answer] = {}
        self._sessions: dict[tuple[RegisterBlock, ...], Session] = {}

    def about(self, known: Known, path: str) -> Operation[Evidence]:
        """What a register of a model holds."""
        register, absent = yield from _located(known.driver.registers[path], self._sessions, self.unit, known)
        request = read_request(register, _view(register))
        if absent:
            self._answers[request] = absent
        elif request not in self._answers:
            self._answers[request] = yield from _ask(request, self.unit, self.protocol)
        earlier = self.evidence.get((request, path))
        maps = (*(earlier.map_ids if earlier else ()), known.map_id)
        found = _evidence(tuple(dict.fromkeys(maps)), register, request, self._answers[request])
        self.evidence[request, path] = found
        return found

    def lacks(self, known: Known, others: list[Known]) -> Operation[Evidence | None]:
        """The first refusal of a register that each device of the model has, of the few that are tried; or None."""
        for path in _tried(known, others):
            error = (found := (yield from self.about(known, path))).error
            if isinstance(error, ExceptionAnswer) and error.code == known.driver.protocol.absent:
                return found
        return None


def _tried(known: Known, others: list[Known]) -> list[str]:
    """Registers that each device of the model has: those that were read already, and first of others what few have."""
    read = {path for one in known.driver.identity for path in one.registers()}
    found = [path for path, one in known.driver.registers.items() if one.mandatory and _is_plain(one)]
    found.sort(key=lambda path: (path not in read, sum(path in other.driver.registers for other in others)))
    return found[: MOST_TRIED + len(read.intersection(found))]


def _is_plain(register: Register[Any]) -> bool:
    """Whether one read that changes nothing tells if it is there: it has no condition, block or page."""
    plain = register.is_read_along and register.when.always and not register.block
    return plain and _view(register).address(register.at) <= WIRE


def _located(
    register: Register[Any], sessions: dict[tuple[RegisterBlock, ...], Session], unit: int, known: Known
) -> Operation[tuple[Register[Any], RegscribeError | None]]:
    """The register where the unit has its block, or with the reason why it has none; a chain is walked once."""
    if not register.block:
        return register, None
    driver = known.driver
    blocks, protocol = driver._blocks, driver.protocol  # noqa: SLF001 (drivers are one family)
    if blocks not in sessions:
        registers = driver.registers
        sessions[blocks] = Session(
            unit=unit, protocol=protocol, registers=registers, commands={}, givens={}, blocks=blocks
        )
    try:
        return (yield from located(sessions[blocks], register)), None
    except LinkLost:
        raise  # there is nobody left to ask
    except RegscribeError as error:
        return register, error


def _view(register: Register[Any]) -> View:
    """The first readable view whose meaning depends on no other register."""
    return next((view for view in register.views if view.readable and not view.needs()), register.read_view())


def _ask(request: Request, unit: int, protocol: Protocol) -> Operation[Answer]:
    try:
        reply = yield request
        return verify(request, reply, unit=unit, protocol=protocol) if reply else ()
    except LinkLost:
        raise  # there is nobody left to ask
    except RegscribeError as error:
        return error


def _evidence(map_ids: tuple[str, ...], register: Register[Any], request: Request, answer: Answer) -> Evidence:
    if isinstance(answer, RegscribeError):
        return Evidence(map_ids, register.path, request.address, (), None, answer)
    try:
        value, error = codec.decode(register, _view(register), answer, {}, {}), None
    except RegscribeError as undecodable:
        value, error = None, undecodable
    return Evidence(map_ids, register.path, request.address, answer, value, error)
