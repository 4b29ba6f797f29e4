"""Units as people spell them, as the symbols of the language; a scale in a unit (`0.1V`) is told apart."""

import re
from dataclasses import dataclass
from fractions import Fraction

from regscribe.importers.table.cells import Unclear, quoted
from regscribe.importers.table.cells.numbers import clean, number
from regscribe.model.units import KNOWN_UNITS, meant_unit


@dataclass(frozen=True, slots=True)
class UnitCell:
    """The symbol, and the factor that stood before it (None: none).

    `known` is False of a symbol that a map must declare under `units` first.
    """

    symbol: str
    factor: Fraction | None = None
    known: bool = True


_NO_UNIT = frozenset(
    {"", "-", "--", "---", "none", "n/a", "na", "n.a.", "no unit", "unitless", "dimensionless", "keine", "ohne", "sans"}
    | {"/", ".", "1", "aucune", "ingen", "geen", "nessuna", "*"}
)
_KINDS = frozenset(
    {
        "enum",
        "enumeration",
        "bitfield",
        "bitmap",
        "bitmask",
        "bool",
        "boolean",
        "string",
        "text",
        "hex",
        "ascii",
        "flags",
    }
    | {"flag", "list", "bits", "date", "datetime", "version", "code", "integer", "int", "float"}
)
"""Words of a unit column that say of what kind the value is."""

_FACTOR = re.compile(
    r"[x*\u00d7]?\s*(?P<n>[+-]?(?:[0-9]+(?:[.,][0-9]+)?|[.,][0-9]+)(?:/[0-9]+)?)\s*[x*\u00d7]?\s*(?P<unit>[^0-9\s=:].*)",
    re.IGNORECASE,
)
_BEHIND = re.compile(
    r"(?P<unit>[^0-9\s(\[][^(\[]*?)\s*[(\[]\s*"
    r"(?:[x*\u00d7]?\s*(?P<times>0?[.,][0-9]+)|/\s*(?P<over>10+))\s*[)\]]",
    re.IGNORECASE,
)
"""A factor in brackets behind a unit: `A (x0.1)`, `V (/10)`."""
_POWER = re.compile(r"10\^(?P<n>[+-]?[0-9]{1,2})\s*[x*\u00d7]?\s*(?P<unit>[^0-9\s].*)")
_QUALIFIER = re.compile(
    r"\s*[(\[]?\b(?:rms|r\.m\.s\.|eff|avg|peak|abs|rel|ac|dc|a\.c\.|d\.c\.)\b\.?[)\]]?", re.IGNORECASE
)
_UNIT = re.compile(r"(?:[^\W\d_]|[°%‰µΩ\"'])[^=:;?!<>{}]{0,15}")
_STRAY_DIGIT = re.compile(r"[0-9]{2}|(?<![^\W\d_^])[0-9]")
"""Digits that are no exponent (m3) and no index (CO2)."""

MOST_WORDS = 2
"""Words of a unit; what has more is prose."""

_MILLI_OR_MEGA = frozenset({"mV", "mA", "mW", "m\u03a9", "mAh", "ml", "mg", "ms", "mF", "mH", "mS/cm", "m", "MW", "MV"})
_MILLI_OR_MEGA |= {"MVA", "Mvar", "MWh", "MVAh", "Mvarh", "MJ", "MHz", "MPa", "M\u03a9"}
_TWO_MEANINGS = {"F": "°F", "H": "h", "S": "s", "k": "K", "M": "min"}
"""Single letters that people write for another unit than the one of that symbol."""


def parse_unit(text: str) -> UnitCell | Unclear | None:
    """Read a cell of units; None if it is empty or says that there is none (`-`).

    Unclear: what is no unit but lists codes or names a kind, and letters that stand for two units (`Mw`).
    """
    plain = clean(text)
    plain = plain[1:-1].strip() if re.fullmatch(r"\[[^\[\]]*\]|\([^()]*\)", plain) else plain
    if plain.casefold() in _NO_UNIT:
        return None
    if plain.casefold() in _KINDS:
        return Unclear(f"{quoted(text)} is no unit, it says of what kind the value is")
    found = _symbol(plain)
    if isinstance(found, UnitCell) and found.known:
        factor = _with_factor(plain, text) if plain[:1].isdigit() and plain in KNOWN_UNITS else None
        return factor or found
    return _with_factor(plain, text) or found or Unclear(f"{quoted(text)} is no unit")


def may_scale(text: str) -> bool:
    """Whether an unclear unit may hold a scale (`0.1?`, `V*10`), so that the number hangs on it."""
    plain = clean(text)
    return bool(_STRAY_DIGIT.search(plain)) and not re.match(r"[0-9]+\s*[=:]", plain)


def is_of_a_number(text: str) -> bool:
    """Whether a unit tells a number from a code: `-` and `enum` do not."""
    return parse_unit(text) is not None and clean(text).casefold() not in _KINDS


def _with_factor(plain: str, text: str) -> UnitCell | Unclear | None:
    """The unit behind a factor; None where no factor stands."""
    factor: Fraction | Unclear
    if power := _POWER.fullmatch(plain):
        factor, rest = Fraction(10) ** int(power["n"]), power["unit"]
    elif found := _BEHIND.fullmatch(plain):
        factor = Fraction(1, int(found["over"])) if found["over"] else number(found["times"])
        rest = found["unit"]
    elif found := _FACTOR.fullmatch(plain):
        factor, rest = _fraction(found["n"]), found["unit"]
    else:
        return None
    symbol = _symbol(rest.strip())
    if re.match(r"0[0-9]", plain):
        return Unclear(f"{quoted(text)} begins with a number that lacks its point, or is no unit")
    if isinstance(factor, Unclear) or not isinstance(symbol, UnitCell) or not factor:
        return Unclear(f"{quoted(text)} is no number with a unit")
    if factor < 0:
        return Unclear(f"{quoted(text)} has a negative factor, or says that the number has a sign")
    return UnitCell(symbol.symbol, factor, symbol.known)


def _fraction(text: str) -> Fraction | Unclear:
    above, _, below = text.partition("/")
    first = number(above)
    if not below or isinstance(first, Unclear):
        return first
    return first / int(below) if int(below) else Unclear(f"{quoted(text)} divides by 0")


def _symbol(plain: str) -> UnitCell | Unclear | None:
    """The symbol that a text without a factor means; None where it looks like no unit."""
    if plain in _TWO_MEANINGS:
        return Unclear(f"{quoted(plain)} may stand for two units", f"`{_TWO_MEANINGS[plain]}`")
    if plain in KNOWN_UNITS:
        return UnitCell(plain)
    bare = _QUALIFIER.sub("", plain).strip() or plain
    if found := meant_unit(bare) or meant_unit(bare.replace(".", "")):
        if found in _MILLI_OR_MEGA and bare[:1] != found[0] and bare[:1] in "mM":
            return Unclear(f"{quoted(plain)} may be thousandths or millions", f"`{found}`")
        return UnitCell(found)
    if _UNIT.fullmatch(plain) and len(plain.split()) <= MOST_WORDS and not _STRAY_DIGIT.search(plain):
        return UnitCell(plain, known=False)
    return None
