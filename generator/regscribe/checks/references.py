"""References to registers: word orders, decimals, limits, conditions, and circles of them."""

from collections.abc import Iterable, Iterator
from fractions import Fraction

from regscribe.checks.conditions import conditional
from regscribe.checks.held_values import NUMBERS
from regscribe.checks.rule import Finding, Problem, RuleScope, model_rule, register_rule
from regscribe.model import (
    Cases,
    Kind,
    Order,
    OrderCases,
    Range,
    Ref,
    Register,
    Related,
    Span,
    View,
    orders_of,
    registers_of,
    show,
)
from regscribe.reference.states import domain
from regscribe_runtime.values.terms import parts_of, registers_in

WHOLE = {Kind.INTEGER, Kind.RAW, Kind.ENUM, Kind.BOOLEAN}
CODES_LISTED = 64
"""A register of more values than this is no selector whose every value needs an order."""


def needed(register: Register) -> Iterator[tuple[str, str]]:
    """Registers whose values are needed to read a register: path and reason of each."""
    yield from ((path, "its existence depends on") for path in register.when.registers)
    yield from ((path, "its scale depends on") for path in registers_of(register.scale))
    yield from ((case.then.decimals.register, "its decimals are") for case in register.scale if case.then.decimals)
    yield from ((path, "its scale depends on") for path in _in_scale(register))
    yield from ((path, "its special values depend on") for path in registers_of(register.special_scale))
    yield from ((path, "its faults depend on") for one in register.sentinels for path in one.when.registers)
    yield from ((path, "what its value may be depends on") for path in registers_of(register.partial))
    yield from ((path, "what is valid depends on") for path in registers_of(register.valid))
    yield from ((path, "a limit of what is valid is") for path in _limits(register.valid))
    for view in register.views:
        yield from ((path, f"an order or the factor of view {view.name} depends on") for path in view.needs())


def limiting(register: Register) -> Iterator[tuple[str, str]]:
    """Registers whose values are needed besides to write a register, for limits and conditions: path and reason."""
    yield from ((path, "its range depends on") for path in registers_of(register.range))
    yield from ((path, "a limit is") for path in _limits(register.range))
    decimals = [(case.then.decimals, "the decimals of its range are") for case in register.range]
    decimals += [(case.then.places, "its finest step depends on") for case in register.scale]
    yield from ((one.register, why) for one, why in decimals if one)
    if register.writable:
        yield from ((path, "a write depends on") for path in register.writable.when.registers)
    yield from ((path, "its unit depends on") for path in registers_of(register.unit))


def depending(scope: RuleScope) -> tuple[tuple[Register, str, str, Span], ...]:
    """Registers that decide something, with who needs them in words, its id and its place; kept for all rules."""
    return scope.once("depending", lambda: tuple(_depending(scope)))


def _depending(scope: RuleScope) -> Iterator[tuple[Register, str, str, Span]]:
    for register in scope.model.registers:
        for path, why in dict.fromkeys((*needed(register), *limiting(register))):
            for other in scope.named((path,)):
                yield other, f"`{register.path}` needs `{path}` ({why} it)", register.path, register.span
    for what, thing, span, when in conditional(scope.model):
        for other in scope.named(when.registers):
            yield other, f"{what} has a condition on `{other.path}`", thing, span


def _limits(cases: Cases[Range]) -> tuple[str, ...]:
    """The registers in limits."""
    return registers_in(*(case.then.intervals for case in cases))


def _values(terms: Iterable[tuple[object, ...]]) -> Iterable[str]:
    """The registers whose values stand in terms, without those of conditions."""
    return dict.fromkeys(part.register for part in parts_of(tuple(terms)) if isinstance(part, Ref))


def _in_scale(register: Register) -> tuple[str, ...]:
    """The registers in the terms of a register's scale."""
    return registers_in(*((case.then.multiply, case.then.add) for case in register.scale))


@model_rule("RS0697", "Computed value of what is no number")
def computed_of_no_number(scope: RuleScope) -> Iterator[Finding]:
    """A sum has a meaning only if each of its parts is a number that can be read."""
    for one in scope.model.computed:
        numbers = set(_values([(one.term, one.valid)]))
        for other in scope.named(registers_in(one.term, one.valid, one.when)):
            if (other.path in numbers and other.kind not in NUMBERS) or not other.access.readable:
                message = f"`{one.id}` follows from `{other.path}`, of kind {other.kind} and access {other.access}"
                related = Related(f"`{other.path}` stands here", other.span)
                yield Finding(one.id, one.span, message, "name registers that hold numbers and can be read", related)
        if not registers_in(one.term):
            message = f"`{one.id}` follows from no register"
            yield Finding(one.id, one.span, message, "name the registers, or put the number into a `note`")


@register_rule("RS0461", "Word order from an unsuitable register")
def order_register(register: Register, scope: RuleScope) -> Iterator[Problem]:
    """It is read before the first long value, so it must be one whole word of an order that does not depend on it."""
    for view, _, other in _ordering(register, scope):
        fixed = len(other.views) == 1 and other.base.type.is_integer and not other.base.needs()
        if other.kind not in WHOLE or not fixed:
            message = f"has the word order of view {view.name} from `{other.path}`, which is no plain whole number"
            related = Related(f"`{other.path}` is of kind {other.kind}, type {other.base.type}", other.span)
            yield message, "name a register with an enum or a whole number and one view", related


