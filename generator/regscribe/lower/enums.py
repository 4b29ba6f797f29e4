"""Enums and bit fields, as one model has them."""

from regscribe.lower.interval_text import whole_ends
from regscribe.lower.names import identifier
from regscribe.lower.node import Value, text_of, texts_of
from regscribe.lower.rules import BAD_BITS, UNKNOWN_ENUM
from regscribe.lower.scope import Scope
from regscribe.lower.tree import TreeNode
from regscribe.model import BitField, Enum, Member
from regscribe.model.identifiers import snake

COLUMNS = "columns"
"""The key beside the codes of an enum that names the columns of the manual's table."""


def enum_of(node: Value, scope: Scope, *, inline_id: str) -> Enum | None:
    """The enum that `node` names or spells; None with RS0304 where the name is unknown."""
    if not node.is_text:
        return enum_at(node, scope, inline_id)
    table = scope.named(node, "enums", rule=UNKNOWN_ENUM, what="enum")
    if table and table.key not in scope.enums:
        scope.enums[table.key] = enum_at(table, scope, table.key)
    return scope.enums[table.key] if table else None


def enum_at(table: Value, scope: Scope, name: str) -> Enum:
    """The enum whose members stand at `table`, as the model of the scope has it."""
    members = []
    invalid = []
    for node in _codes(table):
        here = scope.has(node)
        if here and _label(node):
            members.append(_member(node))
        elif node.child("invalid") and (here or _label(node)):
            invalid.append((node.key_whole(), text_of(node, "invalid")))
    columns = texts_of(table, COLUMNS)
    return Enum(id=name, members=tuple(members), invalid=tuple(invalid), span=table.key_span, columns=columns)


def _codes(table: Value) -> list[Value]:
    """The members of an enum, without what stands beside the codes."""
    return [node for key, node in table.items() if key != COLUMNS]


def _member(node: Value) -> Member:
    label = _label(node)
    name = identifier(node.child("label") or node, label=label, given=node.child("id"), capitals=True)
    return Member(node.key_whole(), label, name, text_of(node, "description"), texts_of(node, "cells"))


def _label(node: Value) -> str:
    """What a code or a bit is called; a code without a label by its cells."""
    if not node.is_mapping:
        return node.text()
    return text_of(node, "label") or ", ".join(texts_of(node, "cells"))


def code_anywhere(node: Value, text: str) -> int | None:
    """The code of the member `text` in the enum at `node`, whichever models have it; None if there is none."""
    for member in _codes(node):
        label = _label(member)
        given = text_of(member, "id") if member.is_mapping else ""
        if label and (given or snake(label)).lower() == text.lower():
            return member.key_whole()
    return None


def enum_for(entry: TreeNode, scope: Scope, field: str = "") -> tuple[Value, Enum] | None:
    """The enum of a register (or of one of its bit fields), with the place of its members; None if it has none."""
    node = entry.settings.get("enum")
    name = entry.qualified_id
    if field:
        fields = entry.settings.get("fields")
        owner = fields.child(field) if fields else None
        node = owner.child("enum") if owner else None
        name = f"{name}_{field}"
    enum = enum_of(node, scope, inline_id=name) if node else None
    if node is None or enum is None:
        return None
    table = scope.named(node, "enums", rule=UNKNOWN_ENUM, what="enum") if node.is_text else node
    return (table, enum) if table else None


def fields_of(entry: TreeNode, scope: Scope) -> tuple[BitField, ...]:
    """The flags or fields of a register, those that the model has."""
    flags, fields = entry.settings.get("flags"), entry.settings.get("fields")
    found = [_flag(node) for node in (flags.values() if flags else ()) if scope.has(node)]
    found += [_field(node, scope, entry) for node in (fields.values() if fields else ()) if scope.has(node)]
    return tuple(found)


def _flag(node: Value) -> BitField:
    label = _label(node)
    bit = _bit(node, node.key_whole(), at_key=True)
    name = identifier(node.child("label") or node, label=label, given=node.child("id")).lower()
    return BitField(id=name, label=label, low=bit, high=bit, description=text_of(node, "description"))


def _field(node: Value, scope: Scope, entry: TreeNode) -> BitField:
    name, enum = node.key, node.child("enum")
    bits = node.child("bits") or node.child("bit")
    low, high = whole_ends(bits) if bits else (0, 0)
    if bits is None:
        node.report(BAD_BITS, f"the field `{name}` has no bits", remedy="give `bit: 3` or `bits: 0..3`")
    else:
        _bit(bits, low)
        _bit(bits, high)
    return BitField(
        id=name,
        label=text_of(node, "label", name.replace("_", " ")),
        low=low,
        high=high,
        enum=enum_of(enum, scope, inline_id=f"{entry.qualified_id}_{name}") if enum else None,
        description=text_of(node, "description"),
    )


def _bit(node: Value, bit: int, *, at_key: bool = False) -> int:
    if 0 <= bit <= 63:  # noqa: PLR2004 - the widest wire type has bits 0 to 63
        return bit
    node.report(BAD_BITS, f"there is no bit {bit}", remedy="bits count from 0, the least significant", at_key=at_key)
    return 0
