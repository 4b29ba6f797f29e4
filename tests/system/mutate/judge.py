"""Judge one mutant: build a driver (of a broken map, or with broken code) and run it against unbroken vectors.

    python judge.py driver MAP VECTORS   compile a map without its checks; run vectors and properties against its driver
    python judge.py real MAP OPERATOR    break one thing in the model of a real map; run its committed vectors

Prints what caught the mutant and exits with 0; exits with 1 if nothing did, with 2 if there was nothing to judge.
"""

import dataclasses
import sys
import types
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

from hypothesis import given, settings
from hypothesis import strategies as st

from regscribe import lower, source
from regscribe.emit import python
from regscribe.model import (
    Access,
    Array,
    Case,
    Interval,
    Model,
    Number,
    Order,
    OrderCases,
    Range,
    Register,
    RegisterMap,
    View,
)
from regscribe.testing import DriverUnderTest, Vectors, load
from regscribe.testing import properties as hold
from regscribe.testing.driver_checks import CHECKS

CAUGHT, SURVIVED, NOTHING = 0, 1, 2
PROPERTIES = (hold.round_trip, hold.refusal, hold.total_decoding, hold.agreement, hold.covering_reads, hold.batches)
few = settings(hold.each_run, max_examples=15)


def compiled(text: str) -> RegisterMap | None:
    """The model of a map text, or None if it is no map any more."""
    document, _ = source.parse(text, name="maps/test/kiln.yaml")
    return lower.lower(document)[0] if document else None


def driver_of(register_map: RegisterMap) -> types.ModuleType:
    """Generate the driver of a map and run its module."""
    (code,) = python.render(register_map).values()
    module = types.ModuleType("mutant")
    sys.modules["mutant"] = module
    exec(compile(code, "mutant.py", "exec"), vars(module))  # noqa: S102 (the code that we generated)
    return module


def caught_by(register_map: RegisterMap, vectors: Vectors, *, models: int | None = None) -> str:
    """The check that a driver of the map fails first; empty if it passes all."""
    try:
        module = driver_of(register_map)
        for model in register_map.models[:models]:
            bench = DriverUnderTest(getattr(module, model.class_name), vectors)
            for check in CHECKS:
                check(bench)
            if models is None:
                _properties(bench)
    except AssertionError as failure:
        return str(failure).splitlines()[0] + " " + " ".join(str(failure).splitlines()[1:2]).strip()
    except Exception as crash:  # noqa: BLE001 (a broken emitter or runtime may raise anything)
        return f"{type(crash).__name__}: {crash}"
    return ""


def _properties(bench: DriverUnderTest) -> None:
    for one in PROPERTIES:
        _tried(bench, one)


def _tried(bench: DriverUnderTest, one: Callable[[DriverUnderTest, st.DataObject], None]) -> None:
    @few
    @given(data=st.data())
    def run(data: st.DataObject) -> None:
        one(bench, data)

    run()


Change = Callable[[Register], Register | None]
"""A changed register; None where there is nothing to change."""


def changed(register_map: RegisterMap, change: Change) -> RegisterMap | None:
    """The map with the first register changed that can be, in all models that have it so."""
    found = next((old for old in register_map.models[0].registers if not old.array and change(old) is not None), None)
    if found is None:
        return None
    models = tuple(_with(model, found.path, change) for model in register_map.models)
    return dataclasses.replace(register_map, models=models)


def _with(model: Model, path: str, change: Change) -> Model:
    def one(old: Register | Array) -> Register | Array:
        return (change(old) or old) if isinstance(old, Register) and old.path == path else old

    registers = tuple(change(old) or old if old.path == path else old for old in model.registers)
    return dataclasses.replace(model, members=tuple(map(one, model.members)), registers=registers, by_path={})


def _views(register: Register, **what: Any) -> Register:
    views = tuple(view._replace(**what) for view in register.views)
    return dataclasses.replace(register, views=views)


def address(register: Register) -> Register | None:
    """One register stands an address further on."""
    return dataclasses.replace(register, at=register.at + 1)


def multiply(register: Register) -> Register | None:
    """The scale is ten times as steep."""
    if register.enum or register.fields:
        return None
    cases = tuple(Case(case.when, case.then._replace(multiply=case.then.multiply * 10)) for case in register.scale)
    return dataclasses.replace(register, scale=cases)


