"""From the stored value to the value of use: constant and conditional scales, decimals rules."""

from dataclasses import dataclass
from fractions import Fraction

from regscribe.lower.conditions import condition
from regscribe.lower.interval_text import unordered
from regscribe.lower.node import Value
from regscribe.lower.rules import NO_ENDS, TWO_SCALES, UNKNOWN_DECIMALS, UNKNOWN_SCALE, WRONG_SORT
from regscribe.lower.scope import Scope, path_of
from regscribe.lower.tree import TreeNode
from regscribe.model import ALWAYS, IDENTITY, SAME, Case, Cases, Condition, Conversion, Decimals, WireType, always, show

NOT_STATED = "not_stated"
_WITH_POINT = "value"
_MOST_DIGITS = 100
_LINEAR = frozenset({"multiply", "add"})
_WAYS = _LINEAR | {"scale", "decimals"}
_TWO_WAYS = "keep the one that the manual states"


@dataclass(frozen=True, slots=True)
class Scaling:
    """A conversion under a condition; `ends` are its values at the type's lowest and highest raw code, if told so."""

    when: Condition
    conversion: Conversion
    ends: tuple[Fraction, Fraction] | None = None


def scale_of(entry: TreeNode, wire: WireType, scope: Scope) -> tuple[Scaling, ...]:
    """The conversion of a register by case; RS0318 where the map gives two."""
    settings = entry.settings
    given = [key for key in settings if key in _WAYS]
    if len(given) > 1 and not set(given) <= _LINEAR:
        message = f"`{entry.id}` has both `{given[0]}` and `{given[1]}`"
        settings[given[1]].report(TWO_SCALES, message, remedy=_TWO_WAYS, at_key=True)
    if "scale" in settings:
        return _scale(settings["scale"], wire, scope)
    if "decimals" in settings:
        return tuple(Scaling(case.when, case.then) for case in decimals_of(settings["decimals"], scope))
    return (Scaling(ALWAYS, _linear(settings.get("multiply"), settings.get("add"))),)


def _linear(multiply: Value | None, add: Value | None) -> Conversion:
    if multiply is None and add is None:
        return IDENTITY
    return Conversion(multiply.number() if multiply else Fraction(1), add.number() if add else Fraction(0))


def _scale(node: Value, wire: WireType, scope: Scope) -> tuple[Scaling, ...]:
    if node.is_text and ".." in node.text():
        return (_affine(node, ALWAYS, unordered(node), wire),)
    found = scope.named(node, "scales", rule=UNKNOWN_SCALE, what="scale")
    return (scale_at(found, wire, scope) if found else ()) or (Scaling(ALWAYS, IDENTITY),)


def scale_at(node: Value, wire: WireType, scope: Scope) -> tuple[Scaling, ...]:
    """The cases of the scale that stands at `node`, for raw codes of the type `wire`."""
    return scope.once((node.path, wire), lambda: tuple(_case(case, wire, scope) for case in node.elements()))


def _case(node: Value, wire: WireType, scope: Scope) -> Scaling:
    when = condition(node.child("when"), scope)
    low, high, digits = node.child("from"), node.child("to"), node.child("decimals")
    if low and high:
        return _affine(node, when, (low.number(), high.number()), wire)
    if digits:
        return Scaling(when, Conversion(multiply=_power(digits)))
    return Scaling(when, _linear(node.child("multiply"), node.child("add")))


def _affine(node: Value, when: Condition, ends: tuple[Fraction, Fraction], wire: WireType) -> Scaling:
    if not wire.is_integer:
        message = f"the scale from {show(ends[0])} to {show(ends[1])} needs a whole number on the wire, not {wire}"
        node.report(NO_ENDS, message, remedy="use `multiply` and `add`")
        return Scaling(when, IDENTITY)
    multiply = (ends[1] - ends[0]) / (wire.maximum - wire.minimum)
    return Scaling(when, Conversion(multiply=multiply, add=ends[0] - multiply * wire.minimum), ends)


def _power(node: Value) -> Fraction:
    digits = node.whole()
    if 0 <= digits <= _MOST_DIGITS:
        return Fraction(1, 10**digits)
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
    cases = scope.once(rule.path, lambda: tuple(_decimals_case(node, scope) for node in rule.elements()))
    return cases if any(case.when.always for case in cases) else (*cases, Case(ALWAYS, IDENTITY))


def _decimals_case(node: Value, scope: Scope) -> Case[Conversion]:
    when = condition(node.child("when"), scope)
    register, at_most, step, stores = (node.child(key) for key in ("register", "at_most", "step", "stores"))
    if register is None:
        return Case(when, IDENTITY)
    path = path_of(scope.register(register), register.text())
    decimals = Decimals(path, at_most.whole() if at_most else None)
    increment = step.number() if step else None
    if stores is not None and stores.text() == _WITH_POINT:
        return Case(when, Conversion(step=Fraction(1) if increment is None else increment, places=decimals))
    return Case(when, Conversion(decimals=decimals, step=increment))
