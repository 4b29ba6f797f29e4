"""Read operations: generators of requests, without I/O."""

# an annotation of an inner function is evaluated at every call otherwise, which costs a read a hundredth of its time
from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from itertools import chain
from typing import Any, TypeVar

from regscribe_runtime.errors import (
    BrokenChain,
    ExceptionAnswer,
    NotPresent,
    RegscribeError,
    Unsteady,
    ValueNotDecodable,
)
from regscribe_runtime.operations.bisect import REFUSALS, Bisection, is_absence
from regscribe_runtime.operations.locate import MovedError, locate
from regscribe_runtime.operations.prepared_read import MISSING, PreparedRead, dependencies, make_ready, missing
from regscribe_runtime.operations.session import Operation, Session, Task
from regscribe_runtime.operations.snapshot import Snapshot
from regscribe_runtime.planning.address_ranges import RegisterSpan, span_of
from regscribe_runtime.planning.plan import Block, RequestLimits, blocks
from regscribe_runtime.planning.read_places import read_places
from regscribe_runtime.registers import codec
from regscribe_runtime.registers.presence import absence, condition_text, seen
from regscribe_runtime.registers.register import Register
from regscribe_runtime.values.conditions import Condition, choose, registers_of
from regscribe_runtime.values.views import View
from regscribe_runtime.wire.requests import Request

T = TypeVar("T")

TRIES = 4
"""Most reads of a snapshot whose dependencies change; an absent dependency takes one of them."""

FEW = 3
"""Most requests for dependencies without a plan of the whole device."""

NO_VALUE = (ValueNotDecodable, NotPresent, BrokenChain)
"""Errors of a register that has no value now, which say nothing against the others."""

MAX_DEPTH = 8
"""Most levels of dependencies, in case of a cycle that the compiler let through."""


def item_of(register: Register[Any], view: View) -> RegisterSpan:
    """The addresses of a register in a view."""
    return span_of(view, view.address(register.at))


def fetch(session: Session, items: Iterable[RegisterSpan]) -> Operation[dict[RegisterSpan, tuple[int, ...]]]:
    """The present words of items: a few without a plan of the whole device, more in the requests of least cost."""
    wanted = sorted(set(items))
    requests = _joined(wanted, RequestLimits.of(session.protocol))
    if len(requests) > FEW or session.absences:
        terms = session.terms()
        alone = [item for item in wanted if terms.ground.stretch(item) is None]  # not in plans: requested alone
        requests = [_block([item]) for item in alone]
        requests += blocks([item for item in wanted if item not in alone], terms)
    found = {}
    for function, address, quantity, held in requests:
        words = yield from session.exchange(Request(function, address, quantity))
        for item in held:
            start = item.address - address
            found[item] = tuple(words[start : start + item.words])
    return found


def _joined(items: Sequence[RegisterSpan], limits: RequestLimits) -> list[Block]:
    """The requests for sorted items, one for items that follow each other without a gap."""
    runs: list[list[RegisterSpan]] = []
    for item in items:
        run = runs[-1] if runs else [item]
        adjacent = (item.space, item.address) == (run[-1].space, run[-1].end)
        if adjacent and item.end - run[0].address <= limits.most(item.space):
            run.append(item)
        else:
            runs.append([item])
    return [_block(run) for run in runs]


def _block(run: Sequence[RegisterSpan]) -> Block:
    first = run[0].address
    return Block(run[0].space.read_function, first, run[-1].end - first, tuple(run))


def know(session: Session, paths: Iterable[str], *, fresh: bool = False, depth: int = 0) -> Operation[dict[str, Any]]:
    """The values of registers by path, from memory or (with `fresh`) all of them from the device."""
    wanted = [path for path in dict.fromkeys(paths) if fresh or path not in session.memory]
    if not wanted:
        return session.memory
    if depth > MAX_DEPTH:
        message = f"the meaning of {wanted[0]} depends on too long a chain of registers"
        raise RuntimeError(message)
    gone = yield from locate(session, map(session.registers.__getitem__, wanted))
    gone |= yield from absences(session, wanted, depth=depth)
    for error in gone.values():
        raise error
    registers = list(map(session.registers.__getitem__, wanted))
    views = list(map(Register.read_view, registers))
    needs = dict.fromkeys(chain.from_iterable(map(Register.needs, registers, views)))
    unknown = yield from _unknown(session, needs, depth=depth + 1)
    spans = list(map(item_of, registers, views))
    found = yield from fetch(session, spans)
    values = {}
    for register, view, span in zip(registers, views, spans, strict=True):
        state = codec.known_state(register, session.memory, unknown)
        values[register.path] = codec.decode(register, view, found[span], state, session.givens, named=False)
    for path, value in values.items():
        if not fresh or session.memory.get(path, value) != value:  # of fresh ones, those remembered that have changed
            session.remember(path, value)
    return session.memory | values


