"""The exporter of JSON: the whole model under `schema/export.schema.json`, ready for programs in any language."""

import json
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import fields
from enum import Enum as PythonEnum
from fractions import Fraction
from typing import Any

from regscribe.emit.header import FORMAT
from regscribe.export.device.facts import DEVICE_FACTS, FACTS, Carries, Carry
from regscribe.model import (
    BOTTOM,
    TOP,
    Array,
    Command,
    FrameExample,
    IdentityRule,
    Interval,
    Is,
    Limit,
    Model,
    Number,
    Open,
    OrderCases,
    Ref,
    Register,
    RegisterMap,
    Space,
    TimingExample,
    ValueExample,
    View,
    exact,
    show,
)
from regscribe.plugins import Option
from regscribe_runtime.values.versions import version_of_key

name = "json"
summary = "the whole model, for programs in any language"
options: tuple[Option, ...] = ()
carries: Carries = dict.fromkeys((fact.id for fact in (*FACTS, *DEVICE_FACTS)), Carry.WHOLE)
verified = "a check of it against schema/export.schema.json"

EXAMPLES = {ValueExample: "value", FrameExample: "frame", TimingExample: "timing"}
PLACES = frozenset({"span", "by_path", "libraries", "shipped", "rules"})
"""Fields that say where something stands in a file, that only speed a look-up, or that only emitters of code need."""

Json = Any  # what the json module writes: nested lists and dicts of str, int, float, bool and None


def export(maps: Sequence[RegisterMap], _: Mapping[str, str]) -> dict[str, str]:
    """Return the document for standard output."""
    return {"": json_text(maps)}


def json_text(maps: Iterable[RegisterMap]) -> str:
    """Return all facts of the maps as one JSON document, indented, with a line end."""
    document = {"format": FORMAT, "maps": [_fields(each, "source") for each in maps]}
    return json.dumps(document, ensure_ascii=False, indent=1) + "\n"


def number(value: Number) -> Json:
    """Return a JSON number where its decimal text is exact also for readers of doubles, else both halves."""
    if value.denominator == 1:
        return value.numerator
    try:
        nearest = float(value)
    except OverflowError:
        nearest = 0.0
    if exact(nearest) == value:
        return nearest
    return {"numerator": value.numerator, "denominator": value.denominator, "text": show(value)}


def _model(model: Model) -> Json:
    known = zip(model.programs, model.program_notes, strict=True)
    programs = [_fields(program) | _fields(notes) for program, notes in known]
    members = [_tree(member) for member in model.members]
    return _fields(model, "program_notes") | {"members": members, "programs": programs}


def _tree(member: Register | Array) -> Json:
    """Arrays stay folded as a tree whose leaves are the paths of the first element's registers."""
    if isinstance(member, Register):
        return member.path
    return _fields(member) | {"members": [_tree(inner) for inner in member.members]}


def _fields(record: Any, *besides: str) -> dict[str, Json]:  # noqa: ANN401 (any dataclass or named tuple of the model)
    """The fields of a record, less PLACES and those in `besides`."""
    names = getattr(record, "_fields", None) or [item.name for item in fields(record)]
    return {name: plain(getattr(record, name)) for name in names if name not in PLACES and name not in besides}


def _command(command: Command) -> Json:
    """A command with the register of each step and the space that the step writes."""
    steps = [
        _fields(step)
        | {"register": path, "space": step.space.value}
        | _place(step.space, step.address)
        | {"page": step.space.page(step.address)}
        for step, path in command.named_steps
    ]
    return _fields(command, "step_registers") | {"steps": steps}


def _register(register: Register) -> Json:
    aliases = [register.base.space.inside(one) for one in register.aliases]
    views = [_view(view, register.at) for view in register.views]
    return _fields(register, "at") | {"aliases": aliases, "views": views}


def _view(view: View, at: int) -> Json:
    place = _place(view.space, view.address(at))
    return _fields(view, "offset", "order") | place | {"word_order": plain(view.order)}


def _place(space: Space, address: int) -> Json:
    """An address in its page, file or queue, and the number of the file or queue."""
    facts = space.facts(address)
    return {name: facts.get(name) for name in ("address", "file", "queue")}


def _order(order: OrderCases) -> Json:
    by_code = order.by_code()
    return {"register": by_code[0], "codes": plain(by_code[1])} if by_code else _fields(order)


def _test(test: Is) -> Json:
    codes = [{"low": _end(test, low), "high": _end(test, high)} for low, high in test.codes]
    return _fields(test, "bits") | {"codes": codes}


def _end(test: Is, end: Number | str) -> Json:
    """A number, a choice, or a version as text; null for an open end."""
    if isinstance(end, str) or end in {BOTTOM, TOP}:
        return end if isinstance(end, str) else None
    return version_of_key(int(end)) if test.version else number(end)


def _limit(limit: Limit) -> Json:
    if isinstance(limit, Open):
        return {"text": str(limit)}
    if isinstance(limit, Ref):
        return _fields(limit)
    return {"value": number(limit)} if isinstance(limit, Number) else {"term": plain(limit)}


WRITERS: dict[type, Callable[[Any], Json]] = {
    Fraction: number,
    bytes: lambda frame: frame.hex(" ").upper(),
    Register: _register,
    Is: _test,
    OrderCases: _order,
    Interval: lambda interval: {"low": _limit(interval.low), "high": _limit(interval.high)},
    tuple: lambda items: [plain(item) for item in _as_printed(items)],
    Model: _model,
    Command: _command,
    IdentityRule: lambda rule: _fields(rule.identity) | {"models": list(rule.models)},
    **dict.fromkeys(EXAMPLES, lambda example: {"type": EXAMPLES[type(example)]} | _fields(example)),
}
"""Types that are not written as an object of their fields."""


def _as_printed(items: tuple[Any, ...]) -> tuple[Any, ...]:
    """The items; of a stretch of addresses (space, first, last) those that stand in requests."""
    space = items[0] if items and isinstance(items[0], Space) else None
    return (space, *map(space.plain, items[1:])) if space else items


def plain(value: Any) -> Json:  # noqa: ANN401 (any value of the model)
    """Return a value of the model as the export has it."""
    if isinstance(value, PythonEnum):
        return value.value
    if value is None or isinstance(value, str | bool | int):
        return value
    write: Callable[[Any], Json] = WRITERS.get(type(value), _fields)
    return write(value)
