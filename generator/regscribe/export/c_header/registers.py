"""The constants of one register, or of the same one in all elements of arrays."""

from collections.abc import Iterator
from fractions import Fraction
from math import ceil, floor

from regscribe.dialects import LETTERS
from regscribe.emit.words import condition_words
from regscribe.export.c_header.codes import Codes
from regscribe.export.c_header.elements import Entry
from regscribe.export.c_header.spelling import literal, real, remark, signed, unsigned, whole
from regscribe.export.device import Device, Point
from regscribe.export.device.names import Names
from regscribe.losses import Grade
from regscribe.model import Kind, show
from regscribe_runtime.values.octets import TextForm

ACCESS = {"r": 1, "w": 2, "rw": 3}
NUMBERS = frozenset({Kind.NUMBER, Kind.INTEGER})


class Registers:
    """Writes the registers of a device, and tells what of them a header cannot say."""

    def __init__(self, device: Device, prefix: str) -> None:
        """`prefix` begins each name."""
        self.names = Names()
        self._device, self._prefix = device, prefix
        self._codes = Codes(device, self.names, prefix)

    def lines(self, entry: Entry) -> Iterator[str]:
        """The comment of a register and its constants."""
        point, name = entry.point, f"{self._prefix}_{entry.id.upper()}"
        yield from self._comment(entry)
        space = point.wire.space
        yield self._define(f"{name}_ADDR", entry.address(space.inside(point.address)), entry.arguments)
        if point.write not in {None, point.address}:
            written = point.register.write_view.space.inside(point.write or 0)
            yield self._define(f"{name}_WRITE_ADDR", entry.address(written), entry.arguments)
        for part in ("file", "queue"):
            if part in (found := space.facts(point.address)):
                yield self._define(f"{name}_{part.upper()}", f"{found[part]}u")
        for number, (low, high, _) in enumerate(entry.spans, 1):
            behind = f"_{number}" if len(entry.spans) > 1 else ""
            yield self._define(f"{name}_FIRST{behind}", f"{low}u")
            yield self._define(f"{name}_LAST{behind}", f"{high}u")
        for key, text in (*self._place(point), *self._scale(point), *self._limits(point), *self._faults(point)):
            yield self._define(f"{name}_{key}", text)
        for key, text in self._specials(point):
            yield self._define(f"{name}_{key}", text)
        yield from self._codes.lines(point, name)

    def _define(self, name: str, text: str, arguments: str = "") -> str:
        return f"#define {self.names.give(name)}{arguments} {text}"

    def _comment(self, entry: Entry) -> Iterator[str]:
        one = entry.point.register
        title = one.name if entry.last in {"", one.name} else f"{one.name} .. {entry.last}"
        parts = [title, f"({one.symbol})" if one.symbol else "", f"section {one.section}" if one.section else ""]
        said = [*(f"inferred: {each.what} ({each.why})" for each in one.inferred)]
        said += [one.description, f"DANGER: {one.danger}" if one.danger else ""]
        if not one.when.always:
            words = f"exists only while {condition_words(one.when)}"
            self._lose(entry.point, "condition", f"in a comment only: {words}")
            said.append(words)
        if one.kind is Kind.RAW:
            said.append("the manual does not state its scale")
        fixed = [loss.done for loss in self._device.losses if loss.register == one.path and loss.grade is Grade.WRONG]
        first, *others = map(remark, filter(None, (" ".join(filter(None, parts)), *said, *fixed)))
        yield f"/* {first}{'' if others else ' */'}"
        yield from (f" * {text}{'' if number < len(others) else ' */'}" for number, text in enumerate(others, 1))

    def _lose(self, point: Point, fact: str, done: str) -> None:
        self._device.lose(point.register, fact, Grade.LOST, done)

    def _place(self, point: Point) -> Iterator[tuple[str, str]]:
        wire, one = point.wire, point.register
        yield "WORDS", f"{point.words}u"
        yield "SPACE", f"{self._prefix}_SPACE_{wire.space.name}"
        yield "TYPE", f"{self._prefix}_TYPE_{wire.type.value.upper()}"
        if not wire.space.is_bits:
            yield "ORDER", f"{self._prefix}_ORDER_{LETTERS[wire.words, wire.bytes]}"  # type: ignore[index]  # what fits
        yield "ACCESS", f"{ACCESS[one.access.value]}u"
        if point.unit:
            yield "UNIT", literal(point.unit)
        if one.layout:
            yield "LAYOUT", literal(one.layout)
        if one.version_digits:
            yield "VERSION_DIGITS", f"{one.version_digits}u"
            yield "VERSION_GROUP", f"{one.version_group}u"
        if one.kind is Kind.STRING:
            yield from _text(one.text)

    @staticmethod
    def _scale(point: Point) -> Iterator[tuple[str, str]]:
        if point.register.kind in NUMBERS:
            yield "SCALE_NUM", signed(point.slope.numerator)
            yield "SCALE_DEN", signed(point.slope.denominator)
            yield "OFFSET_NUM", signed(point.offset.numerator)
            yield "OFFSET_DEN", signed(point.offset.denominator)

    def _limits(self, point: Point) -> Iterator[tuple[str, str]]:
        if not point.register.range or not point.register.access.writable:
            return
        if point.limits is None:
            self._lose(point, "range", "left out: its ends are no numbers in the stated state")
            return
        low, high = sorted((end - point.offset) / point.slope for end in point.limits)
        yield from self._ends(point, "range", "RAW", low, high)

    def _faults(self, point: Point) -> Iterator[tuple[str, str]]:
        if len(point.faults) < len(point.sentinels):
            gone = {one.id for one in point.sentinels} - {one.id for one in point.faults}
            self._lose(point, "sentinel", f"left out: {', '.join(sorted(gone))}, which this view cannot carry")
        for fault in point.faults:
            key = f"FAULT_{fault.id.upper()}"
            if fault.low is None or fault.high is None:
                yield f"{key}_IS_NAN", f"1 /* {remark(fault.label)} */"
            elif fault.low != fault.high:
                yield from self._ends(point, "sentinel", key, Fraction(fault.low), Fraction(fault.high))
            elif text := _number(point, Fraction(fault.low)):
                yield key, f"{text} /* {remark(fault.label)} */"
            else:
                self._lose(point, "sentinel", f"left out: {fault.id}, no number of C")

    def _ends(self, point: Point, fact: str, key: str, low: Fraction, high: Fraction) -> Iterator[tuple[str, str]]:
        """The constants of an interval; of whole numbers the ends that lie within."""
        if point.wire.type.is_integer:
            low, high = Fraction(ceil(low)), Fraction(floor(high))
        first, last = _number(point, low), _number(point, high)
        if first is None or last is None:
            self._lose(point, fact, f"left out: ends of {key.lower()}, beyond the numbers of C")
        else:
            yield f"{key}_MIN", first
            yield f"{key}_MAX", last

    def _specials(self, point: Point) -> Iterator[tuple[str, str]]:
        gone = {one.id for one in point.specials} - {one.id for one in point.special_numbers}
        for special in point.special_numbers:
            text = _number(point, Fraction(special.wire))
            means = f" (reads as {show(special.value)})" if special.value != special.code else ""
            if text:
                yield f"SPECIAL_{special.id.upper()}", f"{text} /* {remark(special.label)}{means} */"
            else:
                gone.add(special.id)
        if gone:
            self._lose(point, "special-value", f"left out: {', '.join(sorted(gone))}, no number on the wire as stated")


def _text(form: TextForm) -> Iterator[tuple[str, str]]:
    """How characters stand in the words of a text, and what fills them up."""
    yield "ENCODING", literal(form.encoding)
    yield "PADDING", unsigned(form.padding)
    yield "ENDS", literal("".join(map(chr, form.ends)))
    if form.per_register:
        yield "CHARACTER_IN", literal(f"{form.per_register} byte")


def _number(point: Point, number: Fraction) -> str | None:
    """A number on the wire as a constant; None where C has none."""
    if not point.wire.type.is_integer:
        return real(number)
    inside = number.denominator == 1 and -(1 << 63) <= number < 1 << 64
    return whole(int(number), point.wire.type) if inside else None
