"""The contents of a backup: its device, and each setting by group and name; and differences between settings."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from regscribe.tools.live.reading import without
from regscribe.tools.live.value_text import Plain, text_of

FORMAT = 1
NO_GROUP = "other"
"""The group of settings that are in none of the map's."""


class BackupError(Exception):
    """A file that is no backup, cannot be read or cannot be written; the message says what is wrong, and where."""


class UnfitError(BackupError):
    """A backup of another device, or with values that this one cannot take; nothing was written."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Saved:
    """One setting: a plain value in `unit`, and the words that transmit it in the view that drivers prefer.

    Where the device held no value, `value` is None and `error` says why. `stays` is the kind of a setting that must not
    be copied to another device, else empty. `absent` are flags and parts that do not show in the
    value, with the reason.
    """

    value: Plain | None = None
    unit: str = ""
    raw: tuple[int, ...] = ()
    stays: str = ""
    error: str = ""
    absent: Mapping[str, str] = field(default_factory=dict)

    @property
    def spelled(self) -> str:
        """The value with its unit, or the error, for people."""
        if self.value is None:
            return f"({self.error})"
        return f"{text_of(self.value)} {self.unit}".rstrip() + without(self.absent)


@dataclass(frozen=True, slots=True, kw_only=True)
class BackupOrigin:
    """Which device was saved: map and its content hash, model, unit, link, and when (RFC 3339, UTC).

    `identification` are the values by which the device was identified, for the record.
    """

    map_id: str
    map_sha256: str
    model: str
    unit: int
    link: str = ""
    taken: str = ""
    identification: Mapping[str, Saved] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, kw_only=True)
class Backup:
    """The settings of one device: saved values by path, in groups, in the manual's order."""

    origin: BackupOrigin
    groups: Mapping[str, Mapping[str, Saved]]

    def settings(self) -> Iterator[tuple[str, Saved]]:
        """Every setting with its path."""
        return ((path, saved) for group in self.groups.values() for path, saved in group.items())


class Side(NamedTuple):
    """One of the two sets: its name, its map and model, and its settings by path."""

    name: str
    map_id: str
    model: str
    settings: Mapping[str, Saved]

    @classmethod
    def of(cls, backup: Backup, name: str) -> "Side":
        """A backup as one side."""
        return cls(name, backup.origin.map_id, backup.origin.model, dict(backup.settings()))


class SettingDifference(NamedTuple):
    """A setting whose two values differ; None on the side that does not have it."""

    path: str
    left: Saved | None
    right: Saved | None


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
