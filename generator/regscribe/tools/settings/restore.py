"""Writes a backup back: checked as a whole first, in the map's order, only what differs, resumable after a break."""

from collections.abc import Collection, Mapping
from typing import Any, NamedTuple

from regscribe.tools.live.names import Driver
from regscribe.tools.live.reading import unit_needs
from regscribe.tools.settings.backup import Backup, UnfitError
from regscribe.tools.settings.compatibility import BackupFit, Misfit, fit
from regscribe.tools.settings.take import writable
from regscribe_runtime import ValueRefused
from regscribe_runtime.errors import ValuesRefused
from regscribe_runtime.operations import tasks
from regscribe_runtime.operations.session import Operation, Session, Task
from regscribe_runtime.report import Teller, WriteReport

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
        state = yield from _present(session, driver)
        found = fit(backup, driver, state=state, givens=session.givens, include=include)
        if not partial:
            _refuse(found)
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
        if not dry_run:
            yield from _in_effect(session, found.values, report)
        return Restored(found, report)

    return task


def _present(session: Session, driver: Driver) -> Operation[dict[str, Any]]:
    """Read the values that units and scales of settings depend on."""
    paths: dict[str, None] = {}
    for register in writable(driver):
        paths.update(dict.fromkeys((*unit_needs(register), *register.needs(register.read_view()))))
    snapshot = yield from tasks.read_many([session.registers[path] for path in paths])(session)
    return snapshot.valid


def _refuse(found: BackupFit) -> None:
    if not found.strange and not found.misfits:
        return
    lines = [*found.strange, *(f"{one.path}: {one.reason}" for one in found.misfits[:MOST_NAMED])]
    if len(found.misfits) > MOST_NAMED:
        lines.append(f"and {len(found.misfits) - MOST_NAMED} more that do not fit")
    lines.append(f"{len(found.values)} settings fit: restore those with `partial`, after a look at the plan (dry run)")
    raise UnfitError("\n".join(lines))


def _without(found: BackupFit, refusal: ValueRefused) -> BackupFit:
    """The fit without the values that the device cannot take now."""
    refused = refusal.refusals if isinstance(refusal, ValuesRefused) else (refusal,)
    gone = {one.register: one.reason for one in refused if one.register in found.values}
    if not gone:
        raise refusal
    values = {path: value for path, value in found.values.items() if path not in gone}
    return found._replace(values=values, misfits=(*found.misfits, *(Misfit(*one) for one in gone.items())))


def _in_effect(session: Session, values: Mapping[str, Any], report: WriteReport) -> Operation[None]:
    """Run the commands that make settings take effect, if an earlier attempt broke off before them."""
    for name in dict.fromkeys(session.registers[path].apply for path in values):
        if name and name not in report.commands:
            yield from tasks.run(session.commands[name], confirm=True)(session)
