"""The text `a..b`: two numbers with the lower first."""

import re
from fractions import Fraction

from regscribe.lower.node import Value, brief
from regscribe.lower.rules import REVERSED, WRONG_SORT
from regscribe.model import parse, show

_NUMBER = r"([+-]?[0-9]{1,30}(?:\.[0-9]{1,30})?(?:[eE][+-]?[0-9]{1,3})?)"
_ENDS = re.compile(rf"\s*{_NUMBER}\s*\.\.\s*{_NUMBER}\s*")


def ends(node: Value) -> tuple[Fraction, Fraction]:
    """The two ends that `a..b` spells; a plain number stands for both. RS0330 and RS0315 where it does not."""
    low, high = unordered(node)
    if low > high:
        message = f"the range {node.text()} is reversed: {show(low)} is more than {show(high)}"
        node.report(REVERSED, message, remedy=f"write {show(high)}..{show(low)}")
        return high, low
    return low, high


def unordered(node: Value) -> tuple[Fraction, Fraction]:
    """The two ends that `a..b` spells, in whatever order; RS0330 for any other text."""
    if node.is_number:
        return node.number(), node.number()
    match = _ENDS.fullmatch(node.value) if node.is_text else None
    if match is not None:
        try:
            return parse(match[1]), parse(match[2])
        except ValueError:  # an exponent beyond those of all types
            pass
    shown = f"`{brief(node.text())}`" if node.is_text else "this"
    node.report(WRONG_SORT, f"{shown} is no range", remedy="write two numbers as a..b, for example -10..250.5")
    return Fraction(0), Fraction(0)


def whole_ends(node: Value) -> tuple[int, int]:
    """The two whole ends that `a..b` spells; RS0330 where one has a fraction."""
    low, high = ends(node)
    if low.denominator != 1 or high.denominator != 1:
        node.report(WRONG_SORT, f"`{node.text()}` is no range of whole numbers", remedy="write whole numbers, as 1..8")
        return 0, 0
    return low.numerator, high.numerator
