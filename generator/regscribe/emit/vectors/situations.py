"""In which surroundings a register must be tried: every case of its scale and range, every order, every decimals."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import islice, product

from regscribe.emit.vectors.subject import GivenTry, Questions, Tries, Values, questions_of, tries_of
from regscribe.model import (
    IDENTITY,
    Conversion,
    Interval,
    Kind,
    Model,
    Number,
    Reference,
    Register,
    RegisterMap,
    View,
)
from regscribe.model.condition import Cases, T
from regscribe.reference import Surroundings, choose, decimal_factor, holds, word_order

Meaning = Callable[[Surroundings], object]
"""What a situation comes to, for the register that is tried."""

MOST_COMBINATIONS = 20_000
"""Enough for every combination of six registers with five values each; more would only repeat what was tried."""

LOW_STORED, HIGH_STORED = Fraction(100), Fraction(1500)
"""Where limits that stand in other registers are put: stored numbers that every type of 16 bits and more can hold."""


@dataclass(frozen=True, slots=True)
class Situation:
    """What is known beside the register itself. Not `full`: it differs from another one only in the codes.

    `parts` are the names in `values` that are a field of a register; `words` those of such registers.
    """

    values: tuple[tuple[str, Fraction], ...] = ()
    codes: tuple[tuple[str, frozenset[Fraction]], ...] = ()
    facts: tuple[tuple[str, bool], ...] = ()
    parts: tuple[str, ...] = ()
    words: tuple[str, ...] = ()
    full: bool = True

    @property
    def state(self) -> dict[str, Fraction]:
        """The values of whole registers, as a driver takes them."""
        return {name: value for name, value in self.values if name not in self.parts}

    @property
    def known(self) -> Surroundings:
        """The same as the reference wants it."""
        return Surroundings(dict(self.values), dict(self.codes), dict(self.facts))


class Finder:
    """Finds situations; registers that depend on the same things in the same way are worked out once."""

    def __init__(self, register_map: RegisterMap) -> None:
        self._map = register_map
        self._known: dict[object, tuple[Situation, ...]] = {}

    def situations(self, model: Model, register: Register, view: View) -> tuple[Situation, ...]:
        """Return the situations in which `view` must be tried.

        Full ones: each combination of a case of the scale, a case of the range and their decimals, and each word order;
        besides, one for each code that decides between the cases.
        """
        tries = tries_of(self._map, model, questions_of(register, view))
        asked = tuple(tries.values.items()), tuple(tries.givens.items()), tuple(tries.parts.items())
        ranges = register.range if register.access.writable else ()
        key = (register.scale, register.special_scale, ranges, register.kind, view.word_order, view.words, asked)
        if key not in self._known:
            self._known[key] = _situations(tries, register, view)
        return self._known[key]


def _situations(tries: Tries, register: Register, view: View) -> tuple[Situation, ...]:
    seen: dict[object, Situation] = {}
    every = list(islice(_combinations(tries), MOST_COMBINATIONS))
    for situation in every:
        known = situation.known
        seen.setdefault(_signature(register, known), situation)
        if view.words > 1:
            seen.setdefault(word_order(view, known), situation)
    full = list(dict.fromkeys(seen.values()))
    found = [*full, *_missing(tries.values, full, every, lambda known: _meaning(register, known))]
    return tuple(_with_limits(register, situation) for situation in found)


def writable_situations(
    register_map: RegisterMap, model: Model, register: Register
) -> tuple[tuple[Situation, bool], ...]:
    """Return one situation for each code that decides whether a write is accepted, and whether it is."""
    if register.writable is None:
        return ()
    condition = register.writable.when
    tries = tries_of(register_map, model, Questions((condition,)))
    every = list(islice(_combinations(tries), MOST_COMBINATIONS))
    seen = {holds(condition, situation.known): situation for situation in reversed(every)}
    full = list(seen.values())
    found = [*full, *_missing(tries.values, full, every, lambda known: holds(condition, known))]
    return tuple((situation, holds(condition, situation.known)) for situation in found)


def _combinations(tries: Tries) -> Iterator[Situation]:
    names, givens = tuple(tries.values), tuple(tries.givens)
    for picked in product(*tries.values.values(), *tries.givens.values()):
        values = tuple(zip(names, picked, strict=False))
        said: tuple[tuple[str, GivenTry], ...] = tuple(zip(givens, picked[len(names) :], strict=True))  # type: ignore[arg-type]
        yield Situation(
            values + _words(tries, dict(values)),  # type: ignore[arg-type]
            tuple((name, codes) for name, codes in said if isinstance(codes, frozenset)),
            tuple((name, fact) for name, fact in said if isinstance(fact, bool)),
            tuple(tries.parts),
            tuple(register for register, _ in tries.parts.values()),
        )


def _words(tries: Tries, values: dict[str, Fraction]) -> tuple[tuple[str, Fraction], ...]:
    """Put fields together to the words that they are parts of."""
    words: dict[str, int] = {}
    for name, (register, low) in tries.parts.items():
        words[register] = words.get(register, 0) | int(values[name]) << low
    return tuple((register, Fraction(word)) for register, word in words.items() if register not in values)


def _missing(values: Values, full: list[Situation], every: list[Situation], meaning: Meaning) -> list[Situation]:
    """Return a situation for each value that no full one has: one where this value makes a difference, if it can."""
    covered = {pair for situation in full for pair in situation.values}
    wanted = [(name, value) for name, listed in values.items() for value in listed if (name, value) not in covered]
    if not wanted:
        return []
    meanings = {situation: meaning(situation.known) for situation in every}
    found: dict[Situation, None] = {}
    for name, value in wanted:
        differ: dict[object, set[object]] = {}
        for situation, meant in meanings.items():
            differ.setdefault(_without(situation, name), set()).add(meant)
        having = [situation for situation in every if (name, value) in situation.values]
        best = max(having, key=lambda situation: len(differ[_without(situation, name)]), default=None)
        if best is not None:
            found[replace(best, full=False)] = None
    return list(found)


def _without(situation: Situation, name: str) -> object:
    others = tuple(pair for pair in situation.values if pair[0] != name and pair[0] not in situation.words)
    return others, situation.codes, situation.facts


def _index(cases: Cases[T], known: Surroundings) -> int:
    return next((index for index, case in enumerate(cases) if holds(case.when, known)), -1)


def _special_factor(register: Register, known: Surroundings) -> object:
    conversion = choose(register.special_scale, known)
    return conversion and decimal_factor(conversion.decimals, known)


def _signature(register: Register, known: Surroundings) -> object:
    conversion = choose(register.scale, known)
    limits_now = choose(register.range, known) if register.access.writable else None
    return (
        _index(register.scale, known),
        conversion and decimal_factor(conversion.decimals, known),
        _special_factor(register, known),
        _index(register.range, known) if register.access.writable else 0,
        limits_now and decimal_factor(limits_now.decimals, known),
        _increment(register, conversion, known),
    )


def _increment(register: Register, conversion: Conversion | None, known: Surroundings) -> object:
    """Return what tells how fine a value may be written."""
    if conversion is None or conversion.step is None or not register.access.writable:
        return conversion and conversion.step
    factor = decimal_factor(conversion.places, known)
    return factor and conversion.step / factor


def _meaning(register: Register, known: Surroundings) -> object:
    """Return the scale and the limits as numbers: two cases that say the same are the same."""
    conversion = choose(register.scale, known)
    factor = conversion and decimal_factor(conversion.decimals, known)
    increment = _increment(register, conversion, known)
    scale = (conversion.multiply / factor, conversion.add / factor, increment) if conversion and factor else None
    limits_now = choose(register.range, known) if register.access.writable else None
    limits = limits_now and limits_now.intervals, limits_now and decimal_factor(limits_now.decimals, known)
    return scale, limits, _special_factor(register, known)


def _with_limits(register: Register, situation: Situation) -> Situation:
    """Give a value to each limit that is a register and has none yet: such that the range is not empty."""
    known = situation.known
    conversion = choose(register.scale, known)
    limits_now = choose(register.range, known) if register.access.writable else None
    factor = conversion and decimal_factor(conversion.decimals, known)
    if limits_now is None or register.kind is Kind.STRING:
        return situation
    if conversion is None or not factor:  # nothing can be written then, whatever the limits
        conversion, factor = IDENTITY, Fraction(1)
    ends = sorted((conversion.multiply * stored + conversion.add) / factor for stored in (LOW_STORED, HIGH_STORED))
    values = dict(situation.values)
    for interval in limits_now.intervals:
        low, high = _ends(interval, ends[0], ends[1], decimal_factor(limits_now.decimals, known) or Fraction(1))
        for limit, value in ((interval.low, low), (interval.high, high)):
            if isinstance(limit, Reference):
                values.setdefault(limit.register, value)
    return replace(situation, values=tuple(values.items()))


def _ends(interval: Interval, low: Fraction, high: Fraction, factor: Fraction) -> tuple[Fraction, Fraction]:
    width = high - low
    if isinstance(interval.low, Number) and interval.low.value / factor >= high:
        high = interval.low.value / factor + width
    if isinstance(interval.high, Number) and interval.high.value / factor <= low:
        low = interval.high.value / factor - width
    return low, high
