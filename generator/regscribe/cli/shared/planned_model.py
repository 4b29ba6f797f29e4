"""A compiled model to plan for: the planner of its driver takes its registers as they are."""

from collections.abc import Mapping
from dataclasses import dataclass

from regscribe import model as compiled
from regscribe.model.located import layout_of, located
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
    layout: compiled.Layout

    @classmethod
    def of(cls, register_map: compiled.RegisterMap, name: str, bases: Mapping[str, int]) -> "PlannedModel":
        """A model of a map; `bases` are addresses by the ids of its blocks and chains, as far as they are stated."""
        model = register_map.model(name)
        layout = layout_of(register_map, model, bases)
        model = located(model, layout)
        return cls(model, {register.path: register for register in model.registers}, register_map.protocol, layout)

    @property
    def readable(self) -> list[str]:
        """The paths of all registers that are read where all are."""
        return [path for path, register in self.registers.items() if register.is_read_along]

    def terms(self, cost: Cost) -> Terms:
        """Limits, readable ground and cost that a plan is made under."""
        unused = (*self.model.unused, *self.layout.stretches)
        ground = ground_of(self.registers.values(), unused=unused, holes=self.protocol.read_holes)
        return Terms(RequestLimits.of(self.protocol), ground, cost)
