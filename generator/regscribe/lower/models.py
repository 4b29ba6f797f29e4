"""One model of a map: its groups in their order for writing, its registers, and arrays both folded and expanded."""

import re
from dataclasses import dataclass

from regscribe.lower.blocks import block_named
from regscribe.lower.commands import CommandScope, commands_of
from regscribe.lower.computed import computed_of
from regscribe.lower.node import Value
from regscribe.lower.pages import page_number, pages_of
from regscribe.lower.process import process_of
from regscribe.lower.programs import programs_of
from regscribe.lower.registers import folded, register_of, seen_from, subject_counting
from regscribe.lower.rules import NOT_PACKED, UNKNOWN_GROUP
from regscribe.lower.scope import Scope
from regscribe.lower.texts import known_name, whole_ends
from regscribe.lower.tree import (
    Item,
    PlacedCondition,
    TreeBranch,
    TreeNode,
    TreePosition,
    entries_of,
    items_in,
    name_of,
    span_of,
)
from regscribe.lower.variants import Models
from regscribe.model import Array, Group, Model, Protocol, Register, Space


@dataclass(frozen=True, slots=True)
class Bundle:
    """One group in the map, with what one model has of it; `entries` are its registers, arrays expanded."""

    node: Value
    id: str
    items: tuple[Item, ...]
    entries: list[TreeNode]


def scopes_of(root: Value) -> dict[str, tuple[Scope, list[Bundle]]]:
    """Names and groups of each model, needed before any register is lowered: registers refer to each other."""
    models = tuple(name for name, _ in root.items_of("models"))
    bundles = {model: [_bundle(node, root, model, models) for node in root.elements_of("groups")] for model in models}
    entries = {model: {entry.path: entry for bundle in bundles[model] for entry in bundle.entries} for model in models}
    owners: dict[str, Models] = {}
    for model in models:
        for path in entries[model]:
            owners[path] = (*owners.get(path, ()), model)
    return {model: (Scope(root, model, models, entries[model], owners), bundles[model]) for model in models}


def _bundle(node: Value, root: Value, model: str, models: Models) -> Bundle:
    name, each = name_of(node), node.child("each")
    place = TreePosition(
        model=model,
        every=models,
        among=models,
        group=name,
        section=node.text_of("source"),
        sets=root.mapping_of("sets"),
        layers=(each,) if each else (),
        whens=(PlacedCondition(when, ()),) if (when := node.child("when")) else (),
        block=block_named(node, root),
        page=page_number(node, root),
    )
    items = items_in(node.elements_of("registers"), place)
    return Bundle(node, name, items, entries_of(items))


def model_of(node: Value, root: Value, scope: Scope, bundles: list[Bundle], protocol: Protocol) -> Model:
    """The model whose entry in the map's table of models is `node`."""
    members, registers = members_of(tuple(item for bundle in bundles for item in bundle.items), scope)
    device = CommandScope(scope, {register.path: register for register in registers}, protocol)
    commands = commands_of(root, device)
    programs = programs_of(root, scope)
    prefix = root.mapping_of("map").text_of("class_prefix")
    return Model(
        name=scope.model,
        class_name=node.text_of("class") or f"{prefix}{re.sub('[^A-Za-z0-9]', '', scope.model)}",
        description=node.text_of("description"),
        members=members,
        registers=registers,
        groups=_groups(bundles, root),
        commands=commands,
        computed=computed_of(root, scope),
        programs=tuple(program for program, _ in programs),
        program_notes=tuple(notes for _, notes in programs),
        process=process_of(root.child("process"), scope),
        unused=tuple(stretch_of(each) for each in root.elements_of("unused") if scope.has(each)),
        pages=pages_of(root, device),
        span=node.key_span,
    )


def stretch_of(node: Value) -> tuple[Space, int, int]:
    """A stretch of addresses: space, first, last."""
    space, (first, last) = node.choice_of("space", Space.HOLDING), whole_ends(node.child("at"))
    return space, space.within(first), space.within(last, space.each - 1)


def _groups(bundles: list[Bundle], root: Value) -> tuple[Group, ...]:
    """The groups that a model has something of; a group that is empty in the map itself is kept for the checks.

    RS0332 for unknown groups in the map's `write_order`.
    """
    order: dict[str, int] = {}
    known = [bundle.id for bundle in bundles]
    for place, node in enumerate(root.elements_of("write_order"), start=1):
        order.setdefault(known_name(node, UNKNOWN_GROUP, "group", known), place)
    return tuple(
        Group(
            id=bundle.id,
            name=bundle.node.text_of("name", bundle.id),
            members=tuple(entry.path for entry in bundle.entries),
            description=bundle.node.text_of("description"),
            section=bundle.node.text_of("source"),
            order=bundle.node.whole_of("order") if bundle.node.child("order") else order.get(bundle.id),
            span=span_of(bundle.node),
        )
        for bundle in bundles
        if bundle.entries or not bundle.node.elements_of("registers")
    )


def members_of(items: tuple[Item, ...], scope: Scope) -> tuple[tuple[Register | Array, ...], tuple[Register, ...]]:
    """The members with arrays folded, and all registers with arrays expanded."""
    members: list[Register | Array] = []
    registers: list[Register] = []
    for item in items:
        expanded = [register_of(entry, scope) for entry in entries_of((item,))]
        members += expanded if isinstance(item, TreeNode) else [_array(item, scope)]
        registers += expanded
    return tuple(members), tuple(registers)


def _counted(branch: TreeBranch, scope: Scope) -> str:
    """What says how many elements there are, as `Is.subject` has it; empty where the map does."""
    inside = entries_of((branch,))
    if not (branch.counted and inside):
        return ""
    return subject_counting(branch.counted.node, seen_from(inside[0], branch.counted.prefixes, scope, folded=True))


def _array(branch: TreeBranch, scope: Scope) -> Array:
    first = branch.elements[0]
    return Array(
        id=branch.id,
        name=branch.node.text_of("name", branch.id),
        first=branch.first,
        count=len(branch.elements),
        stride=branch.stride,
        members=tuple(folded(one, scope) if isinstance(one, TreeNode) else _array(one, scope) for one in first),
        description=branch.node.text_of("description"),
        section=branch.section,
        to_end=branch.to_end,
        counted=_counted(branch, scope),
        packed=_is_packed(branch.node.child("repeat"), branch.block, scope),
        span=span_of(branch.node),
    )


def _is_packed(repeat: Value | None, block: str, scope: Scope) -> bool:
    """Whether what stands behind an array moves up by the elements that are not there; RS0366 where it cannot."""
    if repeat is None or not repeat.is_mapping or not repeat.truth_of("packed"):
        return False
    to = repeat.child("to")
    counter = scope.find(to.text()) if to and to.is_text else None
    if not block or counter is None or counter.place.block != block or counter.place.array:
        remedy = "give in `to` a register of the same block outside arrays, or remove `packed`"
        message = "what stands behind can only move by a count that stands in the same block, outside all arrays"
        if to and to.is_mapping and to.child("block"):
            message = "nothing stands behind an array that goes to the end of its block, so that nothing can move"
            remedy = "remove `packed`, or give in `to` the register that counts the elements"
        (repeat.child("packed") or repeat).report(NOT_PACKED, message, remedy=remedy)
    return True
