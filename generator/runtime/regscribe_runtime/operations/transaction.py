"""Several writes as one operation: sent in order, the fate of each recorded, and undone after an error."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from contextlib import suppress
from typing import Any

from regscribe_runtime.errors import ExceptionAnswer, PartialWrite, RegscribeError, is_lost
from regscribe_runtime.operations.read_back import (
    RegisterWrite,
    Target,
    keeps,
    look_back,
    settling_seconds,
    words_of,
)
from regscribe_runtime.operations.session import Operation, Pause, Session
from regscribe_runtime.operations.write_order import Batch, batches
from regscribe_runtime.operations.write_request import EEPROM, run
from regscribe_runtime.report import Change, Fate, Progress, Sent, Teller, Words, WriteReport
from regscribe_runtime.wire.requests import Request

TOUCHED = frozenset({Fate.WRITTEN, Fate.DIFFERS, Fate.UNKNOWN})
"""Fates of registers that may hold something else than before."""


class Transaction:
    """The changes, requests and commands of a `configure`, with the fate of each."""

    def __init__(self, session: Session, tell: Teller | None) -> None:
        self.session, self.tell = session, tell
        self.changes: dict[str, Change] = {}
        self.first: dict[str, Change] = {}
        self.state: dict[str, Any] = {}
        self.requests: list[Sent] = []
        self.unlocked: set[str] = set()

    # --- records

    def report(self, *, dry_run: bool = False) -> WriteReport:
        """The report of what is known now; what was not reached was not written."""
        left = Fate.PLANNED if dry_run else Fate.NOT_WRITTEN
        original = [
            one._replace(before=self.first[path].before, was=self.first[path].was) for path, one in self.changes.items()
        ]
        changes = [one._replace(fate=left) if one.fate is Fate.PLANNED else one for one in original]
        requests = [one._replace(fate=left) if one.fate is Fate.PLANNED else one for one in self.requests]
        return WriteReport(tuple(changes), tuple(requests), dry_run)

    def plan(self, changes: Iterable[Change]) -> list[RegisterWrite]:
        """Record changes; the writes of those that are no equal values."""
        for change in changes:
            self.changes[change.register] = change
            self.first.setdefault(change.register, change)
        return [self.write_of(change.register, change.sent) for change in changes if change.fate is Fate.PLANNED]

    def mark(self, path: str, fate: Fate, read: Words | None = None) -> None:
        """Record the fate of a register, and the words that were read back."""
        change = self.changes[path]
        self.changes[path] = change._replace(fate=fate, read=change.read if read is None else read)

    def paths(self, *fates: Fate) -> list[str]:
        """The registers with one of these fates, in the order of writing."""
        return [path for path, change in self.changes.items() if change.fate in fates]

    def target(self, path: str) -> Target:
        """A register and the view in which it is written."""
        register = self.session.registers[path]
        return register, register.view(self.changes[path].view)

    def write_of(self, path: str, words: Words) -> RegisterWrite:
        """The write of words to a register."""
        return RegisterWrite(*self.target(path), words, self.state)

    # --- sending

    def write(self, pieces: Sequence[RegisterWrite]) -> Operation[None]:
        """Send pieces in their order, with the commands that unlock; raises the first error."""
        for batch in batches(self.session, pieces):
            self._tell(batch.pieces[0].path)
            yield from self._unlock(batch.pieces[0].register.unlock)
            yield from self._send(batch)

    def _tell(self, what: str) -> None:
        if self.tell is not None:
            planned = len(self.paths(Fate.PLANNED))
            self.tell(Progress(len(self.changes) - planned, len(self.changes), what))

    def _unlock(self, command: str) -> Operation[None]:
        if command and command not in self.unlocked:
            self.unlocked.add(command)
            yield from self.command(command)

    def command(self, name: str) -> Operation[None]:
        """Run a command that unlocks or applies, and record its fate."""
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
            self._record(batch)
            raise
        except RegscribeError as error:
            yield from self._judge(batch, error)
            if self._record(batch) is not Fate.WRITTEN:
                raise
        else:
            self._mark_all(batch, Fate.WRITTEN)
            self._record(batch)
        finally:
            self._after(batch)

    def _after(self, batch: Batch) -> None:
        """Count the wear of a request that was sent, and forget what it may have changed."""
        self.session.forget()
        for piece in batch.pieces:
            if piece.register.persistence in EEPROM:
                self.session.wear.add(piece.path, written=1)

    def _mark_all(self, batch: Batch, fate: Fate) -> None:
        for piece in batch.pieces:
            self.mark(piece.path, fate)

    def _record(self, batch: Batch) -> Fate:
        """Record a request and return its fate, which is that of its values if they share one."""
        request, paths = batch.request, tuple(piece.path for piece in batch.pieces)
        fates = {self.changes[path].fate for path in paths}
        fate = fates.pop() if len(fates) == 1 else Fate.UNKNOWN
        self.requests += self.sent(request, paths, fate)
        return fate

    def sent(self, request: Request, paths: tuple[str, ...], fate: Fate = Fate.PLANNED) -> list[Sent]:
        """The records of a request that writes registers: more than one where it goes out in portions."""
        each = self.session.portions(request)
        return [Sent(one.function, one.address, one.words, paths, fate=fate) for one in each]

    def _judge(self, batch: Batch, error: RegscribeError) -> Operation[None]:
        """Find the fate of the values of a request that ended in an error."""
        self._mark_all(batch, Fate.UNKNOWN)
        if isinstance(error, PartialWrite):
            written = error.written
            for piece in batch.pieces:
                count = len(piece.words)
                whole = Fate.WRITTEN if written >= count else Fate.NOT_WRITTEN
                self.mark(piece.path, Fate.UNKNOWN if 0 < written < count else whole)
                written -= count
        elif len(batch.pieces) == 1 and not is_lost(error):
            self.mark(batch.pieces[0].path, Fate.NOT_WRITTEN)
        else:
            yield from self.settle([piece.path for piece in batch.pieces], error)

    # --- reading back

    def settle(self, paths: Sequence[str], after: Exception) -> Operation[None]:
        """Read registers back and record the fates that this shows; one that cannot be read keeps its own."""
        targets = [self.target(path) for path in paths if self.session.registers[path].can_be_checked]
        found = (yield from look_back(self.session, targets, after)) if targets else None
        for path, words in (found or {}).items():
            self._mark_held(path, words)

    def _mark_held(self, path: str, words: Words) -> None:
        change = self.changes[path]
        fate = Fate.UNKNOWN
        if self._holds(path, words, change.sent):
            fate = Fate.WRITTEN
        elif any(self._holds(path, words, before) for before in (self.first[path].before, change.before)):
            fate = Fate.NOT_WRITTEN
        self.mark(path, fate, words)

    def _holds(self, path: str, read: Words, written: Words | None) -> bool:
        return written is not None and self.write_of(path, written).matches(read, self.session)

    def verify(self) -> Operation[tuple[str, ...]]:
        """Read back what was written and the device keeps; the registers that hold something else."""
        targets = [self.target(path) for path in self.paths(Fate.WRITTEN)]
        targets = [one for one in targets if one[0].can_be_checked and keeps(one[0])]
        if not targets:
            return ()
        yield Pause(settling_seconds(self.session, targets))
        found = yield from words_of(self.session, targets)
        for path, words in found.items():
            good = self._holds(path, words, self.changes[path].sent)
            self.mark(path, Fate.WRITTEN if good else Fate.DIFFERS, words)
        return tuple(self.paths(Fate.DIFFERS))

    def shown(self, path: str) -> str:
        """What was sent to a register and what it holds, in words."""
        change = self.changes[path]
        held, read = self.write_of(path, change.sent).held(change.read, self.session), list(change.read or ())
        return f"{path} holds {held!r} (words {read}), sent was {change.value!r} ({list(change.sent)})"

    # --- undoing

    def undo(self, applied: Sequence[str]) -> Operation[None]:
        """Write back what the registers held, the last one first, then run the commands `applied` once more.

        What governs the line is left as it is: the driver talks that way now.
        """
        touched = [path for path in self.paths(*TOUCHED) if not self.session.registers[path].governs]
        self.unlocked.clear()
        try:
            for path in reversed(touched):
                yield from self._restore(path, self.changes[path].before)
            for command in applied:
                yield from self.command(command)
            yield from self._check_restored(touched)
        except RegscribeError as error:  # what was not reached is as it was before
            yield from self.settle(touched, error)
            self._mark_restored(touched)

    def _restore(self, path: str, words: Words | None) -> Operation[None]:
        if words is None:
            return
        with suppress(BaseException):  # the caller cannot break off an undoing
            self._tell(f"undo {path}")
        yield from self._unlock(self.session.registers[path].unlock)
        for batch in batches(self.session, [self.write_of(path, words)]):
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
                if found is None or not self._holds(path, found[path], words):
                    raise
            finally:
                self._after(batch)
            self.mark(path, Fate.RESTORED, words)

    def _check_restored(self, touched: Sequence[str]) -> Operation[None]:
        """Read all back; what the device converted on the way (a unit of measure) is written back once more."""
        first = {path: before for path in touched if (before := self.first[path].before) is not None}
        targets = [self.target(path) for path in first]
        found = yield from words_of(self.session, targets)
        wrong = [path for path, words in found.items() if not self._holds(path, words, first[path])]
        for path in wrong:
            yield from self._restore(path, first[path])
        if wrong:
            found = yield from words_of(self.session, targets)
        for path, words in found.items():
            self._mark_held(path, words)
        self._mark_restored(found)

    def _mark_restored(self, paths: Iterable[str]) -> None:
        for path in paths:
            if self.changes[path].fate is Fate.NOT_WRITTEN:
                self.mark(path, Fate.RESTORED)
