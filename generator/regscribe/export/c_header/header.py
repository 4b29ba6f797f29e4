"""The whole header: its head, what numbers of types, spaces and orders mean, and the registers group by group."""

from collections.abc import Iterable, Iterator
from itertools import groupby

from regscribe.dialects import LETTERS
from regscribe.export.c_header.elements import Entry, entries
from regscribe.export.c_header.registers import Registers
from regscribe.export.c_header.spelling import TYPES, remark, unsigned
from regscribe.export.device import Device
from regscribe.model import Space

SPACES = {one: one.read_function for one in Space if one is not Space.ENRON}
"""The spaces that a header names; the number of each is the function that reads it."""

MEANING = """\
 * value = number on the wire * _SCALE_NUM / _SCALE_DEN + _OFFSET_NUM / _OFFSET_DEN; without _SCALE_NUM it is the number
 * _ADDR: from 0, as in requests   _WORDS: registers (or bits) from there on   _SPACE: the function that reads it
 * _ORDER: how the bytes A B C D stand on the wire, A the most significant; of a single byte ABCD is that of the low one
 * _FILE, _QUEUE: the file whose record, or the queue whose value _ADDR is (the count of a queue is 0)
 * _ACCESS: 1 read, 2 write, 3 both   _WRITE_ADDR: where it is not _ADDR
 * _RAW_MIN, _RAW_MAX: ends of what may be written, as numbers on the wire; _FAULT_..: numbers that are no values"""


def header(device: Device) -> str:
    """Return the text of the header of a model; what it cannot say becomes a loss of the device."""
    prefix = device.model.class_name.upper()
    registers = Registers(device, prefix)
    guard = registers.names.give(f"{prefix}_H")
    lines = [
        *_head(device),
        f"#ifndef {guard}",
        f"#define {guard}",
        "",
        "#include <stdint.h>",
        "",
        *(f"#define {registers.names.give(name)} {text}" if name else "" for name, text in _numbers(prefix, device)),
        *_groups(device, registers),
        "",
        f"#endif /* {guard} */",
    ]
    return "\n".join(lines) + "\n"


def _head(device: Device) -> Iterator[str]:
    yield "/*"
    yield from (f" * {remark(line)}" for line in device.heading)
    yield " *"
    yield MEANING
    yield " */"


def _numbers(prefix: str, device: Device) -> Iterator[tuple[str, str]]:
    """What is the same for every register, given away first: codes of a register may want such a name too."""
    limits = device.register_map.protocol
    yield f"{prefix}_READ_WORDS_MAX", f"{limits.read_words}u"
    yield f"{prefix}_WRITE_WORDS_MAX", f"{limits.write_words}u"
    yield "", ""
    yield from ((f"{prefix}_SPACE_{space.name}", f"{number}u") for space, number in SPACES.items())
    yield from ((f"{prefix}_ORDER_{order}", f"{number}u") for number, order in enumerate(LETTERS.values()))
    yield from ((f"{prefix}_TYPE_{kind.upper()}", unsigned(number)) for number, kind in enumerate(TYPES, 1))


def _groups(device: Device, registers: Registers) -> Iterator[str]:
    titles = {group.id: group.name for group in device.model.groups}
    every: Iterable[Entry] = entries(device.points)
    for group, some in groupby(every, lambda entry: entry.point.register.group):
        yield ""
        yield f"/* {remark(f'{titles.get(group, group)} ({group})')} */"
        for entry in some:
            yield ""
            yield from registers.lines(entry)
