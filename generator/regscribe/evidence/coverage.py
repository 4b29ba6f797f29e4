"""How much of a device a map covers: addresses, facts of registers, worked examples, what is inferred and open."""

import re
from collections.abc import Callable, Iterable, Iterator

from regscribe.emit.words import one_line
from regscribe.evidence.coverage_values import Addresses, MapCoverage, ModelCoverage, Remark
from regscribe.model import FrameExample, Kind, Model, Open, Register, RegisterMap, Space, ValueExample
from regscribe.model.located import layout_of, located

INFERRED, OPEN_LIMIT, NOT_STATED = KINDS = ("inferred", "open limit", "decimals not stated")
"""Kinds of remarks about registers, in the order in which they are listed."""


def coverage(register_map: RegisterMap) -> MapCoverage:
    """Count what a map covers."""
    return MapCoverage(
        id=register_map.id,
        title=one_line(register_map.title),
        models=tuple(_model(register_map, model) for model in register_map.models),
        remarks=tuple(_remarks(register_map)),
        errata=len(register_map.errata),
        waivers=len(register_map.waivers),
        overrides=len(register_map.overrides),
        givens=len(register_map.givens),
        examples=len(register_map.examples),
    )


def _model(register_map: RegisterMap, model: Model) -> ModelCoverage:
    def number(fact: Callable[[Register], object]) -> int:
        return sum(bool(fact(register)) for register in model.registers)

    shown = _exemplified(register_map, model)
    return ModelCoverage(
        name=one_line(model.name),
        addresses=tuple(_addresses(register_map, model)),
        registers=len(model.registers),
        ranged=number(lambda register: register.range),
        coded=number(lambda register: register.enum or register.fields or register.specials or register.sentinels),
        defaults=number(lambda register: register.default is not None or bool(register.default_cases)),
        units=number(lambda register: any(case.then for case in register.unit)),
        sections=number(lambda register: register.section),
        examples=number(lambda register: register.path in shown),
        inferred=number(lambda register: register.inferred),
        open_limits=number(open_limits),
        raw=number(lambda register: register.kind is Kind.RAW),
    )


def _exemplified(register_map: RegisterMap, model: Model) -> frozenset[str]:
    """Return the paths of the registers of `model` that an example decodes, writes, or reads and writes in a frame.

    An example is about one model; it counts for another one whose register has the same views and scale.
    """
    forms = {
        each.name: {register.path: (register.views, register.scale) for register in each.registers}
        for each in register_map.models
    }
    named: list[tuple[str, str]] = []
    for example in register_map.examples:
        if isinstance(example, ValueExample):
            named.append((example.model, example.register))
        elif isinstance(example, FrameExample):
            paths = (*(path for path, _ in example.writes), *_carried(register_map, example))
            named += [(example.model, path) for path in paths]
    own = forms[model.name].items()
    return frozenset(path for name, path in named if (path, forms.get(name, {}).get(path)) in own)


def _carried(register_map: RegisterMap, frame: FrameExample) -> set[str]:
    """The registers whose words a frame carries; a request without words counts if it is for one register."""
    if frame.address is None or not register_map.has(frame.model):
        return set()
    spaces, start = _spaces(register_map, frame.function), frame.address
    end = start + (frame.count or len(frame.words or (0,)))
    found = {
        register.path
        for register in register_map.model(frame.model).registers
        for view in register.views
        if view.space in spaces
        and not register.block
        and not register.page
        and start <= view.space.plain(view.address(register.at))
        and view.space.plain(view.last(register.at)) < end
    }
    return found if frame.words or len(found) == 1 else set()


def _spaces(register_map: RegisterMap, function: int) -> set[Space]:
    """The spaces that a function reads or writes, itself or like others."""
    plain = (space for space in Space if space is not Space.ENRON)
    by_code = {code: space for space in plain for code in (space.read_function, *space.write_functions)}
    alike = next((codes for codes in register_map.alike if function in codes), (function,))
    found = {by_code[code] for code in alike if code in by_code} if function in by_code else set()
    return found | ({Space.ENRON} if Space.HOLDING in found else set())


def open_limits(register: Register) -> tuple[str, ...]:
    """Return the limits that the manual names without giving them, each once, in the order of the range."""
    intervals = (interval for case in register.range for interval in case.then.intervals)
    limits = (limit for interval in intervals for limit in (interval.low, interval.high))
    return tuple(dict.fromkeys(one_line(limit) for limit in limits if isinstance(limit, Open)))


def _addresses(register_map: RegisterMap, model: Model) -> Iterator[Addresses]:
    """Yield the counts of each space that holds anything, in the order of `Space`."""
    model = located(model, layout_of(register_map, model, {}))  # a block counts where a device may have it
    registers = model.registers
    stretches: dict[str, Iterable[Stretch]] = {
        "mapped": ((view.space, view.address(one.at), view.last(one.at)) for one in registers for view in one.views),
        "aliases": ((one.base.space, alias, alias + one.base.words - 1) for one in registers for alias in one.aliases),
        "commands": (
            (step.space, step.address, step.address + len(step.words) - 1)
            for command in model.commands
            for step in command.steps
        ),
        "unused": model.unused,
        "reserved": register_map.reserved,
    }
    for space, found in _by_space(stretches).items():
        if documented := set[int]().union(*found.values()):
            found["commands"] -= found["mapped"] | found["aliases"]
            numbers = {kind: len(addresses) for kind, addresses in found.items()}
            yield Addresses(space=space.value, documented=len(documented), **numbers)


Stretch = tuple[Space, int, int]
"""A space, and the first and the last address of a stretch in it."""


def _by_space(stretches: dict[str, Iterable[Stretch]]) -> dict[Space, dict[str, set[int]]]:
    found: dict[Space, dict[str, set[int]]] = {space: {kind: set() for kind in stretches} for space in Space}
    for kind, each in stretches.items():
        for space, first, last in each:
            found[space][kind].update(range(first, last + 1))
    return found


def _remarks(register_map: RegisterMap) -> Iterator[Remark]:
    """Yield what is inferred and open, by kind; what several models or registers share is said once."""
    models: dict[tuple[str, str, str], dict[str, None]] = {}
    for model in register_map.models:
        for register in model.registers:
            for kind, text in _of_register(register):
                at = re.sub(r"\[\d+\]", "[i]", register.path)
                models.setdefault((kind, text, at), {})[one_line(model.name)] = None
    shared: dict[tuple[str, str, tuple[str, ...]], list[str]] = {}
    for (kind, text, at), having in models.items():
        some = () if len(having) == len(register_map.models) else tuple(having)
        shared.setdefault((kind, text, some), []).append(at)
    for wanted in KINDS:
        for (kind, text, names), paths in shared.items():
            if kind == wanted:
                yield Remark(kind=kind, at=tuple(paths), text=text, models=names)
    for given in register_map.givens:
        yield Remark(kind="given", at=(given.id,), text=f"{one_line(given.description)}: {one_line(given.reason)}")


def _of_register(register: Register) -> Iterator[tuple[str, str]]:
    for item in register.inferred:
        yield INFERRED, f"{one_line(item.what)}: {one_line(item.why)}"
    for text in open_limits(register):
        yield OPEN_LIMIT, text
    if register.kind is Kind.RAW:
        yield NOT_STATED, ""
