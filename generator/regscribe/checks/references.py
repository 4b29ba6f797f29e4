"""References to registers: word orders, decimals, limits, conditions, and circles of them."""

from collections.abc import Iterator
from fractions import Fraction

from regscribe.checks.assumed_values import count_registers
from regscribe.checks.held_values import NUMBERS
from regscribe.checks.rule import Finding, RuleScope, model_rule, register_rule
from regscribe.model import Kind, Order, OrderFrom, Ref, Register, Related, registers_of, show
from regscribe.reference.states import domain

WHOLE = {Kind.INTEGER, Kind.RAW, Kind.ENUM, Kind.BOOLEAN}
CODES_LISTED = 64
"""A register of more values than this is no selector whose every value needs an order."""


def needed(register: Register) -> Iterator[tuple[str, str]]:
    """What a register needs to be read, and why: pairs of another register's path and a reason."""
    yield from ((path, "its scale depends on") for path in registers_of(register.scale))
    yield from ((case.then.decimals.register, "its decimals are") for case in register.scale if case.then.decimals)
    for view in register.views:
        if isinstance(view.order, OrderFrom):
            yield view.order.register, f"the word order of view {view.name} is"


def limiting(register: Register) -> Iterator[tuple[str, str]]:
    """What a register needs besides to be written: limits and conditions."""
    yield from ((path, "its range depends on") for path in registers_of(register.range))
    yield from ((path, "a limit is") for path in _limits(register))
    decimals = [(case.then.decimals, "the decimals of its range are") for case in register.range]
    decimals += [(case.then.places, "its finest step depends on") for case in register.scale]
    yield from ((one.register, why) for one, why in decimals if one)
    if register.writable:
        yield from ((path, "a write depends on") for path in register.writable.when.registers)
    yield from ((path, "its unit depends on") for path in registers_of(register.unit))


def _limits(register: Register) -> Iterator[str]:
    for case in register.range:
        for interval in case.then.intervals:
            yield from (end.register for end in (interval.low, interval.high) if isinstance(end, Ref))


@register_rule(
    "RS0461",
    "Word order from an unsuitable register",
    "It is read before the first long value, so it must be one whole word of an order that does not depend on it.",
)
def order_register(register: Register, scope: RuleScope) -> Iterator[Finding]:
    """The register must be a whole number or an enum with a single integer view."""
    for view in register.views:
        other = scope.registers.get(view.order.register) if isinstance(view.order, OrderFrom) else None
        if other is None:
            continue
        fixed = len(other.views) == 1 and other.base.type.is_integer and isinstance(other.base.order, Order)
        if other.kind not in WHOLE or not fixed:
            message = f"has the word order of view {view.name} from `{other.path}`, which is no plain whole number"
            related = Related(f"`{other.path}` is of kind {other.kind}, type {other.base.type}", other.span)
            yield Finding.at(register, message, "name a register with an enum or a whole number and one view", related)


@model_rule("RS0462", "Registers need each other", "A value that needs itself to be decoded can never be read.")
def circle(scope: RuleScope) -> Iterator[Finding]:
    """Walk what registers need to be read (scale, decimals, word order); each circle is reported once."""
    done: set[str] = set()
    for start in scope.registers:
        yield from (_circular(ring, scope) for ring in _rings(start, done, scope))


def _circular(ring: list[str], scope: RuleScope) -> Finding:
    register = min((scope.registers[name] for name in ring), key=lambda one: one.span)
    place = ring.index(register.path)
    chain = " needs ".join(f"`{name}`" for name in (*ring[place:], *ring[:place], register.path))
    return Finding(register.path, register.span, chain, "make one of them independent of the others")


def _rings(start: str, done: set[str], scope: RuleScope) -> Iterator[list[str]]:
    """Circles that are met on the way from `start`: depth first, on a stack of our own (chains may be long)."""
    if start in done:
        return
    path, open_names, turns = [start], {start}, [_others(start, scope)]
    while path:
        name = next(turns[-1], None)
        if name is None:
            turns.pop()
            done.add(path[-1])
            open_names.discard(path.pop())
        elif name in open_names:
            yield path[path.index(name) :]
        elif name not in done and name in scope.registers:
            path.append(name)
            open_names.add(name)
            turns.append(_others(name, scope))


def _others(name: str, scope: RuleScope) -> Iterator[str]:
    return iter(dict.fromkeys(path for path, _ in needed(scope.registers[name])))


@register_rule(
    "RS0463", "Needed register cannot be read", "A value that decides must be readable, or it is never known."
)
def unreadable(register: Register, scope: RuleScope) -> Iterator[Finding]:
    """Look at the access of every register that this one needs."""
    for path, why in dict.fromkeys((*needed(register), *limiting(register))):
        other = scope.registers.get(path)
        if other and not other.access.readable:
            related = Related(f"`{path}` has access {other.access}", other.span)
            yield Finding.at(register, f"needs `{path}` ({why} it), which can only be written", "correct one", related)


@register_rule("RS0464", "Decimals from a register that is no whole number", "A number of decimals is 0, 1, 2 ...")
def decimals_register(register: Register, scope: RuleScope) -> Iterator[Finding]:
    """The register must be of a whole kind, and not below 0."""
    for path in dict.fromkeys(count_registers(register)):
        other = scope.registers.get(path)
        if other is None:
            continue
        lowest = min((stretch.low for stretch in domain(other)), default=Fraction(0))
        if other.kind not in WHOLE or (other.range and lowest < 0):
            message = f"has its decimals from `{path}`, which is of kind {other.kind} and starts at {show(lowest)}"
            related = Related(f"`{path}` stands here", other.span)
            yield Finding.at(register, message, "name a register of whole numbers from 0", related)


@register_rule("RS0465", "Limit from a register that is no number", "A code or a text has no size to compare with.")
def limit_register(register: Register, scope: RuleScope) -> Iterator[Finding]:
    """The registers that limits name must be numbers."""
    for path in dict.fromkeys(_limits(register)):
        other = scope.registers.get(path)
        if other and (path == register.path or other.kind not in NUMBERS):
            what = "itself" if path == register.path else f"`{path}`, which is of kind {other.kind}"
            yield Finding.at(register, f"has a limit that is {what}", "name a register that holds a number")


@register_rule(
    "RS0466", "Word order not stated for a code", "With that code set, no long value could be read or written."
)
def order_codes(register: Register, scope: RuleScope) -> Iterator[Finding]:
    """Compare the codes of a word order with the members or the range of the register it comes from."""
    for view in register.views:
        if not isinstance(view.order, OrderFrom):
            continue
        other = scope.registers.get(view.order.register)
        stretches = domain(other) if other else ()
        told = {code for code, _ in view.order.codes}
        lacking = [code for stretch in stretches for code in _codes(stretch.low, stretch.high) if code not in told]
        if other and lacking:
            codes = ", ".join(map(str, lacking))
            message = f"has view {view.name} without a word order for {codes} of `{other.path}`"
            yield Finding.at(register, message, "list the order of every code under `codes`")


def _codes(low: Fraction, high: Fraction) -> range:
    return range(int(low), int(high) + 1) if high - low < CODES_LISTED else range(0)
