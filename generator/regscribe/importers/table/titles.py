"""The space that the title of a section, or the name of a sheet, says for all registers below it.

Only whole expressions count: `Digital inputs` and `Input power` are about the device, `Coil temperature` is one.
"""

import re

from regscribe.model import Space

_REGISTERS = r"(?:reg(?:ister|istre|istro|istri|s)?\w*|rejestr\w*)"
_PHRASES = (
    (Space.INPUT, rf"\binput[\s_-]*{_REGISTERS}|\beingangs[\s-]?register|\bregistres? d['\u2019 ]?entr\u00e9es?"),
    (Space.INPUT, r"\bregistri (?:di |d')?(?:ingresso|input)|\bregistros? de entrada|\binvoerregister|输入寄存器"),
    (Space.HOLDING, rf"\bholding[\s_-]*{_REGISTERS}|\bhalte[\s-]?register|\bregistres? de maintien|保持寄存器"),
    (Space.HOLDING, r"\bregistri (?:di )?(?:mantenimento|holding)|\bregistros? de (?:retenci\u00f3n|mantenimiento)"),
    (Space.DISCRETE, r"\bdiscrete[\s_-]*(?:inputs?|contacts?)\b|离散(?:量)?输入"),
    (Space.COIL, r"^(?:modbus |output )?coils?(?: status(?:es)?| list| table| registers?)?(?: \(.*\))?$|^线圈$"),
)


def space_of_title(title: str) -> Space | None:
    """The one space that a title names; None where it names none, or two."""
    text = " ".join(title.split()).strip(" :.-")
    found = {space for space, phrase in _PHRASES if re.search(phrase, text, re.IGNORECASE)}
    return found.pop() if len(found) == 1 else None
