"""Reading back: what a register holds after a write, and what that says of a write whose answer was lost."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from regscribe_runtime.errors import (
    ExceptionAnswer,
    LinkLost,
    NotWritten,
    ReadBackDiffers,
    RegscribeError,
    ValueNotDecodable,
    WriteFailed,
    WriteUnknown,
    lost,
)
from regscribe_runtime.operations.read import fetch, item_of, read_request
from regscribe_runtime.operations.session import Operation, Pause, Session
from regscribe_runtime.planning.read_places import same_precision
from regscribe_runtime.registers import codec
from regscribe_runtime.registers.register import Register
from regscribe_runtime.report import Words
from regscribe_runtime.values.conditions import Givens, State
from regscribe_runtime.values.kinds import OCTETS
from regscribe_runtime.values.views import View

Target = tuple["Register[Any]", "View"]
"""A register and the view in which it is written."""

LOOKS = (0.0, 1.0)
"""Seconds before each attempt to read back: a lost link may need a moment."""


CERTAIN = 2
"""Numbers of so many words are told apart by the floats that they are read as."""


class RegisterWrite:
    """One value to write: register, view, words, and the state of the device that gives the words their meaning.

    With `bits`, those bits of the only word are written, and the device keeps the others as they are (function 22).
    """

    __slots__ = ("bits", "register", "state", "view", "words")

    def __init__(self, register: Register[Any], view: View, words: Words, state: State, *, bits: int = 0) -> None:
        self.register, self.view, self.words, self.state, self.bits = register, view, words, state, bits

    @property
    def path(self) -> str:
        """The register's path."""
        return self.register.path

    @property
    def target(self) -> Target:
        """The register and its view."""
        return self.register, self.view

    @property
    def address(self) -> int:
        """The wire address of the first word."""
        return self.view.address(self.register.at)

    def value(self, session: Session, *, named: bool = True) -> Any:
        """The value of the words; None if they have none."""
        return meaning(self.register, self.view, self.words, self.state, session, named=named)

    def held(self, read: Words | None, session: Session) -> Any:
        """The value of words that were read back; None if they have none, or are None."""
        return meaning(self.register, self.register.seen_in(self.view), read, self.state, session)

    def matches(self, read: Words, session: Session) -> bool:
        """Whether words that were read back mean what was written: equal words, or an equal value (-0.0 and 0.0).

        A view that cannot be read is compared in the view that is read instead, with the precision of that.
        """
        seen = self.register.seen_in(self.view)
        expected = self.words
        if seen is not self.view:
            expected = codec.carried_over(self.register, self.view, seen, self.words, self.state, session.givens)
        if read == expected or (self.bits and not (read[0] ^ expected[0]) & self.bits):
            return True
        held = self.held(read, session)
        return held is not None and held == self.held(expected, session)

    def differs(self, read: Words, session: Session) -> ReadBackDiffers:
        """The error for a register that holds something else than was sent."""
        value, held = self.value(session), self.held(read, session)
        return ReadBackDiffers(self.path, sent=self.words, read=read, value=value, held=held)


def read_back_needs(register: Register[Any], view: View) -> tuple[str, ...]:
    """Dependencies for comparing what was written in a view that cannot be read with another one."""
    if view.readable or not register.access.readable:
        return ()
    return (*view.needs(), *register.needs(register.read_view()))


def in_view(target: Target, read: Words, state: State, givens: Givens) -> Words | None:
    """What was read back of a register as the words that write it; None where the view read is less precise."""
    register, view = target
    seen = register.seen_in(view)
    if seen is view:
        return read
    return codec.carried_over(register, seen, view, read, state, givens) if same_precision(seen, view) else None


def words_of(session: Session, targets: Iterable[Target]) -> Operation[dict[str, Words]]:
    """The present words of registers by path, in few requests; of views that cannot be read those read instead."""
    chosen = [(register, register.seen_in(view)) for register, view in targets]
    if len(chosen) == 1:
        register, view = chosen[0]
        return {register.path: (yield from session.exchange(read_request(register, view)))}
    places = {register.path: item_of(register, view) for register, view in chosen}
    found = yield from fetch(session, dict.fromkeys(places.values()))
    return {path: found[place] for path, place in places.items()}


