"""What differs between two sets of settings: devices, backups, the manual's defaults."""

from collections.abc import Mapping
from typing import NamedTuple

from regscribe.tools.settings.backup import Backup, Saved


class Side(NamedTuple):
    """One of the two: what it is called, which model it is of, and its settings by path."""

    name: str
    map_id: str
    model: str
    settings: Mapping[str, Saved]


class SettingDifference(NamedTuple):
    """A setting that is not the same: None on the side that does not have it."""

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
    return tuple(
        one
        for one in pairs
        if _differs(one) and (missing or (one.left and one.right)) and (stays or not _personal(one))
    )


def _personal(one: SettingDifference) -> bool:
    return any(saved is not None and saved.stays for saved in (one.left, one.right))


def _differs(one: SettingDifference) -> bool:
    left, right = one.left, one.right
    if left is None or right is None:
        return True
    if left.value is None or right.value is None:
        return (left.value, left.raw) != (right.value, right.raw)
    return _value(left) != _value(right)


def _value(saved: Saved) -> tuple[object, str]:
    value = sorted(saved.value) if isinstance(saved.value, list) else saved.value
    return value, saved.unit
