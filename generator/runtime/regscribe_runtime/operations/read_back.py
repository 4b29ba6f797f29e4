"""Reading back: what a register holds after a write, and what that says of a write whose answer was lost."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from regscribe_runtime.errors import (
    LOST,
    ExceptionAnswer,
    LinkLost,
    NotWritten,
    PartialWrite,
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
from regscribe_runtime.values.conditions import State
from regscribe_runtime.values.kinds import Access
from regscribe_runtime.values.views import View

Target = tuple["Register[Any]", "View"]

LOOKS = (0.0, 1.0)
"""Seconds before each attempt to read back: the link may need a moment to be there again."""

UNDECIDED = frozenset({4, 5, 11})
"""Exceptions after which a write may have been carried out: failed midway, taken but not done, and a gateway's."""


def is_lost(error: Exception) -> bool:
    """Whether a write may have been carried out although it ended in this error."""
    if isinstance(error, ExceptionAnswer):
        return error.code in UNDECIDED and not error.name
    return isinstance(error, LOST) and not isinstance(error, PartialWrite)


def read_back_needs(register: Register[Any], view: View) -> tuple[str, ...]:
    """What must be known to tell what was written in a view from what another one shows, where it cannot be read."""
    seen = view.readable or not register.access.readable
    return () if seen else (*view.needs(), *register.needs(register.read_view()))


def in_view(target: Target, read: Words, state: State) -> Words | None:
    """What was read back of a register as the words that write it; None where the view read shows less than all."""
    register, view = target
    seen = register.seen_in(view)
    if seen is view:
        return read
    return codec.carried_over(register, seen, view, read, state) if same_precision(seen, view) else None


def words_of(session: Session, targets: Iterable[Target]) -> Operation[dict[str, Words]]:
    """The present words of registers by path, in few requests: in these views, or in those read in their place."""
    chosen = [(register, register.seen_in(view)) for register, view in targets]
    if len(chosen) == 1:
        register, view = chosen[0]
        return {register.path: (yield from session.exchange(read_request(register, view)))}
    places = {register.path: item_of(register, view) for register, view in chosen}
    found = yield from fetch(session, dict.fromkeys(places.values()))
    return {path: found[place] for path, place in places.items()}


def look_back(session: Session, targets: Iterable[Target], after: Exception) -> Operation[dict[str, Words] | None]:
    """The present words after a write that ended in the error `after`; None if nobody answers any more."""
    wanted = list(targets)
    yield Pause(rest(session, wanted, after))
    for seconds in LOOKS:
        if seconds:
            yield Pause(seconds)
        try:
            return (yield from words_of(session, wanted))
        except RegscribeError:
            continue
    return None


def rest(session: Session, targets: Iterable[Target], after: Exception | None = None) -> float:
    """Seconds until reading back says something: the map's, and the device's latency where no timeout waited for it."""
    registers = [register for register, _ in targets]
    seconds = max((register.settle for register in registers), default=0) / 1000
    if isinstance(after, LinkLost):
        words = sum(view.words for _, view in targets)
        latencies = [session.protocol.latency(code) for code in (6, 16)]
        needed = [float(one.longest(words)) for one in latencies if one]
        seconds = max([seconds, *(milliseconds / 1000 for milliseconds in needed)])
    return seconds


def same(register: Register[Any], view: View, read: Words, written: Words, state: State, session: Session) -> bool:
    """Whether words that were read back mean what was written: equal words, or others of an equal value (-0.0 and 0.0).

    Of a view that cannot be read, what another one shows of it is compared, as finely as that one can tell.
    """
    seen = register.seen_in(view)
    expected = written if seen is view else codec.carried_over(register, view, seen, written, state)
    if read == expected:
        return True
    mine, its = (meaning(register, seen, words, state, session) for words in (read, expected))
    return mine is not None and mine == its


def meaning(
    register: Register[Any], view: View, words: Words | None, state: State, session: Session, *, named: bool = True
) -> Any:
    """The value of words, special values as in `codec.reader`; None if they mean nothing, or are not known."""
    if words is None:
        return None
    try:
        return codec.decode(register, view, words, state, session.givens, named=named)
    except (ValueNotDecodable, KeyError):
        return None


def fate_of_lost(
    session: Session, target: Target, sent: Words, state: State, cause: RegscribeError
) -> Operation[WriteFailed | None]:
    """What became of a write of one register whose answer was lost: None if it was carried out, else the error."""
    register, view = target
    open_still = "the answer leaves it open" if isinstance(cause, ExceptionAnswer) else "the answer was lost"
    if register.access is not Access.READ_WRITE:
        return lost(WriteUnknown, register.path, f"{open_still} ({cause}), and it cannot be read back", cause)
    found = yield from look_back(session, [target], cause)
    if found is None:
        return lost(WriteUnknown, register.path, f"{open_still} ({cause}), and reading back fails too", cause)
    read = found[register.path]
    if same(register, view, read, sent, state, session):
        return None
    held = _spelled(meaning(register, register.seen_in(view), read, state, session))
    asked = _spelled(meaning(register, view, sent, state, session))
    if steady(register):
        return lost(NotWritten, register.path, f"{open_still} ({cause}); it holds {held}, not {asked}", cause)
    return lost(
        WriteUnknown,
        register.path,
        f"{open_still} ({cause}); it holds {held}, and the device changes it by itself",
        cause,
    )


def _spelled(value: object) -> str:
    """A value for a message; members of enums by name."""
    return getattr(value, "name", None) or repr(value)


def steady(register: Register[Any]) -> bool:
    """Whether the device keeps what is written, so that reading another value back says something."""
    return register.is_configuration or register.persistence == "ram"


def verified(session: Session, target: Target, sent: Words, state: State) -> Operation[None]:
    """Read a register back; ReadBackDiffers if it holds something else, WriteUnknown if it cannot be read."""
    register, view = target
    if register.settle:
        yield Pause(register.settle / 1000)
    try:
        read = (yield from words_of(session, [target]))[register.path]
    except RegscribeError as error:
        raise lost(
            WriteUnknown, register.path, f"the device took it, but reading back fails ({error})", error
        ) from error
    if not same(register, view, read, sent, state, session):
        raise differs(session, target, sent, read, state)


def differs(session: Session, target: Target, sent: Words, read: Words, state: State) -> ReadBackDiffers:
    """The error for a register that holds something else than was sent."""
    register, view = target
    value = meaning(register, view, sent, state, session)
    held = meaning(register, register.seen_in(view), read, state, session)
    return ReadBackDiffers(register.path, sent=sent, read=read, value=value, held=held)


def readable(targets: Mapping[str, Target]) -> dict[str, Target]:
    """The targets that can be read."""
    return {path: target for path, target in targets.items() if target[0].access is Access.READ_WRITE}
