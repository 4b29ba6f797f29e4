"""All that a map does and says: what drivers send and give, what simulated devices answer, and what is written."""

import inspect
import re
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import redirect_stderr, redirect_stdout, suppress
from functools import partial
from io import StringIO
from pathlib import Path
from types import ModuleType
from typing import Any

from regscribe.cli.app import run
from regscribe.emit import markdown, python, vectors
from regscribe.export import csv, json
from regscribe.model import Command, Model, Register, RegisterMap, Space, View
from regscribe.model.located import layout_of
from regscribe.simulate.device.device import SimulatedDevice
from regscribe.testing.simulated_read import givens_of
from regscribe_runtime.driver.computed import Computed

from . import judges
from .matrix_watch import Wire, attempt, shown, values
from .wire import Memory

STATES = range(3)
"""Of how many kinds what a device holds is: all words 0, or each word 0 to 3 by its address."""
FEW_VALUES, FEW_MEMBERS, PARTS = 4, 3, (0, 1, 5, 100)
WRITTEN = (0, 1, 2, 5, 300)
"""Words that a master writes to a simulated device."""
SPACES = {1: Space.COIL, 2: Space.DISCRETE, 3: Space.HOLDING, 4: Space.INPUT}
MANY, SECONDS = 200, 40
SINGLE, SEVERAL = 6, 16
STRETCHES = ((0, 1), (1, 2), (7, 4), (8, MANY), (0, 13), (0, 22), (1, 6), (1, 5), (2016, 1), (2017, 2), (9999, 1))
"""Addresses and quantities that a master asks for."""
ELSEWHERE, FIRST, TIMES, MOST_WRITTEN = (7, 9, 703, 802, 9999), 140, (1, 2, 6, 9), 123
"""Addresses of no register that are written; so many addresses are read one by one; how many values a write has."""
Facts = Iterator[object]
Done = Callable[[Callable[[], Any]], object]


