"""Values as plain text and numbers, for YAML, JSON and the command line; and back, with a reason for each refusal."""

import re
import unicodedata
from collections.abc import Collection, Iterable, Sequence
from decimal import Decimal
from typing import Any

from regscribe.tools.live.errors import meant
from regscribe_runtime import (
    Bit,
    Choice,
    Field,
    Flags,
    NotPresent,
    NumberField,
    OutOfRange,
    Register,
    SensorFault,
    SpecialNumber,
    ValueRefused,
    Word,
)
from regscribe_runtime.registers.enums import unnamed_bits
from regscribe_runtime.registers.octets import OctetType
from regscribe_runtime.registers.value_types import ChoiceType, FlagsType, WordType

Plain = str | int | float | bool | list[str]
"""A value without Python's types: numbers, members and special values by name, the names of set flags."""

_NUMBER = re.compile(r"[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]{1,3})?")
_WHOLE = re.compile(r"[+-]?(?:0[xX][0-9A-Fa-f]{1,500}|[0-9]{1,603})")
"""A whole number in as many digits as the bits of 125 words have."""
_MORE_DIGITS = re.compile(r"[0-9_.,'xX]|\s[\s0-9_.,']*$")
"""What behind a number is more of it (1_000, 1e5000, 0x and too many digits, 1 000) and no unit."""
MOST_EXACT = 2.0**53
"""Up to here a float tells whole numbers apart."""
_UNITS = {"degc": "°C", "degf": "°F", "c": "°C", "f": "°F", "℃": "°C", "℉": "°F", "k": "K", "percent": "%"}
WORDS = frozenset({"flags", "fields"})
"""Kinds of registers that have parts with names."""
TRUE, FALSE = frozenset({"true", "on", "yes", "1"}), frozenset({"false", "off", "no", "0"})


def show(register: Register[Any], value: Any, absent: Collection[str] = ()) -> Plain:  # noqa: ANN401 - a value of any register
    """A value of use as `parse` takes it: a number, a text, a name, the names of set flags, `part=value` of fields.

    Flags that are `absent` now are shown as bits without a name.
    """
    if isinstance(value, (Choice, SpecialNumber)):
        return _name(register, value)
    if isinstance(value, Flags):
        rest = unnamed_bits(value) | sum(int(member) for member in value if member.name in absent)
        unnamed = [f"bit_{bit}" for bit in range(rest.bit_length()) if rest >> bit & 1]
        return [*(member.name or "" for member in value if member.name not in absent), *unnamed]
    if isinstance(value, Word):
        return _show_parts(value)
    if register.kind == "boolean":
        return bool(value)
    if isinstance(register.value_type, OctetType):
        return register.value_type.spell(value)
    return value if isinstance(value, (int, float)) else str(value)


def as_text(register: Register[Any], value: Any, absent: Collection[str] = ()) -> str:  # noqa: ANN401 - as above
    """A value of use for people, without its unit: `150.5`, `RUN`, `HEATER, FAN`."""
    if isinstance(value, Flags) and not value:
        return type(value).label_of_none() or text_of([])
    return text_of(show(register, value, absent))


def text_of(plain: Plain) -> str:
    """A plain value for people; a whole number without a point, and with all its digits."""
    if isinstance(plain, list):
        return ", ".join(plain) or "none"
    if isinstance(plain, bool):
        return str(plain).lower()
    if isinstance(plain, float) and plain.is_integer() and abs(plain) < MOST_EXACT:
        return str(int(plain))
    return str(plain)


def is_number(plain: object) -> bool:
    """Whether a plain value is a number: only numbers have units."""
    return isinstance(plain, (int, float)) and not isinstance(plain, bool)


def parse(register: Register[Any], plain: Plain, *, unit: str = "", current_unit: str = "") -> Any:  # noqa: ANN401 - as above
    """The value of use of a plain value; ValueRefused if there is none, or if it is in another unit.

    `unit` is what stands beside the value; a number's text may carry its own (`150.5 °F`). `current_unit` is the unit
    that the device works in now.
    """
    if register.kind in {"number", "integer", "raw"}:
        return _number(register, plain, unit, current_unit)
    _same_unit(register, unit, current_unit)
    match register.kind:
        case "enum":
            return _member(register, _members_of(register), plain)
        case "flags" | "fields":
            return _flags_or_fields(register, plain)
        case "boolean":
            return _boolean(register.path, plain)
    if not isinstance(plain, str):
        raise ValueRefused(register.path, f"{plain!r} is no text: put it in quotes")
    try:
        return register.value_type.parse(plain) if isinstance(register.value_type, OctetType) else plain
    except ValueError as error:
        raise ValueRefused(register.path, f"`{plain[:60]}` is no {register.kind}: {error}") from None


def choices(register: Register[Any]) -> tuple[str, ...]:
    """The names that a value of the register may have: of members, special values, flags and parts."""
    kind = register.kind
    if kind == "boolean":
        return ("false", "true")
    if kind in {"enum", "flags"}:
        return tuple(_name(register, member) for member in _members_of(register))
    if kind == "fields":
        return tuple(f"{name}=" for name in _members_of(register).parts)
    return tuple(member.name for member in register.value_type.special or ())


