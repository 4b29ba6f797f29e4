"""Settings that travel: read from a device into a file, compared, and written back to it or to another.

Operations are tasks for both kinds of driver: `device.run(backup(type(device)))`, awaited for an asyncio driver.
"""

from regscribe.tools.settings.backup import Backup, BackupError, BackupOrigin, Saved, UnfitError
from regscribe.tools.settings.backup_file import load, save, to_text
from regscribe.tools.settings.compare import SettingDifference, Side, differences, side
from regscribe.tools.settings.compatibility import KINDS, BackupFit, Misfit, fit
from regscribe.tools.settings.factory import factory
from regscribe.tools.settings.restore import Restored, restore
from regscribe.tools.settings.take import backup, saved

__all__ = [
    "KINDS",
    "Backup",
    "BackupError",
    "BackupFit",
    "BackupOrigin",
    "Misfit",
    "Restored",
    "Saved",
    "SettingDifference",
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