class Held(Memory):
    """A device that holds small numbers at all addresses, others in each state."""

    state = 0

    def __init__(self, headers: Mapping[tuple[Space, int], int]) -> None:
        super().__init__()
        self.headers = headers

    def get(self, space: str, address: int, count: int) -> list[int]:
        """What was written there, or a number from the address."""
        most = 1 if space in {"coil", "discrete"} else 3
        cells = self.cells[space]
        kinds = 4 if self.state else 1
        held = {at: (at * 7 // 3 + self.state) % kinds & most for at in range(address, address + count)}
        held |= {at: word for (where, at), word in self.headers.items() if where == space and at in held}
        return [cells.get(at, word) for at, word in held.items()]


def of_drivers(register_map: RegisterMap) -> Facts:
    """What the drivers of all models send and give, over words of every state."""
    module = _module_of(register_map)
    for model in register_map.models:
        cls = getattr(module, model.class_name)
        yield (cls.__name__, str(cls.protocol), cls.map_id)
        headers = layout_of(register_map, model, {}).words
        for state in STATES:
            memory = Held(headers)
            memory.state = state
            yield from _of_driver(cls, Wire(memory.answer), memory)
        device = SimulatedDevice(register_map, model.name, givens=_given(register_map))
        yield from _of_driver(cls, Wire(partial(_heard, device)), Held({}))


def _heard(device: SimulatedDevice, pdu: bytes) -> bytes:
    """The answer of a device; for silence the exception of a gateway, so that nobody waits."""
    return device.handle(pdu) or bytes((pdu[0] | 0x80, 0x0B))


def _module_of(register_map: RegisterMap) -> ModuleType:
    """The module of the drivers, behind those of libraries, which it finds by their names."""
    for path, code in python.render(register_map).items():
        module = ModuleType(path.removesuffix(".py").replace("/", "."))
        sys.modules[module.__name__] = module
        exec(compile(code, path, "exec"), vars(module))  # noqa: S102 (a driver that was generated just now)
    return module


def _of_driver(cls: Any, wire: Wire, memory: Held) -> Facts:
    found = givens_of(cls) | {"unit": 1}
    wanted = [one for one in inspect.signature(cls.__init__).parameters.values() if one.kind is one.KEYWORD_ONLY]
    device = cls(wire, **{one.name: found[one.name] for one in wanted if one.default is one.empty})

    def done(do: Callable[[], Any]) -> object:
        memory.clear()
        device.session.forget()
        return tuple(one[0] if one[:1] == ("pause",) else one for one in attempt(wire, do))

    yield done(lambda: [(path, shown(value)) for path, value in device.read().entries.items()])
    for group in _groups(device):
        yield (group.id, group.name, done(lambda: shown(device.read(group))))  # noqa: B023 (done at once)
    for register in device.registers.values():
        yield from _of_register(device, register, done, is_written=memory.state == 1)
    for name, one in inspect.getmembers(cls, lambda one: isinstance(one, Computed)):
        yield (name, one.unit, done(getattr(device, name).read))
    yield from _of_commands(device, done)
    yield done(lambda: device.configure(_wanted(device)).changes)


def _groups(device: Any) -> list[Any]:
    return [one for name, one in sorted(vars(device.groups).items()) if not name.startswith("_")]


def _of_register(device: Any, register: Any, done: Done, *, is_written: bool) -> Facts:
    bound = judges.attribute(device, register.path)
    yield (register.path, type(register).__name__, register.kind, register.access, register.danger, register.stays)
    if register.access != "w":
        yield done(bound.read_unit)
        yield from (done(partial(bound.read, view=view.name)) for view in register.views)
    if register.access != "r" and is_written:
        for value in _few(register):
            yield from (done(partial(bound.write, value, view=view.name)) for view in register.views)
        yield from (done(partial(_replaced, register, part, value)) for part in _parts(register) for value in PARTS)


def _parts(register: Any) -> tuple[str, ...]:
    """The parts of a word of bit fields."""
    return getattr(getattr(register.value_type, "members", None), "parts", ())


def _replaced(register: Any, part: str, value: float) -> object:
    """A word whose part has another value."""
    return register.value_type.make(0).replace(**{part: value})


def _few(register: Any) -> list[Any]:
    """A few values that may be written: plain ones, members and specials."""
    found = list(values(register))
    plain = [one for one in found if type(one) in {int, float, str}]
    return plain[:FEW_VALUES] + [one for one in found if type(one) not in {int, float, str}][:FEW_MEMBERS]


def _wanted(device: Any) -> dict[str, Any]:
    """A configuration: what can be written, with the first value that it takes."""
    found = {}
    for register in device.registers.values():
        if register.access == "rw" and not register.needs(register.read_view()):
            found |= dict.fromkeys([register.path], next(filter(partial(_takes, register), _few(register)), 0))
    return found


def _of_commands(device: Any, done: Done) -> Facts:
    section = getattr(type(device), "commands", None)
    for name, one in section.commands().items() if section else ():
        call = getattr(device.commands, name)
        yield {argument: each.unit for argument, each in one.arguments.items()}
        for arguments in _arguments(one):
            calls = (partial(call, **arguments), partial(call, confirm=True, **arguments))
            yield (name, str(arguments), *map(done, calls))


def _arguments(command: Any) -> Iterator[dict[str, Any]]:
    """Arguments of a command: what each takes, and for one after the other all values that are tried."""
    usual = {name: next(filter(partial(_takes, one), values(one)), 0) for name, one in command.arguments.items()}
    yield usual
    yield from (usual | {name: value} for name, one in command.arguments.items() for value in values(one))


def _takes(register: Any, value: Any) -> bool:
    with suppress(Exception):
        register.encode(value, view=register.read_view().name, state={}, givens={})
        return True
    return False


def of_simulators(register_map: RegisterMap) -> Facts:
    """What simulated devices of all models answer: new, after writes and commands, time, and a failure of power."""
    for model in register_map.models:
        for process in sorted({False, model.process is not None}):
            device = SimulatedDevice(register_map, model.name, givens=_given(register_map), process=process)
            yield from _asked(device)
            yield [device.handle(_read(space, at, 1)) for space in (Space.HOLDING, Space.INPUT) for at in range(FIRST)]
            yield from _lived(device, model)


def _given(register_map: RegisterMap) -> dict[str, Any]:
    return {one.id: _first_of(one) for one in register_map.givens if one.default is None}


def _first_of(given: Any) -> Any:
    return given.choices[0] if given.choices else {"boolean": True, "codes": frozenset({1})}.get(given.kind.value, 1)


def _asked(device: SimulatedDevice) -> Facts:
    """What it holds, addresses and quantities that it does not have, and functions that it does not know."""
    yield (device.unit, device.units, device.pending, dict(device.wear))
    for register in device.model.registers:
        yield device.peek(register.path)
        for view in register.views:
            yield device.handle(_read(view.space, view.address(register.at), view.words))
    for function in SPACES:
        for start, count in STRETCHES:
            yield (function, start, count, device.handle(bytes([function]) + _two(start, count)))
    yield from (device.handle(bytes([function, 0, 0, 0, 1])) for function in (7, 8, 9, 20, 22, 43))


def _lived(device: SimulatedDevice, model: Model) -> Facts:
    for register in model.registers:
        for view in register.views:
            for word in WRITTEN:
                yield from _written(device, register, view, word)
                yield device.peek(register.path)
    yield from (device.handle(bytes([6]) + _two(at, 1)) for at in ELSEWHERE)
    yield from _asked(device)
    for command in model.commands:
        yield from _commanded(device, command)
        yield from _asked(device)
    for _ in range(3):
        device.advance(SECONDS if device.moves else 0)
        yield from _asked(device)
    device.power_cycle()
    yield from _asked(device)


def _written(device: SimulatedDevice, register: Register, view: View, word: int) -> Facts:
    start = view.address(register.at)
    words = (0,) * (view.words - 1) + (word,)
    if view.space.is_bits:
        yield device.handle(bytes([5]) + start.to_bytes(2, "big") + (b"\xff\0" if word else b"\0\0"))
        yield device.handle(bytes([15]) + _two(start, 4) + b"\x01" + bytes([word & 15]))
    elif start < 1 << 16:
        yield device.handle(bytes([6]) + _two(start, word), broadcast=True)
        yield device.handle(bytes([6]) + _two(start, word))
        yield from (device.handle(_write(start, (words * times)[:MOST_WRITTEN])) for times in TIMES)


def _commanded(device: SimulatedDevice, command: Command) -> Facts:
    for step in command.steps:
        start = step.address.to_bytes(2, "big")
        if step.words and step.function == SINGLE:
            yield device.handle(bytes([SINGLE]) + start + step.words[0].to_bytes(2, "big"))
        elif step.words and step.function == SEVERAL:
            yield device.handle(_write(step.address, tuple(step.words)))
        elif step.words:
            yield device.handle(bytes([15]) + start + b"\0" + bytes([len(step.words), 1, step.words[0]]))
    yield device.commands_run


def _read(space: Space, address: int, count: int) -> bytes:
    return bytes([judges.READ_FUNCTIONS[space.value]]) + _two(address & 0xFFFF, count)


def _two(first: int, second: int) -> bytes:
    return first.to_bytes(2, "big") + second.to_bytes(2, "big")


def _write(address: int, words: tuple[int, ...]) -> bytes:
    data = b"".join(word.to_bytes(2, "big") for word in words)
    return bytes([16]) + _two(address, len(words)) + bytes([len(data)]) + data


def of_plans(path: Path, register_map: RegisterMap) -> Facts:
    """What `plan` prints for all registers of each model."""
    for model in register_map.models:
        with redirect_stdout(StringIO()) as out, redirect_stderr(out):
            code = run(["plan", str(path), "--model", model.name, "--all"])
        yield (code, out.getvalue())


def of_code(register_map: RegisterMap) -> Facts:
    """The code of the drivers, without what is said of the file that they come from."""
    for path, code in python.render(register_map).items():
        yield (path, re.sub(r"sha256( = .)? *\w+", "", code))


def of_docs(register_map: RegisterMap) -> Facts:
    """The pages of a map, without what is said of the file."""
    yield from ((path, re.sub(r"sha256 \w+", "", page)) for path, page in markdown.render(register_map).items())


OF_FILE = frozenset({"generated", "sha256"})


def of_vectors(register_map: RegisterMap) -> Facts:
    """The vectors of a map."""
    yield {key: value for key, value in vectors.document(register_map).items() if key not in OF_FILE}


def of_exports(register_map: RegisterMap) -> Facts:
    """A map as JSON and CSV, without what is said of the file."""
    yield re.sub(r'"(content_)?hash": "\w+"', "", json.json_text([register_map]))
    yield csv.csv_text([register_map])