def parts(register: Register[Any]) -> tuple[str, ...]:
    """The names of the flags or fields of a word; none for another register."""
    return tuple(name.removesuffix("=") for name in choices(register)) if register.kind in WORDS else ()


def part_of(register: Register[Any], value: Any, part: str) -> Plain:  # noqa: ANN401 - a value of the register
    """One flag or field of a word, plain; SensorFault, NotPresent or OutOfRange where it has no value."""
    if isinstance(value, Flags):
        return bool(int(value) & int(flag_of(register.path, type(value), part)))
    found = dict(value)[part]
    if isinstance(found, SensorFault | NotPresent | OutOfRange):
        raise found
    return found.name if isinstance(found, Choice) else found


def _members_of(register: Register[Any]) -> Any:  # noqa: ANN401 - members of enums, flags or a word of fields
    kind = register.value_type
    return kind.members if isinstance(kind, ChoiceType | FlagsType | WordType) else ()


def _name(register: Register[Any], member: Any) -> str:  # noqa: ANN401 - a member of an enum, a flag or a special value
    """The name of a member, behind that of its enum where another enum of the register has one of this name."""
    kind = register.value_type
    several = isinstance(kind, ChoiceType) and [one.name for one in kind.members].count(member.name) > 1
    return _qualified(member) if several else str(member.name)


def _qualified(member: Any) -> str:  # noqa: ANN401 - as above
    return f"{type(member).__name__}.{member.name}"


def _show_parts(word: Word) -> list[str]:
    rest, shown = int(word), []
    for name, value in word:
        if isinstance(value, NotPresent | OutOfRange):  # its bits, if any are set, are among the rest
            continue
        shown.append(f"{name}={_part_text(value)}")
        part = vars(type(word))[name]
        rest &= ~((1 << part.high + 1) - (1 << part.low))
    return [*shown, f"rest=0x{rest:04X}"] if rest else shown


def _part_text(value: Any) -> str:  # noqa: ANN401 - a value of any part
    if isinstance(value, SensorFault):
        return value.fault
    return value.name if isinstance(value, Choice) else text_of(value)


def _number(register: Register[Any], plain: Plain, unit: str, current: str) -> Any:  # noqa: ANN401 - or a special value
    if isinstance(plain, (bool, list)):
        raise ValueRefused(register.path, f"{plain!r} is no number")
    if not isinstance(plain, str):
        _same_unit(register, unit, current)
        return _exactly(register, str(plain))
    text = plain.strip()
    special = register.value_type.special
    if special is not None and not _NUMBER.match(text):
        _same_unit(register, unit, current)
        return _member(register, special, text)
    digits, beside = _digits(register, text)
    if beside and unit and _unit(beside) != _unit(unit):
        raise ValueRefused(register.path, f"`{text[:60]}` stands beside the unit {unit}: which one is meant?")
    _same_unit(register, beside or unit, current)
    return _exactly(register, digits)


def _digits(register: Register[Any], text: str) -> tuple[str, str]:
    """The number that a text begins with, and the unit behind it."""
    found = _WHOLE.fullmatch(text) or _NUMBER.match(text)
    if not found:
        raise ValueRefused(register.path, f"`{text[:60]}` is no number")
    if _MORE_DIGITS.match(text, found.end()):
        reason = f"`{text[:60]}` is no number of use: they look like 1500, 150.5, 2e-7 or 0x1F"
        raise ValueRefused(register.path, reason)
    return found[0], text[found.end() :].strip()


def _exactly(register: Register[Any], text: str) -> int | float:
    whole = whole_of(text)
    if whole is not None:
        return whole
    number = Decimal(text)
    close = float(number)
    if not number.is_finite() or Decimal(repr(close)) != number:
        raise ValueRefused(register.path, f"`{text[:60]}` has more digits than a number of use can carry")
    return close if close != int(close) or register.kind == "number" else int(close)


def whole_of(text: str) -> int | None:
    """The number of `1500` or `0x1F`; None for another text."""
    return int(text, 16 if "x" in text.lower() else 10) if _WHOLE.fullmatch(text) else None


def _same_unit(register: Register[Any], unit: str, current: str) -> None:
    if not unit or _unit(unit) == _unit(current):
        return
    if not current:
        raise ValueRefused(register.path, f"the value is given in {unit}, but the register has no unit")
    raise ValueRefused(
        register.path, f"the value is given in {unit}, but the device works in {current}: convert it first"
    )


def _unit(text: str) -> str:
    folded = unicodedata.normalize("NFC", " ".join(text.split()))
    return unicodedata.normalize("NFKC", _UNITS.get(folded.casefold(), folded))


