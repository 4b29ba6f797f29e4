"""The importer of the JSON that pymodbus' simulator reads: each address that it lists is a register with its value.

Without `shared blocks` its addresses run through coils, discrete inputs, input and holding registers, in that order,
and a coil is a bit of a word of 16.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

from regscribe.dialects import read_back
from regscribe.dialects.pymodbus_simulator import SECTIONS, SIZES
from regscribe.draft import Draft, Remark
from regscribe.draft.numbers import plain
from regscribe.importers.shared.document import Collecting, chosen, has, reads, text_of
from regscribe.importers.shared.exact import number, whole
from regscribe.importers.shared.points import Point
from regscribe.importers.shared.read_json import read_json
from regscribe.importers.shared.reading import LeftOutError
from regscribe.importers.shared.tree import Node, TreeError
from regscribe.model import Space, WireType
from regscribe.plugins import Likeness, Option

name = "pymodbus-simulator"
summary = "a device of the JSON of pymodbus' simulator"
options = (Option("device", "name in device_list; needed where there are several.", metavar="NAME"),)

BY_SECTION = read_back(SECTIONS)
BLOCKS = (Space.COIL, Space.DISCRETE, Space.INPUT, Space.HOLDING)
WORD_BITS = 16
MOST_ADDRESSES = 4 * 0x10000
"""Addresses of all four blocks together."""
TAKEN = frozenset({"setup", "write", "invalid", "repeat", *SECTIONS.values()})


def likeness(data: bytes, name: str) -> Likeness:  # noqa: ARG001 - the contract of importers
    """Surely, by a device_list with a setup of sizes."""
    return Likeness.SURE if has(data, r'"device_list"\s*:', r'"setup"\s*:', r'"co size"\s*:') else Likeness.NO


@dataclass(frozen=True, slots=True)
class _Layout:
    """Where the blocks begin; all at 0 where they are shared."""

    starts: tuple[int, ...]
    shared: bool
    written: frozenset[int]

    def place(self, at: int) -> tuple[Space, int]:
        """The space of an address, and the address there."""
        if self.shared:
            return Space.HOLDING, at
        index = max(index for index, start in enumerate(self.starts) if at >= start)
        space = BLOCKS[index]
        inside = at - self.starts[index]
        return space, inside * WORD_BITS if space.is_bits else inside

    def access(self, at: int, space: Space) -> str:
        """Whether an address can be written."""
        return "rw" if at in self.written and space in {Space.HOLDING, Space.COIL} else "r"


@reads
def read(data: bytes, name: str, options: Mapping[str, str]) -> Draft:
    """Return the registers of one device. Raises OptionError where it is not clear which."""
    root, doubled = read_json(text_of(data))
    listed = root.get("device_list")
    if listed is None or not listed.members:
        raise TreeError(root.line, "there is no `device_list`", "is this a configuration of pymodbus' simulator?")
    wanted = chosen("device", options.get("device", ""), [*listed.members], "device")
    device = listed.members[wanted]
    found = Collecting(name)
    found.doubled(doubled)
    layout = _layout(device)
    for wire, section, one in _cells(device):
        _add(found, layout, wire, section, one)
    if layout.shared:
        found.stated.append("shared blocks: every address is a holding register here; others read the same cells")
    else:
        found.stated.append("no shared blocks: addresses run through coils, discrete, input and holding registers")
    _told(found, device)
    return found.draft(title=wanted)


def _layout(device: Node) -> _Layout:
    setup = device.get("setup")
    sizes = [(whole(setup.word(size)) if setup else None) or 0 for size in SIZES]
    starts = tuple(sum(sizes[:index]) for index in range(len(sizes)))
    shared = setup is None or setup.word("shared blocks").lower() in {"true", ""}
    listed = device.get("write")
    written = {at for one in (listed.each if listed else ()) for at in _span(one)}
    return _Layout(starts, shared, frozenset(written))


def _span(one: Node) -> range:
    """The addresses of an entry: one, a pair from first to last, or a mapping with `addr`."""
    at = one.get("addr") or one
    numbers = [whole(end.text) for end in at.each]
    known = [end for end in numbers if end is not None]
    if not known or len(known) != len(numbers) or not 0 <= known[0] <= known[-1] < MOST_ADDRESSES:
        return range(0)
    return range(known[0], known[-1] + 1)


def _cells(device: Node) -> Iterator[tuple[WireType, str, Node]]:
    for section, wire in BY_SECTION.items():
        listed = device.get(section)
        yield from ((wire, section, one) for one in (listed.each if listed else ()))


def _add(found: Collecting, layout: _Layout, wire: WireType, section: str, one: Node) -> None:
    span = _span(one)
    where = one.get("addr") or one
    called = f"{section} {where.shown}"
    if not span:
        found.left_out(called, one, LeftOutError("address-unclear", f"{one.shown} says no addresses"))
        return
    space, at = layout.place(span.start)
    remarks = tuple(
        Remark("action-dropped", f"{key} {value.shown}: what a simulator does with it")
        for key, value in (one.members or {}).items()
        if key not in {"addr", "value"} and not value.is_null
    )
    point = Point(name=f"{section} {span.start}", place=found.place(one), at=at, space=space, remarks=remarks)
    point = replace(point, access=layout.access(span.start, space))
    if space.is_bits:
        found.items.append(replace(point, type=WireType.BIT, count=len(span) * WORD_BITS, name=f"bits {span.start}"))
        return
    value = one.word("value") if one.members else ""
    if wire is WireType.STRING:
        more: dict[str, Any] = {"default": value} if value else {}
        found.items.append(replace(point, type=wire, words=len(span), more=more))
        return
    if wire is WireType.BIT:
        wire, point = WireType.UINT16, replace(point, more={"kind": "raw"})
    if len(span) % wire.words:
        why = LeftOutError("address-unclear", f"{len(span)} addresses are no whole number of {wire}")
        found.left_out(called, one, why)
        return
    stored = number(value) if value else None
    default = {} if stored is None else {"default": plain(stored)}
    found.items.append(replace(point, type=wire, count=len(span) // wire.words, more={**point.more, **default}))


def _told(found: Collecting, device: Node) -> None:
    for key, value in (device.members or {}).items():
        if key not in TAKEN and not value.is_null:
            found.warn(value, f"the section `{key}` is none that pymodbus' simulator has")
    repeated = device.get("repeat")
    for one in repeated.each if repeated else ():
        why = LeftOutError("repeat-dropped", "copies of other addresses are not taken over: write them out")
        found.left_out(f"repeat {one.shown}", one, why)
