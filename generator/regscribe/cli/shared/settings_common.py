"""What the commands about settings share: errors, options, a bar while they write, and how they break off."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import click

from regscribe.cli.shared.error_report import REFUSED, UNKNOWN_STATE, USAGE, Failure
from regscribe.cli.shared.output import show_table
from regscribe.cli.shared.progress import Advance, progress
from regscribe.cli.shared.sigint import Shield
from regscribe.tools import settings
from regscribe.tools.live.value_text import as_text
from regscribe_runtime import BareDevice, NotConfigured
from regscribe_runtime.report import Change, Fate, Progress, Teller

include_option = click.option(
    "--include",
    multiple=True,
    type=click.Choice(settings.KINDS),
    help="Also settings that belong to one device alone, of this kind. Repeat for several.",
)
confirm_option = click.option("--confirm", is_flag=True, help="Write where the map calls it dangerous, too.")


class Stopped(KeyboardInterrupt):
    """Ctrl-C during a write, noticed between two requests: what was under way is finished, the rest is not begun."""


@contextmanager
def told() -> Iterator[None]:
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


@contextmanager
def telling(label: str, backup: settings.Backup, shield: Shield) -> Iterator[Teller]:
    """A bar while settings are written; Ctrl-C breaks off between two requests, a second one at once."""
    with progress(sum(1 for _ in backup.settings()), label) as advance:
        yield _teller(shield, advance)


def _teller(shield: Shield, advance: Advance) -> Teller:
    def tell(state: Progress) -> None:
        if shield.interrupted:
            message = "stopped by Ctrl-C"
            raise Stopped(message)
        advance(f"{state.done} of {state.total}: {state.what}")

    return tell


def loaded(path: Path) -> settings.Backup:
    """The backup in a file; Failure says what is wrong with it."""
    with told():
        return settings.load(path)


def taken(device: BareDevice, link: str) -> settings.Backup:
    """The settings of an open device."""
    return device.run(settings.backup(type(device), link=link))


def show_changes(device: BareDevice, changes: Sequence[Change], *, all_of_them: bool = False) -> None:
    """A table of what was, or would be, written: the value before and after, and what became of it."""
    rows = [
        (one.register, _value(device, one.register, one.was), _value(device, one.register, one.value), str(one.fate))
        for one in changes
        if all_of_them or one.fate is not Fate.EQUAL
    ]
    show_table(("REGISTER", "BEFORE", "AFTER", ""), rows)


def plain_change(device: BareDevice, change: Change) -> dict[str, Any]:
    """A change in JSON."""
    return {
        "register": change.register,
        "before": None if change.was is None else as_text(device.registers[change.register], change.was),
        "after": as_text(device.registers[change.register], change.value),
        "fate": str(change.fate),
    }


def is_file(text: str) -> bool:
    """Whether a text names a backup: it ends so, or there is a file of that name."""
    return text.endswith((".yaml", ".yml")) or Path(text).is_file()


def _value(device: BareDevice, path: str, value: Any) -> str:  # noqa: ANN401 - a value of any register
    return "?" if value is None else as_text(device.registers[path], value)
