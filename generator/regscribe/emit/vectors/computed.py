"""The vectors of computed values: words of the registers that they follow from, one changed after the other."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from itertools import chain, combinations, islice, product
from typing import Any

from regscribe.emit.vectors import octet_vectors
from regscribe.emit.vectors.candidates import bits_of, wire_bits
from regscribe.emit.vectors.scale import scale_now
from regscribe.emit.vectors.vector_sets import once_for_models
from regscribe.emit.words import one_line, term_words
from regscribe.model import Computed, Given, GivenKind, Model, Register, RegisterMap, show
from regscribe.reference import AS_IS, Held, Meaning, compute, present_view, surroundings_of, word_order, words_of_bits
from regscribe.reference.givens import Stated
from regscribe_runtime.values.terms import givens_in, registers_in

Json = dict[str, Any]
Words = tuple[int, ...]
State = Mapping[str, Any]
"""The words of registers by path, and what is given by id."""

FIRST_NUMBER, NEXT_NUMBER = 10, 3
"""The stored number of the first register, and how much more each further one holds, so that none is like another."""
FIRST_WORDS, LAST_WORDS = 6, 12
"""How many of the words worth trying are tried: those of the type stand first, those that the map names last."""
MOST_STATES = 2000
"""Most states among which one is looked for in which there is a value."""


def computed_values(register_map: RegisterMap) -> list[Json]:
    """Return an entry for each computed value of the models."""
    found = ((model.name, _entry(register_map, model, one)) for model in register_map.models for one in model.computed)
    return once_for_models(found, "id")


def _entry(register_map: RegisterMap, model: Model, one: Computed) -> Json:
    found: Json = {"id": one.id, "follows_from": one_line(term_words(one.term))}
    found |= {"unit": one.unit} if one.unit else {}
    return found | {"cases": list(_Trials.of(register_map, model, one).cases())}


@dataclass(frozen=True, slots=True)
class _Trials:
    """What is tried of a computed value: its registers, those that decide first, and by name of each, words with notes.

    So are the givens: what may be given, with a note.
    """

    one: Computed
    map: RegisterMap
    registers: tuple[Register, ...]
    tried: Mapping[str, Mapping[Any, str]]

    @classmethod
    def of(cls, register_map: RegisterMap, model: Model, one: Computed) -> "_Trials":
        gathered: dict[str, Register] = {}
        for path in registers_in(one.term, one.valid, one.when):
            _gather(model, path, gathered)
        registers = tuple(gathered.values())
        asked = givens_in(one.term, one.valid, one.when, *map(_deciding, registers))
        givens = {given.id: _givens(given) for given in register_map.givens if given.id in asked}
        held = Held(surroundings_of(register_map, {name: next(iter(several)) for name, several in givens.items()}))
        tried: dict[str, Mapping[Any, str]] = {}
        for place, register in enumerate(registers):
            tried[register.path] = words = _words(register, held, Fraction(FIRST_NUMBER + NEXT_NUMBER * place))
            held = held.take(register, next(iter(words)))
        return cls(one, register_map, registers, tried | givens)

    def cases(self) -> Iterator[Json]:
        """Yield a case with a value if there is one, and one for each other word of a register."""
        first = next((state for state in islice(self._near(), MOST_STATES) if "value" in self._outcome(state)), None)
        state = first or next(self._near())
        yield {**self._case(state), "note": "ordinary"}
        for name, several in self.tried.items():
            for value, note in several.items():
                if value != state[name]:
                    yield {**self._case({**state, name: value}), "note": f"{name}: {note}"}

    def _near(self) -> Iterator[State]:
        """Yield the first state of all, and those that differ from it in one or two things."""
        first = {name: next(iter(several)) for name, several in self.tried.items()}
        changed = chain(((name,) for name in self.tried), combinations(self.tried, 2))
        yield first
        for names in changed:
            yield from (
                first | dict(zip(names, values, strict=True)) for values in product(*(self.tried[one] for one in names))
            )

    def _case(self, state: State) -> Json:
        words = [{"register": one.path, "words": list(state[one.path])} for one in self.registers]
        givens = {given.id: _shown(state[given.id]) for given in self.map.givens if given.id in state}
        return {"words": words, **({"givens": givens} if givens else {}), **self._outcome(state)}

    def _outcome(self, state: State) -> Json:
        given = {one.id: state[one.id] for one in self.map.givens if one.id in state}
        held = Held(surroundings_of(self.map, given))
        for register in self.registers:
            held = held.take(register, state[register.path])
        reading = compute(self.one, held)
        return (
            {"value": show(Fraction(reading.value))}
            if reading.value is not None
            else {"outcome": reading.meaning.value}
        )


def _gather(model: Model, path: str, found: dict[str, Register]) -> None:
    """Add a register behind those that decide what its words mean."""
    register = model.register(path)
    if register.path in found:
        return
    for needed in (*registers_in(_deciding(register)), *register.base.needs()):
        _gather(model, needed, found)
    found[register.path] = register


def _deciding(register: Register) -> tuple[Any, ...]:
    """What decides whether a register exists, and what its words mean."""
    scales = (register.scale, register.special_scale, register.base.times)
    return (register.when, *scales, register.sentinels, register.valid, register.partial)


def _words(register: Register, held: Held, ordinary: Fraction) -> dict[Words, str]:
    """The words to try of a register with notes; those of an ordinary value stand first, if there are any."""
    view, order = present_view(register.base, held.known) or register.base, word_order(register.base, held.known)
    if view.type.is_octets:
        found = octet_vectors.words(register, view, order or AS_IS)
    else:
        scale = scale_now(register, view, held.known)
        bits = wire_bits(register, view, scale, held.known, full=True)
        number = bits_of(view, ordinary * view.factor)
        several = list((({} if number is None else {number: "ordinary"}) | bits).items())
        several = [*several[:FIRST_WORDS], *several[FIRST_WORDS:][-LAST_WORDS:]]
        found = {words_of_bits(view, pattern, order or AS_IS): note for pattern, note in several}
    usual = [words for words in found if held.read(register, words).meaning is Meaning.VALUE]
    return {words: found[words] for words in (*usual[:1], *found)}


def _givens(given: Given) -> dict[Stated, str]:
    """What to try of a given."""
    if given.kind is GivenKind.BOOLEAN:
        return {True: "given", False: "not given"}
    if given.kind is GivenKind.CODES:
        return {frozenset({Fraction(0), Fraction(1)}): "two codes", frozenset(): "no codes"}
    if given.kind is GivenKind.CHOICE:
        return {choice: choice for choice in given.choices}
    default = given.default if isinstance(given.default, Fraction) else None
    ends = (default, given.low, given.high, *([Fraction(2)] if default is given.low is given.high else ()))
    return {number: show(number) for number in ends if number is not None}


def _shown(stated: Stated) -> Any:  # noqa: ANN401 (as JSON has it)
    if isinstance(stated, frozenset):
        return [show(code) for code in sorted(stated)]
    return stated if isinstance(stated, bool | str) else show(stated)
