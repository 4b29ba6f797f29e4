"""Differences between two sets of settings: of devices, backups, the manual's defaults."""

from collections.abc import Mapping
from typing import NamedTuple

from regscribe.tools.settings.backup import Backup, Saved


class Side(NamedTuple):
    """One of the two sets: its name, its map and model, and its settings by path."""

    name: str
    map_id: str
    model: str
    settings: Mapping[str, Saved]


class SettingDifference(NamedTuple):
    """A setting whose two values differ; None on the side that does not have it."""

    path: str
    left: Saved | None
    right: Saved | None


def side(backup: Backup, name: str) -> Side:
    """A backup as one side."""
    return Side(name, backup.origin.map_id, backup.origin.model, dict(backup.settings()))


def differences(left: Side, right: Side, *, stays: bool = False, missing: bool = True) -> tuple[SettingDifference, ...]:
    """The settings that differ, in the order of the left side, then those of the right side only.

    Without `stays`, what must not be copied to another device (address, calibration, ...) is not compared; without
    `missing`, neither is what one side does not have. Words are compared only where a value is missing: two models may
    transmit the same value in other words.
    """
    paths = dict.fromkeys((*left.settings, *right.settings))
    pairs = (SettingDifference(path, left.settings.get(path), right.settings.get(path)) for path in paths)
    found = []
    for one in pairs:
        tied = any(saved is not None and saved.stays for saved in (one.left, one.right))
        if _differ(one.left, one.right, missing=missing) and (stays or not tied):
            found.append(one)
    return tuple(found)


def _differ(left: Saved | None, right: Saved | None, *, missing: bool) -> bool:
    if left is None or right is None:
        return missing
    if left.value is None or right.value is None:
        return (left.value, left.raw) != (right.value, right.raw)
    values = [sorted(one.value) if isinstance(one.value, list) else one.value for one in (left, right)]
    return (values[0], left.unit) != (values[1], right.unit)
