"""Shared by the commands about settings: a backup or a device as the source, restoring, and its result."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple

import click

from regscribe.cli.shared.diagnostic_text import count
from regscribe.cli.shared.exit_codes import REFUSED, UNKNOWN_STATE, USAGE
from regscribe.cli.shared.failure import Failure
from regscribe.cli.shared.live_report import reported
from regscribe.cli.shared.long_work import Shield, progress
from regscribe.cli.shared.output import alert, detail, remark, show_table
from regscribe.cli.shared.standard_input import is_stdin
from regscribe.cli.shared.target_options import opened
from regscribe.tools import settings
from regscribe.tools.live.target import named
from regscribe.tools.live.value_text import as_text
from regscribe_runtime import BareDevice, NotConfigured
from regscribe_runtime.report import Change, Fate, Progress

include_option = click.option(
    "--include",
    multiple=True,
    type=click.Choice(settings.KINDS),
    help="Also settings that belong to one device alone, of this kind. Repeat for several.",
)


@contextmanager
def settings_reported() -> Iterator[None]:
    """Turn errors of settings into a `Failure`; others pass."""
    try:
        yield
    except settings.UnfitError as error:
        raise Failure(str(error), kind="does-not-fit", code=REFUSED) from None
    except settings.BackupError as error:
        raise Failure(str(error), kind="backup", code=USAGE) from None
    except NotConfigured as error:
        message = f"{error}\nRun the same command again: it goes on where this one was."
        raise Failure(message, kind="broken-off", code=UNKNOWN_STATE) from None


class RestoreOptions(NamedTuple):
    """How settings are written."""

    include: tuple[str, ...]
    partial: bool
    dry_run: bool
    confirm: bool


def restored(
    label: str, device: BareDevice, backup: settings.Backup, options: RestoreOptions, shield: Shield
) -> settings.Restored:
    """Write settings behind a progress bar and report errors; Ctrl-C breaks off between two requests."""
    with settings_reported(), progress(sum(1 for _ in backup.settings()), label) as advance:

        def tell(state: Progress) -> None:
            if shield.interrupted:
                message = "stopped by Ctrl-C"
                raise KeyboardInterrupt(message)
            advance(f"{state.done} of {state.total}: {state.what}")

        return device.run(settings.restore(type(device), backup, tell=tell, **options._asdict()))


def loaded(path: Path) -> settings.Backup:
    """The backup in a file. Raises Failure."""
    with settings_reported():
        found = settings.load(path)
        detail(f"read {path}")
        return found


def taken(device: BareDevice, link: str) -> settings.Backup:
    """The settings of an open device."""
    with settings_reported():
        return device.run(settings.backup(type(device), link=link))


def backup_of(text: str, packages: tuple[str, ...], config: str | None) -> tuple[settings.Backup, str]:
    """The settings of the backup file or of the device that `text` names, and the name of the file or device."""
    if is_stdin(text) or text.endswith((".yaml", ".yml")) or Path(text).is_file():
        return loaded(Path(text)), text
    with reported():
        target = named(text, config, packages)
    with opened(target, identity=True) as device:
        return taken(device, str(target.link)), str(target)


def show_restored(device: BareDevice, done: settings.Restored, *, dry_run: bool) -> None:
    """Print a table of what was written (or would be), and remarks on what was equal, left out, or does not fit."""
    changes = [_plain_change(device, one) for one in done.report.changes if one.fate is not Fate.EQUAL]
    rows = [["?" if text is None else text for text in one.values()] for one in changes]
    show_table(("REGISTER", "BEFORE", "AFTER", ""), rows)
    for line in done.fit.strange:
        alert(line)
    for misfit in done.fit.misfits:
        alert(f"left out: {misfit.path}: {misfit.reason}")
    written = len(done.report.changes) - len(done.report.equal)
    verb = "would be written" if dry_run else "written"
    many = len(done.fit.stays)
    stays = f", {many} {'stays' if many == 1 else 'stay'} with {'its' if many == 1 else 'their'} device" if many else ""
    remark(f"{count(written, 'setting')} {verb}, {len(done.report.equal)} held already{stays}")


def plain_restored(device: BareDevice, done: settings.Restored) -> dict[str, Any]:
    """What became of each setting, in JSON."""
    return {
        "changes": [_plain_change(device, one) for one in done.report.changes],
        "stays": dict(done.fit.stays),
        "does_not_fit": {one.path: one.reason for one in done.fit.misfits},
        "differs": list(done.fit.strange),
    }


def _plain_change(device: BareDevice, change: Change) -> dict[str, str | None]:
    register = device.registers[change.register]
    return {
        "register": change.register,
        "before": None if change.was is None else as_text(register, change.was),
        "after": "?" if change.value is None else as_text(register, change.value),
        "fate": str(change.fate),
    }
