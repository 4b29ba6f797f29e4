"""What holds in a worked example: what it says, else the defaults; and which of these it really depends on."""

from collections.abc import Iterable
from fractions import Fraction
from typing import Any

from regscribe.model import BitField, GivenKind, Register, RegisterMap, show
from regscribe.reference import Surroundings, number_of

Json = dict[str, Any]
Pairs = tuple[tuple[str, Fraction], ...]


class _Asked(dict[str, Fraction]):
    """Values that note which of them were asked for."""

    def __init__(self, values: dict[str, Fraction]) -> None:
        super().__init__(values)
        self.asked: dict[str, None] = {}

    def __getitem__(self, name: str) -> Fraction:
        self.asked[name] = None
        return super().__getitem__(name)


class Assumed:
    """The surroundings of an example; after the reference has worked with them, `told` says what mattered.

    An example may name a given: then that is the one code which counts (a boolean: true unless 0).
    """

    def __init__(self, register_map: RegisterMap, model: str, said: Pairs, writes: Pairs = ()) -> None:
        registers = register_map.model(model).registers
        self._said, self._writes = dict(said), dict(writes)
        values = _defaults(registers) | self._said | self._writes
        self._parts = {_part(register, bits): register.path for register in registers for bits in register.fields}
        self._values = _Asked(_fields(registers, values) | values)
        codes = _ids(register_map, GivenKind.CODES)
        self._codes = {name: frozenset({values[name]} if name in values else ()) for name in codes}
        self._facts = {name: bool(values.get(name, 0)) for name in _ids(register_map, GivenKind.BOOLEAN)}
        self.surroundings = Surroundings(self._values, self._codes, self._facts)

    def told(self) -> Json:
        """Return `state` as the example says it, `assumed` for defaults that mattered, and `givens`."""
        givens: Json = {name: [show(code) for code in sorted(codes)] for name, codes in self._codes.items()}
        givens |= self._facts
        asked = dict.fromkeys(self._parts.get(name, name) for name in self._values.asked)
        known = {**self._said, **self._writes}
        state = {name: show(value) for name, value in self._said.items() if name not in givens}
        assumed = {name: show(dict.get(self._values, name, Fraction(0))) for name in asked if name not in known}
        found = {"state": state, "assumed": assumed, "givens": givens}
        return {key: value for key, value in found.items() if value}


def _defaults(registers: Iterable[Register]) -> dict[str, Fraction]:
    defaults = ((one.path, number_of(one, one.default)) for one in registers)
    return {path: number for path, number in defaults if number is not None}


def _fields(registers: Iterable[Register], values: dict[str, Fraction]) -> dict[str, Fraction]:
    """Return the fields of all registers that have a value."""
    return {
        _part(register, bits): Fraction(int(values[register.path]) >> bits.low & ((1 << bits.width) - 1))
        for register in registers
        if register.path in values
        for bits in register.fields
    }


def _part(register: Register, bits: BitField) -> str:
    return f"{register.path}.{bits.id}"


def _ids(register_map: RegisterMap, kind: GivenKind) -> list[str]:
    return [given.id for given in register_map.givens if given.kind is kind]
