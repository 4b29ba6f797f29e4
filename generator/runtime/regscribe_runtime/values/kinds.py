"""Kinds of values, and access to registers."""

from enum import StrEnum


class Kind(StrEnum):
    """The kind of a register's value.

    `NUMBER` may have a fraction, `INTEGER` never has, `RAW` is a whole number whose scale the manual does not state;
    `FLAGS` is a word of single bits, `FIELDS` a word with at least one wider field; `VERSION` packs decimal digits.
    """

    NUMBER = "number"
    INTEGER = "integer"
    RAW = "raw"
    ENUM = "enum"
    FLAGS = "flags"
    FIELDS = "fields"
    STRING = "string"
    VERSION = "version"
    BOOLEAN = "boolean"
    BYTES = "bytes"
    IPV4 = "ipv4"
    IPV6 = "ipv6"
    MAC = "mac"
    DATETIME = "datetime"
    DATE = "date"
    TIME = "time"


MOMENTS = frozenset({Kind.DATETIME, Kind.DATE, Kind.TIME})
OCTETS = MOMENTS | {Kind.STRING, Kind.BYTES, Kind.IPV4, Kind.IPV6, Kind.MAC}
"""Kinds whose values are bytes and no numbers; outside of programs they are spelled as texts."""

DIVISIBLE = frozenset({Kind.STRING, Kind.BYTES})
"""Kinds whose values may take several requests."""


class Access(StrEnum):
    """Whether a register can be read and written."""

    READ = "r"
    READ_WRITE = "rw"
    WRITE = "w"

    @property
    def readable(self) -> bool:
        """Whether it can be read."""
        return self is not Access.WRITE

    @property
    def writable(self) -> bool:
        """Whether it can be written (perhaps under a condition)."""
        return self is not Access.READ
