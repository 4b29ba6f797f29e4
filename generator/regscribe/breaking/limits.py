"""Whether limits became narrower or wider, for those who write and for those who read."""

from collections.abc import Callable
from fractions import Fraction

from regscribe.breaking.change import Effects
from regscribe.breaking.facts import B, C, H, N
from regscribe.breaking.plain import plain
from regscribe.breaking.rules import LIMITS, NARROWED, WIDENED
from regscribe.model import BitField, Cases, Interval, Number, Range, Register, Rule

Ends = tuple[tuple[Fraction, Fraction], ...]


def write_limits(old: Register, new: Register) -> tuple[Rule, Effects]:
    """Judge `range`: narrower refuses writes, wider lets readers see more."""
    return _judged(old.range, new.range, written=old.access.writable, read=old.access.readable)


def valid_limits(old: Register, new: Register) -> tuple[Rule, Effects]:
    """Judge `valid`: a reading outside is an error of the driver."""
    rule, _ = _judged(old.valid, new.valid, written=old.access.writable, read=True)
    return rule, Effects(N, B if old.access.writable and rule is not WIDENED else H)


def part_limits(name: str, *, written: bool) -> Callable[[BitField, BitField], tuple[Rule, Effects]]:
    """Judge `range` or `valid` of a part of a word."""

    def judge(old: BitField, new: BitField) -> tuple[Rule, Effects]:
        one, other = getattr(old, name), getattr(new, name)
        rule = _direction((one,) if one else (), (other,) if other else ())
        return rule, _effects(rule, written=written, read=True)

    return judge


def _judged(old: Cases[Range], new: Cases[Range], *, written: bool, read: bool) -> tuple[Rule, Effects]:
    rules = {NARROWED if new else WIDENED} if not old or not new else _by_case(old, new)
    rule = rules.pop() if len(rules) == 1 else LIMITS
    return rule, _effects(rule, written=written, read=read)


def _effects(rule: Rule, *, written: bool, read: bool) -> Effects:
    if rule is WIDENED:
        return Effects(N, H if read else C)
    return Effects(N, B if written else C if rule is NARROWED else H)


def _by_case(old: Cases[Range], new: Cases[Range]) -> set[Rule]:
    """The directions in which the cases that differ went."""
    if [plain(case.when) for case in old] != [plain(case.when) for case in new]:
        return {LIMITS}
    found = set()
    for one, other in zip(old, new, strict=True):
        if plain(one.then) != plain(other.then):
            ends = _ends(one.then), _ends(other.then)
            same = one.then.decimals == other.then.decimals
            found.add(_direction(*ends) if same and None not in ends else LIMITS)
    return found


def _ends(limits: Range) -> Ends | None:
    """The intervals as numbers; None where a limit is no plain number."""
    found = []
    for interval in limits.intervals:
        if not isinstance(interval.low, Number) or not isinstance(interval.high, Number):
            return None
        found.append(_numbers(interval))
    return tuple(found)


def _numbers(interval: Interval) -> tuple[Fraction, Fraction]:
    return Fraction(interval.low), Fraction(interval.high)  # type: ignore[arg-type]  # numbers, as was tested


def _direction(old: Ends | None, new: Ends | None) -> Rule:
    """Whether all that was allowed still is, or all that is was: no limits allow everything."""
    if not old or not new:
        return NARROWED if new else WIDENED
    if _within(new, old):
        return NARROWED
    return WIDENED if _within(old, new) else LIMITS


def _within(inner: Ends, outer: Ends) -> bool:
    return all(any(low <= first and last <= high for low, high in outer) for first, last in inner)
