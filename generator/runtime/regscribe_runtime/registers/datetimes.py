"""Dates and times in words: values are `datetime`, `date` and `time` without a time zone, as devices tell them."""

from collections.abc import Callable
from datetime import date, datetime, time, timedelta
from functools import cache
from typing import Any

from regscribe_runtime.registers.octets import OctetType
from regscribe_runtime.values.kinds import Kind
from regscribe_runtime.values.numbers import brief
from regscribe_runtime.values.octets import EPOCH, IEC870, SPANS, Layout, Part, layout_of

DAY = date(2000, 1, 1)
"""A day for times alone."""
CENTURY = 2000
IGNORED = "_w"


@cache
def datetime_as(layout: str) -> OctetType[datetime]:
    """A date with its time."""
    return _type(Kind.DATETIME, datetime, layout, lambda moment: moment, lambda value: value)


@cache
def date_as(layout: str) -> OctetType[date]:
    """A date."""
    return _type(Kind.DATE, date, layout, datetime.date, lambda value: datetime.combine(value, time()))


@cache
def time_as(layout: str) -> OctetType[time]:
    """A time of day."""
    return _type(Kind.TIME, time, layout, datetime.time, lambda value: datetime.combine(DAY, value))


def _type(
    kind: Kind, known: type[Any], text: str, out: Callable[[datetime], Any], into: Callable[[Any], datetime]
) -> OctetType[Any]:
    layout = layout_of(text)

    def read(raw: bytes) -> Any:
        return out(_iec870_read(raw) if text == IEC870 else _read(text, raw))

    def write(value: Any, _: int) -> bytes:
        if type(value) is not known or getattr(value, "tzinfo", None):
            message = f"{brief(value)} is no {known.__name__} without a time zone"
            raise ValueError(message)
        moment = into(value)
        raw = _iec870_spell(moment) if text == IEC870 else _spell(layout, moment, midnight=kind is Kind.TIME)
        if read(raw) != value:
            message = f"{brief(value)} is finer, or lies further, than these words can tell"
            raise ValueError(message)
        return raw

    return OctetType(kind, read, write, known.fromisoformat, lambda value: str(value.isoformat()))


def _read(text: str, raw: bytes) -> datetime:
    layout = layout_of(text)
    if layout.step:
        count = int.from_bytes(raw) * layout.step
        try:
            moment = layout.epoch + timedelta(seconds=count)
        except OverflowError:
            message = f"{count} seconds lead beyond the year 9999"
            raise ValueError(message) from None
        if text in SPANS and moment.date() != EPOCH.date():
            message = f"{count} seconds are more than a day"
            raise ValueError(message)
        return moment
    found = {part.letter: _part(part, raw) for part in layout.parts}
    year = found.get("Y", found.get("y", 0) + CENTURY)
    month, day = found.get("M", 1), found.get("D", 1)
    return datetime(year, month, day, found.get("h", 0), found.get("m", 0), found.get("s", 0))  # noqa: DTZ001 (no zone)


def _part(part: Part, raw: bytes) -> int:
    cells = raw[part.place : part.place + part.size]
    if part.letter in IGNORED:
        return 0
    if part.bcd:
        if not cells.hex().isdecimal():
            message = f"{cells.hex()} has a digit beyond 9"
            raise ValueError(message)
        return int(cells.hex())
    if part.ascii:
        if not (cells.isascii() and cells.isdigit()):
            message = f"{brief(cells)} are no digits"
            raise ValueError(message)
        return int(cells)
    above: int = int.from_bytes(cells) // 10**part.after
    number = above % 10**part.digits if part.digits else above
    if part.letter == "y" and number > 99:  # noqa: PLR2004 (two digits)
        message = f"{number} is no year of two digits"
        raise ValueError(message)
    return number


def _spell(layout: Layout, moment: datetime, *, midnight: bool) -> bytes:
    size = 2 * layout.words
    if layout.step:
        since = datetime.combine(DAY, time()) if midnight else layout.epoch
        seconds = (moment - since) // timedelta(seconds=layout.step)
        if not 0 <= seconds < 1 << 8 * size:
            message = f"{moment.isoformat()} lies outside what {layout.words} words count"
            raise ValueError(message)
        return seconds.to_bytes(size)
    parts = {"Y": moment.year, "y": moment.year - CENTURY, "M": moment.month, "D": moment.day, "_": 0}
    parts |= {"h": moment.hour, "m": moment.minute, "s": moment.second, "w": moment.isoweekday()}
    raw = bytearray(size)
    for part in layout.parts:
        number = parts[part.letter]
        if number < 0 or (part.letter == "y" and number > 99):  # noqa: PLR2004 (two digits)
            message = f"the year {moment.year} lies outside 2000 to 2099"
            raise ValueError(message)
        place = slice(part.place, part.place + part.size)
        if part.bcd:
            raw[place] = bytes.fromhex(f"{number:0{2 * part.size}d}")
        elif part.ascii:
            raw[place] = f"{number:0{part.size}d}".encode()
        else:
            raw[place] = (int.from_bytes(raw[place]) + number * 10**part.after).to_bytes(part.size)
    return bytes(raw)


def _iec870_read(raw: bytes) -> datetime:
    """The four words of IEC 60870-5-4: year; month, weekday and day; hour and minute; milliseconds."""
    _, year, month, day, hour, minute, *milliseconds = raw
    if minute & 0x80 or year & 0x7F > 99:  # noqa: PLR2004 (two digits)
        message = "the device marks its time as invalid" if minute & 0x80 else f"{year & 0x7F} is no year of two digits"
        raise ValueError(message)
    seconds, rest = divmod(int.from_bytes(bytes(milliseconds)), 1000)
    fraction = 1000 * rest
    return datetime(CENTURY + (year & 0x7F), month & 0x0F, day & 0x1F, hour & 0x1F, minute & 0x3F, seconds, fraction)  # noqa: DTZ001


def _iec870_spell(moment: datetime) -> bytes:
    if not 0 <= moment.year - CENTURY < 100:  # noqa: PLR2004 (two digits)
        message = f"the year {moment.year} lies outside 2000 to 2099"
        raise ValueError(message)
    milliseconds = 1000 * moment.second + moment.microsecond // 1000
    day = moment.isoweekday() << 5 | moment.day
    return bytes((0, moment.year - CENTURY, moment.month, day, moment.hour, moment.minute)) + milliseconds.to_bytes(2)
