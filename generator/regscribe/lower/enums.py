"""Enums and bit fields, as one model has them."""

from collections.abc import Callable
from dataclasses import replace

from regscribe.lower.labels import id_of, identifier_of, label_of
from regscribe.lower.node import Keyed, Value
from regscribe.lower.rules import BAD_BITS, IDLE_KEY, UNKNOWN_ENUM
from regscribe.lower.scope import Scope
from regscribe.lower.texts import whole_ends
from regscribe.lower.tree import TreeNode
from regscribe.model import ALWAYS, BitField, Condition, Enum, Member, Space

MakeCondition = Callable[[Value | None, Scope], Condition]
"""What makes a condition of a `when`; those who only ask which codes and bits there are need none."""

NONE = "none"
"""The key beside the bits of a word: the label of no bit set."""
COLUMNS, OTHER = "columns", "other"
"""The keys beside the codes of an enum: the columns of the manual's table, and the label of all other codes."""


def enum_of(node: Value | None, scope: Scope, *, inline_id: str, when: MakeCondition | None = None) -> Enum | None:
    """The enum that `node` names or spells, None for no node; None with RS0304 where the name is unknown.

    Without `when`, which makes the conditions of members, all exist always.
    """
    if node is None:
        return None
    if not node.is_text:
        return enum_at(node, scope, inline_id, when)
    table = scope.named(node, "enums", rule=UNKNOWN_ENUM, what="enum")
    if table and when and any(each.child("when") for each in _codes(table)):
        return scope.once(table.path, lambda: enum_at(table, scope, table.key, when))
    if table and table.key not in scope.enums:
        scope.enums[table.key] = enum_at(table, scope, table.key)
    return scope.enums[table.key] if table else None


def enum_at(table: Value, scope: Scope, name: str, when: MakeCondition | None = None) -> Enum:
    """The enum whose members stand at `table`, as the model of the scope has it."""
    members = []
    invalid = []
    for node in _codes(table):
        here = scope.has(node)
        label = label_of(node)
        if here and label:
            _check_valid(node)
            name_of_code = identifier_of(node, label).upper()
            description, cells = node.text_of("description"), node.texts_of("cells")
            exists = when(node.child("when"), scope) if when else ALWAYS
            members.append(Member(node.key_whole(), label, name_of_code, description, cells, exists))
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


def _check_valid(node: Value) -> None:
    """Report what calls a code invalid that each model has as a member."""
    invalid = node.child("invalid")
    if invalid and not node.child("models"):
        message = f"`invalid` has no effect: with its label, {node.key} is a member on every model"
        invalid.report(IDLE_KEY, message, remedy="remove the label, or name in `models` those that have it")


def _codes(table: Value) -> list[Value]:
    """The members of an enum, without what stands beside the codes."""
    return [node for key, node in table.items() if key not in {COLUMNS, OTHER}]


def codes_named(tables: list[Value], text: str) -> dict[int, set[str]]:
    """The codes of the member `text` in enums, whichever models have it, each with the ids that it has in all."""
    ids: dict[int, set[str]] = {}
    for table in tables:
        for member in _codes(table):
            if label_of(member):
                ids.setdefault(member.key_whole(), set()).add(id_of(member).lower())
    return {code: names for code, names in ids.items() if text.lower() in names}


def tables_of(entry: TreeNode, scope: Scope, field: str = "") -> list[Value]:
    """The tables of the codes of a register (or of one of its bit fields), one for each case."""
    owner: Keyed | None = entry.settings
    if field:
        fields = entry.settings.child("fields")
        owner = fields.child(field) if fields else None
    node = owner.child("enum") if owner else None
    cases = [node] if node and not node.is_list else [case.child("is") for case in node.elements()] if node else []
    found = [scope.named(one, "enums", rule=UNKNOWN_ENUM, what="enum") if one.is_text else one for one in cases if one]
    return [table for table in found if table]


def fields_of(entry: TreeNode, scope: Scope, when: MakeCondition | None = None) -> tuple[BitField, ...]:
    """The flags or fields of a register that the model has; `when` makes their conditions."""
    found = [(node, _flag(node)) for key, node in entry.settings.items_of("flags") if key != NONE and scope.has(node)]
    found += [(node, _field(node, scope, entry)) for _, node in entry.settings.items_of("fields") if scope.has(node)]
    return tuple(_conditional(field, node, scope, when) if when else field for node, field in found)


def _conditional(field: BitField, node: Value, scope: Scope, when: MakeCondition) -> BitField:
    """A flag or field with the conditions under which it exists, and is set; RS0338 for those of its members."""
    follows, enum = node.child("follows"), node.child("enum") if node.is_mapping else None
    table = scope.named(enum, "enums", rule=UNKNOWN_ENUM, what="enum") if enum and enum.is_text else enum
    if enum and table and (conditional := [each.key for each in _codes(table) if each.child("when")]):
        message = f"code {conditional[0]} of the bit field `{field.id}` has `when`, which members of registers may have"
        enum.report(IDLE_KEY, message, remedy="give the whole field a `when`, or remove it")
    return replace(
        field,
        when=when(node.child("when"), scope),
        follows=when(follows, scope) if follows else None,
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
    if 0 <= bit < 16 * Space.HOLDING.most:
        return bit
    node.report(BAD_BITS, f"there is no bit {bit}", remedy="bits count from 0, the least significant", at_key=at_key)
    return 0
