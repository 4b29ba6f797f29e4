"""Writing several values as one operation: checked before the first is sent, in the map's order, verified, undone."""

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
from regscribe_runtime.operations.session import Operation, Pause, Session, Task
from regscribe_runtime.operations.transaction import Transaction
from regscribe_runtime.operations.write_order import batches
from regscribe_runtime.operations.write_plan import Assignment, Present, intend, look, wanted, words_of_wanted
from regscribe_runtime.operations.write_request import EEPROM
from regscribe_runtime.report import Change, Fate, Sent, Teller, WriteReport


class ConfigureOptions(TypedDict, total=False):
    """How to configure.

    `verify` (default True) reads back what the device keeps. `undo` (default True) gives back what was written if the
    operation breaks off; without it, what was written stays. `confirm` is needed if a write is dangerous. `rounded`
    allows values finer than the device can hold. `dry_run` writes nothing: the report says what would be written.
    `tell` is called before each request; an exception that it raises breaks the operation off.
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
        targets = wanted(session, values)
        work = Transaction(session, tell)
        sight = yield from look(session, targets)
        state = dict(sight.state)
        changes = intend(session, targets, sight, rounded=rounded, confirm=confirm)
        if dry_run:
            _foresee(session, work, changes)
            return work.report(dry_run=True)
        work.plan(changes)  # all of it is known, whatever comes of it
        steps = _Steps(session, work, targets, rounded=rounded, verify=verify)
        try:
            try:
                yield from steps.all(sight._replace(state=state))
            except GeneratorExit:
                raise
            except BaseException as error:  # noqa: BLE001 (raised again, with what became of everything)
                yield from _broken(work, error, undo=undo)
        except GeneratorExit:  # cancelled, or Ctrl-C while a request was under way: nothing can be sent any more
            session.broken_off = work.report()
            raise
        finally:
            session.forget()
        _spare(session, work)
        return work.report()

    return task


class _Steps:
    """The writes of a `configure`, phase by phase: a unit of measure that changes ends a phase."""

    def __init__(
        self, session: Session, work: Transaction, targets: Sequence[Assignment], *, rounded: bool, verify: bool
    ) -> None:
        self.session, self.work, self.rounded, self.verify = session, work, rounded, verify
        self.left = [one for one in targets if not one.register.governs]
        self.line = [one for one in targets if one.register.governs]

    def all(self, sight: Present) -> Operation[None]:
        """Write, apply, verify; then what governs the line."""
        self.work.state = sight.state
        while self.left:
            phase = self._phase(sight)
            changes = intend(self.session, phase, sight, rounded=self.rounded)
            yield from self.work.write(self.work.plan(changes))
            self.left = self.left[len(phase) :]
            if self.left:
                yield Pause(max(one.register.settle for one in phase) / 1000)
                sight = yield from look(self.session, self.left)
                self.work.state = {**self.work.state, **sight.state}
                sight = sight._replace(state=self.work.state)
        for command in applies(self.work):
            yield from self.work.command(command)
        if self.verify:
            yield from self._verified()
        yield from self._govern()

    def _phase(self, sight: Present) -> list[Assignment]:
        """What is left up to the first unit of measure that really changes, that one included."""
        found: list[Assignment] = []
        for one in self.left:
            found.append(one)
            if one.register.rescales and self._changes(one, sight):
                break
        return found

    def _changes(self, one: Assignment, sight: Present) -> bool:
        words = words_of_wanted(self.session, one, sight, rounded=self.rounded)
        return sight.words.get(one.register.path) != words

    def _verified(self) -> Operation[None]:
        if wrong := (yield from self.work.verify()):
            shown = "; ".join(self.work.shown(path) for path in wrong)
            message = f"the device changed or ignored values: {shown}"
            raise RegscribeError(message)

    def _govern(self) -> Operation[None]:
        for one in self.line:
            sight = yield from look(self.session, [one])
            (change,) = intend(self.session, [one], sight, rounded=self.rounded)
            self.work.plan([change])
            if change.fate is Fate.EQUAL:
                continue
            try:
                yield from follow(self.session, (one.register, one.view), change.sent, sight.state)
            except GeneratorExit:
                self.work.mark(change.register, Fate.UNKNOWN)
                raise
            except RegscribeError as error:
                self.work.mark(change.register, _fate(error))
                raise
            self.work.mark(change.register, Fate.WRITTEN)


def _fate(error: RegscribeError) -> Fate:
    """What an error of `follow` says of the register."""
    if isinstance(error, (NotWritten, ValueRefused, ExceptionAnswer)):
        return Fate.NOT_WRITTEN
    return Fate.DIFFERS if isinstance(error, ReadBackDiffers) else Fate.UNKNOWN


def applies(work: Transaction) -> list[str]:
    """The commands that make what was written take effect, each once."""
    written = work.paths(Fate.WRITTEN, Fate.DIFFERS, Fate.UNKNOWN)
    names = (work.register(path).apply for path in written if not work.register(path).governs)
    return [name for name in dict.fromkeys(names) if name]


def _foresee(session: Session, work: Transaction, changes: Sequence[Change]) -> None:
    """The requests and commands of a dry run."""
    pieces = work.plan(changes)
    for batch in batches(session, pieces):
        unlock = batch.pieces[0].register.unlock
        if unlock and unlock not in work.unlocked:
            work.unlocked.add(unlock)
            work.requests.append(Sent(0, 0, (), (), unlock))
        request, paths = batch.request, tuple(piece.path for piece in batch.pieces)
        work.requests.append(Sent(request.function, request.address, request.words, paths))
    names = dict.fromkeys(piece.register.apply for piece in pieces)
    work.requests += [Sent(0, 0, (), (), name) for name in names if name]


def _broken(work: Transaction, error: BaseException, *, undo: bool) -> Operation[None]:
    """Undo what was written, if that is wanted, and say what became of everything."""
    ran = {name for name, fate in work.report().commands.items() if fate is not Fate.NOT_WRITTEN}
    applied = [name for name in applies(work) if name in ran]
    if undo and not isinstance(error, LeftAt):  # nobody is there to undo anything
        yield from work.undo(applied)
    raise NotConfigured(str(error) or type(error).__name__, work.report()) from error


def _spare(session: Session, work: Transaction) -> None:
    for path in work.paths(Fate.EQUAL):
        if work.register(path).persistence in EEPROM:
            session.wear.add(path, spared=1)
