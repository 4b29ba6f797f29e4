"""The members of a model: registers, and arrays both folded and expanded."""

from regscribe.lower.node import text_of
from regscribe.lower.registers import folded, register_of
from regscribe.lower.scope import Scope
from regscribe.lower.tree import Item, TreeBranch, TreeNode, entries_of, span_of
from regscribe.model import Array, Register


def members_of(items: tuple[Item, ...], scope: Scope) -> tuple[tuple[Register | Array, ...], tuple[Register, ...]]:
    """The members with arrays folded, and all registers with arrays expanded."""
    members: list[Register | Array] = []
    registers: list[Register] = []
    for item in items:
        made = [register_of(entry, scope) for entry in entries_of((item,))]
        members += made if isinstance(item, TreeNode) else [_array(item, scope)]
        registers += made
    return tuple(members), tuple(registers)


def _array(branch: TreeBranch, scope: Scope) -> Array:
    return Array(
        id=branch.id,
        name=text_of(branch.node, "name", branch.id),
        first=branch.first,
        count=len(branch.elements),
        stride=branch.stride,
        members=tuple(
            folded(one, scope) if isinstance(one, TreeNode) else _array(one, scope) for one in branch.elements[0]
        ),
        description=text_of(branch.node, "description"),
        section=branch.section,
        span=span_of(branch.node),
    )
