"""Whether what has a condition exists in the present state of a device."""

from collections.abc import Mapping
from fractions import Fraction
from typing import Protocol

from regscribe.model import BitField, Condition, Register
from regscribe.reference import Known, UnknownValueError, holds


class Present(Known, Protocol):
    """The present state of a device."""

    def find(self, path: str) -> tuple[Register, BitField | None]:
        """The register of a path, and the bit field if it names one."""
        raise NotImplementedError

    def exists(self, register: Register) -> bool:
        """Whether a register exists now."""
        raise NotImplementedError


def exists(condition: Condition, state: Present) -> bool:
    """Whether a condition holds; what asks a register that does not exist does not."""
    try:
        return holds(condition, _Existing(state))
    except UnknownValueError:
        return False


class _Existing:
    """A state without the values of registers that do not exist."""

    def __init__(self, state: Present) -> None:
        self._state = state

    @property
    def codes(self) -> Mapping[str, frozenset[Fraction]]:
        return self._state.codes

    @property
    def facts(self) -> Mapping[str, bool]:
        return self._state.facts

    @property
    def numbers(self) -> Mapping[str, Fraction]:
        return self._state.numbers

    def look_up(self, subject: str) -> Fraction:
        self._check(subject)
        return self._state.look_up(subject)

    def read(self, subject: str) -> str:
        if not subject.startswith("given."):
            self._check(subject)
        return self._state.read(subject)

    def _check(self, subject: str) -> None:
        register, _ = self._state.find(subject)
        if not self._state.exists(register):
            raise UnknownValueError(subject)
