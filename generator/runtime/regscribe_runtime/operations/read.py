"""What reading takes, step by step, without I/O: each operation is a generator of requests.

An operation is created with a register and run by a part of a driver, which sends the session in first.
"""

# an annotation of an inner function is evaluated at every call otherwise, which costs a read a hundredth of its time
from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, TypeVar

from regscribe_runtime.errors import ExceptionAnswer, RegscribeError, Unsteady, ValueNotDecodable
from regscribe_runtime.operations.bisect import REFUSALS, Bisection, is_absence
from regscribe_runtime.operations.prepared_read import MISSING, PreparedRead, dependencies, make_ready, missing
from regscribe_runtime.operations.session import Operation, Session, Task
from regscribe_runtime.operations.snapshot import Snapshot
from regscribe_runtime.planning.address_ranges import RegisterSpan
from regscribe_runtime.planning.plan import RequestLimits, Terms, blocks
from regscribe_runtime.registers import codec
from regscribe_runtime.registers.register import Register
from regscribe_runtime.values.conditions import choose, registers_of
from regscribe_runtime.values.views import View
from regscribe_runtime.values.wire_types import Space
from regscribe_runtime.wire.requests import Request

T = TypeVar("T")

TRIES = 4
"""Reads of a snapshot until it is given up as unsteady; an absent dependency takes one of them."""

FEW = 3
"""Requests for registers that another one depends on, up to which no plan of the whole device is made for them."""

MAX_DEPTH = 8
"""Dependencies of dependencies; the compiler refuses cycles, this bounds what it let through."""


def item_of(register: Register[Any], view: View) -> RegisterSpan:
    """Where a register stands in a view."""
    return RegisterSpan(view.space, view.address(register.at), view.words)


def fetch(session: Session, items: Iterable[RegisterSpan]) -> Operation[dict[RegisterSpan, tuple[int, ...]]]:
    """The present words of items: a few without a plan of the whole device, more in the requests of least cost."""
    wanted = sorted(set(items))
    requests = _joined(wanted, RequestLimits.of(session.protocol))
    if len(requests) > FEW or session.absences:
        requests = _planned(wanted, session.terms())
    found = {}
    for asked, held in requests.items():
        words = yield from session.exchange(Request(asked.space.read_function, asked.address, asked.words))
        for item in held:
            start = item.address - asked.address
            found[item] = tuple(words[start : start + item.words])
    return found


def _planned(items: Sequence[RegisterSpan], terms: Terms) -> Mapping[RegisterSpan, Sequence[RegisterSpan]]:
    """Items by the span that reads them at the least cost; what plans go round is asked for alone."""
    alone = [item for item in items if terms.ground.stretch(item) is None]
    planned = blocks([item for item in items if item not in alone], terms)
    return {item: [item] for item in alone} | {
        RegisterSpan(block.space, block.address, block.quantity): block.items for block in planned
    }


def _joined(items: Sequence[RegisterSpan], limits: RequestLimits) -> Mapping[RegisterSpan, Sequence[RegisterSpan]]:
    """Sorted items by the span that reads them: those that follow each other without a gap are read together."""
    found: dict[RegisterSpan, Sequence[RegisterSpan]] = {}
    last = RegisterSpan(Space.HOLDING, -1, 0)
    for item in items:
        both = last._replace(words=item.end - last.address)
        if (item.space, item.address) == (last.space, last.end) and both.words <= limits.most(item.space):
            found[both] = [*found.pop(last), item]
            last = both
        else:
            found[item] = [item]
            last = item
    return found


def know(session: Session, paths: Iterable[str], *, fresh: bool = False, depth: int = 0) -> Operation[dict[str, Any]]:
    """The values of registers, from memory or (all of them, with `fresh`) from the device."""
    wanted = [path for path in dict.fromkeys(paths) if fresh or path not in session.memory]
    if not wanted:
        return session.memory
    if depth > MAX_DEPTH:
        message = f"the meaning of {wanted[0]} depends on too long a chain of registers"
        raise RuntimeError(message)
    registers = list(map(session.registers.__getitem__, wanted))
    views = [register.read_view() for register in registers]
    unknown = yield from _unknown(session, _needs(registers, views), depth=depth + 1)
    spans = list(map(item_of, registers, views))
    found = yield from fetch(session, spans)
    values = {
        register.path: codec.decode(register, view, found[span], session.memory, session.givens, unknown, named=False)
        for register, view, span in zip(registers, views, spans, strict=True)
    }
    _remember(session, values, fresh=fresh)
    return session.memory | values if fresh else session.memory


def _remember(session: Session, values: dict[str, Any], *, fresh: bool) -> None:
    """Keep values; of those that were read `fresh`, only the ones that were known and have changed."""
    for path, value in values.items():
        if not fresh or session.memory.get(path, value) != value:
            session.remember(path, value)


def _needs(registers: Iterable[Register[Any]], views: Iterable[View]) -> dict[str, None]:
    """What the meaning of registers depends on, each once."""
    found: dict[str, None] = {}
    for register, view in zip(registers, views, strict=True):
        found |= dict.fromkeys(register.needs(view))
    return found


def read(register: Register[T], view_name: str | None) -> Task[T]:
    """Read one register and decode it."""

    def task(session: Session) -> Operation[T]:
        key = (register.path, view_name)
        if key not in session.prepared:
            view = register.read_view(view_name)
            unknown = yield from _unknown(session, register.needs(view))
            made = codec.decoder(register, view, session.memory, session.givens, unknown)
            if unknown:
                only_now: T = made((yield from session.exchange(read_request(register, view))))
                return only_now  # what is unknown may have a value when it is read again
            session.prepared[key] = read_request(register, view), made
        request, decode = session.prepared[key]
        value: T = decode((yield from session.exchange(request)))
        return value

    return task


