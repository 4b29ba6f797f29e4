"""What a register takes from others, and what it sets of the line: the keys `shadows`, `follows` and `governs`."""

from dataclasses import replace

from regscribe.lower.conditions import condition
from regscribe.lower.node import Value, choice_of, items_of, text_of
from regscribe.lower.scope import Scope, path_of
from regscribe.lower.subject import subject_of
from regscribe.lower.tree import TreeNode
from regscribe.model import BitField, Case, Cases, Governs, Setting, always


def shadowed(node: Value | None, scope: Scope) -> str:
    """The register that `shadows` names; empty where the key is absent."""
    return path_of(scope.register(node), node.text()) if node else ""


def follows_of(node: Value | None, scope: Scope) -> Cases[str]:
    """The registers that one follows, by case."""
    if node is None:
        return ()
    if node.is_text:
        return always(shadowed(node, scope))
    return tuple(
        Case(condition(each.child("when"), scope), shadowed(each.child("is"), scope)) for each in node.elements()
    )


def followed_fields(fields: tuple[BitField, ...], entry: TreeNode, scope: Scope) -> tuple[BitField, ...]:
    """The bits and bit fields of a register, each with the condition that it follows."""
    flags, named = entry.settings.get("flags"), entry.settings.get("fields")
    if flags:
        by_bit = {node.key_whole(): when for node, when in _following(flags)}
        return tuple(_follow(field, by_bit.get(field.low), scope) for field in fields)
    by_name = {node.key: when for node, when in (_following(named) if named else ())}
    return tuple(_follow(field, by_name.get(field.id), scope) for field in fields)


def _following(table: Value) -> list[tuple[Value, Value]]:
    """The bits or bit fields that follow a condition, each with that."""
    return [(node, when) for node in table.values() if (when := node.child("follows"))]


def _follow(field: BitField, when: Value | None, scope: Scope) -> BitField:
    return replace(field, follows=condition(when, scope)) if when else field


def subject_at(node: Value | None, scope: Scope) -> str:
    """The register, or `register.field`, that a value names; empty where it is absent or names none."""
    subject = subject_of(node, node.text(), scope) if node else None
    return subject.path if subject else ""


def governs_of(node: Value | None) -> Governs | None:
    """The key `governs` of a register; the short form is the setting alone."""
    if node is None:
        return None
    address = Setting.ADDRESS
    setting = choice_of(node, "setting", address) if node.is_mapping else node.choice(address)
    codes = tuple((code.key_whole(), code.text()) for _, code in items_of(node, "codes"))
    return Governs(setting, codes, text_of(node, "from"))
