"""A number computed from the values of several registers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from regscribe_runtime.errors import NotDecodable, RegscribeError
from regscribe_runtime.operations.read import read_many
from regscribe_runtime.operations.session import Operation, Session, Task
from regscribe_runtime.registers.enums import Choice, SpecialNumber
from regscribe_runtime.values.terms import Term, UnsettledError, registers_in, resolve


def compute(name: str, term: Term) -> Task[float]:
    """Read the registers of a term in one snapshot and compute it; `name` is for the error."""

    def task(session: Session) -> Operation[float]:
        registers = [session.registers[path] for path in registers_in(term)]
        found = yield from read_many(registers)(session)
        state = {path: _number(name, path, value) for path, value in found.entries.items()}
        return computed(name, term, state, session.givens)

    return task


def computed(name: str, term: Term, state: Mapping[str, Any], givens: Mapping[str, Any]) -> float:
    """The number of a term; NotDecodable where it has none."""
    try:
        return float(resolve(term, state, givens))
    except (UnsettledError, OverflowError) as error:
        raise NotDecodable(name, str(error)) from None


def _number(name: str, path: str, value: Any) -> Any:
    if isinstance(value, RegscribeError):
        raise NotDecodable(name, f"it is computed from {path}: {value}") from value
    if isinstance(value, Choice | SpecialNumber):
        raise NotDecodable(name, f"it is computed from {path}, which is {value!s}")
    return value
