"""A compiled model with its driver, made in memory, so that plans are those of the driver's own planner."""

import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from types import ModuleType

from regscribe import model as compiled
from regscribe.emit import python
from regscribe_runtime import BareDevice, Protocol, Register
from regscribe_runtime.operations.prepared_read import dependencies, laid_out
from regscribe_runtime.operations.session import TERMS, Session
from regscribe_runtime.planning.cost import Cost
from regscribe_runtime.planning.plan import Terms
from regscribe_runtime.planning.read_order import ReadOrder
from regscribe_runtime.planning.read_places import ReadPlace, read_places


@dataclass(frozen=True, slots=True)
class PlannedModel:
    """A model to plan for, and the class of its driver."""

    model: compiled.Model
    driver: type[BareDevice]

    @classmethod
    def of(cls, register_map: compiled.RegisterMap, name: str) -> "PlannedModel":
        """A model of a map."""
        model = register_map.model(name)
        return cls(model, driver_of(register_map, model))

    @property
    def protocol(self) -> Protocol:
        """What the device accepts."""
        return self.driver.protocol

    @property
    def registers(self) -> dict[str, Register[object]]:
        """All registers by path, as the driver declares them."""
        return dict(self.driver.registers)

    @property
    def readable(self) -> list[str]:
        """The paths of all registers that can be read."""
        return [path for path, register in self.driver.registers.items() if register.access != "w"]

    def terms(self, cost: Cost) -> Terms:
        """What plans keep to, at a cost."""
        return self._session().terms()._replace(cost=cost)

    def places(self, path: str) -> tuple[ReadPlace, ...]:
        """Where a register can be read with the same result."""
        return read_places(self.driver.registers[path])

    def with_needs(self, paths: Iterable[str]) -> list[str]:
        """The same registers and behind them all that their meaning depends on, as a driver reads them."""
        found = list(paths)
        needs = dependencies(self._session(), [self.driver.registers[path] for path in found])
        needed = frozenset().union(*needs.values())
        return list(dict.fromkeys([*found, *(path for path in needs if path in needed)]))

    def layout(self, paths: Iterable[str], terms: Terms, *, fresh: bool) -> ReadOrder:
        """Where a driver reads registers and, with `fresh`, what their meaning depends on."""
        session = self._session()
        session.prepared[TERMS] = terms
        return laid_out(session, [self.driver.registers[path] for path in paths], fresh=fresh)[0]

    def _session(self) -> Session:
        return Session(
            unit=self.protocol.unit_ids[0],
            protocol=self.protocol,
            registers=self.driver.registers,
            commands={},
            givens={},
            unused=self.driver._unused,  # noqa: SLF001 (a fact for the runtime)
        )


def driver_of(register_map: compiled.RegisterMap, model: compiled.Model) -> type[BareDevice]:
    """The class of a model's synchronous driver, from the module as it would be generated but without a file."""
    with _set_aside(python.render(register_map)) as modules:
        for module, text in modules:
            exec(compile(text, module.__name__, "exec"), vars(module))  # noqa: S102 (what `generate` writes)
    driver: type[BareDevice] = getattr(modules[-1][0], model.class_name)
    return driver


@contextmanager
def _set_aside(files: dict[str, str]) -> Iterator[list[tuple[ModuleType, str]]]:
    """New modules in place of those of the same names, until what is made of them is made; bases come first."""
    modules = [ModuleType(path.removesuffix(".py").replace("/", ".")) for path in files]
    names = [module.__name__ for module in modules]
    before = {name: sys.modules[name] for name in names if name in sys.modules}
    sys.modules.update(zip(names, modules, strict=True))
    try:
        yield list(zip(modules, files.values(), strict=True))
    finally:
        for name in names:
            del sys.modules[name]
        sys.modules.update(before)
