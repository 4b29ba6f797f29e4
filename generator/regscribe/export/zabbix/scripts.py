"""The scripts of items, in ECMAScript 5: from what the agent tells to the value, or to an error that says the fault.

Numbers are worked out by whole numbers as long as they can be: a double has 53 bits of them.
"""

from collections.abc import Iterator
from fractions import Fraction
from math import ceil, floor, lcm

from regscribe.dialects.zabbix import TYPES
from regscribe.export.device import Point
from regscribe.export.device.numbers import decimal
from regscribe.model import BitField, Kind, Order, WireType
from regscribe.reference import ieee_bits, ieee_number
from regscribe.visible import json_text

EXACT = 2**53
BLANK = 0x20

HALF = "var s = b > 32767 ? -1 : 1, e = b >> 10 & 31, m = b % 1024, x = 15, d = 1024;"
SINGLE = "var s = b > 2147483647 ? -1 : 1, e = Math.floor(b / 8388608) % 256, m = b % 8388608, x = 127, d = 8388608;"
DOUBLE = (
    "var s = w[0] > 32767 ? -1 : 1, e = w[0] >> 4 & 2047, x = 1023, d = 4503599627370496,"
    " m = (w[0] & 15) * 281474976710656 + w[1] * 4294967296 + w[2] * 65536 + w[3];"
)
IEEE = (
    "if (e > 2 * x) throw m ? NAN : 'infinite';"
    " var v = s * (e ? (1 + m / d) * Math.pow(2, e - x) : m / d * Math.pow(2, 1 - x));"
)
LONG = "var v = ((w[0] > 32767 ? w[0] - 65536 : w[0]) * 65536 + w[1]) * 4294967296 + (w[2] * 65536 + w[3]);"


def number_script(point: Point, *, pattern: bool) -> str:
    """The script of a number; empty where the agent's number is the value."""
    checks = checks_of(point, pattern=pattern)
    if point.wire.type is WireType.INT64 or point.wire.type.is_float or checks or point.is_scaled:
        as_told = point.wire.type in TYPES and not point.is_scaled  # a number of 64 bits is more than `v` can be
        number = "value" if as_told else scaled("v", point.slope, point.offset)
        return " ".join([*_taken(point), *checks, f"return {number};"])
    return ""


def checks_of(point: Point, *, pattern: bool) -> list[str]:
    """What a script asks of the number `v` before it is a value; of a `pattern` without its sign."""
    return [*_checks(point, point.wire.type.bits if pattern else 0), *_of_kind(point), *_valid(point)]


def _taken(point: Point) -> Iterator[str]:
    """Yield what makes the number `v` of what the agent tells."""
    kind = point.wire.type
    if kind in {WireType.INT64, WireType.FLOAT64}:
        yield words(point)
    if kind is WireType.INT64:
        yield LONG
    elif kind.is_float:
        found = {
            WireType.FLOAT16: f"var b = Number(value); {HALF}",
            WireType.FLOAT32: f"var b = Number(value); {SINGLE}",
        }
        yield found.get(kind, DOUBLE)
        nan = next((one.label for one in point.faults if one.low is None), "not a number")
        yield IEEE.replace("NAN", quoted(nan))
    else:
        yield "var v = Number(value);"


def words(point: Point) -> str:
    """What makes words `w` of the array that the agent tells (of one word, a number), the most significant first."""
    turned = ".reverse()" if point.wire.words is Order.LITTLE else ""
    return f"var w = [].concat(JSON.parse(value)){turned};"


def _checks(point: Point, bits: int) -> Iterator[str]:
    """Yield the errors of fault words; of a pattern of so many bits, as a number without a sign."""
    for one in point.faults:
        if one.low is None or one.high is None:
            continue
        low, high = Fraction(one.low), Fraction(one.high)
        low, high = (low % 2**bits, high % 2**bits) if bits else (low, high)
        yield f"if ({_reports(point, low, high)}) throw {quoted(one.label)};"


def _of_kind(point: Point) -> Iterator[str]:
    """Yield the errors of numbers that are no value of the register's kind."""
    if point.register.kind is Kind.BOOLEAN and not point.wire.space.is_bits:
        yield "if (v !== 0 && v !== 1) throw 'neither 0 nor 1';"
    if point.register.kind is Kind.INTEGER and (point.slope.denominator > 1 or point.offset.denominator > 1):
        yield f"if ({scaled('v', point.slope, point.offset)} % 1) throw 'no whole number';"


