"""A compiled model to plan for: the planner of its driver takes its registers as they are."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from fractions import Fraction

from regscribe import model as compiled
from regscribe.checks.held_values import default_values, with_fields
from regscribe.model.located import layout_of, located
from regscribe.reference import Surroundings, UnknownValueError, holds, surroundings_of
from regscribe_runtime.planning.address_ranges import ground_of
from regscribe_runtime.planning.cost import Cost
from regscribe_runtime.planning.plan import RequestLimits, Terms
from regscribe_runtime.values.facts import Page
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

    def known(self, register_map: compiled.RegisterMap, state: Mapping[str, Fraction]) -> Surroundings:
        """What is known of a device whose registers hold `state`, else their defaults."""
        return surroundings_of(register_map, {}, with_fields(self.model, {**default_values(self.model), **state}))

    def absent(self, known: Surroundings) -> frozenset[str]:
        """The registers that do not exist as things stand; in doubt one exists."""
        asked = [one for one in self.registers.values() if not one.when.always]
        gone = {one.path for one in asked if not _may_hold(one.when, known)}
        while more := {one.path for one in asked if one.path not in gone and gone.intersection(one.when.registers)}:
            gone |= more
        return frozenset(gone)

    def terms(self, cost: Cost, absent: Collection[str] = ()) -> Terms:
        """Limits, readable ground and cost that a plan is made under."""
        unused = (*self.model.unused, *self.layout.stretches)
        ground = ground_of(self.registers.values(), unused=unused, holes=self.protocol.read_holes, absent=absent)
        pages = tuple(Page(page.steps, page.unit, page.at_once) for page in self.model.pages)
        return Terms(RequestLimits.of(self.protocol), ground, cost, pages)


def _may_hold(condition: compiled.Condition, known: Surroundings) -> bool:
    try:
        return holds(condition, known)
    except UnknownValueError:
        return True