def absences(session: Session, paths: Iterable[str], *, depth: int = 0) -> Operation[dict[str, RegscribeError]]:
    """The errors by path of registers that do not exist now; what decides that is read where it is not remembered."""
    asked = [one for path in paths if (one := session.registers[path]).when.tests]
    if not asked:
        return {}
    unknown = yield from _unknown(session, chain.from_iterable(one.when.registers for one in asked), depth=depth + 1)
    found = {one.path: absence(one.path, one.when, session.memory, session.givens, unknown) for one in asked}
    return {path: error for path, error in found.items() if error}


def exists(session: Session, name: str, when: Condition) -> Operation[None]:
    """Raise NotPresent if what is no register (a command, a setpoint program) does not exist now."""
    state = yield from know(session, when.registers, fresh=True)
    if not when.holds(state, session.givens):
        raise NotPresent(name, condition_text(when, state), seen(when, state, session.givens))


def present(session: Session, register: Register[Any], *, fresh: bool = False) -> Operation[None]:
    """Raise NotPresent if a register does not exist now, by what the device holds; `fresh`: nothing is remembered."""
    if not register.when.tests:
        return
    for again in (fresh, True):
        if again:
            session.forget(dependencies(session.registers, [register]))
        gone = yield from absences(session, [register.path])
        if not gone:
            return
    raise gone[register.path]


def read(register: Register[T], view_name: str | None) -> Task[T]:
    """Read one register and decode it."""

    def task(session: Session) -> Operation[T]:
        key = (register.path, view_name)
        if key not in session.prepared:
            view = register.read_view(view_name)
            yield from present(session, register)
            unknown = yield from _unknown(session, register.needs(view))
            state = codec.known_state(register, session.memory, unknown)
            made = codec.decoder(register, view, state, session.givens)
            if unknown:
                words = yield from session.exchange(read_request(register, view))
                renew(session, register, view, words)
                only_now: T = made(words)
                return only_now  # an unknown register may have a value when it is read again
            session.prepared[key] = read_request(register, view), made
        request, decode = session.prepared[key]
        try:
            words = yield from session.exchange(request)
        except ExceptionAnswer:
            yield from present(session, register, fresh=True)
            raise
        renew(session, register, register.read_view(view_name), words)
        value: T = decode(words)
        return value

    return task


def renew(session: Session, register: Register[Any], view: View, words: tuple[int, ...]) -> None:
    """Forget what is remembered of a register of which other words were read."""
    if register.path not in session.memory:
        return
    value = MISSING
    with suppress(ValueNotDecodable, KeyError):
        value = codec.decode(register, view, words, session.memory, session.givens, named=False)
    if session.memory[register.path] != value:
        session.forget([register.path])


def read_request(register: Register[Any], view: View) -> Request:
    """The request that reads a register in a view."""
    return Request(view.space.read_function, view.address(register.at), view.words)


def read_raw(register: Register[Any], view_name: str | None) -> Task[tuple[int, ...]]:
    """Read the words of one register."""

    def task(session: Session) -> Operation[tuple[int, ...]]:
        yield from present(session, register)
        view = register.read_view(view_name)
        words = yield from session.exchange(read_request(register, view))
        renew(session, register, view, words)
        return words

    return task


def read_unit(register: Register[Any]) -> Task[str]:
    """The engineering unit in the present configuration."""

    def task(session: Session) -> Operation[str]:
        unknown = yield from _unknown(session, registers_of(register.unit))
        state = codec.known_state(register, session.memory, unknown)
        return choose(register.unit, state, session.givens) or ""

    return task


def read_many(registers: Sequence[Register[Any]], *, fresh: bool = True, rest: bool = False) -> Task[Snapshot]:
    """Read several registers in the requests of least cost: one snapshot with a value or an error for each.

    Dependencies (decimals, input type, word order) are read behind the values. If they differ from the remembered ones,
    all is read again, unless values and dependencies came in one request; after TRIES reads Unsteady is raised. Without
    `fresh` remembered dependencies are used: right as long as no other master configures the device.

    A register that the unit lacks is found by `Bisection`. Its entry is an Absent error, and plans leave it out until
    the refusal expires; a `rest` is read without looking for expired ones. Raises NoAnswer, LinkLost, WrongAnswer, and
    ExceptionAnswer for other exceptions.
    """

    def task(session: Session) -> Operation[Snapshot]:
        entries: dict[str, Any] = dict.fromkeys(one.path for one in registers)
        for _ in range(TRIES):
            gone = yield from locate(session, registers)
            here = [session.registers[one.path] for one in registers if one.path not in gone]
            try:
                found = yield from _read_located(here, fresh=fresh, rest=rest)(session)
            except MovedError:
                continue
            return Snapshot(entries | found.entries | gone, found.answers)
        raise Unsteady(unit=session.unit, changed=tuple(session.counters), tries=TRIES)

    return task


