"""Numbers as other programs write them, exactly."""

import re
from fractions import Fraction

MOST_EXPONENT = 30
"""Powers of ten beyond which no scale of a register lies."""

DECIMAL = re.compile(r"([+-]?)(\d{1,40})?(?:\.(\d{0,40}))?(?:[eE]([+-]?\d{1,3}))?")
PREFIXED = re.compile(r"([+-]?)0(x[0-9a-f]{1,16}|b[01]{1,64}|o[0-7]{1,22})")


def number(text: str) -> Fraction | None:
    """Return the number that a text spells in decimal, with or without an exponent, or behind `0x`; None for others."""
    plain = text.strip().replace("_", "").lower()
    if found := PREFIXED.fullmatch(plain):
        return Fraction(int(f"{found[1]}0{found[2]}", 0))
    found = DECIMAL.fullmatch(plain)
    if not found or not (found[2] or found[3]):
        return None
    exponent = int(found[4] or 0)
    if abs(exponent) > MOST_EXPONENT:
        return None
    whole = Fraction(int((found[2] or "") + (found[3] or "")), 10 ** len(found[3] or ""))
    return (-whole if found[1] == "-" else whole) * Fraction(10) ** exponent


def whole(text: str) -> int | None:
    """Return the whole number that a text spells (`16`, `0x10`, `16.0`); None for others."""
    found = number(text)
    return found.numerator if found is not None and found.denominator == 1 else None