def read_request(register: Register[Any], view: View) -> Request:
    """The request that reads a register in a view."""
    return Request(view.space.read_function, view.address(register.at), view.words)


def read_raw(register: Register[Any], view_name: str | None) -> Task[tuple[int, ...]]:
    """Read the words of one register."""

    def task(session: Session) -> Operation[tuple[int, ...]]:
        return (yield from session.exchange(read_request(register, register.read_view(view_name))))

    return task


def read_unit(register: Register[Any]) -> Task[str]:
    """The engineering unit under the present configuration."""

    def task(session: Session) -> Operation[str]:
        unknown = yield from _unknown(session, registers_of(register.unit))
        state = codec.known(register, session.memory, unknown)
        return choose(register.unit, state, session.givens) or ""

    return task


def read_many(registers: Sequence[Register[Any]], *, fresh: bool = True, rest: bool = False) -> Task[Snapshot]:
    """Read several registers in the requests of least cost: one snapshot with a value or an error for each.

    The snapshot is consistent: what the meaning of values depends on (decimals, input type, word order) is read along,
    behind the values. If it is not as it was known before, everything is read again under the new state, unless values
    and state came in one request; after TRIES times Unsteady is raised. Without `fresh`, what was remembered is
    trusted, as single reads do: cheaper, and right as long as nobody else configures the device.

    If the unit refuses a request because it lacks a register, `Bisection` finds it and delivers the rest; the entry of
    that register is an Absent error, and reads go round it until that expires: at the next read (that of a `rest`
    excepted) if others depend on it and the unit was heard to have it. What concerns the whole unit is raised:
    NoAnswer, LinkLost, WrongAnswer, and any other exception answer.
    """

    def task(session: Session) -> Operation[Snapshot]:
        if session.absences and not rest and session.absences.expire():
            session.prepared.clear()
        changed: dict[str, Any] = {}
        for _ in range(TRIES):
            ready = yield from _ready(session, registers, fresh=fresh)
            answers, complete = yield from _answers(session, ready)
            if not complete and ready.blind(answers):
                continue
            changed = ready.changed(answers, session)
            if changed:
                _take_over(session, changed)
                before, ready = ready, (yield from _ready(session, registers, fresh=fresh))
                if not (before.atomic and complete and ready.alike(before)):
                    continue
            read = tuple(zip(ready.blocks, answers, strict=True))
            if complete:
                return Snapshot(ready.decode(answers), read)
            partly = Snapshot(ready.decode_partly(answers, session), read)
            return (yield from _patched(session, registers, partly, fresh=fresh))
        raise Unsteady(unit=session.unit, changed=tuple(changed), tries=TRIES)

    return task


def _ready(session: Session, registers: Sequence[Register[Any]], *, fresh: bool) -> Operation[PreparedRead]:
    key = (tuple(register.path for register in registers), fresh)
    if key not in session.prepared:
        unknown = yield from _learn(session, registers)
        session.prepared[key] = make_ready(session, registers, fresh=fresh, unknown=unknown)
    found: PreparedRead = session.prepared[key]
    return found


def _learn(session: Session, registers: Sequence[Register[Any]]) -> Operation[dict[str, RegscribeError]]:
    """Make known what the meaning of registers depends on; why not, of each that has no value."""
    needs = dependencies(session.registers, registers)
    needed = frozenset().union(*needs.values())
    paths = [path for path in needs if path in needed]
    absent = {path: error for path in paths if (error := missing(session, session.registers[path]))}
    unknown = yield from _unknown(session, [path for path in paths if path not in absent])
    return absent | unknown


def _unknown(session: Session, paths: Iterable[str], *, depth: int = 0) -> Operation[dict[str, RegscribeError]]:
    """Make the values of registers known; of each that has none, why."""
    try:
        yield from know(session, paths, depth=depth)
    except (ValueNotDecodable, ExceptionAnswer) as error:
        _bearable(session, error)
    else:
        return {}
    unknown: dict[str, RegscribeError] = {}
    for path in paths:
        try:
            yield from know(session, [path], depth=depth)
        except (ValueNotDecodable, ExceptionAnswer) as error:
            _bearable(session, error)
            unknown[path] = error
    return unknown


def _bearable(session: Session, error: RegscribeError) -> None:
    if not isinstance(error, ValueNotDecodable) and not is_absence(error, session.protocol.absent):
        raise error


def _answers(session: Session, ready: PreparedRead) -> Operation[tuple[list[Any], bool]]:
    """The words of each block, and whether all could be read."""
    answers: list[Any] = []
    complete = True
    for block in ready.blocks:
        try:
            answers.append((yield from session.exchange(block.request)))
        except REFUSALS as error:
            if not is_absence(error, session.protocol.absent):
                raise
            complete = False
            answers.append((yield from Bisection(session, block.block, error, heard=bool(answers)).run()))
    return answers, complete


def _take_over(session: Session, changed: dict[str, Any]) -> None:
    session.forget(path for path, value in changed.items() if value is MISSING)
    for path, value in changed.items():
        if value is not MISSING:
            session.remember(path, value)


def _patched(
    session: Session, registers: Sequence[Register[Any]], partly: Snapshot, *, fresh: bool
) -> Operation[Snapshot]:
    """A snapshot with what was refused read by another way, or the error that there is none."""
    values = partly.entries
    left = [register for register in registers if values[register.path] is None]
    if not left:
        return partly
    rest = yield from read_many(left, fresh=fresh, rest=True)(session)
    return Snapshot(values | rest.entries, partly.answers + rest.answers)
