"""The manual's worked examples as vectors: values beside words, and frames."""

from fractions import Fraction
from typing import Any

from regscribe.emit.vectors.assumed_state import Assumed
from regscribe.emit.vectors.scale import scale_now
from regscribe.model import FrameExample, Outcome, Register, RegisterMap, ValueExample, View, show
from regscribe.reference import RefusedError, UnknownValueError, decode, encode

Json = dict[str, Any]
Pairs = tuple[tuple[str, Fraction], ...]


def worked_examples(register_map: RegisterMap) -> list[Json]:
    """Return the examples of the manual in its order; timings are no vectors."""
    found = []
    for example in register_map.examples:
        if isinstance(example, ValueExample):
            found.append(_value(register_map, example))
        elif isinstance(example, FrameExample):
            found.append(_frame(register_map, example))
    return found


def _place(register_map: RegisterMap, model: str, path: str, name: str) -> tuple[Register, View]:
    register = register_map.model(model).register(path)
    return register, next((view for view in register.views if view.name == name), register.base)


def _value(register_map: RegisterMap, example: ValueExample) -> Json:
    register, view = _place(register_map, example.model, example.register, example.view)
    words = tuple(word & 0xFFFF for word in example.words)
    known = Assumed(register_map, example.model, example.state)
    encodes = False
    try:
        scale_now(register, view, known.surroundings)  # asks also where a fault or a clipped view decides first
        decode(register, view, words, known.surroundings)
        if isinstance(example.value, Fraction) and not example.lossy and register.access.writable:
            encodes = encode(register, view, example.value, known.surroundings) == words
    except (RefusedError, UnknownValueError):
        encodes = False  # a limit or a condition that the example leaves open
    found: Json = {"source": example.source, "model": example.model, "register": example.register, "view": view.name}
    found |= {"words": list(words), **known.told(), **_outcome(example)}
    return {**found, **({"encodes": True} if encodes else {})}


def _outcome(example: ValueExample) -> Json:
    if example.outcome is Outcome.FAULT:
        return {"fault": str(example.value)}
    found: Json = {} if example.stored is None else {"stored": show(example.stored)}
    if example.outcome is Outcome.SATURATED:
        return {**found, "outcome": "saturated"}
    if example.value is not None:
        found["value"] = show(example.value) if isinstance(example.value, Fraction) else example.value
    if example.flags is not None:
        found["flags"] = list(example.flags)
    return found


def _frame(register_map: RegisterMap, example: FrameExample) -> Json:
    known = Assumed(register_map, example.model, example.state, example.writes)
    places = ((_place(register_map, example.model, path, example.view), value) for path, value in example.writes)
    try:
        encodes = bool([encode(register, view, value, known.surroundings) for (register, view), value in places])
    except (RefusedError, UnknownValueError):
        encodes = False
    found: Json = {"source": example.source, "model": example.model, "frame": example.frame.hex(" ").upper()}
    found |= {"crc": example.crc, "answer": example.answer, "unit": example.unit, "function": example.function}
    found |= _said(example) | (known.told() if example.writes else {})
    return {**found, **({"encodes": True} if encodes else {})}


def _said(example: FrameExample) -> Json:
    numbers = {name: getattr(example, name) for name in ("address", "count") if getattr(example, name) is not None}
    words = {} if example.words is None else {"words": [word & 0xFFFF for word in example.words]}
    writes = {"writes": {path: show(value) for path, value in example.writes}} if example.writes else {}
    return {
        **numbers,
        **words,
        **writes,
        **{name: getattr(example, name) for name in ("view", "command") if getattr(example, name)},
    }
