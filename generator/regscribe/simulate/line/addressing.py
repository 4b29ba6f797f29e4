"""JBUS: the same protocol with addresses counted from one instead of zero."""

import struct
from typing import overload

from regscribe.simulate.errors import SimulatorError
from regscribe_runtime.values.serial_line import first_address

ADDRESSED = frozenset({1, 2, 3, 4, 5, 6, 15, 16, 22, 23})
"""Function codes whose request names an address in its first two bytes of data."""

ECHOED = frozenset({5, 6, 15, 16, 22})
"""Function codes whose answer names it too."""


class AddressError(Exception):
    """An address below the first one."""


def counted_from(addressing: str) -> int:
    """Return the number of the first address; SimulatorError for an unknown way to count."""
    try:
        return first_address(addressing)
    except ValueError as problem:
        raise SimulatorError(str(problem)) from None


@overload
def shifted(pdu: bytes, steps: int, *, echoes: bool = False) -> bytes: ...
@overload
def shifted(pdu: None, steps: int, *, echoes: bool = False) -> None: ...
@overload
def shifted(pdu: bytes | None, steps: int, *, echoes: bool = False) -> bytes | None: ...
def shifted(pdu: bytes | None, steps: int, *, echoes: bool = False) -> bytes | None:
    """Return the PDU with its address moved; AddressError if that leaves the 16 bits (or is below the first)."""
    if pdu is None or not steps or pdu[0] not in (ECHOED if echoes else ADDRESSED) or len(pdu) < struct.calcsize(">BH"):
        return pdu
    address = int.from_bytes(pdu[1:3], "big") + steps
    if not 0 <= address <= 0xFFFF:  # noqa: PLR2004 (16 bits)
        raise AddressError
    return pdu[:1] + address.to_bytes(2, "big") + pdu[3:]
