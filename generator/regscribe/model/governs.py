"""What a register sets of the line that it is written over."""

from dataclasses import dataclass
from enum import StrEnum


class Setting(StrEnum):
    """A setting of the line; `FORMAT` is data bits, parity and stop bits together, `ADDRESSING` modbus or jbus."""

    ADDRESS = "address"
    BAUD = "baud"
    PARITY = "parity"
    DATA_BITS = "data_bits"
    STOP_BITS = "stop_bits"
    FORMAT = "format"
    ADDRESSING = "addressing"


@dataclass(frozen=True, slots=True)
class Governs:
    """A register that sets how the device talks: what each code of it sets, and from when that holds.

    `codes` are pairs of a code and the setting as text (9600, E, 8N1, jbus); of an address the value itself counts.
    None where the manual does not print them. `since` is `at_once` (so that the answer to the write is lost),
    `after_answer`, `apply`, `restart`, or empty where the manual does not say.
    """

    setting: Setting
    codes: tuple[tuple[int, str], ...] = ()
    since: str = ""