def look_back(session: Session, targets: Iterable[Target], after: Exception) -> Operation[dict[str, Words] | None]:
    """The present words by path after a write that ended in the error `after`; None without an answer."""
    wanted = list(targets)
    yield Pause(settling_seconds(session, wanted, after))
    for seconds in LOOKS:
        if seconds:
            yield Pause(seconds)
        try:
            return (yield from words_of(session, wanted))
        except RegscribeError:
            continue
    return None


def settling_seconds(session: Session, targets: Iterable[Target], after: Exception | None = None) -> float:
    """Seconds until reading back is reliable: the map's, and the device's latency if a lost link ended the wait."""
    chosen = list(targets)
    seconds = max((register.settle for register, _ in chosen), default=0) / 1000
    if isinstance(after, LinkLost):
        words = sum(view.words for _, view in chosen)
        latencies = filter(None, map(session.protocol.latency, (6, 16)))
        seconds = max([seconds, *(float(one.longest(words)) / 1000 for one in latencies)])
    return seconds


def meaning(
    register: Register[Any], view: View, words: Words | None, state: State, session: Session, *, named: bool = True
) -> Any:
    """The value of words, special values as in `codec.reader`; None if they have none, or are None."""
    if words is None:
        return None
    try:
        return codec.decode(register, view, words, state, session.givens, named=named)
    except (ValueNotDecodable, KeyError):
        return None


def holds(planned: RegisterWrite, before: Words | None, session: Session) -> bool:
    """Whether a register that holds the words `before` need not be written.

    The words are equal, or texts or numbers that read the same (another padding, -0.0); of more than two words numbers
    may read the same that are not.
    """
    if before is None or before == planned.words:
        return before is not None
    if planned.view.words > CERTAIN and planned.register.kind not in OCTETS:
        return False
    held = meaning(planned.register, planned.view, before, planned.state, session)
    return held is not None and held == planned.value(session)


def fate_of_lost(session: Session, write: RegisterWrite, cause: RegscribeError) -> Operation[WriteFailed | None]:
    """The error for a write whose answer was lost, after reading back; None if it was carried out."""
    register, kind = write.register, WriteUnknown
    reason = "the answer leaves it open" if isinstance(cause, ExceptionAnswer) else "the answer was lost"
    reason = f"{reason} ({cause})"
    if not register.can_be_checked:
        return lost(kind, write.path, f"{reason}, and it cannot be read back", cause)
    found = yield from look_back(session, [write.target], cause)
    if found is None:
        return lost(kind, write.path, f"{reason}, and reading back fails too", cause)
    read = found[write.path]
    if write.matches(read, session):
        return None
    values = write.held(read, session), write.value(session)
    held, wanted = (getattr(value, "name", None) or repr(value) for value in values)
    if len(write.words) > session.protocol.most_written(write.view.space):
        return lost(kind, write.path, f"{reason}; it takes several requests, and holds {held}, not {wanted}", cause)
    if keeps(register):
        return lost(NotWritten, write.path, f"{reason}; it holds {held}, not {wanted}", cause)
    return lost(kind, write.path, f"{reason}; it holds {held}, and the device changes it by itself", cause)


def keeps(register: Register[Any]) -> bool:
    """Whether the device keeps what is written, so that another value read back is an error."""
    return register.is_configuration or (register.persistence == "ram" and register.stays != "momentary")


def verify_write(session: Session, write: RegisterWrite) -> Operation[None]:
    """Read a register back; ReadBackDiffers if it holds something else, WriteUnknown if it cannot be read."""
    if write.register.settle:
        yield Pause(write.register.settle / 1000)
    try:
        read = (yield from words_of(session, [write.target]))[write.path]
    except RegscribeError as error:
        reason = f"the device took it, but reading back fails ({error})"
        raise lost(WriteUnknown, write.path, reason, error) from error
    if not write.matches(read, session):
        raise write.differs(read, session)
