"""What all devices of one model share: where values stand, what they begin with, and what depends on what."""

from collections import OrderedDict
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from threading import Lock

from regscribe.model import Model, NotANumber, OrderFrom, Register, RegisterMap, Space
from regscribe.reference import Surroundings
from regscribe.simulate.device.address_index import AddressIndex, AddressSpan, places_of
from regscribe.simulate.device.followed_values import sources_of

Stored = Fraction | str | NotANumber
"""What the device holds for a register: a number (an enum's code, a word's bits), a text, or a float that is none."""

Image = dict[Space, dict[int, int]]
"""What a read shows at each address."""

_KEPT = 64


@dataclass(frozen=True, slots=True)
class Blueprint:
    """The immutable part of a device: of 1,000 devices of one model there is one.

    `stored` and `image` are the state of a new device, of which each device keeps only what is different; they are
    filled once, by `State`. `places` are where a register is transmitted, `ordered_by` the registers whose word order
    a register sets, `followers` those that (or whose bits) change with it, `shadows` all that take
    their value from another one when power comes, each behind the one that it shadows.
    """

    register_map: RegisterMap
    model: Model
    givens: Surroundings
    layout: AddressIndex
    places: Mapping[str, tuple[AddressSpan, ...]]
    ordered_by: Mapping[str, tuple[Register, ...]]
    followers: Mapping[str, tuple[Register, ...]]
    shadows: tuple[Register, ...]
    stored: dict[str, Stored] = field(default_factory=dict)
    image: Image = field(default_factory=lambda: {space: {} for space in Space})


def draw(register_map: RegisterMap, model: Model, givens: Surroundings) -> Blueprint:
    """Return a new blueprint, its state still empty."""
    return Blueprint(
        register_map,
        model,
        givens,
        AddressIndex(model, register_map.reserved),
        {register.path: places_of(register) for register in model.registers},
        _by_source(model.registers, _orderers),
        _by_source(model.registers, sources_of),
        _shadows(model),
    )


def _by_source(
    registers: Iterable[Register], sources: Callable[[Register], Iterable[str]]
) -> dict[str, tuple[Register, ...]]:
    found: dict[str, list[Register]] = {}
    for register in registers:
        for path in sources(register):
            found.setdefault(path, []).append(register)
    return {path: tuple(dependents) for path, dependents in found.items()}


def _shadows(model: Model) -> tuple[Register, ...]:
    """All shadows of a model, those of a register that is no shadow itself first."""
    origins = {register.path: register.shadows for register in model.registers if register.shadows}
    return tuple(sorted((model.register(path) for path in origins), key=lambda one: _depth(one.path, origins)))


def _depth(path: str, origins: Mapping[str, str]) -> int:
    passed: list[str] = []
    while path in origins and path not in passed:  # the latter: a circle, which has to end somewhere
        passed.append(path)
        path = origins[path]
    return len(passed)


def _orderers(register: Register) -> set[str]:
    orders = (view.order for view in register.views)
    return {order.register for order in orders if isinstance(order, OrderFrom)}


_Key = tuple[int, str, frozenset[tuple[str, bool | frozenset[Fraction]]]]


class PlanCache:
    """The last blueprints by map (the object, not its contents), model and givens."""

    def __init__(self) -> None:
        self._kept: OrderedDict[_Key, Blueprint] = OrderedDict()
        self._lock = Lock()

    def find(self, register_map: RegisterMap, model: Model, givens: Surroundings) -> Blueprint | None:
        """Return the blueprint of an earlier device; None if there is none."""
        return self._kept.get(_key(register_map, model, givens))

    def put(self, blueprint: Blueprint) -> None:
        """Keep a blueprint; it keeps its map alive, so that no other map can take the place of that object."""
        with self._lock:
            self._kept[_key(blueprint.register_map, blueprint.model, blueprint.givens)] = blueprint
            while len(self._kept) > _KEPT:
                self._kept.popitem(last=False)


def _key(register_map: RegisterMap, model: Model, givens: Surroundings) -> _Key:
    return id(register_map), model.name, frozenset((*givens.codes.items(), *givens.facts.items()))
