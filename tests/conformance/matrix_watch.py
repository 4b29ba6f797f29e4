"""What a map does: a driver over a link without a line, a simulated device behind its PDUs, and the docs."""

import re
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import partial
from types import SimpleNamespace
from typing import Any
from unittest.mock import patch

from regscribe.emit import markdown, python
from regscribe.model import Register, RegisterMap, Space, View
from regscribe.simulate.device.device import SimulatedDevice
from regscribe_runtime import RegscribeError, ValueRefused
from regscribe_runtime.driver import executor
from regscribe_runtime.link.links import Retry
from regscribe_runtime.link.locks import Turns
from regscribe_runtime.values.serial_line import SerialLine
from regscribe_runtime.wire import pdu

from . import judges
from .suite import module_of
from .wire import Memory

NUMBERS = (0, 1, 2, 3, 5, 7, 11, 30, 100, 70000, -1, 1.5, 0.25)
TEXTS = ("", "A", "AB\0", "ABCDEF", "1.2", "0.1", "12", "00.01", "3", "\xe9")
WORDS = {
    1: ((0,), (1,), (3,), (5,), (7,), (12,), (0x4142,), (0x8000,), (0xFFFF,), (1200,), (0x4200,), (0x300,)),
    2: (
        (0, 0),
        (0, 1),
        (0, 3),
        (3, 0),
        (0, 7),
        (0x4142, 0x4300),
        (0x40A0, 0),
        (0x4040, 0),
        (0x7FC0, 0),
        (0x8000, 0),
        (0xFFFF, 0xFFFF),
    ),
    3: ((0x4142, 0x4344, 0x4546), (0x4142, 0x4300, 0x4400)),
    4: (
        (0, 0, 0, 0),
        (0, 0, 0, 1),
        (0, 0, 0, 3),
        (0, 0, 0, 7),
        (0x4014, 0, 0, 0),
        (0x4008, 0, 0, 0),
        (0x7FF8, 0, 0, 0),
    ),
}
"""What a register is let hold, by its number of words."""
STATES = ({900: 1, 901: 1, 902: 0, 903: 2, 904: 50, 905: 1}, {900: 0, 901: 0, 902: 1, 903: 4, 904: 6, 905: 0})
"""What the registers around it hold."""
STATUS = 7
SPARE = (50, 70, 78)
"""Addresses of no register, but where the map has an alias there."""


class Wire:
    """A link that answers from memory, and notes requests and pauses."""

    def __init__(self, answer: Callable[[bytes], bytes | None]) -> None:
        self.answer = answer
        self.epoch, self.timeout, self.retry = 1, 1.0, Retry(reads=0)
        self.lock: Any = Turns()
        self.line: Any = SerialLine("", 9600)
        self.addressing = "modbus"
        self.log: list[object] = []

    def open(self) -> None:
        """Nothing to open."""

    def close(self) -> None:
        """Nothing to close."""

    def retune(self, change: Any) -> None:
        """Note it."""
        self.log.append(("retune", repr(change)))

    def call(self, unit: int, request: Any) -> Any:
        """Answer a request."""
        asked = request._replace(seconds=0.0)
        self.log.append((unit, *asked[:4]))
        answer = self.answer(pdu.encode_request(asked))
        assert answer is not None
        return pdu.decode_reply(asked, answer)


def attempt(wire: Wire, do: Callable[[], Any]) -> tuple[object, ...]:
    """What an operation gives, what it was refused with, and what went over the wire."""
    wire.log.clear()
    noted = SimpleNamespace(sleep=lambda seconds: wire.log.append(("pause", seconds)))
    try:
        with patch.object(executor, "time", noted):
            found: object = shown(do())
    except (ValueRefused, RegscribeError) as error:
        found = (type(error).__name__, getattr(error, "fault", ""))
    except (ValueError, TypeError, AttributeError) as error:
        found = type(error).__name__
    return (found, *wire.log)


def shown(value: Any) -> object:
    """A value with its type and its name."""
    if isinstance(value, int | float | str | bool | None):
        named = getattr(value, "name", "")
        return (type(value).__name__, repr(value), str(named))
    return re.sub(r" at 0x[0-9a-f]+", "", repr(value))


def driver_of(register_map: RegisterMap) -> Any:
    """The module of a map's driver."""
    ((_, code),) = python.render(register_map).items()
    return module_of(code)


class Subject:
    """The register under trial in a driver whose device is memory."""

    def __init__(self, module: Any, path: str) -> None:
        self.memory = Memory()
        self.wire = Wire(self.memory.answer)
        self.device = module.MatrixA(self.wire, unit=1)
        self.path = path
        self.declared = self.device.registers[path]
        self.bound = judges.attribute(self.device, path)

    def hold(self, view: Any, words: tuple[int, ...], state: dict[int, int]) -> None:
        """Let the device hold words, and nothing be remembered."""
        self.memory.clear()
        views = [view for view in self.declared.views if view.space is Space.ENRON]
        self.memory.long = {view.space.plain(view.address(self.declared.at)) for view in views}
        self.device.session.forget()
        most = {"coil": 1, "discrete": 1, "status": 0xFF}.get(view.space, 0xFFFF)
        self.memory.put(view.space, view.address(self.declared.at), [word & most for word in words])
        for at, word in state.items():
            self.memory.put("holding", at, [word])

    def tried(self, do: Callable[[], Any]) -> tuple[object, ...]:
        """What an operation gives, or was refused with, and what went over the wire."""
        return attempt(self.wire, do)


