"""What a register or a bit takes from others by itself: the keys `shadows` and `follows`."""

from dataclasses import replace

from regscribe.lower.conditions import condition
from regscribe.lower.node import Value
from regscribe.lower.scope import Scope, path_of
from regscribe.lower.subject import subject_of
from regscribe.lower.tree import TreeNode
from regscribe.model import BitField, Case, Cases, always


def shadowed(node: Value | None, scope: Scope) -> str:
    """The register that `shadows` names; empty where the key is absent."""
    return path_of(scope.register(node), node.text()) if node else ""


def follows_of(node: Value | None, scope: Scope) -> Cases[str]:
    """The registers that one follows, by case."""
    if node is None:
        return ()
    if node.is_text:
        return always(shadowed(node, scope))
    return tuple(_case(each, scope) for each in node.elements())


def _case(node: Value, scope: Scope) -> Case[str]:
    return Case(condition(node.child("when"), scope), shadowed(node.child("is"), scope))


def followed_fields(fields: tuple[BitField, ...], entry: TreeNode, scope: Scope) -> tuple[BitField, ...]:
    """The bits and bit fields of a register with what each of them follows."""
    flags, named = entry.settings.get("flags"), entry.settings.get("fields")
    bits = {node.key_whole(): node for node in (flags.values() if flags else ()) if node.child("follows")}
    names = {name: node for name, node in (named.items() if named else ()) if node.child("follows")}
    if not bits and not names:
        return fields
    found = [(field, bits.get(field.low) if flags else names.get(field.id)) for field in fields]
    return tuple(
        replace(field, follows=condition(node.child("follows"), scope)) if node else field for field, node in found
    )


def subject_at(node: Value | None, scope: Scope) -> str:
    """The register, or `register.field`, that a value names; empty where it is absent or names none."""
    subject = subject_of(node, node.text(), scope) if node else None
    if subject is None:
        return ""
    path = path_of(subject.entry, subject.name)
    return f"{path}.{subject.field}" if subject.field else path
