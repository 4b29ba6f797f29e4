"""What holds in a worked example: what it says, else the defaults; and which of these it really depends on."""

from fractions import Fraction
from typing import Any

from regscribe.model import GivenKind, RegisterMap, show
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
        defaults = {one.path: number_of(one, one.default) for one in registers}
        values = {path: number for path, number in defaults.items() if number is not None}
        values |= self._said | self._writes
        self._parts: dict[str, str] = {}
        for register in registers:
            for bits in register.fields if register.path in values else ():
                self._parts[f"{register.path}.{bits.id}"] = register.path
                part = int(values[register.path]) >> bits.low & ((1 << bits.width) - 1)
                values.setdefault(f"{register.path}.{bits.id}", Fraction(part))
        self._values = _Asked(values)
        codes = [given.id for given in register_map.givens if given.kind is GivenKind.CODES]
        self._codes = {name: frozenset({values[name]} if name in values else ()) for name in codes}
        facts = [given.id for given in register_map.givens if given.kind is GivenKind.BOOLEAN]
        self._facts = {name: bool(values.get(name, 0)) for name in facts}
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
