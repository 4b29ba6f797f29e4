"""From a stored number to the value of use: the conversion of a register by case, named scales and decimals."""

from dataclasses import dataclass, replace
from fractions import Fraction

from regscribe.lower.conditions import cases_of, condition_of
from regscribe.lower.node import Keyed, Value
from regscribe.lower.rules import NO_ENDS, TWO_SCALES, UNKNOWN_DECIMALS, UNKNOWN_SCALE, WRONG_SORT
from regscribe.lower.scope import Scope
from regscribe.lower.terms import ONE, divided, power_of, product, summed, term_of
from regscribe.lower.texts import ends, unordered
from regscribe.lower.tree import TreeNode
from regscribe.model import (
    ALWAYS,
    IDENTITY,
    SAME,
    Case,
    Cases,
    Condition,
    Conversion,
    Decimals,
    Number,
    Term,
    WireType,
    always,
    show,
)

NOT_STATED = "not_stated"
_MOST_DIGITS = 100
_LINEAR = frozenset({"multiply", "divide", "exponent", "add"})
_WAYS = _LINEAR | {"scale", "decimals"}


@dataclass(frozen=True, slots=True)
class Scaling:
    """A conversion under a condition; `ends` are its values at the type's lowest and highest raw code, if given so."""

    when: Condition
    conversion: Conversion
    ends: tuple[Number, Number] | None = None


def scale_of(entry: TreeNode, wire: WireType, scope: Scope) -> tuple[Scaling, ...]:
    """The conversion of a register by case; RS0318 where the map gives two."""
    step = entry.settings.get("step")
    found = _scaling(entry, wire, scope)
    return tuple(_with_step(part, step) for part in found) if step else found


def _with_step(part: Scaling, step: Value) -> Scaling:
    """A conversion whose values are so far apart; RS0330 where its numbers are not those of the map."""
    conversion = part.conversion
    if isinstance(conversion.multiply, Number) and conversion == Conversion(conversion.multiply, conversion.add):
        return replace(part, conversion=conversion._replace(step=abs(step.number() / (conversion.multiply or 1))))
    message = "a step in the unit of the value needs a scale whose factor is a number of the map"
    step.report(WRONG_SORT, message, remedy="remove it, or give the `step` of the rule under `decimals`")
    return part


def _scaling(entry: TreeNode, wire: WireType, scope: Scope) -> tuple[Scaling, ...]:
    """The conversion by case, without a step; RS0318 where the map gives two."""
    settings = entry.settings
    given = list(filter(_WAYS.__contains__, settings))
    if len(given) > 1 and not set(given) <= _LINEAR:
        message = f"`{entry.id}` has both `{given[0]}` and `{given[1]}`"
        settings[given[1]].report(TWO_SCALES, message, remedy="keep the one that the manual states", at_key=True)
    node = settings.get("scale")
    if node is None and "decimals" in settings:
        return tuple(Scaling(case.when, case.then) for case in decimals_of(settings["decimals"], scope))
    if node is None:
        return (Scaling(ALWAYS, _linear(settings, scope)),)
    if not node.is_text:
        return scale_at(node, wire, scope)
    if ".." in node.text():
        return (_affine(ALWAYS, unordered(node), _raw_ends(node, wire)),)
    table = scope.named(node, "scales", rule=UNKNOWN_SCALE, what="scale")
    return (scale_at(table, wire, scope) if table else ()) or (Scaling(ALWAYS, IDENTITY),)


def _linear(keys: Keyed, scope: Scope) -> Conversion:
    """The straight line that `multiply`, `divide`, `exponent` and `add` describe."""
    multiply, exponent, add = (keys.child(key) for key in ("multiply", "exponent", "add"))
    factors = [term_of(multiply, scope, ONE), power_of(exponent, scope) if exponent else ONE]
    conversion = Conversion(divided(product(factors), keys.child("divide"), scope), term_of(add, scope))
    return IDENTITY if conversion == IDENTITY else conversion


