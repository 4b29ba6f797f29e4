"""Model values as expressions over `regscribe_runtime.values`: any of its types, and what a module names and shares."""

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from fractions import Fraction

from regscribe.emit.python.constants import Pool, names_of
from regscribe.emit.python.formatting import Call, Expression, call, group, mapping
from regscribe.emit.python.literals import exact, literal, member
from regscribe.emit.words import cases_words, conversion_words, range_words
from regscribe.model import (
    IDENTITY,
    Case,
    Cases,
    Condition,
    Conversion,
    Decimals,
    Limit,
    Model,
    Number,
    Open,
    Order,
    OrderFromRegister,
    Range,
    Reference,
    Register,
    Rounding,
    Space,
    Test,
    View,
    show,
)

Known = Callable[[object], Expression | None]
"""How a module writes a value by other means than its content, such as the name of a constant; None: it does not."""


def expression(value: object, known: Known = lambda _: None) -> Expression:
    """The expression that makes `value`: a named tuple, tuple, enum member, text, exact number, True, False or None.

    `known` is asked first about the value and about everything in it. TypeError for a value of any other type.
    """
    found = known(value)
    if found is not None:
        return found
    match value:
        case None | bool():
            return str(value)
        case Enum():
            return f"{type(value).__name__}.{value.name}"
        case str():
            return literal(value)
        case int() | Fraction():
            return _number(value)
        case tuple():
            return _record(value, known) if hasattr(value, "_fields") else group([expression(i, known) for i in value])
    message = f"a declaration cannot hold {value!r}, a {type(value).__name__}"
    raise TypeError(message)


def _number(value: int | Fraction) -> str:
    return str(value.numerator) if value.denominator == 1 else f"Fraction({literal(show(Fraction(value)))})"


def _record(value: tuple[object, ...], known: Known) -> Call:
    """A call with the required fields by position and those that are not at their default by name."""
    names: tuple[str, ...] = getattr(value, "_fields")  # noqa: B009 - a plain tuple has none
    defaults: dict[str, object] = getattr(value, "_field_defaults")  # noqa: B009 - as above
    every = dict(zip(names, value, strict=True))
    required = [expression(every[name], known) for name in names if name not in defaults]
    stated = {name: every[name] for name in names if name in defaults and every[name] != defaults[name]}
    return call(type(value).__name__, *required, **{name: expression(one, known) for name, one in stated.items()})


