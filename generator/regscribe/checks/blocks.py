"""Blocks: what could not be moved to where a device has it."""

from collections.abc import Iterator

from regscribe.checks.rule import Finding, Problem, RuleScope, Scopes, map_rule, register_rule
from regscribe.model import Register, RegisterMap


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


@map_rule("RS0696", "Identification by a register of a block")
def identity_in_block(register_map: RegisterMap, scopes: Scopes) -> Iterator[Finding]:
    """A device is identified before its blocks are found."""
    for rule in register_map.identity:
        for register in (one for scope in scopes for one in scope.named(rule.identity.registers()) if one.block):
            yield Finding.at(register, f"identifies a model, and stands in block {register.block}", "use another one")
