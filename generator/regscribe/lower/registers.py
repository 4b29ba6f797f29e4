"""One register of one model, from the keys that count for it."""

from dataclasses import replace
from fractions import Fraction

from regscribe.lower.conditions import write_condition
from regscribe.lower.enums import enum_of, fields_of
from regscribe.lower.idle_keys import report_idle
from regscribe.lower.node import Value, text_of
from regscribe.lower.ranges import range_of
from regscribe.lower.register_links import followed_fields, follows_of, governs_of, shadowed
from regscribe.lower.rules import NO_ACCESS, UNKNOWN_COMMAND
from regscribe.lower.scales import NOT_STATED, Scaling, decimals_rule, scale_of
from regscribe.lower.scope import Scope
from regscribe.lower.special_values import beginning_of, sentinels_of, specials_of, version_of
from regscribe.lower.tree import TreeNode
from regscribe.lower.units import rescaled, unit_of
from regscribe.lower.views import at_of, views_of
from regscribe.model import (
    SAME,
    Access,
    Case,
    Cases,
    Conversion,
    Inferred,
    Kind,
    Register,
    View,
    WireType,
)
from regscribe.model.identifiers import has_mark, indexed

_RULES = {"views": "views", "scale": "scale", "decimals": "scale", "range_decimals": "special_scale"}
"""Keys that may name a rule of the map, and what the rule makes."""
_BY_KEY = {"enum": Kind.ENUM, "flags": Kind.FLAGS, "fields": Kind.FIELDS, "version": Kind.VERSION}


def register_of(entry: TreeNode, everywhere: Scope) -> Register:
    """Give the keys of a register their meaning on the model of the scope."""
    scope = everywhere.at(entry)
    settings = entry.settings
    views = views_of(entry, scope)
    scaling = scale_of(entry, views[0].type, scope)
    kind = kind_of(entry, views, scaling)
    enum = enum_of(settings["enum"], scope, inline_id=entry.qualified_id) if "enum" in settings else None
    unit, unit_id = unit_of(settings.get("unit"), scope)
    digits, group = version_of(settings.get("version"))
    register = Register(
        id=entry.id,
        path=entry.path,
        name=_name(entry),
        kind=kind,
        access=_access(entry),
        at=at_of(entry),
        views=views,
        symbol=indexed(_text(entry, "symbol"), entry.place.index),
        description=_text(entry, "description"),
        section=_text(entry, "source") or entry.place.section,
        group=entry.place.group,
        aliases=_aliases(entry, views[0]),
        scale=tuple(Case(part.when, part.conversion) for part in scaling),
        unit=unit,
        unit_id=unit_id,
        range=range_of(entry, scaling, scope),
        specials=specials_of(entry),
        special_scale=_special_scale(entry, scope),
        sentinels=sentinels_of(entry),
        default=beginning_of(entry, "default", kind, enum),
        delivered=beginning_of(entry, "delivered", kind, enum),
        enum=enum,
        fields=followed_fields(fields_of(entry, scope), entry, scope),
        writable=write_condition(settings.get("writable"), scope),
        persistence=_text(entry, "persistence"),
        endurance=settings["endurance"].whole() if "endurance" in settings else None,
        rescales=rescaled(settings["rescales"], scope) if "rescales" in settings else "",
        unlock=_command(settings.get("unlock"), scope),
        apply=_command(settings.get("apply"), scope),
        danger=_text(entry, "danger"),
        stays=_text(entry, "stays"),
        governs=governs_of(settings.get("governs")),
        settle=settings["settle"].whole() if "settle" in settings else 0,
        shadows=shadowed(settings.get("shadows"), scope),
        follows=follows_of(settings.get("follows"), scope),
        difference="difference" in settings and settings["difference"].truth(),
        inferred=inferred_of(settings.get("inferred")),
        version_digits=digits,
        version_group=group,
        array=entry.place.array,
        index=entry.place.index,
        printed=indexed(_text(entry, "printed"), entry.place.index),
        rules=tuple((use, _text(entry, key)) for key, use in _RULES.items() if _text(entry, key).isidentifier()),
        span=entry.span,
    )
    report_idle(entry, register)
    return register


