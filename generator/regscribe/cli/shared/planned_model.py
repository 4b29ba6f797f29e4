"""A compiled model as the planner of its driver sees it: the same declarations, so the same plans."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from regscribe import model as compiled
from regscribe_runtime.operations.prepared_read import dependencies, laid_out
from regscribe_runtime.planning.address_ranges import ground_of
from regscribe_runtime.planning.cost import Cost
from regscribe_runtime.planning.plan import RequestLimits, Terms
from regscribe_runtime.planning.read_order import ReadOrder
from regscribe_runtime.planning.read_places import ReadPlace, read_places
from regscribe_runtime.values.protocol import Protocol


@dataclass(frozen=True, slots=True)
class PlannedModel:
    """A model to plan for, its registers by path, and what the device accepts."""

    model: compiled.Model
    registers: Mapping[str, compiled.Register]
    protocol: Protocol

    @classmethod
    def of(cls, register_map: compiled.RegisterMap, name: str) -> "PlannedModel":
        """A model of a map."""
        model = register_map.model(name)
        return cls(model, {register.path: register for register in model.registers}, register_map.protocol)

    @property
    def readable(self) -> list[str]:
        """The paths of all registers that can be read."""
        return [path for path, register in self.registers.items() if register.access.readable]

    def terms(self, cost: Cost) -> Terms:
        """What plans keep to, at a cost."""
        ground = ground_of(self.registers.values(), unused=self.model.unused, holes=self.protocol.read_holes)
        return Terms(RequestLimits.of(self.protocol), ground, cost)

    def places(self, path: str) -> tuple[ReadPlace, ...]:
        """Where a register can be read with the same result."""
        return read_places(self.registers[path])

    def with_needs(self, paths: Iterable[str]) -> list[str]:
        """The same registers and behind them all that their meaning depends on, as a driver reads them."""
        found = list(paths)
        needs = dependencies(self.registers, [self.registers[path] for path in found])
        needed = frozenset().union(*needs.values())
        return list(dict.fromkeys([*found, *(path for path in needs if path in needed)]))

    def layout(self, paths: Iterable[str], terms: Terms, *, fresh: bool) -> ReadOrder:
        """Where a driver reads registers and, with `fresh`, what their meaning depends on."""
        return laid_out(self.registers, [self.registers[path] for path in paths], terms, fresh=fresh)[0]
