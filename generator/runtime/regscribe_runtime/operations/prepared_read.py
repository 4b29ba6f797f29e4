"""The requests and decoders of a read of several registers under the present state.

Registers that the meaning of values depends on (decimals, input type, word order) are read in the same plan, behind
all values that depend on them. If they hold at the end what was known before the first request, they held it all the
time, so every value is decoded with the state under which it was sent.
"""

from collections.abc import Collection, Iterable, Mapping, Sequence
from contextlib import suppress
from typing import Any, TypeVar

from regscribe_runtime.errors import RegscribeError, ValueNotDecodable
from regscribe_runtime.operations.bisect import Words
from regscribe_runtime.operations.decode_block import Placed, PreparedBlock
from regscribe_runtime.operations.session import Session
from regscribe_runtime.planning.plan import Terms
from regscribe_runtime.planning.read_order import ReadOrder, WordPosition, lay_out
from regscribe_runtime.planning.read_places import place_of, read_places
from regscribe_runtime.registers import codec
from regscribe_runtime.registers.presence import absence
from regscribe_runtime.registers.register import Register
from regscribe_runtime.values.views import Readable, is_lasting, needs, read_view

MISSING = object()
"""In place of an unknown value."""


class PreparedRead:
    """The requests of one read and the decoders of the answers; made by `make_ready`.

    `entries` has the paths of all registers in their order, with the errors of absent ones and None for the others.
    """

    __slots__ = ("_entries", "_unchanged", "_unknown", "_watched", "atomic", "blocks")

    def __init__(
        self,
        blocks_: list[PreparedBlock],
        entries: dict[str, RegscribeError | None],
        *,
        watched: list[tuple[Register[Any], WordPosition]],
        atomic: bool,
        unknown: Mapping[str, RegscribeError],
    ) -> None:
        self.blocks, self.atomic = blocks_, atomic
        self._entries, self._unknown, self._watched = entries, unknown, watched
        self._unchanged: list[Words] | None = None if watched else []

    def changed(self, answers: Sequence[Words], session: Session) -> dict[str, Any]:
        """The dependencies that differ from the remembered ones: new values by path, MISSING for what is no value."""
        words = [_words(place, answers) for _, place in self._watched]
        if words == self._unchanged:
            return {}
        state, found = dict(session.memory), {}
        for (register, place), raw in zip(self._watched, words, strict=True):
            value = MISSING
            with suppress(ValueNotDecodable, KeyError):
                value = codec.decode(register, place.view, raw, state, session.givens, named=False)  # type: ignore[arg-type] # asked: `blind`
            if session.memory.get(register.path, MISSING) != value:
                found[register.path] = value
            if value is MISSING:
                state.pop(register.path, None)
            else:
                state[register.path] = value
        if not found:
            self._unchanged = words
        return found

    def decode(self, answers: Sequence[Sequence[int]]) -> dict[str, Any]:
        """Values or errors by path."""
        values: dict[str, Any] = self._entries.copy()
        for block, words in zip(self.blocks, answers, strict=True):
            values.update(block.decode(words))
        return values

    def decode_partly(self, answers: Sequence[Words], session: Session) -> dict[str, Any]:
        """As `decode`, for answers in which words are missing: None for a register that could not be read."""
        values: dict[str, Any] = self._entries.copy()
        for block, words in zip(self.blocks, answers, strict=True):
            values.update(block.decode_partly(words, session, self._unknown))
        return values

    def blind(self, answers: Sequence[Words]) -> bool:
        """Whether a dependency could not be read."""
        return any(None in _words(place, answers) for _, place in self._watched)

    def alike(self, other: "PreparedRead") -> bool:
        """Whether another one sends the same requests."""
        return [block.request for block in self.blocks] == [block.request for block in other.blocks]


def _words(place: WordPosition, answers: Sequence[Words]) -> Words:
    return answers[place.block][place.start : place.start + place.view.words]


R = TypeVar("R", bound=Readable)


def dependencies(registers: Mapping[str, R], wanted: Iterable[R]) -> dict[str, frozenset[str]]:
    """Dependencies of each register by path, transitively, in topological order."""
    found: dict[str, frozenset[str]] = {}

    def visit(register: R) -> frozenset[str]:
        if register.path not in found:
            direct = needs(register, read_view(register))
            deeper = [visit(registers[path]) for path in direct]
            found[register.path] = frozenset(direct).union(*deeper)
        return found[register.path]

    for register in wanted:
        visit(register)
    return found


def laid_out(
    registers: Mapping[str, R], chosen: Sequence[R], terms: Terms, *, fresh: bool, gone: Collection[str] = ()
) -> tuple[ReadOrder, dict[str, R], dict[str, frozenset[str]]]:
    """The read order of registers and, with `fresh`, of their dependencies; all of these, and dependencies, by path.

    The registers `gone` do not exist now: they are not read. A dependency that lasts is remembered in any case.
    """
    depends = {
        path: frozenset([need for need in found if not is_lasting(registers[need])])
        for path, found in (dependencies(registers, chosen) if fresh else {}).items()
    }
    needed = frozenset().union(*depends.values())
    wanted = {register.path: register for register in chosen}
    wanted |= {path: registers[path] for path in depends if path in needed and path not in wanted}
    here = {path: one for path, one in wanted.items() if path not in gone}
    there = {path: place for path, one in here.items() if (place := place_of(one, terms.ground))}
    return lay_out(there, depends, terms, gone), wanted, depends


def make_ready(
    session: Session, registers: Sequence[Register[Any]], *, fresh: bool, unknown: Mapping[str, RegscribeError]
) -> PreparedRead:
    """Plan a read of registers and, with `fresh`, of their dependencies; `unknown`: errors of dependencies by path."""
    chosen = {register.path: register for register in registers}
    absent = {one.path: one for one in session.conditional if not session.has(one)}
    layout, wanted, depends = laid_out(session.registers, registers, session.terms(), fresh=fresh, gone=absent)
    placed: list[list[Placed]] = [[] for _ in layout.blocks]
    for path, place in layout.places.items():
        if path in chosen:
            placed[place.block].append((chosen[path], place.view, place.start))
    made = [
        PreparedBlock(block, sorted(own, key=lambda one: one[2]), session, unknown)
        for block, own in zip(layout.blocks, placed, strict=True)
    ]
    entries = {
        path: absence(path, one.when, session.memory, session.givens, unknown)
        if path in absent
        else missing(session, one)
        for path, one in chosen.items()
    }
    watched = [(wanted[path], layout.checks[path]) for path in depends if path in layout.checks]
    return PreparedRead(made, entries, watched=watched, atomic=layout.atomic, unknown=unknown)


def missing(session: Session, register: Register[Any]) -> RegscribeError | None:
    """The error of a register that this unit does not have; None if it can be read somewhere."""
    if place_of(register, session.terms().ground):
        return None
    for place in read_places(register):
        if found := session.absences.error(register.path, place.span, session.unit):
            return found
    message = f"{register.path} cannot be read from this device: it can only be written, or belongs to another one"
    raise ValueError(message)
