"""Codes of enums, masks of bits and parts."""

from collections.abc import Iterator, Sequence

from regscribe.export.c_header.spelling import LAST_INT, remark, signed, unsigned
from regscribe.export.device import Device, Point
from regscribe.export.device.names import Names
from regscribe.losses import Grade
from regscribe.model import BitField, Member


class Codes:
    """Writes what the codes and bits of registers mean; an enum that several have is written once."""

    def __init__(self, device: Device, names: Names, prefix: str) -> None:
        """`prefix` begins each name."""
        self._device, self._names, self._prefix = device, names, prefix
        self._written: dict[tuple[str, tuple[Member, ...]], str] = {}

    def lines(self, point: Point, name: str) -> Iterator[str]:
        """The enum of a register, its masks and its parts."""
        if point.members and point.register.enum:
            yield from self._enum(point.register.enum.id, point.members, name)
        for part in point.fields:
            yield from self._part(point, part, f"{name}_{part.id.upper()}")

    def _enum(self, wanted: str, members: Sequence[Member], name: str) -> Iterator[str]:
        """The enum, and a type of the name of the register; codes beyond an `int` are constants instead."""
        if any(not -LAST_INT - 1 <= one.code <= LAST_INT for one in members):
            for one in members:
                yield f"#define {self._names.give(f'{name}_{one.id}')} {signed(one.code)} /* {remark(one.label)} */"
            return
        key = (wanted, tuple(members))
        if key not in self._written:
            self._written[key] = self._names.give(f"{self._prefix}_{wanted}".lower())
            yield f"enum {self._written[key]} {{"
            for number, one in enumerate(members, 1):
                member = self._names.give(f"{self._prefix}_{wanted.upper()}_{one.id}")
                comma = "," if number < len(members) else ""
                yield f"    {member} = {signed(one.code)}{comma} /* {remark(one.label)} */"
            yield "};"
        yield f"typedef enum {self._written[key]} {self._names.give(f'{name.lower()}_code')};"

    def _part(self, point: Point, part: BitField, name: str) -> Iterator[str]:
        mask = unsigned(((1 << part.width) - 1) << part.low, hexadecimal=True)
        yield f"#define {self._names.give(f'{name}_MASK')} {mask} /* {remark(part.label)} */"
        if part.is_flag:
            return
        yield f"#define {self._names.give(f'{name}_SHIFT')} {part.low}u"
        if part.is_scaled:
            yield f"#define {self._names.give(f'{name}_SIGNED')} {int(part.signed)}"
            for key, number in (("SCALE", part.multiply), ("OFFSET", part.add)):
                yield f"#define {self._names.give(f'{name}_{key}_NUM')} {signed(number.numerator)}"
                yield f"#define {self._names.give(f'{name}_{key}_DEN')} {signed(number.denominator)}"
        gone = [what for what in ("unit", "range", "valid", "sentinels") if getattr(part, what)]
        if gone:
            done = f"left out: {', '.join(gone)} of the part {part.id}"
            self._device.lose(point.register, "fields", Grade.LOST, done)
        if part.enum:
            yield from self._enum(part.enum.id, part.enum.members, name)
