"""Filters of ESPHome's sensors, in their order, as one scale."""

import re
from fractions import Fraction

from regscribe.draft import Remark
from regscribe.importers.shared.exact import number
from regscribe.importers.shared.reading import Keys, code_of, unclear_scale
from regscribe.importers.shared.tree import Node

Scale = tuple[Fraction, Fraction]
"""What a number is multiplied by, and what is added after that."""

OF_TIME = frozenset(
    {"delta", "throttle", "throttle_average", "heartbeat", "debounce", "timeout", "round", "round_to_multiple_of"}
    | {"median", "quantile", "min", "max", "skip_initial", "or"}
    | {"sliding_window_moving_average", "exponential_moving_average", "throttle_with_priority"}
)
"""Filters that only smooth, round or delay what is shown."""

PAIR = re.compile(r"\s*(\S+)\s*->\s*(\S+)\s*")
POINTS = 2


def scaled(keys: Keys) -> Scale | None:
    """Return the scale of all filters; None, with a remark to a person, where one cannot be said as one."""
    filters = keys.take("filters")
    scale: Scale = Fraction(1), Fraction(0)
    for one in filters.each if filters else ():
        for kind, value in (one.members or {one.text: one}).items():
            found = _one(keys, kind, value, scale)
            if found is None:
                keys.remarks.append(unclear_scale(f"the filter {kind} {value.shown} is not understood"))
                return None
            scale = found
    if not scale[0]:
        keys.remarks.append(unclear_scale("a filter multiplies by 0"))
        return None
    return scale


def _one(keys: Keys, kind: str, value: Node, scale: Scale) -> Scale | None:
    """The scale with one more filter behind it; None where it is not understood."""
    multiply, add = scale
    if kind in OF_TIME:
        keys.remarks.append(Remark(f"filter-{code_of(kind)}", f"the filter {kind} is for what is shown", lossy=False))
        return scale
    if kind in {"filter_out", "clamp"}:
        message = f"the filter {kind} {value.shown} is not taken over"
        keys.remarks.append(Remark(f"filter-{code_of(kind)}", message, todo=kind == "filter_out"))
        return scale
    if kind == "calibrate_linear":
        line = _line(value)
        return None if line is None else (multiply * line[0], add * line[0] + line[1])
    given = number(value.text) if value.is_scalar and not value.tag else None
    if given is None:
        return None
    if kind == "multiply":
        return multiply * given, add * given
    return (multiply, add + given) if kind == "offset" else None


def _line(value: Node) -> Scale | None:
    """The straight line through two points (`0 -> 4`); None where there are others."""
    listed = value.get("datapoints") or value
    pairs = [PAIR.fullmatch(one.text) for one in listed.each]
    numbers = [(number(one[1]), number(one[2])) for one in pairs if one]
    if len(pairs) != POINTS or len(numbers) != POINTS:
        return None
    (low, first), (high, last) = numbers
    if low is None or first is None or high is None or last is None or low == high:
        return None
    slope = (last - first) / (high - low)
    return slope, first - slope * low
