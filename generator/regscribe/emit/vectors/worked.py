"""The manual's worked examples as vectors: values beside words, and frames."""

from fractions import Fraction
from typing import Any

from regscribe.emit.vectors.scale import scale_now
from regscribe.model import FrameExample, GivenKind, Outcome, Register, RegisterMap, ValueExample, View, show
from regscribe.reference import RefusedError, UnknownValueError, decode, encode, number_of, present_view

Json = dict[str, Any]
Pairs = tuple[tuple[str, Fraction], ...]


def worked_examples(register_map: RegisterMap) -> list[Json]:
    """Return the examples of the manual in its order; timings are no vectors."""
    found = []
    for example in register_map.examples:
        if isinstance(example, ValueExample):
            found.append(_value(register_map, example))
        elif isinstance(example, FrameExample):
            found.append(_frame(register_map, example))
    return found


def _place(register_map: RegisterMap, model: str, path: str, name: str) -> tuple[Register, View]:
    register = register_map.model(model).register(path)
    return register, next((view for view in register.views if view.name == name), register.base)


def _value(register_map: RegisterMap, example: ValueExample) -> Json:
    register, view = _place(register_map, example.model, example.register, example.view)
    words = tuple(word & 0xFFFF for word in example.words)
    known = _ExampleState(register_map, example.model, example.state)
    encodes = False
    try:
        seen = present_view(view, known) or view
        scale_now(register, seen, known)  # asks also where a fault or a clipped view decides first
        decode(register, view, words, known)
        if isinstance(example.value, Fraction) and not example.lossy and register.access.writable:
            encodes = encode(register, view, example.value, known) == words
    except (RefusedError, UnknownValueError):
        encodes = False  # a limit or a condition that the example leaves open
    found: Json = {"source": example.source, "model": example.model, "register": example.register, "view": view.name}
    found |= {"words": list(words), **known.as_json(), **_outcome(example)}
    return found | ({"encodes": True} if encodes else {})


def _outcome(example: ValueExample) -> Json:
    if example.outcome is Outcome.FAULT:
        return {"fault": str(example.value)}
    found: Json = {} if example.stored is None else {"stored": show(example.stored)}
    if example.outcome is Outcome.SATURATED:
        return {**found, "outcome": "saturated"}
    if example.value is not None:
        found["value"] = show(example.value) if isinstance(example.value, Fraction) else example.value
    if example.flags is not None:
        found["flags"] = list(example.flags)
    return found


def _frame(register_map: RegisterMap, example: FrameExample) -> Json:
    known = _ExampleState(register_map, example.model, example.state, example.writes)
    places = ((_place(register_map, example.model, path, example.view), value) for path, value in example.writes)
    try:
        encodes = bool([encode(register, view, value, known) for (register, view), value in places])
    except (RefusedError, UnknownValueError):
        encodes = False
    found: Json = {"source": example.source, "model": example.model, "frame": example.frame.hex(" ").upper()}
    found |= {"crc": example.crc, "answer": example.answer, "unit": example.unit, "function": example.function}
    found |= _request_facts(example) | (known.as_json() if example.writes else {})
    return found | ({"encodes": True} if encodes else {})


def _request_facts(example: FrameExample) -> Json:
    found: Json = {name: getattr(example, name) for name in ("address", "count") if getattr(example, name) is not None}
    if example.words is not None:
        found["words"] = [word & 0xFFFF for word in example.words]
    if example.writes:
        found["writes"] = {path: show(value) for path, value in example.writes}
    return found | {name: getattr(example, name) for name in ("view", "command") if getattr(example, name)}


class _ExampleState:
    """State of the device in an example, for the reference: what the example states, else the defaults.

    An example may name a given: then that is the only code of the given (a boolean: true unless 0). The values that
    the reference looks up are recorded.
    """

    def __init__(self, register_map: RegisterMap, model: str, stated: Pairs, writes: Pairs = ()) -> None:
        registers = register_map.model(model).registers
        self._stated, self._known = dict(stated), dict((*stated, *writes))
        defaults = ((register.path, number_of(register, register.default)) for register in registers)
        values = {path: default for path, default in defaults if default is not None} | self._known
        self._owners: dict[str, str] = {}
        fields: dict[str, Fraction] = {}
        for register in registers:
            for bits in register.fields:
                name = f"{register.path}.{bits.id}"
                self._owners[name] = register.path
                if register.path in values:
                    fields[name] = Fraction(int(values[register.path]) >> bits.low & ((1 << bits.width) - 1))
        self._values = fields | values
        self._read: dict[str, None] = {}
        self.codes: dict[str, frozenset[Fraction]] = {}
        self.facts: dict[str, bool] = {}
        self.numbers: dict[str, Fraction] = {}
        self.texts = {f"given.{given.id}": str(given.default) for given in register_map.givens if given.choices}
        for given in register_map.givens:
            if given.kind is GivenKind.NUMBER:
                self.numbers[given.id] = values.get(given.id, Fraction(given.default or 0))
            elif given.kind is GivenKind.CODES:
                self.codes[given.id] = frozenset({values[given.id]} if given.id in values else ())
            elif given.kind is GivenKind.BOOLEAN:
                self.facts[given.id] = bool(values.get(given.id, 0))

    def look_up(self, subject: str) -> Fraction:
        """Return the value of `subject`; raises UnknownValueError if there is none."""
        if subject not in self._values:
            raise UnknownValueError(subject)
        self._read[subject] = None
        return self._values[subject]

    def read(self, subject: str) -> str:
        """Return the text of `subject`; raises UnknownValueError if there is none."""
        if subject not in self.texts:
            raise UnknownValueError(subject)
        return self.texts[subject]

    def as_json(self) -> Json:
        """Return `state` as the example states it, `assumed` for defaults that were read so far, and `givens`."""
        givens: Json = {name: [show(code) for code in sorted(codes)] for name, codes in self.codes.items()}
        givens |= self.facts
        givens |= {name: show(number) for name, number in self.numbers.items()}
        read = dict.fromkeys(self._owners.get(name, name) for name in self._read)
        state = {name: show(value) for name, value in self._stated.items() if name not in givens}
        assumed = {name: show(self._values.get(name, Fraction(0))) for name in read if name not in self._known}
        found = {"state": state, "assumed": assumed, "givens": givens}
        return {key: value for key, value in found.items() if value}