def by_driver(module: Any, path: str) -> Iterator[object]:
    """All that a driver does with the register: reads, units, writes, configurations, reading it among others."""
    if path not in module.MatrixA.registers:
        yield "absent"
        return
    subject = Subject(module, path)
    declared = subject.declared
    yield (type(declared).__name__, declared.kind, declared.is_configuration, declared.stays, declared.default)
    yield [shown(value) for value in values(declared)]
    for state in STATES:
        for view in declared.views:
            yield from _in_view(subject, view, state)
        yield subject.tried(subject.bound.read_unit if declared.access != "w" else dict)
        yield subject.tried(subject.bound.read if declared.access != "w" else dict)
        if declared.access != "r":
            yield from _together(subject, state)


def _in_view(subject: Subject, view: Any, state: dict[int, int]) -> Iterator[object]:
    declared, bound = subject.declared, subject.bound
    for words in WORDS.get(view.words, ()) if declared.access != "w" else ():
        subject.hold(view, words, state)
        yield subject.tried(lambda: bound.read(view=view.name))
    yield subject.tried(lambda: subject.device.read(subject.path, "low"))
    for value in values(declared) if declared.access != "r" else ():
        for words in ((0,) * view.words, (0xFFFF,) * view.words):
            subject.hold(view, words, state)
            yield subject.tried(partial(bound.write, value, view=view.name, verify=True))


def _together(subject: Subject, state: dict[int, int]) -> Iterator[object]:
    bound, view = subject.bound, subject.declared.views[-1]
    for wanted in (1, 5, "A"):
        value = next((one for one in values(subject.declared) if one == wanted), wanted)
        subject.hold(view, (3,) * view.words, state)
        yield subject.tried(lambda: subject.device.configure({subject.path: value, "low": 3, "sel": 2}).changes)  # noqa: B023 (done at once)
        yield subject.tried(partial(bound.write, value))
        yield subject.tried(partial(bound.write, value, confirm=True))
        if subject.declared.access == "rw":
            yield subject.tried(lambda: bound.change(lambda _: value))  # noqa: B023 (done at once)


def values(declared: Any) -> Iterator[Any]:
    """Values that a program may write: numbers and texts, members, specials and words of bits of its kind."""
    kind = declared.value_type
    yield from TEXTS if kind.kind in {"text", "string", "version"} else NUMBERS
    for number in (0, 1, 3, 5, 7):
        with suppress(Exception):  # a kind makes what it makes
            made = kind.make(number)
            if type(made) not in {int, float, bool, str}:
                yield made
    yield from getattr(kind, "special", None) or ()


def by_simulator(register_map: RegisterMap, path: str) -> Iterator[object]:
    """All that a simulated device answers around the register: as delivered, after writes, after power was away."""
    register = next((one for one in register_map.models[0].registers if one.path == path), None)
    if register is None:
        yield "absent"
        return
    for state in STATES:
        device = SimulatedDevice(register_map, "A", unit=1)
        yield from _seen(device, register)
        for number in (0, 1, 5, 7, 300):
            yield from _lived(device, register, state, number)
        yield dict(device.wear)


def _lived(device: SimulatedDevice, register: Register, state: dict[int, int], number: int) -> Iterator[object]:
    """A number comes, the unit of measure changes, commands are given, power goes and comes."""
    for at, word in {**state, 903: state[903] + number, 904: 50}.items():
        device.handle(_write(at, (word,)))
    device.handle(_write(910, (0x4140 + number, 0)))
    yield from _seen(device, register)  # what follows others, before it is written itself
    for view in register.views:
        for words in ((number,) * view.words, (0,) * (view.words - 1) + (number,)):
            yield from _written(device, register, view, words)
            yield from _seen(device, register)
    for at, word in ((905, number % 2), (700, 1), (701, 1)):
        device.handle(_write(at, (word,)))
        yield from _seen(device, register)
    try:
        device.poke(register.path, number)
    except Exception as error:  # noqa: BLE001 (it says why)
        yield type(error).__name__
    device.power_cycle()
    yield from _seen(device, register)


def _written(device: SimulatedDevice, register: Register, view: View, words: tuple[int, ...]) -> Iterator[object]:
    start = view.space.plain(view.address(register.at))
    where = start.to_bytes(2, "big")
    if view.space is Space.HOLDING:
        yield from (device.handle(_write(address, words)) for address in (start, *SPARE))
        yield device.handle(bytes([6]) + where + words[-1].to_bytes(2, "big"))
    elif view.space is Space.ENRON:
        data = b"".join(word.to_bytes(2, "big") for word in words)
        count = (len(data) // 4).to_bytes(2, "big") + bytes([len(data)])
        yield device.handle(bytes([16]) + where + count + data)
        yield device.handle(bytes([6]) + where + data[-4:])
    elif view.space is Space.COIL:
        yield device.handle(bytes([5]) + where + (b"\xff\0" if words[-1] else b"\0\0"))


def _write(address: int, words: tuple[int, ...]) -> bytes:
    data = b"".join(word.to_bytes(2, "big") for word in words)
    return bytes([16]) + address.to_bytes(2, "big") + len(words).to_bytes(2, "big") + bytes([len(data)]) + data


def _seen(device: SimulatedDevice, register: Register) -> Iterator[object]:
    yield device.peek(register.path)
    yield device.handle(_read(3, 903, 1))
    for view in register.views:
        function = judges.READ_FUNCTIONS[view.space.value]
        yield device.handle(b"\x07") if function == STATUS else None
        for address in (view.space.plain(view.address(register.at)), *SPARE):
            yield device.handle(_read(function, address, view.words // view.space.each))


def _read(function: int, address: int, count: int) -> bytes:
    return bytes([function]) + address.to_bytes(2, "big") + count.to_bytes(2, "big")


def by_docs(register_map: RegisterMap) -> str:
    """The pages of a map."""
    return "\n".join(f"{name}\n{page}" for name, page in sorted(markdown.render(register_map).items()))
