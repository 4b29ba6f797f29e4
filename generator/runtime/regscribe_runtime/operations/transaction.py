"""Several writes as one operation: sent in their order, known of each what became of it, and undone if they break."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from regscribe_runtime.errors import ExceptionAnswer, PartialWrite, RegscribeError
from regscribe_runtime.operations.read_back import Target, is_lost, look_back, meaning, rest, same, steady, words_of
from regscribe_runtime.operations.session import Operation, Pause, Session
from regscribe_runtime.operations.write_order import Batch, RegisterWrite, batches
from regscribe_runtime.operations.write_request import EEPROM, run
from regscribe_runtime.registers.register import Register
from regscribe_runtime.report import Change, Fate, Progress, Sent, Teller, Words, WriteReport
from regscribe_runtime.values.kinds import Access

TOUCHED = frozenset({Fate.WRITTEN, Fate.DIFFERS, Fate.UNKNOWN})
"""Fates of registers that may hold something else than before."""


class Transaction:
    """What is known of a `configure` under way."""

    def __init__(self, session: Session, tell: Teller | None) -> None:
        self.session, self.tell = session, tell
        self.changes: dict[str, Change] = {}
        self.first: dict[str, Change] = {}
        self.state: dict[str, Any] = {}
        self.requests: list[Sent] = []
        self.unlocked: set[str] = set()
        self.cause: BaseException | None = None

    # --- what is known

    def report(self, *, dry_run: bool = False) -> WriteReport:
        """The report of what is known now; what was not reached was not written."""
        left = Fate.PLANNED if dry_run else Fate.NOT_WRITTEN
        told = [
            one._replace(before=self.first[path].before, was=self.first[path].was) for path, one in self.changes.items()
        ]
        changes = [one._replace(fate=left) if one.fate is Fate.PLANNED else one for one in told]
        requests = [one._replace(fate=left) if one.fate is Fate.PLANNED else one for one in self.requests]
        return WriteReport(tuple(changes), tuple(requests), dry_run)

    def plan(self, changes: Iterable[Change]) -> list[RegisterWrite]:
        """Take note of changes; the pieces of those that are no equal values."""
        for change in changes:
            self.changes[change.register] = change
            self.first.setdefault(change.register, change)
        return [self._piece(change, change.sent) for change in changes if change.fate is Fate.PLANNED]

    def mark(self, path: str, fate: Fate, read: Words | None = None) -> None:
        """A register has this fate now."""
        change = self.changes[path]
        self.changes[path] = change._replace(fate=fate, read=change.read if read is None else read)

    def paths(self, *fates: Fate) -> list[str]:
        """The registers with one of these fates, in the order of writing."""
        return [path for path, change in self.changes.items() if change.fate in fates]

    def target(self, path: str) -> Target:
        """A register and the view in which it is written."""
        register = self.register(path)
        return register, register.view(self.changes[path].view)

    def register(self, path: str) -> Register[Any]:
        """A register by its path."""
        found: Register[Any] = self.session.registers[path]
        return found

    def _piece(self, change: Change, words: Words) -> RegisterWrite:
        register = self.register(change.register)
        return RegisterWrite(register, register.view(change.view), words)  # pyright: ignore[reportArgumentType] # a register is a descriptor, but no attribute of this tuple

    # --- sending

    def write(self, pieces: Sequence[RegisterWrite]) -> Operation[None]:
        """Send pieces in their order, unlocking where that is needed; the error of the first that fails."""
        for batch in batches(self.session, pieces):
            self._told(batch.pieces[0].path)
            yield from self._unlock(batch.pieces[0].register.unlock)
            yield from self._send(batch)

    def _told(self, what: str) -> None:
        if self.tell is not None:
            planned = len(self.paths(Fate.PLANNED))
            self.tell(Progress(len(self.changes) - planned, len(self.changes), what))

    def _unlock(self, command: str) -> Operation[None]:
        if command and command not in self.unlocked:
            self.unlocked.add(command)
            yield from self.command(command)

    def command(self, name: str) -> Operation[None]:
        """Run a command that unlocks or applies, and take note of it."""
        fate = Fate.UNKNOWN
        try:
            yield from run(self.session.commands[name], confirm=True)(self.session)
            fate = Fate.WRITTEN
        except ExceptionAnswer:
            fate = Fate.NOT_WRITTEN
            raise
        finally:
            self.requests.append(Sent(0, 0, (), (), name, fate))

    def _send(self, batch: Batch) -> Operation[None]:
        try:
            yield from self.session.exchange(batch.request)
        except GeneratorExit:  # cancelled while the request was under way
            self._mark_all(batch, Fate.UNKNOWN)
            self._note(batch)
            raise
        except RegscribeError as error:
            yield from self._judge(batch, error)
            if self._note(batch) is not Fate.WRITTEN:
                raise
        else:
            self._mark_all(batch, Fate.WRITTEN)
            self._note(batch)
        finally:
            self.session.forget()
            for piece in batch.pieces:
                if piece.register.persistence in EEPROM:
                    self.session.wear.add(piece.path, written=1)

    def _mark_all(self, batch: Batch, fate: Fate) -> None:
        for piece in batch.pieces:
            self.mark(piece.path, fate)

    def _note(self, batch: Batch) -> Fate:
        """Take note of a request and return its fate, which is that of its values if they share one."""
        request, paths = batch.request, tuple(piece.path for piece in batch.pieces)
        fates = {self.changes[path].fate for path in paths}
        fate = fates.pop() if len(fates) == 1 else Fate.UNKNOWN
        self.requests.append(Sent(request.function, request.address, request.words, paths, fate=fate))
        return fate

    def _judge(self, batch: Batch, error: RegscribeError) -> Operation[None]:
        """What became of the values of a request that was not answered well."""
        self._mark_all(batch, Fate.UNKNOWN)
        if isinstance(error, PartialWrite):
            self._count(batch, error.written)
        elif len(batch.pieces) == 1 and not is_lost(error):
            self.mark(batch.pieces[0].path, Fate.NOT_WRITTEN)
        else:
            yield from self.settle([piece.path for piece in batch.pieces], error)

    def _count(self, batch: Batch, written: int) -> None:
        for piece in batch.pieces:
            written -= len(piece.words)
            if written > -len(piece.words):  # part of it, or all
                self.mark(piece.path, Fate.WRITTEN if written >= 0 else Fate.UNKNOWN)
            else:
                self.mark(piece.path, Fate.NOT_WRITTEN)

    # --- reading back

    def settle(self, paths: Sequence[str], after: Exception) -> Operation[None]:
        """Read registers back and give each the fate that this shows; who cannot be read keeps the one it has."""
        targets = [self.target(path) for path in paths if self.register(path).access is Access.READ_WRITE]
        found = (yield from look_back(self.session, targets, after)) if targets else None
        for path, words in (found or {}).items():
            self._shows(path, words)

    def _shows(self, path: str, words: Words) -> None:
        change = self.changes[path]
        if self._is(path, words, change.sent):
            self.mark(path, Fate.WRITTEN, words)
        elif any(self._is(path, words, before) for before in (self.first[path].before, change.before)):
            self.mark(path, Fate.NOT_WRITTEN, words)
        else:
            self.mark(path, Fate.UNKNOWN, words)

    def _is(self, path: str, read: Words, written: Words | None) -> bool:
        """Whether what was read back is what these words would set."""
        return written is not None and same(*self.target(path), read, written, self.state, self.session)

    def verify(self) -> Operation[tuple[str, ...]]:
        """Read back all that was written and that the device keeps; the registers that hold something else."""
        paths = [path for path in self.paths(Fate.WRITTEN) if self._can_be_verified(path)]
        if not paths:
            return ()
        targets = [self.target(path) for path in paths]
        yield Pause(rest(self.session, targets))
        found = yield from words_of(self.session, targets)
        for path, words in found.items():
            alike = self._is(path, words, self.changes[path].sent)
            self.mark(path, Fate.WRITTEN if alike else Fate.DIFFERS, words)
        return tuple(self.paths(Fate.DIFFERS))

    def _can_be_verified(self, path: str) -> bool:
        register = self.register(path)
        return register.access is Access.READ_WRITE and steady(register)

    def shown(self, path: str) -> str:
        """What was sent to a register and what it holds, in words."""
        change, (register, view) = self.changes[path], self.target(path)
        held = meaning(register, register.seen_in(view), change.read, self.state, self.session)
        return (
            f"{path} holds {held!r} (words {list(change.read or ())}), sent was {change.value!r} ({list(change.sent)})"
        )

    # --- undoing

    def undo(self, applied: Sequence[str]) -> Operation[None]:
        """Give back what the registers held, the last one first; `applied` are commands to run once more then.

        What governs the line is left as it is: the driver talks that way now.
        """
        touched = [path for path in self.paths(*TOUCHED) if not self.register(path).governs]
        self.unlocked.clear()
        try:
            for path in reversed(touched):
                yield from self._give_back(path, self.changes[path].before)
            for command in applied:
                yield from self.command(command)
            yield from self._undone(touched)
        except RegscribeError as error:  # what was not reached is as it was before
            yield from self.settle(touched, error)
            for path in touched:
                self._undone_one(path)

    def _give_back(self, path: str, words: Words | None) -> Operation[None]:
        if words is None:
            return
        self._told_quietly(path)
        yield from self._unlock(self.register(path).unlock)
        for batch in batches(self.session, [self._piece(self.changes[path], words)]):
            try:
                yield from self.session.exchange(batch.request)
            except GeneratorExit:
                self.mark(path, Fate.UNKNOWN)
                raise
            except RegscribeError as error:
                if not is_lost(error):
                    raise
                self.mark(path, Fate.UNKNOWN)
                found = yield from look_back(self.session, [self.target(path)], error)
                if found is None or not self._is(path, found[path], words):
                    raise
            finally:
                self.session.forget()
            self.mark(path, Fate.RESTORED, words)

    def _told_quietly(self, what: str) -> None:
        """Tell of progress; who breaks off an undoing is not heard."""
        try:
            self._told(f"undo {what}")
        except BaseException as error:  # noqa: BLE001 (the caller's: it has broken off already)
            self.cause = self.cause or error

    def _undone(self, touched: Sequence[str]) -> Operation[None]:
        """Read all back; what the device converted on the way (a unit of measure) is given back once more."""
        first = {path: before for path in touched if (before := self.first[path].before) is not None}
        targets = [self.target(path) for path in first]
        found = yield from words_of(self.session, targets)
        wrong = [path for path, words in found.items() if not self._is(path, words, first[path])]
        for path in wrong:
            yield from self._give_back(path, first[path])
        if wrong:
            found = yield from words_of(self.session, targets)
        for path, words in found.items():
            self.mark(path, Fate.UNKNOWN, words)
            self._shows(path, words)
            self._undone_one(path)

    def _undone_one(self, path: str) -> None:
        if self.changes[path].fate is Fate.NOT_WRITTEN:
            self.mark(path, Fate.RESTORED)
