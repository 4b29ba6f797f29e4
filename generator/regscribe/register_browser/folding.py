"""Arrays folded: the registers of all elements as that of the first, with what differs from element to element.

`elements` of a folded register is `{"index": [[1], [2], ..], "vary": {place: change}}`. A place is the way to a fact,
its keys joined by `/`; a change is `{"from": first, "step": step}` of whole numbers, `{"as": text}` with `{0}`, `{1}`
for the indices, or `{"each": [..]}`, the fact in every element. What fits in no such way stays unfolded.
"""

import re
from collections.abc import Iterator, Sequence
from typing import Any

from regscribe.emit.outline import pattern

Json = Any
_INDEX = re.compile(r"\d+")


def fold(registers: Sequence[Json]) -> list[Json]:
    """Return registers in their order, those of the elements of an array as one."""
    groups: dict[tuple[str, str], list[Json]] = {}
    for one in registers:
        groups.setdefault((pattern(one["path"]), _shape(one)), []).append(one)
    return [_folded(each) if len(each) > 1 else each[0] for each in groups.values()]


def _shape(register: Json) -> str:
    """What registers of elements have in common: the places of all facts."""
    return "\n".join(place for place, _ in _leaves(register)) if register.get("index") else register["path"]


def _leaves(value: Json, place: str = "") -> Iterator[tuple[str, Json]]:
    if isinstance(value, dict | list) and value:
        items = value.items() if isinstance(value, dict) else enumerate(value)
        for key, each in items:
            yield from _leaves(each, f"{place}/{key}" if place else str(key))
    else:
        yield place, value


def _folded(registers: Sequence[Json]) -> Json:
    indices = [one["index"] for one in registers]
    columns = zip(*(_leaves(one) for one in registers), strict=True)
    vary = {
        column[0][0]: _change([value for _, value in column], indices)
        for column in columns
        if any(value != column[0][1] for _, value in column) and not column[0][0].startswith("index/")
    }
    return registers[0] | {"elements": {"index": indices, "vary": vary}}


def _change(values: list[Json], indices: Sequence[Sequence[int]]) -> Json:
    first, second = values[:2]
    if all(isinstance(one, int) and not isinstance(one, bool) for one in values):
        step = second - first
        if all(value == first + step * number for number, value in enumerate(values)):
            return {"from": first, "step": step}
    elif all(isinstance(one, str) for one in values):
        for template in _templates(first, indices[0]):
            if all(_filled(template, index) == value for value, index in zip(values, indices, strict=True)):
                return {"as": template}
    return {"each": values}


def _templates(text: str, index: Sequence[int]) -> Iterator[str]:
    """Texts with marks for the numbers that are indices: all of them, or one alone."""
    if "{" in text:
        return
    places = {str(number): place for place, number in reversed(list(enumerate(index)))}
    found = [each for each in _INDEX.finditer(text) if each[0] in places]
    for chosen in (found, *([one] for one in found)):
        made = text
        for each in reversed(chosen):
            made = f"{made[: each.start()]}{{{places[each[0]]}}}{made[each.end() :]}"
        yield made


def _filled(template: str, index: Sequence[int]) -> str:
    return re.sub(r"\{(\d)\}", lambda mark: str(index[int(mark[1])]), template)
