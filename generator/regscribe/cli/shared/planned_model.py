"""A compiled model to plan for: the planner of its driver takes its registers as they are."""

from collections.abc import Mapping
from dataclasses import dataclass

from regscribe import model as compiled
from regscribe_runtime.planning.address_ranges import ground_of
from regscribe_runtime.planning.cost import Cost
from regscribe_runtime.planning.plan import RequestLimits, Terms
from regscribe_runtime.values.protocol import Protocol


@dataclass(frozen=True, slots=True)
class PlannedModel:
    """A model to plan for, its registers by path, and the protocol of its device."""

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
        """The paths of all registers that are read where all are."""
        return [path for path, register in self.registers.items() if register.is_read_along]

    def terms(self, cost: Cost) -> Terms:
        """Limits, readable ground and cost that a plan is made under."""
        ground = ground_of(self.registers.values(), unused=self.model.unused, holes=self.protocol.read_holes)
        return Terms(RequestLimits.of(self.protocol), ground, cost)
