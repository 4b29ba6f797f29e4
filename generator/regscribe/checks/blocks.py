"""Blocks: what could not be moved to where a device has it."""

from collections.abc import Iterator

from regscribe.checks.rule import Finding, Problem, RuleScope, Scopes, map_rule, model_rule, register_rule
from regscribe.model import Access, Array, Kind, Register, RegisterMap, Related
from regscribe.model.located import arrays_in
from regscribe_runtime.values.views import scale_needs


@register_rule("RS0695", "Register that cannot move with its block")
def cannot_move(register: Register, scope: RuleScope) -> Iterator[Problem]:
    """In a block each address is the base plus a distance, in the space of the chain."""
    block = next((one for one in scope.register_map.blocks if one.id == register.block), None)
    for view in register.views if block else ():
        if view.stride != 1 or view.region or view.align > 1:
            message = f"stands in block {register.block}, and its view {view.name} has a stride, region or alignment"
            yield message, "give it views without these, or take it out of the block"
        elif block and block.chain and view.space is not block.chain.space:
            message = f"is in space {view.space}, and chain {block.chain.id} of its block in {block.chain.space}"
            yield message, "correct `space` of one of them"


@model_rule("RS0674", "Array to an end that the map does not tell, or with registers behind it")
def behind_the_end(scope: RuleScope) -> Iterator[Finding]:
    """Where a device has more elements, one stands there; only a block in a chain has a length."""
    chained = [block.id for block in scope.register_map.blocks if block.chain]
    for array in (one for one in scope.model.members if isinstance(one, Array) and one.to_end):
        inside = [one for one in scope.model.registers if one.array.split(".")[0] == array.id]
        begin, block = min(one.address for one in inside), inside[0].block
        if block not in chained:
            message = f"array `{array.id}` goes to the end of block {block}, whose length nothing tells"
            yield Finding(array.id, array.span, message, "give the index of its last element")
        related = Related(f"`{array.id}` goes to the end of the block", array.span)
        for one in scope.model.registers:
            if one.block == block and one not in inside and one.base.last(one.at) >= begin:
                message = f"stands at {one.address} of block {block}, where array `{array.id}` goes on from {begin}"
                yield Finding.at(one, message, "correct one of the addresses", related)


@model_rule("RS0675", "Count of packed elements that may change or lacks meaning")
def counter_of_packed(scope: RuleScope) -> Iterator[Finding]:
    """Addresses that follow a count must not be changed by a write, nor wait for a scale."""
    for path in dict.fromkeys(one.counted for one in arrays_in(scope.model.members) if one.packed):
        counter = scope.registers[path]
        if counter.access is not Access.READ or counter.kind is not Kind.INTEGER or scale_needs(counter):
            message = "counts packed elements, but it is no plain whole number that can only be read"
            yield Finding.at(counter, message, "give it `access: r`, no scale and no codes")


@model_rule("RS0676", "Packed array too deep, or in an array with registers behind it")
def packed_twice(scope: RuleScope) -> Iterator[Finding]:
    """What stands behind would follow from several counts at once, which no driver works out."""
    for outer in (one for one in scope.model.members if isinstance(one, Array)):
        related = Related(f"`{outer.id}` is the array around it", outer.span)
        deep = [one for one in arrays_in(outer.members) if one.packed]
        for inner in deep if outer.packed else [one for one in deep if one not in outer.members]:
            message = f"array `{inner.id}` is packed, and not directly in an array that is not packed"
            yield Finding(inner.id, inner.span, message, "leave `packed` out, or take it out of its array", related)
        for one in _behind(outer, scope) if deep else ():
            message = f"stands at {one.address} of block {one.block}, behind array `{outer.id}` with a packed one in it"
            yield Finding.at(one, message, "leave `packed` out, or put the register before the array", related)


def _behind(array: Array, scope: RuleScope) -> Iterator[Register]:
    """The registers of the block that stand behind the beginning of an array."""
    inside = [one for one in scope.model.registers if one.array.split(".")[0] == array.id]
    begin, block = min(one.address for one in inside), inside[0].block
    return (one for one in scope.model.registers if one.block == block and one not in inside and one.address >= begin)


@map_rule("RS0696", "Identification by a register of a block that a given places")
def identity_in_block(register_map: RegisterMap, scopes: Scopes) -> Iterator[Finding]:
    """A device is identified before anybody states its givens."""
    stated = [block.id for block in register_map.blocks if block.given]
    for rule in register_map.identity:
        for register in (one for scope in scopes for one in scope.named(rule.identity.registers())):
            if register.block not in stated:
                continue
            yield Finding.at(register, f"identifies a model, and stands in block {register.block}", "use another")