def scale_at(node: Value, wire: WireType, scope: Scope) -> tuple[Scaling, ...]:
    """The cases of the scale that stands at `node`, for raw codes of the type `wire`."""
    return scope.once((node.path, wire), lambda: tuple(_case(case, wire, scope) for case in node.elements()))


def _case(node: Value, wire: WireType, scope: Scope) -> Scaling:
    when = condition_of(node, scope)
    low, high, digits = node.child("from"), node.child("to"), node.child("decimals")
    if low and high:
        return _affine(when, (term_of(low, scope), term_of(high, scope)), _raw_ends(node, wire))
    return Scaling(when, Conversion(multiply=_power(digits)) if digits else _linear(node, scope))


def _raw_ends(node: Value, wire: WireType) -> tuple[Fraction, Fraction] | None:
    """The raw codes at the ends of a scale; RS0328 where neither the map nor the type has two."""
    stated = node.child("raw") if node.is_mapping else None
    if stated:
        low, high = ends(stated)
        if low < high:
            return low, high
        message, remedy = f"the scale has one raw code only, {show(low)}", "give `raw` two ends"
    elif wire.is_integer:
        return wire.ends
    else:
        message = f"a scale from end to end needs a whole number on the wire, not {wire}"
        remedy = "give `raw`, or use `multiply` and `add`"
    node.report(NO_ENDS, message, remedy=remedy)
    return None


def _affine(when: Condition, ends: tuple[Term, Term], raw: tuple[Fraction, Fraction] | None) -> Scaling:
    """The straight line through both ends; in use they are the range, where they are numbers."""
    if raw is None:
        return Scaling(when, IDENTITY)
    (low, high), (first, last) = ends, raw
    multiply = product([summed([high, product([-ONE, low])]), 1 / (last - first)])
    conversion = Conversion(multiply=multiply, add=summed([low, product([-first, multiply])]))
    return Scaling(when, conversion, (low, high) if isinstance(low, Number) and isinstance(high, Number) else None)


def _power(node: Value) -> Fraction:
    digits = node.whole()
    if abs(digits) <= _MOST_DIGITS:
        return 1 / Fraction(10) ** digits
    node.report(WRONG_SORT, f"a number cannot have {digits} decimals", remedy="give the digits after the point, as 1")
    return Fraction(1)


def decimals_of(node: Value, scope: Scope) -> Cases[Conversion]:
    """The conversion that `decimals` stands for: digits, `not_stated`, or a rule."""
    if node.is_number:
        return always(Conversion(multiply=_power(node)))
    return SAME if node.text() == NOT_STATED else decimals_rule(node, scope)


def decimals_rule(node: Value, scope: Scope) -> Cases[Conversion]:
    """The cases of the decimals rule that `node` names: the rule's own, then identity if it has a condition."""
    rule = scope.named(node, "decimals", rule=UNKNOWN_DECIMALS, what="decimals rule")
    return rule_at(rule, scope) if rule else SAME


def rule_at(rule: Value, scope: Scope) -> Cases[Conversion]:
    """The cases of the decimals rule that stands at `rule`; where none of its own holds, the identity."""
    cases = scope.once(rule.path, lambda: cases_of(rule, scope, lambda node: _decimals(node, scope)))
    return cases if any(case.when.always for case in cases) else (*cases, Case(ALWAYS, IDENTITY))


def _decimals(node: Value, scope: Scope) -> Conversion:
    register, at_most, step = (node.child(key) for key in ("register", "at_most", "step"))
    if register is None:
        return IDENTITY
    decimals = Decimals(scope.path(register), at_most.whole() if at_most else None)
    increment = step.number() if step else None
    if node.text_of("stores") == "value":  # with its point
        return Conversion(step=Fraction(1) if increment is None else increment, places=decimals)
    return Conversion(decimals=decimals, step=increment)
