"""Writes a backup back: checked as a whole first, in the map's order, only what differs, resumable after a break."""

from collections.abc import Collection, Iterable, Mapping
from typing import Any, NamedTuple

from regscribe.tools.live.names import Driver
from regscribe.tools.live.reading import shown_needs, unit_needs
from regscribe.tools.settings.backup import Backup, Saved, UnfitError
from regscribe.tools.settings.compatibility import BackupFit, Misfit, fit, staying
from regscribe.tools.settings.take import read_saved, writable
from regscribe_runtime import NotConfigured, Register, ValueRefused
from regscribe_runtime.errors import ValuesRefused
from regscribe_runtime.operations import tasks
from regscribe_runtime.operations.session import Operation, Session, Task
from regscribe_runtime.report import Change, Fate, Teller, Words, WriteReport

MOST_NAMED = 8
"""Misfits that a message lists before it says how many more there are."""


class Restored(NamedTuple):
    """The result of a restore or its dry run: how the file fits, and the fate of each value."""

    fit: BackupFit
    report: WriteReport


def restore(
    driver: Driver,
    backup: Backup,
    *,
    include: Collection[str] = (),
    partial: bool = False,
    dry_run: bool = False,
    confirm: bool = False,
    tell: Teller | None = None,
) -> Task[Restored]:
    """Bring a device to the settings of a backup.

    Settings that stay with their device are left out unless `include` names their kind. A file of another model or map,
    and one with values that the device cannot take, is refused (UnfitError) unless `partial`: then what fits is
    written. What the device holds already is not written; all is verified. Nothing is undone when it breaks off
    (NotConfigured says what was written): run again, it resumes.
    """

    def task(session: Session) -> Operation[Restored]:
        state, held = yield from _present(session, driver, backup, include)
        found = fit(backup, driver, state=state, givens=session.givens, include=include, held=held)
        if not partial:
            _refuse(found, other_map=backup.origin.map_id != driver.map_id)
        while True:
            try:
                report = yield from tasks.configure(
                    found.values, verify=True, undo=False, confirm=confirm, dry_run=dry_run, tell=tell
                )(session)
                break
            except ValueRefused as refusal:
                if not partial:
                    raise
                found = _without(found, refusal)
            except NotConfigured as error:
                raise NotConfigured(error.why, _beside(held, error.report)) from error.__cause__
        if not dry_run:
            yield from _in_effect(session, (*held, *found.values), report)
        return Restored(found, _beside(held, report))

    return task


def _present(
    session: Session, driver: Driver, backup: Backup, include: Collection[str]
) -> Operation[tuple[dict[str, Any], dict[str, Change]]]:
    """Read the values that units and scales of settings depend on, and which settings the device holds already."""
    stays = staying(backup, driver, include)
    wanted = {path: saved for path, saved in backup.settings() if path not in stays}
    asked = [one for one in writable(driver) if one.path in wanted]
    needed = {path for one in asked for path in (*unit_needs(one), *one.needs(one.read_view()))}
    state, present = yield from read_saved(asked, lambda one: (*shown_needs(one), *one.needs(one.read_view())))(session)
    held = _held(driver, wanted, present)
    known = {path: value for path, value in state.items() if path in needed or path in held}
    return known, {path: _equal(driver.registers[path], present[path].raw, state.get(path)) for path in held}


def _held(driver: Driver, wanted: Mapping[str, Saved], present: Mapping[str, Saved]) -> list[str]:
    """The settings whose words and value are those of the file, and stay so while the others are written."""
    same = {path for path, saved in wanted.items() if path in present and _same(saved, present[path])}
    while left := {path for path in same if not wanted.keys().isdisjoint(_deciding(driver.registers[path]) - same)}:
        same -= left
    return [path for path in wanted if path in same]


def _same(saved: Saved, present: Saved) -> bool:
    """Whether the words are those of the file and mean the same: a value, or none for the same reason."""
    return bool(saved.raw) and _meaning(saved) == _meaning(present)


def _meaning(saved: Saved) -> tuple[object, ...]:
    return saved.raw, saved.value, saved.unit, saved.error


def _deciding(register: Register[Any]) -> set[str]:
    """The registers that decide where a register stands, whether it exists, what its words mean, and its unit."""
    needs = register.needs(register.read_view())
    return {*needs, *shown_needs(register), *register.when.registers, *register.counters}


def _beside(held: Mapping[str, Change], report: WriteReport) -> WriteReport:
    return report._replace(changes=(*held.values(), *report.changes))


def _equal(register: Register[Any], words: Words, value: object) -> Change:
    return Change(register.path, register.read_view().name, words, words, value, value, Fate.EQUAL)


def _refuse(found: BackupFit, *, other_map: bool) -> None:
    if not found.strange and not found.misfits:
        return
    lines = list(found.strange[:1] if other_map else found.strange)
    if not other_map:  # from which all else follows
        lines += [f"{one.path}: {one.reason}" for one in found.misfits[:MOST_NAMED]]
        if len(found.misfits) > MOST_NAMED:
            lines.append(f"and {len(found.misfits) - MOST_NAMED} more that do not fit")
    fit = "1 setting fits: restore it" if len(found.values) == 1 else f"{len(found.values)} settings fit: restore those"
    lines.append(f"{fit} with `partial`, after a look at the plan (dry run)" if found.values else "no setting fits")
    raise UnfitError("\n".join(lines))


def _without(found: BackupFit, refusal: ValueRefused) -> BackupFit:
    """The fit without the values that the device cannot take now."""
    refused = refusal.refusals if isinstance(refusal, ValuesRefused) else (refusal,)
    gone = {one.register: one.reason for one in refused if one.register in found.values}
    if not gone:
        raise refusal
    values = {path: value for path, value in found.values.items() if path not in gone}
    return found._replace(values=values, misfits=(*found.misfits, *(Misfit(*one) for one in gone.items())))


def _in_effect(session: Session, paths: Iterable[str], report: WriteReport) -> Operation[None]:
    """Run the commands that make settings take effect, if an earlier attempt broke off before them."""
    for name in dict.fromkeys(session.registers[path].apply for path in paths):
        if name and name not in report.commands:
            yield from tasks.run(session.commands[name], confirm=True)(session)
