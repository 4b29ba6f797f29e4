"""Names of registers, their parts, groups, array elements and commands, and addresses, as people type them.

One chooser serves the commands that ask a device and the planner: `NamedRegisters` has the registers of a driver, or
those of a compiled model.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple, Protocol

from regscribe.model.nearest import near
from regscribe.tools.live import value_text
from regscribe.tools.live.addresses import found_at, is_address, spelled
from regscribe.tools.live.errors import MOST_NAMED, TargetError, unknown
from regscribe_runtime import AnyCommand, Computed, Group, Register, SubPart
from regscribe_runtime.driver.device import AsyncBareDevice, BareDevice
from regscribe_runtime.values.facts import ReadFacts
from regscribe_runtime.values.views import Placed

Driver = type[BareDevice] | type[AsyncBareDevice]


class Choice(NamedTuple):
    """What one name means: a register or a computed value by its path, in a view or a part of it if that is not empty.

    `note` says which register an address is.
    """

    path: str
    view: str = ""
    part: str = ""
    note: str = ""


class Named(Placed, Protocol):
    """A register that is chosen by name."""

    @property
    def is_read_along(self) -> bool: ...  # noqa: D102 (a field)


@dataclass(frozen=True, slots=True, kw_only=True)
class NamedRegisters:
    """What names are looked up among: registers, groups, computed values by id, and the `parts` of a register."""

    model: str
    registers: Mapping[str, Named]
    groups: Mapping[str, Sequence[str]] = field(default_factory=dict)
    computed: Mapping[str, Sequence[str]] = field(default_factory=dict)
    parts: Callable[[str], Sequence[str]] = lambda _: ()

    def choices(self, name: str) -> list[Choice]:
        """What a name means: a register, a computed value, a group, an array, an element, a part, or an address.

        TargetError for a name that is none, and for a register that cannot be read.
        """
        if name in self.registers:
            if not self.registers[name].access.readable:
                message = f"`{name}` of {self.model} can only be written"
                raise TargetError(message)
            return [Choice(name)]
        if name in self.computed:
            return [Choice(name)]
        below = [Choice(path) for path in self._several(name)]
        return below or self.part(name) or self._addressed(name)

    def part(self, name: str) -> list[Choice]:
        """The flag or field that `word.part` names; none if it names none."""
        path, _, part = name.rpartition(".")
        known = {one.casefold(): one for one in self.parts(path)}
        return [Choice(path, part=known[part.casefold()])] if part.casefold() in known else []

    def _several(self, name: str) -> Sequence[str]:
        """The registers of a group, and those in an array or an element, that are read along."""
        if name in self.groups:
            return self.groups[name]
        return [path for path, one in self.registers.items() if one.is_read_along and _is_below(path, name)]

    def _addressed(self, name: str) -> list[Choice]:
        """The registers at an address."""
        if not is_address(name):
            raise TargetError(self.unknown(name))
        meaning, hits = found_at(name, self.registers, self.model)
        readable = [hit for hit in hits if hit.register.access.readable and hit.view.readable]
        if not readable:
            message = f"{spelled(meaning)} of {self.model} is {hits[0].spelled}, which can only be written"
            raise TargetError(message)
        place = spelled(meaning)
        return [
            Choice(hit.register.path, "" if hit.is_usual else hit.view.name, note=f"{place} is {hit.spelled}")
            for hit in readable
        ]

    def unknown(self, name: str) -> str:
        """What a message says of a name that is none."""
        if any(_is_below(path, name) for path in self.registers):
            return f"`{name}` of {self.model} can only be written"
        path, _, part = name.rpartition(".")
        if parts := self.parts(path):
            return unknown("part", part, parts, where=f"in {path} of {self.model}")
        known = [*_nearest(name, self.registers), *self.computed, *self.groups]
        text = unknown("register or group", name, known, where=f"in {self.model}")
        alike = near(name, self.groups, most=MOST_NAMED)
        return f"{text}{_listed('groups', dict.fromkeys((*alike, *self.groups)))}"


def _is_below(path: str, name: str) -> bool:
    return bool(name) and path.startswith((f"{name}.", f"{name}["))


def _listed(what: str, names: Iterable[str]) -> str:
    """The end of a message: the names there are, as far as they are not too many."""
    every = list(names)
    more = f" and {len(every) - MOST_NAMED} more" if len(every) > MOST_NAMED else ""
    return f"; {what}: {', '.join(every[:MOST_NAMED])}{more}" if every else ""


class Excerpt:
    """A register that is read in another view than usual, or of which one flag or field is wanted."""

    def __init__(self, register: Register[Any], view: str = "", part: str = "") -> None:
        """Keep the register and the names; a record's field would be taken for a register that it declares."""
        self.register = register
        self.view = view
        self.part = part

    @property
    def path(self) -> str:
        """What it is called: `config_bits.run`, `setpoint_ram (ieee)`."""
        return f"{self.register.path}.{self.part}" if self.part else f"{self.register.path} ({self.view})"

    @property
    def reading(self) -> ReadFacts:
        """How its register wants to be read."""
        return self.register.reading