def _reports(point: Point, low: Fraction, high: Fraction) -> str:
    if low == high and abs(low) >= EXACT and point.wire.type is WireType.UINT64:
        return f"value === '{low}'"
    if low == high and abs(low) >= EXACT and point.wire.type is WireType.INT64:
        raw = (int(low) % 2**64).to_bytes(8, "big")
        return f"w.join() === '{','.join(str(int.from_bytes(raw[at : at + 2], 'big')) for at in range(0, 8, 2))}'"
    if point.wire.type.is_float and low == high:
        bits = ieee_bits(low, point.wire.type)
        return f"v === {float(ieee_number(bits or 0, point.wire.type))!r}"
    return f"v === {low}" if low == high else f"v >= {decimal(low)} && v <= {decimal(high)}"


def _valid(point: Point) -> Iterator[str]:
    """Yield the error of a reading that is none while all is well; special values lie outside with right."""
    if not point.valid:
        return
    inside = [_within(point, low, high) for low, high in point.valid]
    special = [f"v === {decimal(Fraction(one.wire))}" for one in point.special_numbers]
    yield f"if (!({' || '.join([*inside, *special])})) throw 'outside of what it reads while all is well';"


def _within(point: Point, low: Fraction | None, high: Fraction | None) -> str:
    ends = [None if end is None else (end - point.offset) / point.slope for end in (low, high)]
    first, last = ends if point.slope > 0 else reversed(ends)
    if point.wire.type.is_integer:
        first, last = (
            None if first is None else Fraction(ceil(first)),
            None if last is None else Fraction(floor(last)),
        )
    said = [f"v >= {decimal(first)}"] if first is not None else []
    said += [f"v <= {decimal(last)}"] if last is not None else []
    return f"({' && '.join(said) or 'true'})"


def part_script(part: BitField) -> str:
    """The script of a part of a word: its number, or the error of a fault."""
    size = 2**part.width
    lines = [f"var v = Math.floor(Number(value) / {2**part.low}) % {size};"]
    if part.signed:
        lines.append(f"if (v >= {size // 2}) v -= {size};")
    faults = [(*one.ends, one.label) for one in part.sentinels if one.ends]
    lines += [f"if (v >= {low} && v <= {high}) throw {quoted(label)};" for low, high, label in faults]
    number = scaled("v", part.multiply, part.add)
    if part.valid:
        low, high = ((end - part.add) / part.multiply for end in part.valid)
        first, last = sorted((low, high))
        lines.append(f"if (v < {ceil(first)} || v > {floor(last)}) throw 'outside of what it reads while all is well';")
    return " ".join([*lines, f"return {number};"])


def text_script(point: Point) -> str:
    """The script of a text: its bytes, up to its end, without what fills it up."""
    form = point.register.text
    taken = {"low": "b.push(w[i] & 255);", "high": "b.push(w[i] >> 8);"}
    each = taken.get(form.per_register, "b.push(w[i] >> 8, w[i] & 255);")
    ends = " || ".join(f"b[i] === {end}" for end in form.ends)
    lines = [words(point), *_text_faults(point), f"var b = [], i; for (i = 0; i < w.length; i++) {{ {each} }}"]
    if ends:
        lines.append(f"for (i = 0; i < b.length; i++) if ({ends}) b.length = i;")
    lines += [f"while (b[b.length - 1] === {byte}) b.pop();" for byte in dict.fromkeys((form.padding, BLANK))]
    if form.encoding == "ascii":
        lines.append("for (i = 0; i < b.length; i++) if (b[i] > 127) throw 'no ASCII';")
    return " ".join([*lines, _characters(form.encoding)])


def _text_faults(point: Point) -> Iterator[str]:
    """Yield the errors of texts that are a fault, as the one number of all their bytes."""
    for one in point.sentinels:
        if one.ends and one.ends[0] == one.ends[1]:
            raw = int(one.ends[0]).to_bytes(2 * point.words, "big")
            each = [str(int.from_bytes(raw[at : at + 2], "big")) for at in range(0, len(raw), 2)]
            yield f"if (w.join() === '{','.join(each)}') throw {quoted(one.label)};"


def _characters(encoding: str) -> str:
    if encoding != "utf-8":
        return "return String.fromCharCode.apply(null, b);"
    hexadecimal = "function (c) { return '%' + (c + 256).toString(16).slice(1); }"
    return f"return decodeURIComponent(b.map({hexadecimal}).join(''));"


def scaled(number: str, slope: Fraction, offset: Fraction) -> str:
    """The number times the slope and the offset added, by one division of whole numbers."""
    divisor = lcm(slope.denominator, offset.denominator)
    times, added = slope * divisor, offset * divisor
    text = number if times == 1 else f"{number} * {times}"
    text = text if not added else f"{text} {'+' if added > 0 else '-'} {abs(added)}"
    return text if divisor == 1 else f"({text}) / {divisor}"


def quoted(text: str) -> str:
    """A text as a literal; what Zabbix would take for a macro is spelled by its number."""
    return json_text(text).replace("{$", "{\\u0024").replace("{#", "{\\u0023").replace("{{", "{\\u007b")
