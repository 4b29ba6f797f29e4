"""A number computed from the values of several registers."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from typing import Any, NoReturn, Protocol

from regscribe_runtime.errors import NotDecodable, OutOfRange, RegscribeError
from regscribe_runtime.operations.read import read_many
from regscribe_runtime.operations.session import Operation, Session, Task
from regscribe_runtime.registers.codec import interval_ends, outside
from regscribe_runtime.registers.enums import Choice, SpecialNumber
from regscribe_runtime.registers.presence import absence
from regscribe_runtime.values.conditions import Cases, Condition
from regscribe_runtime.values.scales import Range
from regscribe_runtime.values.terms import Ref, Term, UnsettledError, parts_of, resolve


class Computable(Protocol):
    """How a number follows from registers: while `when` holds, and valid within `valid`."""

    path: str
    term: Term
    valid: Cases[Range]
    when: Condition

    @property
    @abstractmethod
    def needs(self) -> tuple[str, ...]:
        """The paths of the registers that it follows from."""


def compute(wanted: Computable) -> Task[float]:
    """Read the registers of a term in one snapshot and compute it."""

    def task(session: Session) -> Operation[float]:
        found = yield from read_many([session.registers[path] for path in wanted.needs])(session)
        return computed(wanted, found.entries, session.givens)

    return task


def computed(wanted: Computable, entries: Mapping[str, Any], givens: Mapping[str, Any]) -> float:
    """The number of a term over values and errors by path.

    NotPresent while it does not exist, NotDecodable where it has no number, OutOfRange where that is not valid.
    """
    values = {path: value for path, value in entries.items() if not isinstance(value, RegscribeError)}
    errors = {path: value for path, value in entries.items() if isinstance(value, RegscribeError)}
    gone = absence(wanted.path, wanted.when, values, givens, errors)
    if gone:
        raise gone
    state = _Numbers(wanted.path, entries)
    _check_numbers(wanted, values)
    try:
        amount = resolve(wanted.term, state, givens)
        number = float(amount)
    except (UnsettledError, OverflowError) as error:
        raise NotDecodable(wanted.path, str(error)) from None
    ends = interval_ends(wanted.path, wanted.valid, state, givens)
    if ends is not None and (why := outside(ends, amount)):
        raise OutOfRange(wanted.path, why)
    return number


class _Numbers(dict[str, Any]):
    """The values of registers; looking up one that has none raises NotDecodable for what is computed."""

    def __init__(self, name: str, entries: Mapping[str, Any]) -> None:
        super().__init__({path: value for path, value in entries.items() if not isinstance(value, RegscribeError)})
        self._name, self._entries = name, entries

    def __missing__(self, path: str) -> NoReturn:
        error = self._entries[path]
        raise NotDecodable(self._name, f"it is computed from {path}: {error}") from error


def _check_numbers(wanted: Computable, values: Mapping[str, Any]) -> None:
    """Refuse codes and special values where a number is computed with; conditions may ask for them."""
    for path in (part.register for part in parts_of((wanted.term, wanted.valid)) if isinstance(part, Ref)):
        value = values.get(path)
        if isinstance(value, Choice | SpecialNumber):
            raise NotDecodable(wanted.path, f"it is computed from {path}, which is {value!s}")
