"""Texts of a map with a form of their own: identifiers, names of other things, ranges `a..b`, version patterns."""

import re
from collections.abc import Callable, Collection, Iterable
from dataclasses import replace
from fractions import Fraction

from regscribe.lower.node import ZERO, Value, brief
from regscribe.lower.rules import BAD_VERSION, NO_IDENTIFIER, REVERSED, WRONG_SORT
from regscribe.model import parse, show
from regscribe.model.identifiers import snake, unindexed
from regscribe.model.nearest import nearest

_LISTED = 12
_NUMBER = r"([+-]?[0-9]{1,30}(?:\.[0-9]{1,30})?(?:[eE][+-]?[0-9]{1,3})?)"
_ENDS = re.compile(rf"\s*{_NUMBER}\s*\.\.\s*{_NUMBER}\s*")


def identifier(node: Value, *, label: str, given: Value | None, derive: Callable[[str], str] = snake) -> str:
    """The identifier `given` in the map, or else the one that `derive` makes of `label`; RS0317 where that is none."""
    name = given.text() if given else derive(unindexed(label))
    if not name.isidentifier():
        where = given or node
        what = f"`{name}` is no identifier" if given else f"no identifier can be derived from `{brief(label)}`"
        where.report(NO_IDENTIFIER, what, remedy="give an `id` of letters, digits and _ that starts with a letter")
        return "unnamed"
    return name


def unknown(
    node: Value, rule: str, what: str, name: str, known: Iterable[str], *, of: str = "", at_key: bool = False
) -> None:
    """Report that there is no `what` of this name (in the thing `of`), with the nearest one and those that exist."""
    if (rule, node.key_span if at_key else node.span) in node.context.found:
        return
    names = list(dict.fromkeys(known))
    near = nearest(name, names)
    place = f" in `{of}`" if of else ""
    guess = f"did you mean `{near}`? " if near else ""
    more = f" and {len(names) - _LISTED} more" if len(names) > _LISTED else ""
    listed = f"there are: {', '.join(map(brief, names[:_LISTED]))}{more}" if names else "there are none"
    said = f"there is no {what} `{brief(name)}`{place}"
    meant = _in_place_of(name, near, written=node.key if at_key else node.value)
    node.report(rule, said, remedy=f"{guess}{listed}", at_key=at_key, replacement=meant)


def _in_place_of(name: str, near: str, *, written: object) -> str:
    """What is written, with the name that was meant in it: `register.field` holds two; empty for no text."""
    if not near or not isinstance(written, str):
        return ""
    before, dot, after = written.partition(f"{name}.") if written.startswith(f"{name}.") else ("", "", "")
    if dot:
        return f"{near}.{after}"
    before, found, after = written.rpartition(name)
    return f"{before}{near}" if found and not after and before[-1:] in {"", "."} else ""


def known_name(node: Value, rule: str, what: str, known: Collection[str], *, of: str = "") -> str:
    """The text of `node`, which is to be one of the names known; reports `rule` where it is none of them."""
    name = node.text()
    if name not in known:
        unknown(node, rule, what, name, known, of=of)
    return name


def ends(node: Value) -> tuple[Fraction, Fraction]:
    """The two ends that `a..b` spells; a plain number stands for both. RS0330 and RS0315 where it does not."""
    low, high = unordered(node)
    if low > high:
        message = f"the range {node.text()} is reversed: {show(low)} is more than {show(high)}"
        node.report(REVERSED, message, remedy=f"write {show(high)}..{show(low)}")
        return high, low
    return low, high


def ordered(node: Value, low: Fraction, high: Fraction) -> tuple[Fraction, Fraction]:
    """The two ends of `{from: a, to: b}`; RS0315 where the first is above the second."""
    if low > high:
        node.report(REVERSED, "the range is reversed: `from` is more than `to`", remedy="exchange the two")
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
    return ZERO, ZERO


def key_ends(node: Value) -> tuple[Fraction, Fraction]:
    """The two ends that the key `a..b` of a value spells; RS0330 and RS0315 at the key where it does not."""
    return ends(replace(node, value=node.key))


def whole_ends(node: Value | None, otherwise: tuple[int, int] = (0, 0)) -> tuple[int, int]:
    """The two whole ends that `a..b` spells, `otherwise` where there is no value; RS0330 where one has a fraction."""
    if node is None:
        return otherwise
    low, high = ends(node)
    if low.denominator != 1 or high.denominator != 1:
        node.report(WRONG_SORT, f"`{node.text()}` is no range of whole numbers", remedy="write whole numbers, as 1..8")
        return 0, 0
    return low.numerator, high.numerator


def version_of(node: Value | None) -> tuple[int, int]:
    """Decimal digits and digits of a group of a version pattern such as nn.nn.nn; RS0329 for any other text."""
    if node is None:
        return 0, 0
    groups = node.text().split(".")
    if not all(group and group == "n" * len(groups[0]) for group in groups):
        message = f"`{node.text()}` is no version pattern"
        node.report(BAD_VERSION, message, remedy="write one n a digit, in groups of equal length, as nn.nn.nn")
        return 0, 0
    return len(groups) * len(groups[0]), len(groups[0])