def offset(register: Register) -> Register | None:
    """The scale is shifted by one."""
    if register.enum or register.fields:
        return None
    cases = tuple(Case(case.when, case.then._replace(add=case.then.add + 1)) for case in register.scale)
    return dataclasses.replace(register, scale=cases)


def sign(register: Register) -> Register | None:
    """A signed type becomes unsigned, or an unsigned one signed."""
    other = {"int16": "uint16", "uint16": "int16"}.get(register.base.type)
    if other is None or register.enum or register.fields or len(register.views) > 1:
        return None
    return _views(register, type=type(register.base.type)(other))


def case(register: Register) -> Register | None:
    """Two cases of a scale are exchanged."""
    if len(register.scale) < 2:
        return None
    first, second, *rest = register.scale
    swapped = (Case(first.when, second.then), Case(second.when, first.then), *rest)
    return dataclasses.replace(register, scale=swapped) if first.then != second.then else None


def limit(register: Register) -> Register | None:
    """The upper limit of a range is one lower."""
    if not register.range or register.access is Access.READ or len(register.scale) > 1:
        return None
    found = register.range[0].then.intervals[0]
    if not isinstance(found.high, Number):
        return None
    narrower = Range((Interval(found.low, found.high - 1),), register.range[0].then.decimals)
    return dataclasses.replace(register, range=(Case(register.range[0].when, narrower), *register.range[1:]))


def access(register: Register) -> Register | None:
    """A register that can only be read can be written."""
    return dataclasses.replace(register, access=Access.READ_WRITE) if register.access is Access.READ else None


def alias(register: Register) -> Register | None:
    """An alias is lost."""
    return dataclasses.replace(register, aliases=()) if register.aliases else None


def member(register: Register) -> Register | None:
    """Two members of an enum exchange their codes."""
    enum = register.enum
    if enum is None or len(enum.members) < 2:
        return None
    first, second, *rest = enum.members
    codes = (dataclasses.replace(first, code=second.code), dataclasses.replace(second, code=first.code), *rest)
    return dataclasses.replace(register, enum=dataclasses.replace(enum, members=codes))


def bit(register: Register) -> Register | None:
    """A bit field is taken from one bit higher."""
    if not register.fields:
        return None
    first, *rest = register.fields
    moved = dataclasses.replace(first, low=first.low + 1, high=first.high + 1)
    return dataclasses.replace(register, fields=(moved, *rest))


def order(register: Register) -> Register | None:
    """The codes of the word order are exchanged."""

    def turned(view: View) -> View:
        if not isinstance(view.order, OrderCases):
            return view
        other = {Order.BIG: Order.LITTLE, Order.LITTLE: Order.BIG}
        return view._replace(order=OrderCases(tuple(Case(when, other[then]) for when, then in view.order.cases)))

    views = tuple(map(turned, register.views))
    return dataclasses.replace(register, views=views) if views != register.views else None


def factor(register: Register) -> Register | None:
    """A mirror transmits a hundred times the value instead of ten times."""
    views = tuple(view._replace(factor=Fraction(100)) if view.factor != 1 else view for view in register.views)
    return dataclasses.replace(register, views=views) if views != register.views else None


OPERATORS: dict[str, Change] = {
    one.__name__: one
    for one in (address, multiply, offset, sign, case, limit, access, alias, member, bit, order, factor)
}


def main(arguments: list[str]) -> int:
    """Judge what the command line names."""
    what, path, other = arguments
    text = Path(path).read_text(encoding="utf-8")
    register_map = compiled(text)
    if what == "real" and register_map is not None:
        maker, family = register_map.id.split("/")
        vectors = load(Path(path).parents[2] / "generated" / "vectors" / maker / f"{family}.json")
        broken = changed(register_map, OPERATORS[other])
        found = caught_by(broken, vectors, models=1) if broken else None
    else:
        found = caught_by(register_map, load(Path(other))) if register_map else None
    if found is None:
        return NOTHING
    print(found)  # noqa: T201 (what the runner reads)
    return CAUGHT if found else SURVIVED


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
