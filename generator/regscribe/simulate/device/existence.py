"""Whether what has a condition exists in the present state of a device."""

from collections.abc import Collection, Mapping
from dataclasses import replace
from fractions import Fraction
from typing import Protocol

from regscribe.model import AnyOf, BitField, Condition, Model, Register
from regscribe.reference import Known, UnknownValueError, holds
from regscribe.simulate.errors import SimulatorError

NEVER = Condition((AnyOf(()),))
"""The condition of what a device does not have."""


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


def leaving_out(model: Model, paths: Collection[str]) -> Model:
    """The model of a device without these registers; SimulatorError for one that the map does not call optional."""
    optional = [register.path for register in model.registers if register.mandatory is False]
    if strange := next((path for path in paths if path not in optional), ""):
        known = ", ".join(optional) or "none"
        message = f"{model.name} is never without {strange!r}: registers with `mandatory: false` are {known}"
        raise SimulatorError(message)
    registers = tuple(replace(one, when=NEVER) if one.path in paths else one for one in model.registers)
    return replace(model, registers=registers, by_path={}) if paths else model
