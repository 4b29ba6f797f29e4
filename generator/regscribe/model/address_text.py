"""Addresses as people write them: decimal, hexadecimal, and Modicon's numbers, whose first digit tells the space."""

import re
from typing import NamedTuple

from regscribe_runtime.values.wire_types import Space

MODICON = {Space.COIL: 0, Space.DISCRETE: 1, Space.INPUT: 3, Space.HOLDING: 4}
"""The first digit of Modicon's numbers: 40001 or 400001 is the holding register at wire address 0."""

SHORT, LONG = 4, 5
"""Digits of Modicon's numbers after the first: the long ones reach the whole address space."""

LAST = 0xFFFF

_HEX = re.compile(r"(?:0x|\$)([0-9a-f]+)|([0-9a-f]*[0-9][0-9a-f]*)h", re.IGNORECASE)
_DECIMAL = re.compile(r"[0-9]+")


class AddressReading(NamedTuple):
    """One meaning of a written address: the wire address, the space (None: any), and how it was read."""

    address: int
    space: Space | None
    notation: str


def readings(text: str) -> tuple[AddressReading, ...]:
    """Return all meanings of a written address, the plainest first; none for what is no address.

    `4049` and `0xFD1` (also `FD1h`, `$FD1`) are wire addresses of any space. `44050` is the wire address 44050 and,
    as Modicon writes it, holding register 4049. `holding:4049` names the space (`input`, `coil`, `discrete`) as well.
    """
    text = text.strip()
    name, colon, rest = text.partition(":")
    if colon:
        return _in_space(name.casefold(), rest)
    if found := _HEX.fullmatch(text):
        address = int(found[1] or found[2], 16)
        return (AddressReading(address, None, "hexadecimal"),) if address <= LAST else ()
    if not (_DECIMAL.fullmatch(text) and len(text) <= LONG + 1):
        return ()
    plain = [AddressReading(int(text), None, "decimal")] if int(text) <= LAST else []
    return (*plain, *_modicon_readings(text))


def _in_space(name: str, text: str) -> tuple[AddressReading, ...]:
    """The meanings of a written address behind the name of a space: a wire address, never a number of Modicon's."""
    named = [space for space in MODICON if space == name]
    plain = [one for one in readings(text) if one.space is None]
    return tuple(one._replace(space=space) for space in named for one in plain)


def _modicon_readings(text: str) -> list[AddressReading]:
    number = int(text[1:] or 0)
    if len(text) not in {SHORT + 1, LONG + 1} or not 1 <= number <= LAST + 1:
        return []
    spaces = [space for space, digit in MODICON.items() if text[0] == str(digit)]
    return [AddressReading(number - 1, space, "Modicon") for space in spaces]


def modicon(space: Space, address: int) -> str:
    """Return Modicon's number of a wire address, long where the short has too few digits; empty for other spaces."""
    if space not in MODICON or not 0 <= address <= LAST:
        return ""
    digits = SHORT if address + 1 < 10**SHORT else LONG
    return f"{MODICON[space]}{address + 1:0{digits}}"


def hexadecimal(address: int) -> str:
    """Return a wire address in hexadecimal digits: `0xFD1`."""
    return f"0x{address:X}"
