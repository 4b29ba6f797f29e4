"""Conditions on the values of other registers, and cases selected by them."""

from collections.abc import Callable, Iterable, Mapping
from fractions import Fraction
from typing import Any, Generic, NamedTuple, TypeVar

from regscribe_runtime.values.numbers import exact, show
from regscribe_runtime.values.versions import version_key, version_of_key

T = TypeVar("T")

State = Mapping[str, Any]
"""Known values of use by register path: numbers; an enum or a word of bits as its code."""

Givens = Mapping[str, Any]
"""Facts from other manuals, given to the driver's constructor by id: a set of codes, a bool, a number or a text."""


TOP = 1 << 1024
BOTTOM = -TOP
"""Open ends of codes: no value of use is beyond them, as none is beyond a double."""

GIVEN = "given"
"""The subject of a test of a number or a choice that is given: `given.ct_ratio`."""


class Is(NamedTuple):
    """A test: the value of `register` (or of its bit field `field`, at `bits`) lies in one of `codes`.

    Codes are pairs of both ends, which are included. With `given`, the codes are those of the given of that id; with an
    empty `register`, the given itself is the result or, with `codes` (texts for a choice), what is tested. `negated`
    inverts the test. `version`: the register holds a text, and codes are keys of versions; a text without a version
    lies in none.
    """

    register: str
    codes: tuple[tuple[Any, Any], ...] = ()
    field: str = ""
    bits: tuple[int, int] | None = None
    given: str = ""
    negated: bool = False
    version: bool = False

    @property
    def subject(self) -> str:
        """The path to look up: `register`, `register.field` or `given.id`."""
        if not self.register:
            return f"{GIVEN}.{self.given}"
        return f"{self.register}.{self.field}" if self.field else self.register

    @property
    def asks_given(self) -> bool:
        """Whether it asks for the codes of a given, or for a given that is yes or no."""
        return bool(self.given) and not self.codes

    def lists(self, value: Any) -> bool:
        """Whether `value` lies in one of the codes."""
        return any(low <= value <= high for low, high in self.codes)

    def holds(self, state: State, givens: Givens) -> bool:
        """Tell whether the test is true; KeyError if the register's value is not in `state`."""
        return self._is_met(state, givens) is not self.negated

    def _is_met(self, state: State, givens: Givens) -> bool:
        if not self.register:
            return self.lists(givens[self.given]) if self.codes else bool(givens[self.given])
        value = state[self.register]
        if self.version:
            key = version_key(value)
            return key is not None and self.lists(key)
        if isinstance(value, str):  # a version counts as the number that its digits pack
            value = int(value.replace(".", ""))
        if self.bits:
            low, high = self.bits
            value = (int(value) >> low) & ((1 << (high - low + 1)) - 1)
        if self.given:
            return value in givens[self.given]
        return self.lists(Fraction(value) if isinstance(value, int) else exact(value))

    @property
    def words(self) -> str:
        """The test in plain words: `input_type is 13 to 22`."""
        return self.told(Is.end)

    def told(self, end: "Tell") -> str:
        """The test in words, with `end` for each code."""
        be = "is not" if self.negated else "is"
        if self.asks_given:
            return f"{self.register} {be} one of {self.given}" if self.register else f"{self.given} {be} true"
        return f"{self.subject} {be} {' or '.join(self._shown(*ends, end) for ends in self.codes)}"

    def _shown(self, low: Any, high: Any, end: "Tell") -> str:
        first, last = (end(self, one) for one in (low, high))
        if low == high:
            return first
        return f"at most {last}" if low == BOTTOM else f"at least {first}" if high == TOP else f"{first} to {last}"

    def end(self, end: Any) -> str:
        """A code as text."""
        return version_of_key(end) if self.version else end if isinstance(end, str) else show(end)


Tell = Callable[[Is, Any], str]
"""How a code of a test is told."""


def at_least(subject: str, least: int) -> Is:
    """The test that a register, or `given.id`, is `least` or more."""
    kind, _, name = subject.partition(".")
    return Is("", ((least, TOP),), given=name) if kind == GIVEN and name else Is(subject, ((least, TOP),))


class AnyOf(NamedTuple):
    """A test: one of the conditions holds; `negated` inverts it."""

    conditions: tuple["Condition", ...]
    negated: bool = False

    def holds(self, state: State, givens: Givens) -> bool:
        """Tell whether the test is true; the error of a value that counts and is not known."""
        return _decided(self.conditions, state, givens, by=True) is not self.negated

    def told(self, end: Tell) -> str:
        """The test in words, with `end` for each code."""
        return f"{'not ' if self.negated else ''}({' or '.join(each.told(end) for each in self.conditions)})"


def _decided(tests: Iterable["Is | AnyOf | Condition"], state: State, givens: Givens, *, by: bool) -> bool:
    """`by` if one test is `by`, else the contrary; the error of a value that is not known if no test decides."""
    unknown: Exception | None = None
    for test in tests:
        try:
            if test.holds(state, givens) is by:
                return by
        except (LookupError, ValueError) as error:
            unknown = error
    if unknown is not None:
        raise unknown
    return not by


class Condition(NamedTuple):
    """All tests hold; no tests: always. `name` is the map's name for it, if it has one."""

    tests: tuple[Is | AnyOf, ...] = ()
    name: str = ""

    @property
    def always(self) -> bool:
        """Whether it has no tests."""
        return not self.tests

    @property
    def leaves(self) -> tuple[Is, ...]:
        """The tests of values, those within `AnyOf` among them."""
        found: list[Is] = []
        for test in self.tests:
            found += (
                [test] if isinstance(test, Is) else [leaf for condition in test.conditions for leaf in condition.leaves]
            )
        return tuple(found)

    @property
    def registers(self) -> tuple[str, ...]:
        """The registers of the tests, each once, in order."""
        return tuple(dict.fromkeys([test.register for test in self.leaves if test.register])) if self.tests else ()

    def holds(self, state: State, givens: Givens) -> bool:
        """Tell whether all tests are true; the error (KeyError) of a value that counts and is not known."""
        return _decided(self.tests, state, givens, by=False)

    @property
    def words(self) -> str:
        """The condition in plain words."""
        return self.told(Is.end)

    def told(self, end: Tell) -> str:
        """The condition in words, with `end` for each code."""
        return " and ".join(test.told(end) for test in self.tests)


ALWAYS = Condition()


class Case(NamedTuple, Generic[T]):
    """A value `then` under the condition `when`; of a tuple of cases the first whose condition holds counts."""

    when: Condition
    then: T


Cases = tuple[Case[T], ...]


def always(then: T) -> Cases[T]:
    """A single case without a condition."""
    return (Case(ALWAYS, then),)


def choose(cases: Cases[T], state: State, givens: Givens) -> T | None:
    """The value of the first case whose condition holds; None if none does."""
    for when, then in cases:
        if when.holds(state, givens):
            return then
    return None


def registers_of(cases: Cases[Any]) -> tuple[str, ...]:
    """The registers in the conditions of the cases, each once."""
    if not cases:
        return ()
    return tuple(dict.fromkeys([name for case in cases if case.when.tests for name in case.when.registers]))