def kind_of(entry: TreeNode, views: tuple[View, ...], scaling: tuple[Scaling, ...]) -> Kind:
    """What the value is to a program: told by the map, or else by the other keys."""
    settings = entry.settings
    if "kind" in settings:
        return settings["kind"].choice(Kind.INTEGER)
    for key, kind in _BY_KEY.items():
        if key in settings:
            return kind
    if views[0].type is WireType.STRING:
        return Kind.STRING
    if views[0].type is WireType.BIT:
        return Kind.BOOLEAN
    if "decimals" in settings and settings["decimals"].value == NOT_STATED:
        return Kind.RAW
    return Kind.NUMBER if _has_fractions(entry, views, scaling) else Kind.INTEGER


def _has_fractions(entry: TreeNode, views: tuple[View, ...], scaling: tuple[Scaling, ...]) -> bool:
    return (
        any(view.type.is_float or (1 / Fraction(view.factor or 1)).denominator != 1 for view in views)
        or any(_makes_fractions(part.conversion) for part in scaling)
        or any((special.means or special.code).denominator != 1 for special in specials_of(entry))
    )


def _makes_fractions(conversion: Conversion) -> bool:
    """Whether a whole stored number can become a value with a fraction."""
    whole = conversion.multiply.denominator == conversion.add.denominator == 1
    return not whole or conversion.decimals is not None or conversion.places is not None


def _special_scale(entry: TreeNode, scope: Scope) -> Cases[Conversion]:
    """The scale of the codes of special values: the decimals that divide the range divide them as well."""
    rule = entry.settings.get("range_decimals")
    divides = any(special.code for special in specials_of(entry))  # 0 stays 0
    return decimals_rule(rule, scope) if rule and divides else SAME


def _text(entry: TreeNode, key: str) -> str:
    return entry.settings[key].text().strip() if key in entry.settings else ""


def _name(entry: TreeNode) -> str:
    """The manual's name, in an array with the index of the element (those of arrays in arrays joined by dots)."""
    name, index = _text(entry, "name"), entry.place.index
    if not index or has_mark(name):
        return indexed(name, index)
    return f"{name} {'.'.join(map(str, index))}"


def folded(entry: TreeNode, everywhere: Scope) -> Register:
    """A register of an array's first element as one of all elements.

    It is named without an index, marks as they are, and what it refers to in its own element has empty brackets.
    """
    name, symbol, printed = (_text(entry, key) for key in ("name", "symbol", "printed"))
    register = register_of(entry, replace(everywhere, folded=True))
    return replace(register, name=name, symbol=symbol, printed=printed)


def _access(entry: TreeNode) -> Access:
    node = entry.settings.get("access")
    if node is not None:
        return node.choice(Access.READ)
    message = f"`{entry.id}` has no access"
    (entry.node.child("name") or entry.node).report(
        NO_ACCESS, message, remedy="give `access: r`, `rw` or `w` here or in the group's `each`"
    )
    return Access.READ


def _aliases(entry: TreeNode, base: View) -> tuple[int, ...]:
    node = entry.settings.get("aliases")
    shift = entry.place.shift * base.stride
    return tuple(element.whole() + shift for element in node.elements()) if node else ()


def _command(node: Value | None, scope: Scope) -> str:
    if node is None:
        return ""
    scope.named(node, "commands", rule=UNKNOWN_COMMAND, what="command")
    return node.text()


def inferred_of(node: Value | None) -> tuple[Inferred, ...]:
    """What the manual does not say, and how it is known."""
    elements = node.elements() if node else []
    return tuple(Inferred(text_of(element, "what"), text_of(element, "why")) for element in elements)
