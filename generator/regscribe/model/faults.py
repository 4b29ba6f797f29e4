"""What only the compiler and the simulator know of a device on the line: its answers to bad requests, and notes."""

from dataclasses import dataclass
from enum import StrEnum

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


@dataclass(frozen=True, slots=True, kw_only=True)
class ProtocolNotes:
    """What documents the protocol: where the manual has it, its remarks on the serial line and on latencies.

    `latencies` are pairs of a function and a remark. `stated` are the keys that the map gives (of limits, faults and
    serial line too); all others are as Modbus has them.
    """

    section: str = ""
    serial: str = ""
    latencies: tuple[tuple[int, str], ...] = ()
    stated: tuple[str, ...] = ()
