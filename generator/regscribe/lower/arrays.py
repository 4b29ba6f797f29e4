"""The members of a model: registers, and arrays both folded and expanded."""

from regscribe.lower.node import text_of
from regscribe.lower.registers import folded, register_of
from regscribe.lower.scope import Scope
from regscribe.lower.tree import Branch, Entry, Item, span_of
from regscribe.model import Array, Register


def members_of(items: tuple[Item, ...], scope: Scope) -> tuple[tuple[Register | Array, ...], tuple[Register, ...]]:
    """The members with arrays folded, and all registers with arrays expanded."""
    members: list[Register | Array] = []
    registers: list[Register] = []
    for item in items:
        if isinstance(item, Entry):
            register = register_of(item, scope)
            members.append(folded(register, item))
            registers.append(register)
        else:
            array, expanded = _array(item, scope)
            members.append(array)
            registers.extend(expanded)
    return tuple(members), tuple(registers)


def _array(branch: Branch, scope: Scope) -> tuple[Array, list[Register]]:
    elements = [members_of(element, scope) for element in branch.elements]
    array = Array(
        id=branch.id,
        name=text_of(branch.node, "name", branch.id),
        first=branch.first,
        count=len(elements),
        stride=branch.stride,
        members=elements[0][0],
        description=text_of(branch.node, "description"),
        section=branch.section,
        span=span_of(branch.node),
    )
    return array, [register for _, registers in elements for register in registers]
