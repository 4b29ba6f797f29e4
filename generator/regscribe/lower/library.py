"""What a library means by itself: its enums, its commands, and those sets of registers that need no map around them."""

from collections.abc import Callable
from functools import partial
from typing import TypeVar

from regscribe.lower.commands import CommandScope, commands_of
from regscribe.lower.enums import enum_at
from regscribe.lower.members import members_of
from regscribe.lower.node import Collector, Value, items_of, text_of
from regscribe.lower.protocol import protocol_of
from regscribe.lower.scope import Scope
from regscribe.lower.tree import TreePosition, entries_of, items_in
from regscribe.model import Library, Model, Protocol, Severity
from regscribe.source import Document

T = TypeVar("T")
EVERY = ("",)
"""The models of a library: one without a name, so that none can be meant."""


def library_of(document: Document) -> Library:
    """What a library declares for every map; whatever needs something of a map is left to that map."""
    root = Value(Collector(document), (), document.data)
    about = root.child("library") or root
    protocol = _alone(document, _protocol)
    scope = Scope(root, "", EVERY, {}, {})
    sets = [_alone(document, partial(_set, name=name)) for name, _ in items_of(root, "sets")]
    return Library(
        id=text_of(about, "id"),
        title=text_of(about, "title"),
        content_hash=document.content_hash,
        enums=tuple(enum_at(table, scope, name) for name, table in items_of(root, "enums")),
        sets=tuple(found for found in sets if found is not None),
        commands=_alone(document, lambda root: commands_of(root, CommandScope(scope, {}, protocol or Protocol())))
        or (),
        protocol=protocol,
    )


def _alone(document: Document, part: Callable[[Value], T]) -> T | None:
    """A part of a library; None if it is wrong without the map that it is meant for."""
    context = Collector(document)
    found = part(Value(context, (), document.data))
    return None if any(one.severity is Severity.ERROR for one in context.diagnostics) else found


def _protocol(root: Value) -> Protocol | None:
    return protocol_of(root.child("protocol")) if root.child("protocol") else None


def _set(root: Value, name: str) -> Model | None:
    sets = root.child("sets")
    table = sets.child(name) if sets else None
    place = TreePosition(model="", every=EVERY, among=EVERY, group="", section="", sets=sets, open=(name,))
    items = items_in(table.elements() if table else [], place)
    entries = {entry.path: entry for entry in entries_of(items)}
    scope = Scope(root, "", EVERY, entries, dict.fromkeys(entries, EVERY))
    members, registers = members_of(items, scope)
    return Model(name=name, class_name="", members=members, registers=registers)