@dataclass(frozen=True, slots=True)
class Specs:
    """Builds expressions for the registers of one model; what is shared goes to `pool`."""

    model: Model
    pool: Pool

    def when(self, condition: Condition) -> Expression:
        """A tuple of tests; a named condition becomes a constant of its name."""
        tests = group([self._test(test) for test in condition.tests])
        return (
            self.pool.share(tests, condition.name, f"{condition.name}_{self.model.name}")
            if condition.name and condition.tests
            else tests
        )

    def _test(self, test: Test) -> Call:
        codes = group([group([exact(code.low), exact(code.high)]) for code in test.codes]) if test.codes else None
        return call(
            "Is",
            literal(test.register),
            *([codes] if codes else []),
            bits=self._bits(test) if test.field else None,
            given=literal(test.given) if test.given else None,
            negated="True" if test.negated else None,
        )

    def _bits(self, test: Test) -> str:
        found = next(field for field in self.model.register(test.register).fields if field.id == test.field)
        return f"({found.low}, {found.high})"

    def scale(self, register: Register) -> Expression | None:
        """The cases of a scale; None for the identity."""
        return self._scale(register, "scale", "value of the stored x")

    def special_scale(self, register: Register) -> Expression | None:
        """The cases of the decimals of special values; None for the identity."""
        return self._scale(register, "special_scale", "value of the special code x")

    def _share(self, register: Register, use: str, expression: Expression, comment: str = "") -> str:
        return self.pool.share(expression, *names_of(register, use, self.model), comment=comment)

    def _scale(self, register: Register, use: str, about: str) -> Expression | None:
        cases: Cases[Conversion] = getattr(register, use)
        if cases == (Case(Condition(), IDENTITY),):
            return None
        words = cases_words(tuple(Case(case.when, conversion_words(case.then)) for case in cases))
        built = group([group([self.when(case.when), self._conversion(case.then)]) for case in cases])
        return self._share(register, use, built, f"{about}: {words}")

    @staticmethod
    def _conversion(conversion: Conversion) -> Expression:
        found = conversion.decimals or conversion.places
        return call(
            "Conversion",
            multiply=exact(conversion.multiply) if conversion.multiply != 1 else None,
            add=exact(conversion.add) if conversion.add else None,
            decimals=literal(conversion.decimals.register) if conversion.decimals else None,
            at_most=str(found.at_most) if found and found.at_most is not None else None,
            step=exact(conversion.step) if conversion.step is not None else None,
            places=literal(conversion.places.register) if conversion.places else None,
        )

    def range(self, register: Register) -> Expression | None:
        """The cases of a range; None where the manual gives none."""
        cases = register.range
        if all(isinstance(end, Open) for case in cases for one in case.then.intervals for end in (one.low, one.high)):
            return None  # nothing could be checked
        if len(cases) == 1 and cases[0].when.always and self._simple(cases[0].then):
            (interval,) = cases[0].then.intervals
            simple = call(self.pool.helper("within"), _limit(interval.low), _limit(interval.high))
            return self.pool.maybe(simple, *names_of(register, "range", self.model))
        words = cases_words(tuple(Case(case.when, range_words(case.then)) for case in cases))
        built = group([group([self.when(case.when), self._limits(case.then)]) for case in cases])
        return self._share(register, "range", built, words)

    @staticmethod
    def _simple(limits: Range) -> bool:
        return len(limits.intervals) == 1 and limits.decimals is None

    @staticmethod
    def _limits(limits: Range) -> Call:
        intervals = [call("Interval", _limit(interval.low), _limit(interval.high)) for interval in limits.intervals]
        found: Decimals | None = limits.decimals
        return call(
            "Limits",
            group(intervals),
            decimals=literal(found.register) if found else None,
            at_most=str(found.at_most) if found and found.at_most is not None else None,
        )

    def unit(self, register: Register) -> Expression | None:
        """A unit, or its cases; None without one."""
        cases = register.unit
        if len(cases) == 1 and cases[0].when.always:
            return literal(cases[0].then) if cases[0].then else None
        built = group([group([self.when(case.when), literal(case.then)]) for case in cases])
        return self._share(register, "unit", built, cases_words(cases))

    def governs(self, register: Register) -> Expression | None:
        """What a register sets of the line; None if it sets nothing of it."""
        if register.governs is None:
            return None
        return self.pool.maybe(expression(register.governs), *names_of(register, "governs", self.model))

    def value(self, value: object) -> Expression:
        """A value of the vocabulary with the conditions in it."""
        return expression(value, lambda one: self.when(one) if isinstance(one, Condition) else None)

    def views(self, register: Register) -> str:
        """The name of the constant that holds a register's view set."""
        base = register.base
        templates = group([_view(view, base) for view in register.views])
        if len(register.views) > 1:
            return self._share(register, "views", templates)
        if base == _plain(base):
            return self.pool.share(call(self.pool.helper("word"), member(base.type)), base.type)
        kind = base.type if base.space is Space.HOLDING else f"{base.space}_{base.type}"
        return self.pool.share(templates, kind)


def _limit(limit: Limit) -> Expression:
    match limit:
        case Number(value):
            return exact(value)
        case Reference(register):
            return call("Ref", literal(register))
        case Open():
            return "None"


def _plain(view: View) -> View:
    return View("base", Space.HOLDING, view.address, view.type, words=view.type.words, region=view.region)


def _view(view: View, base: View) -> Call:
    # wire address = offset + stride x at, with the base view's own address as `at`
    offset = view.address - view.stride * base.address
    return call(
        "View",
        literal(view.name),
        member(view.type),
        offset=str(offset) if offset else None,
        stride=str(view.stride) if view.stride != 1 else None,
        words=str(view.words) if view.words != 1 else None,
        factor=exact(view.factor) if view.factor != 1 else None,
        rounding=member(view.rounding) if view.rounding is not Rounding.NONE else None,
        saturates="True" if view.saturates else None,
        order=_order(view.word_order),
        byte_order=member(view.byte_order) if view.byte_order is not Order.BIG else None,
        functions=f"({', '.join(map(str, view.functions))}{',' * (len(view.functions) == 1)})"
        if view.functions
        else None,
        space=member(view.space) if view.space is not Space.HOLDING else None,
        preferred="True" if view.preferred else None,
        align=str(view.align) if view.align != 1 else None,
    )


def _order(order: Order | OrderFromRegister) -> Expression | None:
    if isinstance(order, OrderFromRegister):
        codes = mapping([(str(code), member(found)) for code, found in order.codes])
        return call("OrderFrom", literal(order.register), codes)
    return member(order) if order is not Order.BIG else None
