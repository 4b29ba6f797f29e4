"""A compiled model as the planner sees a device: places of registers, limits, latencies, what values depend on."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from regscribe import model as compiled
from regscribe.runtime import Latency, Protocol, Register, View, raw, wire
from regscribe.runtime.cost import Cost
from regscribe.runtime.ground import ground_of
from regscribe.runtime.plan import Limits, Plan, Terms, plan
from regscribe.runtime.ways import Way, ways

FALLBACK_BAUD, FALLBACK_FORMAT = 9600, "8N1"
"""Where a map does not say how a device is delivered."""


@dataclass(frozen=True, slots=True)
class Subject:
    """A model to plan for: its readable registers by path, and of each the paths that its meaning depends on."""

    model: compiled.Model
    protocol: Protocol
    registers: dict[str, Register[int]]
    needs: dict[str, tuple[str, ...]]

    @classmethod
    def of(cls, register_map: compiled.RegisterMap, name: str) -> "Subject":
        """A model of a map."""
        model = register_map.model(name)
        registers = {one.path: _register(one) for one in model.registers}
        return cls(
            model, protocol_of(register_map.protocol), registers, {one.path: _needs(one) for one in model.registers}
        )

    @property
    def readable(self) -> list[str]:
        """The paths of all registers that can be read."""
        return [one.path for one in self.model.registers if one.access.readable]

    def terms(self, cost: Cost) -> Terms:
        """What plans keep to, at a cost."""
        unused = [(str(space), first, last) for space, first, last in self.model.unused]
        protocol = self.protocol
        ground = ground_of(self.registers.values(), unused=unused, holes=protocol.read_holes)
        return Terms(Limits(protocol.read_words, protocol.read_bits, protocol.read_holes), ground, cost)

    def ways(self, path: str) -> tuple[Way, ...]:
        """Where a register can be read with the same result."""
        return ways(self.registers[path])

    def with_needs(self, paths: Iterable[str]) -> list[str]:
        """The same registers and behind them all that their meaning depends on, as a driver reads them."""
        found = dict.fromkeys(paths)
        for path in (left := list(found)):
            left += [need for need in self.needs[path] if need not in found]
            found.update(dict.fromkeys(self.needs[path]))
        return list(found)

    def plan(self, paths: Iterable[str], terms: Terms) -> Plan:
        """The plan of least cost for some registers."""
        return plan([tuple(way.item for way in self.ways(path)) for path in paths], terms)


def protocol_of(protocol: compiled.Protocol) -> Protocol:
    """What of a protocol a plan depends on."""
    return Protocol(
        functions=protocol.functions,
        read_words=protocol.read_words,
        read_bits=protocol.read_bits,
        read_holes=protocol.read_holes,
        baud=protocol.serial.default_baud or FALLBACK_BAUD,
        format=protocol.serial.default_format or FALLBACK_FORMAT,
        bauds=protocol.serial.baud_rates,
        formats=protocol.serial.formats,
        gap=float(protocol.serial.gap_characters),
        latencies={one.function: _latency(one) for one in protocol.latencies},
    )


def _latency(one: compiled.Latency) -> Latency:
    return Latency(
        float(one.minimum),
        float(one.maximum),
        float(one.minimum_per_word),
        float(one.maximum_per_word),
        float(one.characters),
    )


def _register(one: compiled.Register) -> Register[int]:
    made = Register(0, tuple(_view(view) for view in one.views), raw, aliases=one.aliases)
    made.path, made.access = one.path, str(one.access)
    return made


def _view(view: compiled.View) -> View:
    return View(
        view.name,
        getattr(wire, view.type.upper(), wire.UINT16),
        offset=view.address,
        stride=0,
        words=view.words,
        factor=str(view.factor),
        rounding=str(view.rounding),
        saturates=view.saturates,
        byte_order=str(view.byte_order),
        functions=view.functions,
        space=str(view.space),
        preferred=view.preferred,
        align=view.align,
    )


def _needs(one: compiled.Register) -> tuple[str, ...]:
    return tuple(dict.fromkeys(_needed(one)))


def _needed(one: compiled.Register) -> Iterator[str]:
    order = one.preferred.word_order
    if isinstance(order, compiled.OrderFromRegister):
        yield order.register
    for case in one.scale:
        yield from case.when.registers
        if case.then.decimals:
            yield case.then.decimals.register
