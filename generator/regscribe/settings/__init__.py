"""Settings that travel: read from a device into a file, compared, and written back to it or to another.

Operations are tasks for both kinds of driver: `device.run(backup(type(device)))`, awaited for an asyncio driver.
"""

from regscribe.settings.differing import Difference, Side, differences, side
from regscribe.settings.factory import factory
from regscribe.settings.fitting import KINDS, Fit, Misfit, fit
from regscribe.settings.restoring import Restored, restore
from regscribe.settings.saved import Backup, BackupError, Origin, Saved, UnfitError
from regscribe.settings.taking import backup, saved
from regscribe.settings.text import load, save, to_text

__all__ = [
    "KINDS",
    "Backup",
    "BackupError",
    "Difference",
    "Fit",
    "Misfit",
    "Origin",
    "Restored",
    "Saved",
    "Side",
    "UnfitError",
    "backup",
    "differences",
    "factory",
    "fit",
    "load",
    "restore",
    "save",
    "saved",
    "side",
    "to_text",
]