def _member(register: Register[Any], members: Iterable[Any], plain: Plain) -> Any:  # noqa: ANN401 - a member, or a code
    known = list(members)
    enums = " or ".join(dict.fromkeys(type(one).__name__ for one in known))
    if isinstance(plain, (bool, list)) or (isinstance(plain, float) and not plain.is_integer()):
        raise ValueRefused(register.path, f"{plain!r} names no member of {enums}")
    text = str(int(plain) if isinstance(plain, float) else plain).strip()
    found = _fitting(known, text)
    if len(found) == 1:
        return found[0]
    if len({type(one) for one in found}) == len(found) > 1 and len({one.value for one in found}) == 1:
        return int(found[0].value)  # the member that has the code as the device is set
    if found:
        which = " or ".join(f"{_name(register, one)} ({one.value} {one.label})" for one in found)
        raise ValueRefused(register.path, f"`{text[:60]}` may be {which}: write the name")
    raise ValueRefused(register.path, f"`{text[:60]}` is no member of {enums}{_suggestion(known, text)}")


def _fitting(known: Sequence[Any], text: str) -> list[Any]:
    """Members with this name; else with this label or code; else with a label that begins with this word."""
    wanted, code = text.casefold(), whole_of(text)
    by_name = [one for one in known if wanted in {one.name.casefold(), _qualified(one).casefold()}]
    by_label_or_code = [one for one in known if one.label.casefold() == wanted or one.value == code]
    by_first_word = [one for one in known if one.label.casefold().split()[:1] == [wanted]]
    return by_name or by_label_or_code or by_first_word


def _suggestion(known: Sequence[Any], text: str) -> str:
    labels = {one.label: one.name for one in known if one.label}
    hint = meant(text, [*(one.name for one in known), *labels])
    for label, name in labels.items():
        hint = hint.replace(f"`{label}`", f"`{name}` ({label})") if name != label else hint
    return hint if "did you mean" in hint else meant("", [one.name for one in known])


def _flags_or_fields(register: Register[Any], plain: Plain) -> Any:  # noqa: ANN401 - flags or a word of the register
    members = _members_of(register)
    bits = _bits(register.path, plain)
    if bits is not None:
        return members(bits)
    value = members(0)
    nothing = {"none", members.label_of_none().casefold()} if register.kind == "flags" else {"none"}
    if isinstance(plain, str) and plain.strip().casefold() in nothing:
        return value
    for part in plain if isinstance(plain, list) else str(plain).split(","):
        text = str(part).strip()
        if not text or text.casefold() in nothing:
            continue
        if register.kind == "flags":
            value |= flag_of(register.path, members, text)
        else:
            value = with_part(register, value, text)
    return value


def flag_of(path: str, members: Any, name: str) -> Any:  # noqa: ANN401 - flags of the register
    """The flag with this name or label, or `bit_9`, which may have none."""
    for member in members:
        label = getattr(member, "label", "")
        if name.casefold() in {member.name.casefold(), str(label).casefold()}:
            return member
    bit = re.fullmatch(r"bit_([0-9]{1,4})", name)
    if bit:
        return members(1 << int(bit[1]))
    raise ValueRefused(path, f"`{name[:60]}` is no flag{meant(name, [one.name for one in members])}")


def with_part(register: Register[Any], word: Any, text: str) -> Any:  # noqa: ANN401 - a word of the register
    """The word with one part set by `part=value` or `rest=0x8000`."""
    name, _, value = text.partition("=")
    rest = whole_of(value) if name == "rest" else None
    if rest is not None:
        return type(word)(int(word) | rest)
    if name not in word.parts or not value:
        hint = meant(name, word.parts) if name not in word.parts else ": write part=value"
        raise ValueRefused(register.path, f"`{text[:60]}` is no part{hint}")
    try:
        return word.replace(**{name: _part(register, vars(type(word))[name], value)})
    except ValueRefused:
        raise
    except ValueError as error:
        raise ValueRefused(register.path, str(error)) from None


def _part(register: Register[Any], part: Bit | Field[Any], text: str) -> float:
    if isinstance(part, Bit):
        return int(_boolean(register.path, text))
    if issubclass(part.kind, Choice):
        return int(_member(register, part.kind, text))
    if isinstance(part, NumberField):
        return _exactly(register, _digits(register, text.strip())[0])
    number = whole_of(text)
    if number is None:
        raise ValueRefused(register.path, f"`{text[:60]}` is no whole number")
    if not 0 <= number < 1 << (part.high - part.low + 1):
        raise ValueRefused(register.path, f"{number} does not fit {part.high - part.low + 1} bits")
    return number


def _bits(path: str, plain: Plain) -> int | None:
    """A pattern of bits that is given as a number; None where names are given."""
    if isinstance(plain, str):
        return whole_of(plain.strip())
    if isinstance(plain, (bool, float)):
        raise ValueRefused(path, f"{plain!r} is no pattern of bits: name them, or write a whole number")
    return plain if isinstance(plain, int) else None


def _boolean(path: str, plain: object) -> bool:
    text = str(plain).strip().casefold()
    if text not in TRUE | FALSE:
        raise ValueRefused(path, f"`{text[:60]}` is neither true nor false")
    return text in TRUE
