"""Settings that travel: read from a device into a file, compared, and written back to it or to another.

Operations are tasks for both kinds of driver: `device.run(backup(type(device)))`, awaited for an asyncio driver.
"""

from regscribe.tools.settings.backup import Backup, BackupError, Saved, SettingDifference, Side, UnfitError, differences
from regscribe.tools.settings.backup_file import load, save, to_text
from regscribe.tools.settings.compatibility import KINDS
from regscribe.tools.settings.restore import Restored, restore
from regscribe.tools.settings.take import backup, factory

__all__ = [
    "KINDS",
    "Backup",
    "BackupError",
    "Restored",
    "Saved",
    "SettingDifference",
    "Side",
    "UnfitError",
    "backup",
    "differences",
    "factory",
    "load",
    "restore",
    "save",
    "to_text",
]