Readable = Register[Any] | Computed | Excerpt


def names_of(driver: Driver) -> NamedRegisters:
    """The names of a driver."""

    def parts(path: str) -> Sequence[str]:
        return value_text.parts(driver.registers[path]) if path in driver.registers else ()

    return NamedRegisters(
        model=driver.model,
        registers=driver.registers,
        groups={name: [one.path for one in group.registers(driver)] for name, group in groups_of(driver).items()},
        computed={name: one.needs for name, one in computed_of(driver).items()},
        parts=parts,
    )


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
    below = [path for path in driver.registers if _is_below(path, name)]
    if below:
        message = f"`{name}` is not one register of {driver.model} but several: {', '.join(below[:MOST_NAMED])}"
        raise TargetError(message)
    raise TargetError(unknown("register", name, _nearest(name, driver.registers), where=f"in {driver.model}"))


def to_write(driver: Driver, name: str) -> Choice:
    """What is written by that name: a register, a flag or field of one, or what begins at an address.

    TargetError for what is none of these, or several registers.
    """
    known = names_of(driver)
    if name in driver.registers:
        return Choice(name)
    if found := known.part(name):
        return found[0]
    if known.parts(name.rpartition(".")[0]):
        raise TargetError(known.unknown(name))
    if not is_address(name):
        return Choice(register_named(driver, name).path)
    meaning, hits = found_at(name, driver.registers, driver.model)
    writable = [hit for hit in hits if hit.register.access.writable and hit.view.writable] or hits
    if len(writable) > 1 or writable[0].word:
        every = " and ".join(hit.spelled for hit in writable)
        message = f"{spelled(meaning)} of {driver.model} is {every}: write a register by its name"
        raise TargetError(message)
    (hit,) = writable
    usual = hit.view.name == driver.registers[hit.register.path].view().name
    return Choice(hit.register.path, "" if usual else hit.view.name, note=f"{spelled(meaning)} is {hit.spelled}")


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
    """What names mean, as things to read; each once, in this order.

    TargetError for a name that is none, and for a register that cannot be read.
    """
    found: dict[str, Readable] = {}
    for choice in choices(driver, names):
        one = _readable(driver, choice)
        found[one.path] = one
    return list(found.values())


def choices(driver: Driver, names: Iterable[str]) -> list[Choice]:
    """What names mean, in this order; TargetError as `chosen`."""
    known = names_of(driver)
    return [choice for name in names for choice in known.choices(name)]


def _readable(driver: Driver, choice: Choice) -> Readable:
    register = driver.registers.get(choice.path)
    if register is None:
        return computed_of(driver)[choice.path]
    return Excerpt(register, choice.view, choice.part) if choice.view or choice.part else register


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


def _nearest(name: str, registers: Mapping[str, object]) -> Iterable[str]:
    """The paths to guess among; `segments[9].soak` is nearest to elements that exist."""
    arrays = dict.fromkeys(part for path in registers if "[" in path for part in _heads(path))
    return [*registers, *arrays] if "[" in name or name not in arrays else registers


def _heads(path: str) -> Iterator[str]:
    steps = path.split(".")
    yield from (".".join(steps[: count + 1]) for count in range(len(steps) - 1))
    yield from (step.split("[")[0] for step in steps[:1])
