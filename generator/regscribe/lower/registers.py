"""One register of one model, from the keys that count for it."""

from collections.abc import Iterable
from dataclasses import replace
from fractions import Fraction

from regscribe.lower.conditions import both, cases_of, condition, write_condition
from regscribe.lower.enum_cases import enum_by_case
from regscribe.lower.enums import NONE, fields_of
from regscribe.lower.field_numbers import with_numbers
from regscribe.lower.idle_keys import report_idle_keys
from regscribe.lower.matchers import given_named
from regscribe.lower.node import ZERO, Keyed, Value
from regscribe.lower.octets import text_of
from regscribe.lower.register_values import beginnings_of, range_of, ranges_at, sentinels_of, specials_of
from regscribe.lower.rules import NO_ACCESS, WRONG_SORT
from regscribe.lower.scales import NOT_STATED, Scaling, decimals_rule, scale_of
from regscribe.lower.scope import Scope
from regscribe.lower.texts import version_of
from regscribe.lower.tree import TreeNode, span_of
from regscribe.lower.units import rescaled, unit_of
from regscribe.lower.views import at_of, views_of
from regscribe.model import (
    SAME,
    Access,
    Case,
    Cases,
    Condition,
    Governs,
    Inferred,
    Kind,
    Number,
    ReadFacts,
    Register,
    Setting,
    Special,
    View,
    WireType,
    always,
)
from regscribe.model.identifiers import has_mark, indexed
from regscribe_runtime.values.conditions import GIVEN, at_least
from regscribe_runtime.values.octets import KINDS
from regscribe_runtime.values.wire_types import PAGE_BITS

_RULES = {"views": "views", "scale": "scale", "decimals": "scale", "range_decimals": "special_scale"}
"""Keys that may name a rule of the map, and what the rule makes."""
_BY_KEY = {"enum": Kind.ENUM, "flags": Kind.FLAGS, "fields": Kind.FIELDS, "version": Kind.VERSION}
_BY_TYPE = KINDS | {WireType.BIT: Kind.BOOLEAN}


def register_of(entry: TreeNode, everywhere: Scope) -> Register:
    """Give the keys of a register their meaning on the model of the scope."""
    scope = everywhere.at(entry)
    settings, place = entry.settings, entry.place
    views = views_of(entry, scope)
    scaling = scale_of(entry, views[0].type, scope)
    specials = specials_of(entry)
    kind = kind_of(entry, views, scaling, specials)
    enum = enum_by_case(settings.get("enum"), scope, entry.qualified_id)
    unit, unit_id = unit_of(settings.get("unit"), scope)
    default, defaults = beginnings_of(settings.get("default"), kind, enum, specials, scope)
    delivered, deliveries = beginnings_of(settings.get("delivered"), kind, enum, specials, scope)
    range_decimals = settings.get("range_decimals")
    divided = any(special.code for special in specials)  # 0 stays 0
    digits, group = version_of(settings.get("version"))
    moved = place.shift * views[0].stride + (place.page << PAGE_BITS)
    register = Register(
        id=entry.id,
        path=entry.path,
        name=_name(entry),
        kind=kind,
        access=_access(entry),
        at=at_of(entry),
        views=views,
        symbol=indexed(settings.text_of("symbol"), place.index),
        description=settings.text_of("description"),
        section=settings.text_of("source") or place.section,
        group=place.group,
        aliases=tuple(views[0].space.within(alias) + moved for alias in settings.wholes_of("aliases")),
        scale=tuple(Case(part.when, part.conversion) for part in scaling),
        unit=unit,
        unit_id=unit_id,
        range=range_of(entry, scaling, scope),
        valid=ranges_at(settings.get("valid"), scope),
        specials=specials,
        special_scale=decimals_rule(range_decimals, scope) if range_decimals and divided else SAME,
        sentinels=sentinels_of(entry, scope),
        default=default,
        default_cases=defaults,
        delivered=delivered,
        delivered_cases=deliveries,
        enum=enum,
        fields=with_numbers(fields_of(entry, scope, condition), entry, scope),
        none=flags.line_of(NONE) if (flags := settings.child("flags")) else "",
        writable=write_condition(settings.get("writable"), scope),
        when=_existence(entry, scope),
        persistence=settings.text_of("persistence"),
        endurance=settings["endurance"].whole() if "endurance" in settings else None,
        rescales=rescaled(settings.get("rescales"), scope),
        unlock=scope.command(settings.get("unlock")),
        apply=scope.command(settings.get("apply")),
        danger=settings.text_of("danger"),
        stays=settings.text_of("stays"),
        governs=_governs(settings.get("governs")),
        settle=settings.whole_of("settle"),
        reading=_reading(settings),
        static=settings.truth_of("static"),
        mandatory=settings["mandatory"].truth() if "mandatory" in settings else None,
        shadows=scope.path(settings.get("shadows")),
        rereads=scope.path(settings.get("rereads")),
        follows=_follows(settings.get("follows"), scope),
        difference=settings.truth_of("difference"),
        inferred=inferred_of(settings),
        text=text_of(settings),
        layout=settings.line_of("layout"),
        version_digits=digits,
        version_group=group,
        array=place.array,
        index=place.index,
        printed=indexed(settings.text_of("printed"), place.index),
        block=place.block,
        page=place.page,
        rules=tuple(
            (use, str(node.value))
            for key, use in _RULES.items()
            if (node := settings.get(key)) and node.is_text and node.text().isidentifier()
        ),
        span=span_of(entry.node),
    )
    report_idle_keys(entry, register)
    return register


