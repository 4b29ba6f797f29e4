"""A model as it stands on one device: the registers of blocks at the addresses where a layout has them."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from fractions import Fraction

from regscribe.model.map import Command, Model, RegisterMap
from regscribe.model.register import Array, Register
from regscribe_runtime.values.blocks import HEADER, Layout, lay_out
from regscribe_runtime.values.kinds import Kind


def layout_of(register_map: RegisterMap, model: Model, bases: Mapping[str, int]) -> Layout:
    """A layout of a device of the model: its blocks one behind the other, as long as the registers need.

    `bases` are addresses by the ids of chains (where the marker stands) and of blocks (where their base is).
    """
    ends: dict[str, int] = {}
    for register in model.registers:
        last = [view.last(register.at) for view in register.views]
        last += [alias + register.base.words - 1 for alias in register.aliases]
        ends[register.block] = max(ends.get(register.block, 0), *(one + 1 for one in last))
    for array in arrays_in(model.members):
        inside = list(_registers_in(array))
        if array.to_end and inside:  # its last element has room for the stride, whatever stands at the end of that
            reach = min(register.at for register in inside) + array.count * array.stride
            ends[inside[0].block] = max(ends[inside[0].block], reach)
    return lay_out(register_map.blocks, ends, bases)


def _registers_in(array: Array) -> Iterator[Register]:
    """The registers of the first element, those of arrays in it too."""
    for one in array.members:
        yield from _registers_in(one) if isinstance(one, Array) else (one,)


def arrays_in(members: Iterable[Register | Array]) -> Iterator[Array]:
    """All arrays, those in others too."""
    for one in members:
        if isinstance(one, Array):
            yield one
            yield from arrays_in(one.members)


def located(model: Model, layout: Layout) -> Model:
    """The model with the registers of blocks, and steps of commands there, where the layout has them.

    A register at a word of a header holds what the chain says, one that counts packed elements as many as may be.
    """
    most = {one.counted: one.count for one in arrays_in(model.members) if one.packed}

    def moved(register: Register) -> Register:
        header = layout.headers.get(register.block)
        if header is None:
            return register
        word = layout.words.get((register.base.space, header.base + register.at))
        headed = 0 <= register.at < HEADER and register.base.words == 1
        number = headed and word is not None and register.kind in {Kind.INTEGER, Kind.RAW, Kind.NUMBER}
        delivered = Fraction(word or 0) if number else register.delivered
        return replace(
            register,
            at=register.at + header.base,
            aliases=tuple(alias + header.base for alias in register.aliases),
            delivered=Fraction(most[register.path]) if register.path in most else delivered,
            delivered_cases=() if number or register.path in most else register.delivered_cases,
            block="",
        )

    def member(one: Register | Array) -> Register | Array:
        return replace(one, members=tuple(map(member, one.members))) if isinstance(one, Array) else moved(one)

    def command(one: Command) -> Command:
        bases = {name: header.base for name, header in layout.headers.items()}
        steps = (step._replace(address=step.address + bases.get(step.block, 0), block="") for step in one.steps)
        return replace(one, steps=tuple(steps))

    return replace(
        model,
        members=tuple(map(member, model.members)),
        registers=tuple(map(moved, model.registers)),
        commands=tuple(map(command, model.commands)),
        by_path={},
    )