def _read_located(registers: Sequence[Register[Any]], *, fresh: bool, rest: bool) -> Task[Snapshot]:
    """As `read_many`, of registers where they stand on the device."""

    def task(session: Session) -> Operation[Snapshot]:
        if session.absences and not rest and session.absences.expire():
            session.prepared.clear()
        changed: dict[str, Any] = {}
        trusted = fresh
        for _ in range(TRIES):
            ready = yield from _ready(session, registers, fresh=fresh)
            answers, complete = yield from _answers(session, ready)
            if not complete and ready.blind(answers):
                continue
            changed = ready.changed(answers, session)
            _adopt(session, changed)
            if not complete and (changed or not trusted) and _doubtful(session, registers):
                trusted = True
                continue
            if changed:
                before, ready = ready, (yield from _ready(session, registers, fresh=fresh))
                if not (before.atomic and complete and ready.alike(before)):
                    continue
            read = tuple(zip(ready.blocks, answers, strict=True))
            if complete:
                return Snapshot(ready.decode(answers), read)
            partly = Snapshot(ready.decode_partly(answers, session), read)
            return (yield from _completed(session, registers, partly, fresh=fresh))
        raise Unsteady(unit=session.unit, changed=tuple(changed), tries=TRIES)

    return task


def _completed(
    session: Session, registers: Sequence[Register[Any]], partly: Snapshot, *, fresh: bool
) -> Operation[Snapshot]:
    """A snapshot with the registers that could not be read in its requests, but may be in others."""
    values = partly.entries
    left = [register for register in registers if values[register.path] is None]
    others = (yield from _read_located(left, fresh=fresh, rest=True)(session)) if left else Snapshot({})
    return Snapshot(values | others.entries, partly.answers + others.answers)


def _adopt(session: Session, changed: Mapping[str, Any]) -> None:
    """Remember what has changed."""
    session.forget(path for path, value in changed.items() if value is MISSING)
    for path, value in changed.items():
        if value is not MISSING:
            session.remember(path, value)
    if session.counters.intersection(changed):
        raise MovedError


def _doubtful(session: Session, registers: Sequence[Register[Any]]) -> bool:
    """Whether what was refused may not exist any more: that says nothing of the unit, and all is read again."""
    passing = [one for one in registers if not one.when.always]
    doubted = session.absences.drop({place.span for one in passing for place in read_places(one)})
    if doubted:
        session.forget(dependencies(session.registers, passing))
        session.prepared.clear()
    return doubted


def read_part(placed: Mapping[str, Register[Any]]) -> Task[Snapshot]:
    """Read several registers; the snapshot has the keys of `placed`."""

    def task(session: Session) -> Operation[Snapshot]:
        found = yield from read_many(list(placed.values()))(session)
        names = {register.path: name for name, register in placed.items()}
        return Snapshot({names[path]: value for path, value in found.entries.items()}, found.answers)

    return task


def _ready(session: Session, registers: Sequence[Register[Any]], *, fresh: bool) -> Operation[PreparedRead]:
    key = (tuple(register.path for register in registers), fresh)
    if key not in session.prepared:
        unknown = yield from _learn(session, registers)
        session.prepared[key] = make_ready(session, registers, fresh=fresh, unknown=unknown)
    found: PreparedRead = session.prepared[key]
    return found


def _learn(session: Session, registers: Sequence[Register[Any]]) -> Operation[dict[str, RegscribeError]]:
    """Make the dependencies of registers known; the error by path of those without a value."""
    needs = dependencies(session.registers, registers)
    needed = frozenset().union(*needs.values())
    paths = [path for path in needs if path in needed]
    absent = yield from locate(session, map(session.registers.__getitem__, paths))
    there = [path for path in paths if path not in absent]
    known = [one for path in there if session.has(one := session.registers[path])]
    absent |= {one.path: error for one in known if (error := missing(session, one))}
    unknown = yield from _unknown(session, [path for path in there if path not in absent])
    return absent | unknown


def _unknown(session: Session, paths: Iterable[str], *, depth: int = 0) -> Operation[dict[str, RegscribeError]]:
    """Make the values of registers known; the error by path of those without a value."""
    wanted = list(dict.fromkeys(paths))
    unknown = yield from absences(session, wanted, depth=depth)
    wanted = [path for path in wanted if path not in unknown]
    try:
        yield from know(session, wanted, depth=depth)
    except (*NO_VALUE, ExceptionAnswer) as error:
        _raise_unless_absent(session, error)
    else:
        return unknown
    for path in wanted:
        try:
            yield from know(session, [path], depth=depth)
        except (*NO_VALUE, ExceptionAnswer) as error:
            _raise_unless_absent(session, error)
            unknown[path] = error
    return unknown


def _raise_unless_absent(session: Session, error: RegscribeError) -> None:
    if not isinstance(error, NO_VALUE) and not is_absence(error, session.protocol.absent):
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
