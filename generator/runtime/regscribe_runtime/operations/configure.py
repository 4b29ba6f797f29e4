"""Several values written as one operation: checked before the first is sent, in the map's order, verified, undone."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, TypedDict

from regscribe_runtime.errors import (
    ExceptionAnswer,
    LeftAt,
    NotConfigured,
    NotWritten,
    ReadBackDiffers,
    RegscribeError,
    ValueRefused,
)
from regscribe_runtime.operations.line_change import follow
from regscribe_runtime.operations.locate import locate
from regscribe_runtime.operations.read_back import RegisterWrite
from regscribe_runtime.operations.session import Operation, Pause, Session, Task
from regscribe_runtime.operations.transaction import Transaction
from regscribe_runtime.operations.write_order import batches
from regscribe_runtime.operations.write_plan import (
    Assignment,
    Present,
    assignments,
    encoded,
    named,
    plan_changes,
    read_present,
)
from regscribe_runtime.operations.write_request import EEPROM
from regscribe_runtime.report import Fate, Sent, Teller, WriteReport


class ConfigureOptions(TypedDict, total=False):
    """Options of `configure`.

    `verify` (default True) reads back what the device keeps. `undo` (default True) writes the old values back after an
    error. `confirm` is needed if a write is dangerous. `rounded` allows values finer than the device can hold.
    `dry_run` writes nothing: the report says what would be written. `tell` is called before each request; an exception
    that it raises ends the operation.
    """

    verify: bool
    undo: bool
    confirm: bool
    rounded: bool
    dry_run: bool
    tell: Teller | None


def configure(
    values: Mapping[Any, Any],
    *,
    verify: bool = True,
    undo: bool = True,
    confirm: bool = False,
    rounded: bool = False,
    dry_run: bool = False,
    tell: Teller | None = None,
) -> Task[WriteReport]:
    """Bring several registers (by path, declaration or attribute) to their values; see `BareDevice.configure`."""

    def task(session: Session) -> Operation[WriteReport]:
        gone = yield from locate(session, named(session, values), fresh=True)
        chosen = assignments(session, values, gone)
        work = Transaction(session, tell)
        present = yield from read_present(session, chosen)
        work.state = dict(present.state)
        changes = plan_changes(session, chosen, present, rounded=rounded, confirm=confirm)
        pieces = work.plan(changes)  # for the report, whatever happens
        if dry_run:
            _add_planned_requests(work, pieces)
            return work.report(dry_run=True)
        try:
            try:
                yield from _write(work, chosen, present._replace(state=work.state), rounded=rounded, verify=verify)
            except GeneratorExit:
                raise
            except BaseException as error:  # noqa: BLE001 (raised again, with what became of everything)
                yield from _fail(work, error, undo=undo)
        except GeneratorExit:  # cancelled, or Ctrl-C while a request was under way: nothing can be sent any more
            session.broken_off = work.report()
            raise
        finally:
            session.forget()
        for path in work.paths(Fate.EQUAL):
            if session.registers[path].persistence in EEPROM:
                session.wear.add(path, spared=1)
        return work.report()

    return task


def _write(
    work: Transaction, chosen: Sequence[Assignment], present: Present, *, rounded: bool, verify: bool
) -> Operation[None]:
    """Write in phases, apply, verify; then write what governs the line."""
    session = work.session
    left = [one for one in chosen if not one.register.governs]
    while left:
        phase = _phase(session, left, present, rounded=rounded)
        yield from work.write(work.plan(plan_changes(session, phase, present, rounded=rounded)))
        left = left[len(phase) :]
        if left:
            yield Pause(max(one.register.settle for one in phase) / 1000)
            present = yield from read_present(session, left)
            work.state = {**work.state, **present.state}
            present = present._replace(state=work.state)
    for command in _apply_commands(work):
        yield from work.command(command)
    if verify and (wrong := (yield from work.verify())):
        message = f"the device changed or ignored values: {'; '.join(map(work.shown, wrong))}"
        raise RegscribeError(message)
    for one in chosen:
        yield from _write_line(work, one, rounded=rounded)


def _phase(session: Session, left: Sequence[Assignment], present: Present, *, rounded: bool) -> Sequence[Assignment]:
    """What is left up to the first unit of measure that changes: the device converts other registers then."""
    for number, one in enumerate(left, start=1):
        if one.register.rescales:
            words = encoded(session, one, present, rounded=rounded)
            if present.words.get(one.register.path) != words:
                return left[:number]
    return left


def _write_line(work: Transaction, one: Assignment, *, rounded: bool) -> Operation[None]:
    """Write a register if it governs the line, unless the device holds the value."""
    register, session = one.register, work.session
    if register.governs is None:
        return
    present = yield from read_present(session, [one])
    (change,) = plan_changes(session, [one], present, rounded=rounded)
    work.plan([change])
    if change.fate is Fate.EQUAL:
        return
    fate = change.fate
    try:
        yield from follow(session, RegisterWrite(register, one.view, change.sent, present.state), register.governs)
        fate = Fate.WRITTEN
    except (NotWritten, ValueRefused, ExceptionAnswer):
        fate = Fate.NOT_WRITTEN
        raise
    except ReadBackDiffers:
        fate = Fate.DIFFERS
        raise
    except (GeneratorExit, RegscribeError):
        fate = Fate.UNKNOWN
        raise
    finally:
        work.mark(register.path, fate)


def _apply_commands(work: Transaction) -> list[str]:
    """The commands that make what was written take effect, each once."""
    written = map(work.session.registers.__getitem__, work.paths(Fate.WRITTEN, Fate.DIFFERS, Fate.UNKNOWN))
    return list(dict.fromkeys(one.apply for one in written if one.apply and not one.governs))


def _add_planned_requests(work: Transaction, pieces: Sequence[RegisterWrite]) -> None:
    """Add the requests and commands of a dry run."""
    for request, together in batches(work.session, pieces):
        unlock = together[0].register.unlock
        if unlock and unlock not in work.unlocked:
            work.unlocked.add(unlock)
            work.requests.append(Sent(0, 0, (), (), unlock))
        paths = tuple(piece.path for piece in together)
        work.requests += work.sent(request, paths)
    names = dict.fromkeys(piece.register.apply for piece in pieces)
    work.requests += [Sent(0, 0, (), (), name) for name in names if name]


def _fail(work: Transaction, error: BaseException, *, undo: bool) -> Operation[None]:
    """Undo what was written, if `undo`, and raise NotConfigured with the report."""
    ran = {name for name, fate in work.report().commands.items() if fate is not Fate.NOT_WRITTEN}
    applied = [name for name in _apply_commands(work) if name in ran]
    if undo and not isinstance(error, LeftAt):  # no device is there to be written
        yield from work.undo(applied)
    raise NotConfigured(str(error) or type(error).__name__, work.report()) from error