def folded(entry: TreeNode, everywhere: Scope) -> Register:
    """A register of an array's first element as one of all elements.

    It is named without an index, marks as they are, and what it refers to in its own element has empty brackets.
    """
    name, symbol, printed = (entry.settings.text_of(key) for key in ("name", "symbol", "printed"))
    register = register_of(entry, replace(everywhere, folded=True))
    return replace(register, name=name, symbol=symbol, printed=printed)


def kind_of(
    entry: TreeNode, views: tuple[View, ...], scaling: tuple[Scaling, ...], specials: tuple[Special, ...]
) -> Kind:
    """Kind of the value in programs: stated by the map, else derived from the other keys."""
    settings = entry.settings
    if "kind" in settings:
        return settings["kind"].choice(Kind.INTEGER)
    kind = next((kind for key, kind in _BY_KEY.items() if key in settings), _BY_TYPE.get(views[0].type))
    if kind:
        return kind
    if "decimals" in settings and settings["decimals"].value == NOT_STATED:
        return Kind.RAW
    return Kind.NUMBER if _has_fractions(views, scaling, specials) else Kind.INTEGER


def _has_fractions(views: Iterable[View], scaling: Iterable[Scaling], specials: Iterable[Special]) -> bool:
    return (
        any(view.type.is_float or view.times or (1 / Fraction(view.factor or 1)).denominator != 1 for view in views)
        or any(map(_makes_fractions, scaling))
        or any((special.means or special.code).denominator != 1 for special in specials)
    )


def _makes_fractions(scaling: Scaling) -> bool:
    """Whether a whole stored number can become a value with a fraction."""
    conversion = scaling.conversion
    whole = all(isinstance(one, Number) and one.denominator == 1 for one in (conversion.multiply, conversion.add))
    return not whole or conversion.decimals is not None or conversion.places is not None


def _existence(entry: TreeNode, scope: Scope) -> Condition:
    """The condition under which a register exists: its own and those of its surroundings, as each stands there."""
    found = []
    for when, prefixes, least in entry.whens:
        when.context.used.add(when.path)
        there = seen_from(entry, prefixes, scope)
        if not least:
            found.append(condition(when, there))
        elif not scope.folded:  # there it differs from element to element
            found.append(Condition((at_least(subject_counting(when, there), least),)))
    return both(*found)


def seen_from(entry: TreeNode, prefixes: tuple[str, ...], scope: Scope, *, folded: bool = False) -> Scope:
    """The scope of what stands around a register, in the elements `prefixes`."""
    there = scope.at(replace(entry, place=replace(entry.place, prefixes=prefixes)))
    return replace(there, folded=scope.folded or folded)


def subject_counting(node: Value, scope: Scope) -> str:
    """The register, or `given.id`, that says how many elements an array has; RS0301 or RS0312 where there is none."""
    given = node.child("given")
    counter = None if given else scope.find(node.text())
    if counter and "string" in {counter.settings.text_of("type"), counter.settings.text_of("kind")}:
        node.report(WRONG_SORT, f"`{node.text()}` holds a text, which counts nothing", remedy="name a whole number")
    return f"{GIVEN}.{given_named(given, scope, 'number')}" if given else scope.path(node)


def _name(entry: TreeNode) -> str:
    """The manual's name, in an array with the index of the element (those of arrays in arrays joined by dots)."""
    name, index = entry.settings.text_of("name"), entry.place.index
    if not index or has_mark(name):
        return indexed(name, index)
    return f"{name} {'.'.join(map(str, index))}"


def _access(entry: TreeNode) -> Access:
    if "access" in entry.settings:
        return entry.settings["access"].choice(Access.READ)
    remedy = "give `access: r`, `rw` or `w` here or in the group's `each`"
    (entry.node.child("name") or entry.node).report(NO_ACCESS, f"`{entry.id}` has no access", remedy=remedy)
    return Access.READ


def _follows(node: Value | None, scope: Scope) -> Cases[str]:
    """The registers that one follows, by case."""
    if node is None:
        return ()
    if node.is_text:
        return always(scope.path(node))
    return cases_of(node, scope, lambda case: scope.path(case.child("is")))


def _reading(keys: Keyed) -> ReadFacts:
    poll, clears = keys.child("poll"), keys.text_of("reading") == "clears"
    usual: str | Fraction = "once" if keys.truth_of("static") else ZERO
    wanted = usual if poll is None else poll.number() if poll.is_number else poll.text()
    return ReadFacts(clears, wanted, keys.fraction_of("good_for"))


def _governs(node: Value | None) -> Governs | None:
    """What a register sets of the serial line; the short form of the key is the setting alone."""
    if node is None:
        return None
    address = Setting.ADDRESS
    setting = node.choice_of("setting", address) if node.is_mapping else node.choice(address)
    codes = tuple((code.key_whole(), code.text()) for _, code in node.items_of("codes"))
    return Governs(setting, codes, node.text_of("from"))


def inferred_of(keys: Keyed) -> tuple[Inferred, ...]:
    """What the manual does not say, and how it is known."""
    return tuple(Inferred(each.text_of("what"), each.text_of("why")) for each in keys.elements_of("inferred"))