def _ordering(register: Register, scope: RuleScope) -> Iterator[tuple[View, OrderCases, Register]]:
    """The views of which the codes of another register alone tell an order, with the order and that register."""
    for view in register.views:
        for order in (view.order, view.byte_order):
            by_code = order.by_code() if isinstance(order, OrderCases) else None
            if isinstance(order, OrderCases) and by_code and by_code[0] in scope.registers:
                yield view, order, scope.registers[by_code[0]]


@model_rule("RS0685", "Deciding register that reading clears")
def decided_by_clearing(scope: RuleScope) -> Iterator[Finding]:
    """Each time that it is read to decode another one, what it held is lost."""
    for other, who, thing, span in depending(scope):
        if other.reading.clears:
            related = Related(f"`{other.path}` has `reading: clears`", other.span)
            yield Finding(thing, span, f"{who}, which reading clears", "correct one of the two", related)


@model_rule("RS0462", "Registers need each other")
def circle(scope: RuleScope) -> Iterator[Finding]:
    """A value that needs itself to be decoded can never be read."""
    done: set[str] = set()
    for start in scope.registers:
        for ring in _rings(start, done, scope):
            register = min((scope.registers[name] for name in ring), key=lambda one: one.span)
            place = ring.index(register.path)
            chain = " needs ".join(f"`{name}`" for name in (*ring[place:], *ring[:place], register.path))
            yield Finding(register.path, register.span, chain, "make one of them independent of the others")


def _rings(start: str, done: set[str], scope: RuleScope) -> Iterator[list[str]]:
    """Circles on the way from `start`, depth first, without recursion since chains may be long."""
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


@model_rule("RS0463", "Needed register cannot be read")
def unreadable(scope: RuleScope) -> Iterator[Finding]:
    """A value that decides must be readable, or it is never known."""
    for other, who, thing, span in depending(scope):
        if not other.access.readable:
            related = Related(f"`{other.path}` has access {other.access}", other.span)
            yield Finding(thing, span, f"{who}, which can only be written", "correct one", related)


@register_rule("RS0464", "Decimals from a register that is no whole number")
def decimals_register(register: Register, scope: RuleScope) -> Iterator[Problem]:
    """A number of decimals is 0, 1, 2 ..."""
    counts = [case.then.decimals for case in register.scale]
    counts += [case.then.places for case in register.scale]
    counts += [case.then.decimals for case in register.range]
    for other in scope.named(one.register for one in filter(None, counts)):
        lowest = min((stretch.low for stretch in domain(other)), default=Fraction(0))
        if other.kind not in WHOLE or (other.range and lowest < 0):
            what = f"of kind {other.kind} and starts at {show(lowest)}"
            message = f"has its decimals from `{other.path}`, which is {what}"
            related = Related(f"`{other.path}` stands here", other.span)
            yield message, "name a register of whole numbers from 0", related


@register_rule("RS0465", "Limit from a register that is no number")
def limit_register(register: Register, scope: RuleScope) -> Iterator[Problem]:
    """A code or a text has no size to compare with."""
    for other in scope.named(_values(case.then.intervals for case in (*register.range, *register.valid))):
        if other is register or other.kind not in NUMBERS:
            what = "itself" if other is register else f"`{other.path}`, which is of kind {other.kind}"
            yield f"has a limit that is {what}", "name a register that holds a number"


@register_rule("RS0651", "Scale from a register that is no number")
def scale_register(register: Register, scope: RuleScope) -> Iterator[Problem]:
    """A text, a version or a word of bits cannot multiply, divide or be added."""
    terms = [(case.then.multiply, case.then.add) for case in register.scale]
    for other in scope.named(_values([*terms, *((view.times,) for view in register.views)])):
        if other is register or other.kind not in NUMBERS | WHOLE:
            what = "itself" if other is register else f"`{other.path}`, which is of kind {other.kind}"
            yield f"has a scale that depends on {what}", "name a register that holds a number"


@register_rule("RS0466", "Word order not stated for a code")
def order_codes(register: Register, scope: RuleScope) -> Iterator[Problem]:
    """With that code set, no long value could be read or written."""
    for view, order, other in _ordering(register, scope):
        stated = {code for case in order.cases for code, _ in case.when.leaves[0].codes}
        few = [stretch for stretch in domain(other) if stretch.high - stretch.low < CODES_LISTED]
        codes = [code for stretch in few for code in range(int(stretch.low), int(stretch.high) + 1)]
        lacking = ", ".join(str(code) for code in codes if code not in stated)
        if lacking:
            message = f"has view {view.name} without a word order for {lacking} of `{other.path}`"
            yield message, "list the order of every code under `codes`"


@register_rule("RS0610", "Word order with other places than the words have")
def order_places(register: Register, _: RuleScope) -> Iterator[Problem]:
    """A place that is named twice, or left out, would decode one word as another."""
    for view in register.views:
        count = view.type.words if view.type.is_integer or view.type.is_float else view.words
        for order in orders_of(view.order):
            if not isinstance(order, Order) and (len(set(order)), len(order), max(order)) != (count, count, view.words):
                places = ", ".join(map(str, order))
                message = f"has the word order [{places}] in view {view.name}, which has {count} words"
                yield message, f"give each place from 1 to {count} once, that of the most significant word first"
