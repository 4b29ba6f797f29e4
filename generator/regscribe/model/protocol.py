"""How a device behaves on the line: functions, limits, answers to what it dislikes, timing and serial settings."""

from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction

SILENCE = 0
"""In place of an exception code: the device sends no answer."""


class Later(StrEnum):
    """What happens when a request starts at a good address and runs onto a bad one (or a bad value).

    `EXCEPTION`: refused as a whole. For reads, `GARBAGE`: words without meaning, `ZEROS`: zeros. For writes, `STOP`:
    writing ends at the first bad word and the answer counts the words that were written.
    """

    EXCEPTION = "exception"
    GARBAGE = "garbage"
    ZEROS = "zeros"
    STOP = "stop"


@dataclass(frozen=True, slots=True)
class ExceptionCode:
    """An exception code of this device: its name and what the device means by it."""

    code: int
    name: str
    meaning: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Faults:
    """The answer to each kind of bad request: an exception code, or `SILENCE`."""

    function: int = 1
    address: int = 2
    value: int = 3
    read_only: int = 2
    condition: int = 3
    quantity: int = 3
    misaligned_address: int = 2
    misaligned_count: int = 3
    view_function: int = 2
    unused_write: int = 2
    later_read: Later = Later.EXCEPTION
    later_write: Later = Later.EXCEPTION


@dataclass(frozen=True, slots=True)
class Latency:
    """Milliseconds from the end of a request to the start of the answer: fixed part plus a part for each word.

    `characters` character times at the speed of the line are added to both ends; `note` is the manual's further remark.
    """

    function: int
    minimum: Fraction = Fraction(0)
    maximum: Fraction = Fraction(0)
    minimum_per_word: Fraction = Fraction(0)
    maximum_per_word: Fraction = Fraction(0)
    characters: Fraction = Fraction(0)
    note: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Serial:
    """The serial line: speeds in baud, character formats (8N1), defaults, silence between frames in characters."""

    modes: tuple[str, ...] = ("rtu",)
    baud_rates: tuple[int, ...] = ()
    formats: tuple[str, ...] = ()
    default_baud: int | None = None
    default_format: str = ""
    gap_characters: Fraction = Fraction(7, 2)
    description: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Protocol:
    """What the device accepts: function codes, unit ids, most words (or bits) in a request, holes and faults.

    `read_holes`: whether a read may run over addresses of no register (a planner may then bridge gaps).
    `spares_memory`: whether a write of what lasting memory holds already leaves the memory alone.
    `alike`: function codes that do the same (2 reads coils as 1 does); registers stand in the space of one of them.
    `accepts`: limits that the device goes beyond, by another passage of its manual; a driver keeps to the limits.
    `stated`: the keys that the map gives (of limits, faults and serial line too); all others are as Modbus has them.
    """

    functions: tuple[int, ...] = (3, 6, 16)
    broadcast: tuple[int, ...] = ()
    unit_ids: tuple[int, int] = (1, 247)
    default_unit: int | None = None
    read_words: int = 125
    write_words: int = 123
    read_bits: int = 2000
    write_bits: int = 1968
    read_holes: bool = False
    spares_memory: bool = False
    faults: Faults = Faults()
    exceptions: tuple[ExceptionCode, ...] = ()
    latencies: tuple[Latency, ...] = ()
    serial: Serial = Serial()
    section: str = ""
    alike: tuple[tuple[int, ...], ...] = ()
    accepts: tuple[tuple[str, int], ...] = ()
    stated: tuple[str, ...] = ()

    def accepted(self, limit: str) -> int:
        """Return the most that the device answers: `limit` (`read_words` and so on), or what it accepts beyond it."""
        return dict(self.accepts).get(limit, int(getattr(self, limit)))


USUAL_PROTOCOL = Protocol()
"""What counts where a map says nothing."""
