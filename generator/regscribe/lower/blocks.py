"""Blocks whose base each device tells, and the chains that they stand in."""

from collections.abc import Collection, Iterator, Mapping

from regscribe.lower.node import Value
from regscribe.lower.rules import IDLE_BLOCK, NO_MARKER, SAME_BLOCK, UNKNOWN_BLOCK, UNKNOWN_CHAIN, UNKNOWN_GIVEN
from regscribe.lower.texts import known_name, unknown
from regscribe.model import Chain, RegisterBlock, Space

NUMBER = "number"
"""The type of a given that is the base of a block."""


def blocks_of(root: Value) -> tuple[RegisterBlock, ...]:
    """The blocks of a map; RS0362 for two at one header, RS0363 and RS0364 for chains and blocks that mean nothing."""
    chains = {name: _chain(name, node) for name, node in root.items_of("chains")}
    blocks = tuple(_block(name, node, root, chains) for name, node in root.items_of("blocks"))
    taken: dict[tuple[str, int, int], str] = {}
    for block, (_, node) in zip(blocks, root.items_of("blocks"), strict=True):
        for header in [(block.chain.id, one, block.number) for one in block.ids] if block.chain else ():
            if header in taken:
                message = f"block `{taken[header]}` is number {block.number} of id {header[1]} already"
                node.report(SAME_BLOCK, message, remedy="give this one another `id` or `index`", at_key=True)
            taken[header] = block.id
    _report_idle(root, "chains", {block.chain.id for block in blocks if block.chain}, "no block is in it")
    _report_idle(root, "blocks", set(_named(root)), "no group stands in it")
    return blocks


def _chain(name: str, node: Value) -> Chain:
    plain = Chain(name)
    addresses, marker = node.wholes_of("at"), node.wholes_of("marker")
    if len(addresses) > 1 and not marker:
        message = f"nothing tells at which of {', '.join(map(str, addresses))} it begins"
        node.report(NO_MARKER, message, remedy="give its `marker`, or one address", at_key=True)
    return Chain(
        id=name,
        at=addresses,
        marker=tuple(word & 0xFFFF for word in marker),
        end=node.whole_of("end", plain.end) & 0xFFFF,
        space=node.choice_of("space", Space.HOLDING),
    )


def _block(name: str, node: Value, root: Value, chains: Mapping[str, Chain]) -> RegisterBlock:
    given, chain = node.mapping_of("base").child("given"), node.child("chain")
    if given:
        numbers = [key for key, each in root.items_of("givens") if each.text_of("type") == NUMBER]
        if given.text() not in numbers:
            unknown(given, UNKNOWN_GIVEN, "given of type number", given.text(), numbers)
        return RegisterBlock(name, given=given.text())
    named = known_name(chain, UNKNOWN_CHAIN, "chain", chains) if chain else ""
    return RegisterBlock(name, chain=chains.get(named), ids=node.wholes_of("id"), number=node.whole_of("index", 1))


def _named(root: Value) -> Iterator[str]:
    """The blocks that groups stand in."""
    return (group.text_of("block") for group in root.elements_of("groups"))


def _report_idle(root: Value, table: str, used: Collection[str], why: str) -> None:
    unclear = any(rule in {UNKNOWN_BLOCK, UNKNOWN_CHAIN} for rule, _ in root.context.found)
    for name, node in root.items_of(table) if not unclear else ():
        if name not in used:
            node.report(IDLE_BLOCK, f"`{name}` is never looked for: {why}", remedy="use or remove it", at_key=True)


def block_named(node: Value, root: Value) -> str:
    """The block that a group or a step names, empty where it names none; RS0360 for an unknown one."""
    block = node.child("block")
    names = [name for name, _ in root.items_of("blocks")]
    return known_name(block, UNKNOWN_BLOCK, "block", names) if block else ""
