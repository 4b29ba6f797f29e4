"""A program of a device by its number (recipe 2 of 4), and the registers that hold it."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from regscribe.tools.live.errors import TargetError, unknown
from regscribe_runtime import AsyncBareDevice, BareDevice, Register, SetpointProgram
from regscribe_runtime.operations.read import exists
from regscribe_runtime.operations.session import Operation, Session
from regscribe_runtime.values.programs import numbered

Driver = BareDevice | AsyncBareDevice | type[BareDevice] | type[AsyncBareDevice]


@dataclass(frozen=True, slots=True)
class ProgramSlot:
    """Program `number` of those that `spec` declares (0 where there is one without a number), on one model."""

    spec: SetpointProgram
    number: int
    registers: Mapping[str, Register[Any]]
    model: str
    map_id: str

    @property
    def name(self) -> str:
        """`recipe`, or with its number `program 2`."""
        return f"{self.spec.id} {self.number}" if self.spec.programs else self.spec.id

    def exists(self, session: Session) -> Operation[None]:
        """Raise NotPresent if the device has no such program now, by what it says."""
        return exists(session, self.name, self.spec.when)

    def register(self, path: str, segment: int = 0) -> Register[Any]:
        """The register of a path of the declaration, for this program and a segment."""
        return self.registers[numbered(path, self.number, segment)]


def places(driver: Driver) -> tuple[ProgramSlot, ...]:
    """The programs of a device or a driver's class."""
    made = driver if isinstance(driver, type) else type(driver)
    return tuple(
        ProgramSlot(spec, number, made.registers, made.model, made.map_id)
        for spec in made.setpoint_programs
        for number in spec.numbers
    )


def place(driver: Driver, name: str = "") -> ProgramSlot:
    """The program of that name (`recipe`, `program 2` or `2`); without one, the only program.

    TargetError if there is none of that name, or several to choose from.
    """
    found = places(driver)
    if not found:
        message = f"the {driver.model} has no setpoint programs that its map tells of"
        raise TargetError(message)
    names = [one.name for one in found]
    if not name and len(found) > 1:
        message = f"the {driver.model} has {len(found)} programs: name one of {', '.join(names)}"
        raise TargetError(message)
    for one in found:
        if not name or name in {one.name, str(one.number) if one.spec.programs else one.spec.id}:
            return one
    raise TargetError(unknown("program", name, names, where=f"in the {driver.model}"))
