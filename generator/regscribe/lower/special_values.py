"""Single values: defaults, special values, sentinels and packed versions."""

from fractions import Fraction

from regscribe.lower.names import identifier, unknown
from regscribe.lower.node import Value, text_of
from regscribe.lower.rules import BAD_DEFAULT, BAD_VERSION
from regscribe.lower.tree import TreeNode
from regscribe.model import NAN, Enum, Kind, Sentinel, Special


def specials_of(entry: TreeNode) -> tuple[Special, ...]:
    """The special values of a register."""
    node = entry.settings.get("special")
    return tuple(_special(each) for each in node.values()) if node else ()


def _special(node: Value) -> Special:
    label, name = _named(node)
    means = node.child("means")
    return Special(code=node.key_number(), label=label, id=name, means=means.number() if means else None)


def sentinels_of(entry: TreeNode) -> tuple[Sentinel, ...]:
    """The stored numbers of a register that are faults."""
    node = entry.settings.get("sentinels")
    return tuple(_sentinel(each) for each in node.values()) if node else ()


def _sentinel(node: Value) -> Sentinel:
    label, name = _named(node)
    return Sentinel(stored=NAN if node.key == NAN.value else node.key_number(), label=label, id=name)


def _named(node: Value) -> tuple[str, str]:
    label = text_of(node, "label") if node.is_mapping else node.text()
    return label, identifier(node.child("label") or node, label=label, given=node.child("id"), capitals=True)


def version_of(node: Value | None) -> tuple[int, int]:
    """Decimal digits and digits of a group of a version pattern such as nn.nn.nn; RS0329 for any other text."""
    if node is None:
        return 0, 0
    groups = node.text().split(".")
    if not all(group and group == "n" * len(groups[0]) for group in groups):
        message = f"`{node.text()}` is no version pattern"
        node.report(BAD_VERSION, message, remedy="write one n a digit, in groups of equal length, as nn.nn.nn")
        return 0, 0
    return len(groups) * len(groups[0]), len(groups[0])


def beginning_of(entry: TreeNode, key: str, kind: Kind, enum: Enum | None) -> Fraction | str | None:
    """The `default` or `delivered` value as one of use; RS0322 where it names no member or special value.

    Manuals print the code of a special value here, too: it is the number that the code stands for.
    """
    node = entry.settings.get(key)
    if node is None:
        return None
    specials = specials_of(entry)
    value = named_value(node, kind, enum, specials, BAD_DEFAULT)
    if value in {special.means for special in specials}:
        return value
    return next((special.value for special in specials if special.code == value), value)


def named_value(node: Value, kind: Kind, enum: Enum | None, specials: tuple[Special, ...], rule: str) -> Fraction | str:
    """A value of use as a map spells it: a number, a text or version, or the id of an enum member or special value."""
    if kind is Kind.STRING:
        return node.text()
    if not node.is_text:
        return node.number()
    text = node.text()
    named = {member.id.lower(): Fraction(member.code) for member in (enum.members if enum else ())}
    named |= {special.id.lower(): special.value for special in specials}
    if text.lower() in named:
        return named[text.lower()]
    if kind is Kind.VERSION:
        return text
    unknown(node, rule, "member or special value", text, named)
    return Fraction(0)
