"""What a library means by itself: its enums, and those sets of registers that need no map around them."""

from regscribe.lower.enums import enum_at
from regscribe.lower.members import members_of
from regscribe.lower.node import Collector, Value, items_of, text_of
from regscribe.lower.scope import Scope
from regscribe.lower.tree import TreePosition, entries_of, items_in
from regscribe.model import Library, Model, Severity
from regscribe.source import Document

EVERY = ("",)
"""The models of a library: one without a name, so that none can be meant."""


def library_of(document: Document) -> Library:
    """The enums of a library, and those of its sets that need nothing of a map."""
    root = Value(Collector(document), (), document.data)
    about = root.child("library") or root
    scope = Scope(root, "", EVERY, {}, {})
    sets = [_set(document, name) for name, _ in items_of(root, "sets")]
    return Library(
        id=text_of(about, "id"),
        title=text_of(about, "title"),
        content_hash=document.content_hash,
        enums=tuple(enum_at(table, scope, name) for name, table in items_of(root, "enums")),
        sets=tuple(found for found in sets if found is not None),
    )


def _set(document: Document, name: str) -> Model | None:
    """A set of registers; None if it is wrong without the map that it is meant for."""
    context = Collector(document)
    root = Value(context, (), document.data)
    sets = root.child("sets")
    table = sets.child(name) if sets else None
    place = TreePosition(model="", every=EVERY, among=EVERY, group="", section="", sets=sets, open=(name,))
    items = items_in(table.elements() if table else [], place)
    entries = {entry.path: entry for entry in entries_of(items)}
    scope = Scope(root, "", EVERY, entries, dict.fromkeys(entries, EVERY))
    members, registers = members_of(items, scope)
    wrong = any(one.severity is Severity.ERROR for one in context.diagnostics)
    return None if wrong else Model(name=name, class_name="", members=members, registers=registers)
