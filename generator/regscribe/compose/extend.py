"""A map on the basis of another: the base with its models renamed, less what is dropped, changed, and added to."""

from regscribe.compose.findings import CHANGED_IN_PASSING, NO_MODEL, RENUMBERS_NOTHING, ComposeFindings
from regscribe.compose.merge import LISTS, append, laid_over, replace
from regscribe.compose.overrides import Changes
from regscribe.compose.renaming import Renaming, renumbered
from regscribe.compose.tree import at, cut, edit, elements, id_of, key_place, listing, members, put, registers, text
from regscribe.model import Override
from regscribe.source import SourceNode, SourcePlace

_REPLACED = ("format", "map", "manual", "description", "process", "identify", "write_order")
_CLASH = "what differs from the base stands under `override`; else give it another name"


def extended(base: SourceNode, own: SourceNode, findings: ComposeFindings) -> tuple[SourceNode, tuple[Override, ...]]:
    """The base as the extension has it, and what was overridden and dropped."""
    before = {path for path, _ in registers(base)}
    at_base = ("the base", (at(base, ("map", "id")) or base.child("map") or base).place)
    changes = Changes(_with_models(base, own, findings), at_base, findings)
    drop = own.child("drop")
    if drop is not None:
        changes.drop(drop)
    changes.drop_dangling(before)
    changes.root = _renumbered(changes.root, own.child("renumber"), findings, at_base)
    for each in elements(own.child("override")):
        changes.override(each)
    root = laid_over(changes.root, own, findings, LISTS, owner="the base", advice=_CLASH)
    root = replace(root, own, _REPLACED)
    for group in elements(own.child("groups")):
        root = _with_group(root, group, findings)
    return root, tuple(changes.records)


def _with_models(base: SourceNode, own: SourceNode, findings: ComposeFindings) -> SourceNode:
    """The base with the models of the extension, which inherit what the base says of theirs but for the class."""
    have, table = members(base.child("models")), own.child("models") or own
    names: dict[str, list[str]] = {name: [] for name in have}
    models = table
    for name, node in members(table).items():
        origin = node.child("from") or node
        if text(origin) not in have:
            message = f"the base has no model `{text(origin)}`, which `{name}` is to be"
            other = ("the models of the base", key_place(base, "models"))
            findings.unknown(NO_MODEL, message, origin, have, other)
            continue
        names[text(origin)].append(name)
        model = cut(node, "from")
        for key, value in members(have[text(origin)]).items():
            if key != "class" and model.child(key) is None:
                model = put(model, key, value, have[text(origin)])
        models = put(models, name, model, table)
    renaming = Renaming({name: tuple(new) for name, new in names.items()}, tuple(members(table)))
    return put(renaming.inside(base), "models", models, own)


def _renumbered(
    root: SourceNode, table: SourceNode | None, findings: ComposeFindings, at_base: tuple[str, SourcePlace]
) -> SourceNode:
    chapters = {old: text(new) for old, new in members(table).items()}
    if table is None or not chapters:
        return root
    used: set[str] = set()
    new = renumbered(root, chapters, used)
    for old in chapters:
        if old not in used:
            message = f"nothing of the base stands in chapter {old}"
            findings.add(RENUMBERS_NOTHING, message, key_place(table, old), "remove it", at_base)
    models = root.child("models")
    return new if models is None else put(new, "models", models, root)


def _with_group(root: SourceNode, group: SourceNode, findings: ComposeFindings) -> SourceNode:
    """The map with a new group, or with new registers in a group that it has."""
    groups = elements(root.child("groups"))
    same = [number for number, each in enumerate(groups) if id_of(each) == id_of(group)]
    if not same:
        return put(root, "groups", listing([*groups, group], (root.child("groups") or root).place))
    old = groups[same[0]]
    for key in members(group).keys() - {"id", "registers"}:
        message = f"`{key}` is given for `{id_of(group)}`, which is a group of the base"
        advice = "add registers only, and change the group by `override: - {group: ...}`"
        findings.add(CHANGED_IN_PASSING, message, key_place(group, key), advice, ("the group of the base", old.place))
    return edit(root, ("groups", same[0]), lambda below: append(below, group, ("registers",)))
