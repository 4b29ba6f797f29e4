"""Enums and bit fields, as one model has them."""

from collections.abc import Callable
from dataclasses import replace

from regscribe.lower.labels import id_of, identifier_of, label_of
from regscribe.lower.node import Keyed, Value
from regscribe.lower.rules import BAD_BITS, UNKNOWN_ENUM
from regscribe.lower.scope import Scope
from regscribe.lower.texts import whole_ends
from regscribe.lower.tree import TreeNode
from regscribe.model import BitField, Condition, Enum, Member

COLUMNS, OTHER = "columns", "other"
"""The keys beside the codes of an enum: the columns of the manual's table, and the label of all other codes."""


def enum_of(node: Value | None, scope: Scope, *, inline_id: str) -> Enum | None:
    """The enum that `node` names or spells, None for no node; None with RS0304 where the name is unknown."""
    if node is None:
        return None
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
        label = label_of(node)
        if here and label:
            name_of_code = identifier_of(node, label).upper()
            description, cells = node.text_of("description"), node.texts_of("cells")
            members.append(Member(node.key_whole(), label, name_of_code, description, cells))
        elif node.child("invalid") and (here or label):
            invalid.append((node.key_whole(), node.text_of("invalid")))
    columns = table.texts_of(COLUMNS)
    return Enum(
        id=name,
        members=tuple(members),
        invalid=tuple(invalid),
        span=table.key_span,
        columns=columns,
        other=table.line_of(OTHER),
    )


def _codes(table: Value) -> list[Value]:
    """The members of an enum, without what stands beside the codes."""
    return [node for key, node in table.items() if key not in {COLUMNS, OTHER}]


def code_anywhere(table: Value, text: str) -> int | None:
    """The code of the member `text` in the enum at `table`, whichever models have it; None if there is none."""
    found = (member for member in _codes(table) if label_of(member) and id_of(member).lower() == text.lower())
    return next((member.key_whole() for member in found), None)


def enum_for(entry: TreeNode, scope: Scope, field: str = "") -> tuple[Value, Enum] | None:
    """The enum of a register (or of one of its bit fields), with the place of its members; None if it has none."""
    owner: Keyed | None = entry.settings
    if field:
        fields = entry.settings.child("fields")
        owner = fields.child(field) if fields else None
    node = owner.child("enum") if owner else None
    enum = enum_of(node, scope, inline_id="")
    if node is None or enum is None:
        return None
    table = scope.named(node, "enums", rule=UNKNOWN_ENUM, what="enum") if node.is_text else node
    return (table, enum) if table else None


def fields_of(
    entry: TreeNode, scope: Scope, follow: Callable[[Value, Scope], Condition] | None = None
) -> tuple[BitField, ...]:
    """The flags or fields of a register that the model has; `follow` makes the conditions that they follow."""
    found = [(node, _flag(node)) for _, node in entry.settings.items_of("flags") if scope.has(node)]
    found += [(node, _field(node, scope, entry)) for _, node in entry.settings.items_of("fields") if scope.has(node)]
    return tuple(
        replace(field, follows=follow(when, scope)) if follow and (when := node.child("follows")) else field
        for node, field in found
    )


def _flag(node: Value) -> BitField:
    label = label_of(node)
    bit = _bit(node, node.key_whole(), at_key=True)
    name = identifier_of(node, label).lower()
    return BitField(id=name, label=label, low=bit, high=bit, description=node.text_of("description"))


def _field(node: Value, scope: Scope, entry: TreeNode) -> BitField:
    name = node.key
    bits = node.child("bits") or node.child("bit")
    low, high = whole_ends(bits)
    if bits is None:
        node.report(BAD_BITS, f"the field `{name}` has no bits", remedy="give `bit: 3` or `bits: 0..3`")
    else:
        _bit(bits, low)
        _bit(bits, high)
    return BitField(
        id=name,
        label=node.text_of("label", name.replace("_", " ")),
        low=low,
        high=high,
        enum=enum_of(node.child("enum"), scope, inline_id=f"{entry.qualified_id}_{name}"),
        description=node.text_of("description"),
    )


def _bit(node: Value, bit: int, *, at_key: bool = False) -> int:
    if 0 <= bit <= 127:  # noqa: PLR2004 - the widest wire type has bits 0 to 127
        return bit
    node.report(BAD_BITS, f"there is no bit {bit}", remedy="bits count from 0, the least significant", at_key=at_key)
    return 0
