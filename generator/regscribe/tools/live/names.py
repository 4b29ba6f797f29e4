"""Names of registers, groups, array elements and commands of a driver, with suggestions for unknown ones."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from regscribe.tools.live.errors import MOST_NAMED, TargetError, unknown
from regscribe_runtime import AnyCommand, Computed, Group, Register, SubPart
from regscribe_runtime.driver.device import AsyncBareDevice, BareDevice

Driver = type[BareDevice] | type[AsyncBareDevice]
Readable = Register[Any] | Computed


def groups_of(driver: Driver) -> dict[str, Group]:
    """The groups of a driver by id, in the manual's order, without those that are empty for its model."""
    declared = getattr(driver, "groups", None)
    found = {name: value for name, value in vars(declared).items() if isinstance(value, Group)} if declared else {}
    return {name: group for name, group in found.items() if group.registers(driver)}


def computed_of(driver: Driver) -> dict[str, Computed]:
    """The computed values of a driver by id."""
    declared = (pair for base in reversed(driver.__mro__) for pair in vars(base).items())
    return {name: value for name, value in declared if isinstance(value, Computed)}


def commands_of(driver: Driver) -> dict[str, AnyCommand]:
    """The commands of a driver by id."""
    section = getattr(driver, "commands", None)
    return section.commands() if isinstance(section, SubPart) else {}


def register_named(driver: Driver, name: str) -> Register[Any]:
    """The one register of that path; TargetError says which was probably meant."""
    if name in driver.registers:
        return driver.registers[name]
    if name in (computed := computed_of(driver)):
        message = f"`{name}` is no register of {driver.model}: it is {computed_from(computed[name])}"
        raise TargetError(message)
    below = [path for path in driver.registers if path.startswith((f"{name}.", f"{name}["))] if name else []
    if below:
        message = f"`{name}` is not one register of {driver.model} but several: {', '.join(below[:MOST_NAMED])}"
        raise TargetError(message)
    raise TargetError(unknown("register", name, _nearest(name, driver.registers), where=f"in {driver.model}"))


def command_named(driver: Driver, name: str) -> AnyCommand:
    """The command of that id; TargetError says which was probably meant."""
    known = commands_of(driver)
    if name in known:
        return known[name]
    raise TargetError(unknown("command", name, known, where=f"in {driver.model}"))


def computed_from(one: Computed) -> str:
    """What a computed value follows from: `computed from power_1, power_2`."""
    return f"computed from {', '.join(one.needs)}"


def chosen(driver: Driver, names: Iterable[str]) -> list[Readable]:
    """The computed values and the readable registers of paths, groups, arrays and elements; each once, in this order.

    TargetError for a name that is none, and for a register that cannot be read.
    """
    found: dict[str, Readable] = {}
    for name in names:
        found.update((one.path, one) for one in _chosen(driver, name))
    return list(found.values())


def readable(driver: Driver) -> list[Register[Any]]:
    """Every register of a driver that is read where all are; what reading clears is not."""
    return [register for register in driver.registers.values() if register.is_read_along]


def computable(driver: Driver) -> list[Computed]:
    """Every computed value of a driver whose registers are read where all are."""
    known = {register.path for register in readable(driver)}
    return [one for one in computed_of(driver).values() if known.issuperset(one.needs)]


def completions(driver: Driver) -> Iterator[tuple[str, str]]:
    """Names that `chosen` accepts, each with a hint: registers first, then what is computed, groups, arrays."""
    yield from ((path, register.section) for path, register in driver.registers.items())
    yield from ((name, computed_from(one)) for name, one in computed_of(driver).items())
    yield from ((name, group.name) for name, group in groups_of(driver).items())
    yield from ((name, "") for name in dict.fromkeys(path.split(".")[0] for path in driver.registers if "." in path))


def _chosen(driver: Driver, name: str) -> Sequence[Readable]:
    if name in driver.registers:
        if driver.registers[name].access == "w":
            message = f"`{name}` can only be written"
            raise TargetError(message)
        return [driver.registers[name]]
    computed, groups = computed_of(driver), groups_of(driver)
    if name in computed:
        return [computed[name]]
    if name in groups:
        return groups[name].registers(driver)
    below = [one for one in readable(driver) if one.path.startswith((f"{name}.", f"{name}["))] if name else []
    if not below:
        known = [*_nearest(name, driver.registers), *computed, *groups]
        raise TargetError(unknown("register or group", name, known, where=f"in {driver.model}"))
    return below


def _nearest(name: str, registers: Mapping[str, Register[Any]]) -> Iterable[str]:
    """The paths to guess among; `segments[9].soak` is nearest to elements that exist."""
    arrays = dict.fromkeys(part for path in registers if "[" in path for part in _heads(path))
    return [*registers, *arrays] if "[" in name or name not in arrays else registers


def _heads(path: str) -> Iterator[str]:
    steps = path.split(".")
    yield from (".".join(steps[: count + 1]) for count in range(len(steps) - 1))
    yield from (step.split("[")[0] for step in steps[:1])
