"""Situations in which a register is tried: each case of its scale and range, each word order, each decimals."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import chain, islice

from regscribe.emit.vectors.present_scale import cases_of, limit_values
from regscribe.emit.vectors.tried_values import Dependencies, TriedValues, Values, dependencies_of, tried_values
from regscribe.model import Condition, Model, Register, RegisterMap, View
from regscribe.reference import Surroundings, holds, present_view, word_order
from regscribe.reference.states import combinations
from regscribe_runtime.values.versions import version_of_key

GIVEN = "given."
MOST_COMBINATIONS = 20_000
"""Enough for every combination of six registers with five values each; more would only repeat what was tried."""


@dataclass(frozen=True, slots=True)
class Situation:
    """Values of other registers and givens. Not `full`: it differs from another situation in the codes only.

    `parts` are the names in `values` that are a field of a register; `words` those of such registers. `choices` are
    givens, `versions` registers of texts, whose values are keys of versions.
    """

    values: tuple[tuple[str, Fraction], ...] = ()
    codes: tuple[tuple[str, frozenset[Fraction]], ...] = ()
    facts: tuple[tuple[str, bool], ...] = ()
    parts: tuple[str, ...] = ()
    words: tuple[str, ...] = ()
    full: bool = True
    choices: tuple[tuple[str, str], ...] = ()
    versions: tuple[str, ...] = ()

    @property
    def state(self) -> dict[str, Fraction]:
        """The values of whole registers, as a driver takes them."""
        left_out = (*self.parts, *self.versions)
        return {name: value for name, value in self.values if name not in left_out and not name.startswith(GIVEN)}

    @property
    def texts(self) -> dict[str, str]:
        """The texts of registers, as a driver takes them."""
        return {name: f"v{version_of_key(int(value))}" for name, value in self.values if name in self.versions}

    @property
    def numbers(self) -> dict[str, Fraction]:
        """The numbers that are given, by id."""
        return {name.removeprefix(GIVEN): value for name, value in self.values if name.startswith(GIVEN)}

    @property
    def known(self) -> Surroundings:
        """The situation as the reference takes it."""
        texts = self.texts | {f"{GIVEN}{name}": choice for name, choice in self.choices}
        return Surroundings(dict(self.values), dict(self.codes), dict(self.facts), self.numbers, texts)


class Finder:
    """Finds situations, once for registers that depend on the same things in the same way."""

    def __init__(self, register_map: RegisterMap) -> None:
        self._map = register_map
        self._known: dict[object, tuple[Situation, ...]] = {}

    def situations(self, model: Model, register: Register, view: View) -> tuple[Situation, ...]:
        """Return the situations in which `view` must be tried.

        Full ones: each combination of a case of the scale, a case of the range and their decimals, and each word order;
        besides, one for each code that decides between the cases.
        """
        tried = tried_values(self._map, model, dependencies_of(register, view))
        asked = tuple(tried.values.items()), tuple(tried.givens.items()), tuple(tried.parts.items())
        ranges = register.range if register.access.writable else ()
        cases = (register.scale, register.special_scale, ranges, register.valid, register.sentinels, register.partial)
        key = (register.when, *cases, register.kind, view.order, view.byte_order, view.times, view.words, asked)
        if key not in self._known:
            self._known[key] = _situations(tried, register, view)
        return self._known[key]


def _situations(tried: TriedValues, register: Register, view: View) -> tuple[Situation, ...]:
    first: dict[object, Situation] = {}
    meanings: dict[Situation, object] = {}
    for situation in _combinations(tried):
        known = situation.known
        if not holds(register.when, known):
            continue
        cases = cases_of(register, known)
        meanings[situation] = (cases.partial, cases.numbers)
        first.setdefault((cases, present_view(view, known)), situation)
        first.setdefault(word_order(view, known), situation)
    full = list(dict.fromkeys(first.values()))
    found = [*full, *_missing(tried.values, full, meanings)]
    return tuple(_with_limits(register, situation) for situation in found)


def writable_situations(
    register_map: RegisterMap, model: Model, register: Register
) -> tuple[tuple[Situation, bool], ...]:
    """Return one situation for each code that decides whether a write is accepted, and whether it is."""
    return _both_sides(register_map, model, register.writable.when) if register.writable else ()


def existence_situations(
    register_map: RegisterMap, model: Model, register: Register
) -> tuple[tuple[Situation, bool], ...]:
    """Return one situation for each code that decides whether a register exists, and whether it does."""
    return both_sides(register_map, model, register.when)


def both_sides(register_map: RegisterMap, model: Model, condition: Condition) -> tuple[tuple[Situation, bool], ...]:
    """Return one situation for each code that decides whether a condition holds, and whether it does."""
    return () if condition.always else _both_sides(register_map, model, condition)


def _both_sides(register_map: RegisterMap, model: Model, condition: Condition) -> tuple[tuple[Situation, bool], ...]:
    tried = tried_values(register_map, model, Dependencies((condition,)))
    meanings = {situation: holds(condition, situation.known) for situation in _combinations(tried)}
    full = list({allowed: situation for situation, allowed in reversed(meanings.items())}.values())
    found = [*full, *_missing(tried.values, full, meanings)]
    return tuple((situation, holds(condition, situation.known)) for situation in found)


def _combinations(tried: TriedValues) -> list[Situation]:
    """Return the combinations of all values to try, at most MOST_COMBINATIONS."""
    every = ((values, givens) for values in combinations(tried.values) for givens in combinations(tried.givens))
    parts, words = tuple(tried.parts), tuple(register for register, _ in tried.parts.values())
    return [
        Situation(
            (*values.items(), *_words(tried, values)),
            tuple((name, codes) for name, codes in givens.items() if isinstance(codes, frozenset)),
            tuple((name, fact) for name, fact in givens.items() if isinstance(fact, bool)),
            parts,
            words,
            choices=tuple((name, choice) for name, choice in givens.items() if isinstance(choice, str)),
            versions=tried.versions,
        )
        for values, givens in islice(every, MOST_COMBINATIONS)
    ]


def _words(tried: TriedValues, values: dict[str, Fraction]) -> tuple[tuple[str, Fraction], ...]:
    """Combine fields to the words that they are parts of."""
    words: dict[str, int] = {}
    for name, (register, low) in tried.parts.items():
        words[register] = words.get(register, 0) | int(values[name]) << low
    return tuple((register, Fraction(word)) for register, word in words.items() if register not in values)


def _missing(values: Values, full: list[Situation], meanings: Mapping[Situation, object]) -> list[Situation]:
    """Return a situation for each value that no full one has: one where this value makes a difference, if it can."""
    covered = set(chain.from_iterable(situation.values for situation in full))
    found: dict[Situation, None] = {}
    for name, listed in values.items():
        uncovered = [(name, value) for value in listed if (name, value) not in covered]
        effects = _effects(name, meanings) if uncovered else {}
        for pair in uncovered:
            having = [situation for situation in meanings if pair in situation.values]
            if having:
                found[replace(max(having, key=effects.__getitem__), full=False)] = None
    return list(found)


def _effects(name: str, meanings: Mapping[Situation, object]) -> dict[Situation, int]:
    """Count the different meanings that each situation can take by a change of `name` alone."""
    found: dict[object, set[object]] = {}
    for situation, meant in meanings.items():
        found.setdefault(_without(situation, name), set()).add(meant)
    return {situation: len(found[_without(situation, name)]) for situation in meanings}


def _without(situation: Situation, name: str) -> object:
    others = tuple(pair for pair in situation.values if pair[0] != name and pair[0] not in situation.words)
    return others, situation.codes, situation.facts, situation.choices


def _with_limits(register: Register, situation: Situation) -> Situation:
    """Give a value to each limit that is a register and has none yet."""
    known = situation.known
    missing = ((name, value) for name, value in limit_values(register, known).items() if name not in known.values)
    return replace(situation, values=(*situation.values, *missing))
