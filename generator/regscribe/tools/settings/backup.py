"""The contents of a backup: the device that it comes from, and each setting by group and name."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

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
    be copied to another device, else empty.
    """

    value: Plain | None = None
    unit: str = ""
    raw: tuple[int, ...] = ()
    stays: str = ""
    error: str = ""

    @property
    def spelled(self) -> str:
        """The value with its unit, or the error, for people."""
        if self.value is None:
            return f"({self.error})"
        return f"{text_of(self.value)} {self.unit}".rstrip()


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
