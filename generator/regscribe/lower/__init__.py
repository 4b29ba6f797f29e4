"""Plain values -> model: what the keys of a map mean, for each model of the family.

`lower` takes a document whose shape `regscribe.schema.validate` found right. It reads through `Value`, which knows the
place of each value, so a step that merges the raw data of several maps can stand in front of it.
"""

from regscribe.lower.enums import enum_at
from regscribe.lower.map import map_of
from regscribe.lower.models import members_of
from regscribe.lower.node import Collector, Value
from regscribe.lower.rules import RULES
from regscribe.lower.scope import Scope
from regscribe.lower.tree import TreePosition, entries_of, items_in
from regscribe.model import Diagnostic, Library, Model, RegisterMap
from regscribe.source import Document

__all__ = ["RULES", "library_of", "lower"]

_NO_MODELS = ("",)
"""The models of a library: one without a name, so that none can be meant."""


def lower(document: Document) -> tuple[RegisterMap | None, list[Diagnostic]]:
    """The model of a document, and all mistakes of meaning in it; no model where there is one."""
    context = Collector(document)
    register_map = map_of(Value(context, (), document.data))
    return (None if context.found else register_map), context.diagnostics


def library_of(document: Document) -> Library:
    """The enums of a library, and those of its sets that mean the same in every map that uses them."""
    root = Value(Collector(document), (), document.data)
    about = root.mapping_of("library")
    scope = Scope(root, "", _NO_MODELS, {}, {})
    sets = [_set(document, name) for name, _ in root.items_of("sets")]
    return Library(
        id=about.text_of("id"),
        title=about.text_of("title"),
        content_hash=document.content_hash,
        enums=tuple(enum_at(table, scope, name) for name, table in root.items_of("enums")),
        sets=tuple(found for found in sets if found is not None),
    )


def _set(document: Document, name: str) -> Model | None:
    """A set of registers; None if it is wrong without the map that it is meant for."""
    context = Collector(document)
    root = Value(context, (), document.data)
    sets = root.mapping_of("sets")
    place = TreePosition("", _NO_MODELS, _NO_MODELS, group="", section="", sets=sets, open=(name,))
    items = items_in(sets.elements_of(name), place)
    entries = {entry.path: entry for entry in entries_of(items)}
    scope = Scope(root, "", _NO_MODELS, entries, dict.fromkeys(entries, _NO_MODELS))
    members, registers = members_of(items, scope)
    return None if context.found else Model(name=name, class_name="", members=members, registers=registers)
