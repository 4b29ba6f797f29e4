"""Model values as expressions over `regscribe_runtime.values`: any of its types, and what a module names and shares."""

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from fractions import Fraction

from regscribe.emit.python.constants import Pool, names_of
from regscribe.emit.python.formatting import Call, Expression, call, group
from regscribe.emit.python.literals import exact, literal, member
from regscribe.emit.words import cases_words, conversion_words, range_words
from regscribe.model import (
    BOTTOM,
    SAME,
    TOP,
    Case,
    Cases,
    Condition,
    Conversion,
    Model,
    Open,
    OrderCases,
    Range,
    Register,
    Space,
)
from regscribe_runtime.values.views import word

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
            return member(value)
        case str():
            return call("Open", literal(value)) if isinstance(value, Open) else literal(value)
        case int() | Fraction():
            return "BOTTOM" if value == BOTTOM else "TOP" if value == TOP else exact(value)
        case tuple():
            return _record(value, known) if hasattr(value, "_fields") else group([expression(i, known) for i in value])
    message = f"a declaration cannot hold {value!r}, a {type(value).__name__}"
    raise TypeError(message)


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

    def of(self, value: object) -> Expression:
        """The expression of a value; a named condition becomes a constant of its name."""
        return expression(value, self._known)

    def _known(self, value: object) -> Expression | None:
        match value:
            case Condition(tests, name) if tests and name:
                return self.pool.share(expression(value), name, f"{name}_{self.model.name}")
            case OrderCases() if by_code := value.by_code():
                return call(self.pool.helper("order_from"), literal(by_code[0]), self.of(by_code[1]))
            case (Case(when, Range((interval,), None)),) if when.always:
                return call(self.pool.helper("within"), self.of(interval.low), self.of(interval.high))
            case (Case(when, then),) if when.always:
                return call(self.pool.helper("always"), self.of(then))
        return None

    def shared(self, register: Register, use: str, fact: object) -> Expression | None:
        """The constant of a fact of a register; None where the fact is None or empty."""
        return self._share(register, use, self.of(fact)) if fact else None

    def _share(self, register: Register, use: str, expression: Expression, comment: str = "") -> str:
        return self.pool.share(expression, *names_of(register, use, self.model), comment=comment)

    def maybe(self, register: Register, use: str, expression: Expression) -> Expression:
        """The expression itself if it is short, else its constant."""
        return self.pool.maybe(expression, *names_of(register, use, self.model))

    def scale(self, register: Register, use: str, about: str) -> Expression | None:
        """The cases of `scale` or `special_scale` (`use`), with `about` as their comment; None for the identity."""
        cases: Cases[Conversion] = getattr(register, use)
        if cases == SAME:
            return None
        words = cases_words(tuple(Case(case.when, conversion_words(case.then)) for case in cases))
        return self._share(register, use, self.of(cases), f"{about}: {words}")

    def range(self, register: Register, use: str) -> Expression | None:
        """The cases of `range` or `valid` (`use`); None where the manual gives none."""
        cases: Cases[Range] = getattr(register, use)
        if all(isinstance(end, Open) for case in cases for one in case.then.intervals for end in one):
            return None  # nothing could be checked
        if len(cases) == 1 and cases[0].when.always:
            return self.maybe(register, use, self.of(cases))
        words = cases_words(tuple(Case(case.when, range_words(case.then)) for case in cases))
        return self._share(register, use, self.of(cases), words)

    def unit(self, register: Register) -> Expression | None:
        """A unit, or its cases; None without one."""
        cases = register.unit
        if len(cases) == 1 and cases[0].when.always:
            return literal(cases[0].then) if cases[0].then else None
        return self._share(register, "unit", self.of(cases), cases_words(cases))

    def governs(self, register: Register) -> Expression | None:
        """What a register sets of the line; None if it sets nothing of it."""
        governs = register.governs
        return None if governs is None else self.maybe(register, "governs", expression(governs))

    def views(self, register: Register) -> str:
        """The name of the constant that holds a register's view set."""
        base = register.base
        found = tuple(view._replace(region=None) for view in register.views)  # drivers read where registers stand
        if len(found) > 1:
            return self._share(register, "views", self.of(found))
        if found == word(base.type):
            return self.pool.share(call(self.pool.helper("word"), member(base.type)), base.type)
        kind = base.type if base.space is Space.HOLDING else f"{base.space}_{base.type}"
        return self.pool.share(self.of(found), kind)
