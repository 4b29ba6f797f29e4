"""In which surroundings a register must be tried: every case of its scale and range, every order, every decimals."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import islice, product

from regscribe.emit.vectors.subject import GivenTry, Questions, Tries, Values, questions_of, tries_of
from regscribe.model import Interval, Kind, Model, Number, Reference, Register, RegisterMap, View
from regscribe.model.condition import Cases, T
from regscribe.model.reference import Surroundings, choose, decimal_factor, holds, word_order

MOST_COMBINATIONS = 20_000
"""Enough for every combination of six registers with five values each; more would only repeat what was tried."""

LOW_STORED, HIGH_STORED = Fraction(100), Fraction(1500)
"""Where limits that stand in other registers are put: stored numbers that every type of 16 bits and more can hold."""


@dataclass(frozen=True, slots=True)
class Situation:
    """What is known beside the register itself. Not `full`: it differs from another one only in the codes.

    `parts` are the names in `values` that are a field of a register which stands there too.
    """

    values: tuple[tuple[str, Fraction], ...] = ()
    codes: tuple[tuple[str, frozenset[Fraction]], ...] = ()
    facts: tuple[tuple[str, bool], ...] = ()
    parts: tuple[str, ...] = ()
    full: bool = True

    @property
    def state(self) -> dict[str, Fraction]:
        """The values of whole registers, as a driver takes them."""
        return {name: value for name, value in self.values if name not in self.parts}

    @property
    def known(self) -> Surroundings:
        """The same as the reference wants it."""
        return Surroundings(dict(self.values), dict(self.codes), dict(self.facts))


def situations(register_map: RegisterMap, model: Model, register: Register, view: View) -> tuple[Situation, ...]:
    """Return the situations in which `view` must be tried.

    Full ones: each combination of a case of the scale, a case of the range and their decimals, and each word order;
    besides, one for each code that decides between the cases.
    """
    tries = tries_of(register_map, model, questions_of(register, view))
    seen: dict[object, Situation] = {}
    every: list[Situation] = list(islice(_combinations(tries), MOST_COMBINATIONS))
    for situation in every:
        known = situation.known
        seen.setdefault(_signature(register, known), situation)
        if view.words > 1:
            seen.setdefault(word_order(view, known), situation)
    full = list(dict.fromkeys(seen.values()))
    found = [*full, *_missing(tries.values, full, every)]
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
    found = [*seen.values(), *_missing(tries.values, list(seen.values()), every)]
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
        )


def _words(tries: Tries, values: dict[str, Fraction]) -> tuple[tuple[str, Fraction], ...]:
    """Put fields together to the words that they are parts of."""
    words: dict[str, int] = {}
    for name, (register, low) in tries.parts.items():
        words[register] = words.get(register, 0) | int(values[name]) << low
    return tuple((register, Fraction(word)) for register, word in words.items() if register not in values)


def _missing(values: Values, full: list[Situation], every: list[Situation]) -> list[Situation]:
    covered = {pair for situation in full for pair in situation.values}
    wanted = [(name, value) for name, listed in values.items() for value in listed if (name, value) not in covered]
    found: list[Situation] = []
    for pair in wanted:
        if pair in covered:
            continue
        situation = next((other for other in every if pair in other.values), None)
        if situation is not None:
            found.append(replace(situation, full=False))
            covered |= set(situation.values)
    return found


def _index(cases: Cases[T], known: Surroundings) -> int:
    return next((index for index, case in enumerate(cases) if holds(case.when, known)), -1)


def _signature(register: Register, known: Surroundings) -> object:
    conversion = choose(register.scale, known)
    limits_now = choose(register.range, known) if register.access.writable else None
    return (
        _index(register.scale, known),
        conversion and decimal_factor(conversion.decimals, known),
        _index(register.range, known) if register.access.writable else 0,
        limits_now and decimal_factor(limits_now.decimals, known),
    )


def _with_limits(register: Register, situation: Situation) -> Situation:
    """Give a value to each limit that is a register and has none yet: such that the range is not empty."""
    known = situation.known
    conversion = choose(register.scale, known)
    limits_now = choose(register.range, known) if register.access.writable else None
    factor = conversion and decimal_factor(conversion.decimals, known)
    if conversion is None or limits_now is None or not factor or register.kind is Kind.STRING:
        return situation
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
