"""Numbers that follow from several registers, from the words that each of these holds."""

from dataclasses import dataclass, field, replace
from fractions import Fraction

from regscribe.model import Computed, Register
from regscribe.reference.codec import decode, special_value
from regscribe.reference.limits import limits, within
from regscribe.reference.outcome import (
    NOT_DECODABLE,
    NOT_PRESENT,
    OUT_OF_RANGE,
    Meaning,
    Reading,
    RefusedError,
    UnknownValueError,
)
from regscribe.reference.surroundings import Surroundings, choose, holds
from regscribe.reference.terms import amount
from regscribe_runtime.values.conditions import Condition
from regscribe_runtime.values.terms import Ref, parts_of


@dataclass(frozen=True, slots=True)
class Held:
    """What registers hold: `known` values, the paths that are `absent`, and of those with a code or a special value."""

    known: Surroundings
    absent: frozenset[str] = field(default_factory=frozenset)
    coded: frozenset[str] = field(default_factory=frozenset)

    def take(self, register: Register, words: tuple[int, ...]) -> "Held":
        """Return what is known once a register is read in its base view, behind those that decide what it means."""
        value = self.read(register, words).value
        if _without(register.when, self) is NOT_PRESENT:
            return replace(self, absent=self.absent | {register.path})
        if isinstance(value, str):
            return replace(self, known=replace(self.known, texts={**self.known.texts, register.path: value}))
        if value is None:
            return self
        values = {**self.known.values, **_parts(register, value), register.path: value}
        coded = {register.path} if self._is_coded(register, value) else set[str]()
        return replace(self, known=replace(self.known, values=values), coded=self.coded | coded)

    def read(self, register: Register, words: tuple[int, ...]) -> Reading:
        """Return what the words of a register's base view mean here."""
        try:
            return _without(register.when, self) or decode(register, register.base, words, self.known)
        except (UnknownValueError, RefusedError):
            return NOT_DECODABLE

    def _is_coded(self, register: Register, value: Fraction) -> bool:
        names = (special for special in register.specials if special.means is None)
        return register.enum is not None or any(special_value(register, one, self.known) == value for one in names)


def compute(one: Computed, held: Held) -> Reading:
    """Return what a computed value is: a number, absent, outside what is valid, or none.

    Codes and special values are not computed with, wherever in the term or in a limit they stand.
    """
    numbers = {part.register for part in parts_of((one.term, one.valid)) if isinstance(part, Ref)}
    try:
        without = _without(one.when, held)
        return without or (NOT_DECODABLE if numbers & held.coded else _number(one, held.known))
    except (UnknownValueError, RefusedError):
        return NOT_DECODABLE


def _number(one: Computed, known: Surroundings) -> Reading:
    found, valid = amount(one.term, known), choose(one.valid, known)
    if found is None:
        return NOT_DECODABLE
    is_valid = valid is None or within(limits(valid, known), found)
    return Reading(Meaning.VALUE, found) if is_valid else OUT_OF_RANGE


def _without(when: Condition, held: Held) -> Reading | None:
    """Return that a thing does not exist, or that nobody knows; None if it exists.

    What depends on a register that does not exist does not exist either.
    """
    try:
        return None if holds(when, held.known) else NOT_PRESENT
    except UnknownValueError:
        return NOT_PRESENT if held.absent.intersection(when.registers) else NOT_DECODABLE


def _parts(register: Register, value: Fraction) -> dict[str, Fraction]:
    if not register.fields:
        return {}
    word = int(value)
    parts = {bits.id: word >> bits.low & ((1 << bits.width) - 1) for bits in register.fields}
    return {f"{register.path}.{name}": Fraction(part) for name, part in parts.items()}
