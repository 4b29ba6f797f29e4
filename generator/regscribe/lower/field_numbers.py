"""Parts of a word that are numbers of use: sign, scale, unit, range and sentinels of their own."""

from dataclasses import replace
from fractions import Fraction

from regscribe.lower.labels import identifier_of, label_of
from regscribe.lower.node import Value
from regscribe.lower.rules import BAD_BITS, IDLE_KEY
from regscribe.lower.scope import Scope
from regscribe.lower.texts import ends, key_ends
from regscribe.lower.tree import TreeNode
from regscribe.lower.units import unit_of
from regscribe.model import BitField, Sentinel, show

_OF_NUMBERS = ("type", "multiply", "add", "decimals", "unit", "range", "valid", "sentinels")


def with_numbers(fields: tuple[BitField, ...], entry: TreeNode, scope: Scope) -> tuple[BitField, ...]:
    """The fields of a register with what the map says of their numbers."""
    nodes = dict(entry.settings.items_of("fields"))
    return tuple(number_field(field, nodes[field.id], scope) if field.id in nodes else field for field in fields)


def number_field(field: BitField, node: Value, scope: Scope) -> BitField:
    """The field with what the map says of its number; RS0338 for that of an enum, RS0316 beyond its bits."""
    stated = [key for key in _OF_NUMBERS if node.child(key)]
    if not stated:
        return field
    if field.enum is not None:
        for key in stated:
            node.mapping_of(key).report(IDLE_KEY, f"`{field.id}` has `{key}`, but it is an enum", remedy="remove it")
        return field
    digits = node.child("decimals")
    unit, limits, valid = unit_of(node.child("unit"), scope)[0], node.child("range"), node.child("valid")
    found = replace(
        field,
        signed=node.text_of("type") == "signed",
        multiply=Fraction(1, 10 ** digits.whole()) if digits else node.fraction_of("multiply", Fraction(1)),
        add=node.fraction_of("add"),
        unit=unit[0].then if unit else "",
        range=ends(limits) if limits else None,
        valid=ends(valid) if valid else None,
        sentinels=tuple(_sentinel(each) for _, each in node.items_of("sentinels")),
    )
    _check(found, node)
    return found


def _sentinel(node: Value) -> Sentinel:
    label = label_of(node)
    low, high = key_ends(node) if ".." in node.key else (node.key_number(), None)
    return Sentinel(low, identifier_of(node, label).upper(), label, high)


def _check(field: BitField, node: Value) -> None:
    least = -(1 << field.width - 1) if field.signed else 0
    most = least + (1 << field.width) - 1
    if field.multiply == 0:
        node.mapping_of("multiply").report(BAD_BITS, f"`{field.id}` is multiplied by 0", remedy="correct the factor")
        return
    outside = [one.spelled for one in field.sentinels for end in one.ends or () if not least <= end <= most]
    if outside:
        message = f"`{field.id}` has sentinel {outside[0]}, outside the {least} to {most} of its bits"
        node.mapping_of("sentinels").report(BAD_BITS, message, remedy="correct the sentinel, the bits or the `type`")
    reach = sorted(end * field.multiply + field.add for end in (least, most))
    for key, limits in (("range", field.range), ("valid", field.valid)):
        if limits and not (reach[0] <= limits[0] and limits[1] <= reach[1]):
            message = f"`{field.id}` has `{key}` beyond the {show(reach[0])} to {show(reach[1])} of its bits"
            node.mapping_of(key).report(BAD_BITS, message, remedy="correct the limits, the bits or the scale")
