"""The device that all programs read: what it holds by hand, what our driver reads of it, and what is exported of it."""

import importlib.util
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from types import ModuleType
from typing import Any

from regscribe import plugins, source
from regscribe.emit import python
from regscribe.losses import Exported
from regscribe.model import RegisterMap
from regscribe.simulate import Running, find_map, simulate
from regscribe_runtime import SensorFault

HERE = Path(__file__).parent
MAP = HERE / "device.yaml"
UNIT = 1

Said = bool | str | Fraction | None
"""A value of use; None: the words report a fault."""


@dataclass(frozen=True, slots=True)
class Held:
    """What a register holds, by hand: its words (or bit), and the value that they are.

    `value` is a number (of an enum the code, of flags and parts the word), a text or a truth value; None where the
    words report the `fault` of that id. `special`, `member`, `flags` and `fields` are what else the words mean, by id.
    """

    words: tuple[int, ...]
    value: Said
    fault: str = ""
    special: str = ""
    member: str = ""
    flags: tuple[str, ...] = ()
    fields: Mapping[str, int] | None = None

    @property
    def number(self) -> Fraction:
        """The value as an exact number; a truth value is 0 or 1."""
        assert not isinstance(self.value, str | None), self
        return Fraction(self.value)

    @property
    def hexadecimal(self) -> str:
        """The bytes of the words as they follow each other on the wire."""
        return "".join(f"{word:04X}" for word in self.words)


@dataclass(frozen=True, slots=True)
class Stage:
    """The device as it is served on loopback, and what it holds and reads as, by path.

    `driver` has what the generated driver reads: the value, or the error of a fault. Nobody is to write to it; who
    writes takes a stage of his own (`staged`).
    """

    running: Running
    held: Mapping[str, Held]
    driver: Mapping[str, Any]

    @property
    def host(self) -> str:
        """The address that it is served at."""
        return self.running.host

    @property
    def port(self) -> int:
        """The port that it is served at."""
        return self.running.port

    @property
    def at(self) -> str:
        """Host and port, as exporters take them."""
        return f"{self.host}:{self.port}"

    @property
    def register_map(self) -> RegisterMap:
        """The map, compiled."""
        return find_map(MAP)

    def export(self, form: str, **options: str) -> Exported:
        """Return what a format makes of the device; an option that is not named has its default."""
        exporter = plugins.exporter(form)
        known = {one.name: one.default for one in exporter.options}
        told = {"at": self.at, "unit": str(UNIT)} | {name.replace("_", "-"): text for name, text in options.items()}
        return plugins.export(form, [self.register_map], known | {key: told[key] for key in told if key in known})

    def text(self, form: str, **options: str) -> str:
        """Return the one text of an export."""
        (text,) = self.export(form, **options).texts.values()
        assert isinstance(text, str)
        return text


def told() -> dict[str, Held]:
    """Return what held.yaml says."""
    document, found = source.load(HERE / "held.yaml")
    assert document is not None, found
    return {path: _held(dict(facts)) for path, facts in document.data.items()}


def _held(facts: dict[str, Any]) -> Held:
    digits = facts.pop("words").replace(" ", "")
    words = [digits] if len(digits) == 1 else [digits[at : at + 4] for at in range(0, len(digits), 4)]
    special = facts.get("special", "")
    value = Fraction(0) if special else _value(facts.pop("value", None))
    flags = tuple(facts.pop("flags", ()))
    return Held(tuple(int(word, 16) for word in words), value, flags=flags, **facts)


def _value(value: Any) -> Said:
    if isinstance(value, str) and value.replace("/", "").isdigit():
        return Fraction(value)
    return Fraction(value) if isinstance(value, int | Decimal) and not isinstance(value, bool) else value


@contextmanager
def staged() -> Iterator[Stage]:
    """Serve the device, holding what held.yaml says, while the block runs."""
    held = told()
    with simulate(MAP, unit=UNIT) as running:
        fill(running, held)
        yield Stage(running, held, readings(running))


def fill(running: Running, held: Mapping[str, Held]) -> None:
    """Let a device hold what is said by hand."""
    for path, one in held.items():
        running.poke(path, one.fault or one.special or (int(one.value) if isinstance(one.value, bool) else one.value))


def readings(running: Running) -> dict[str, Any]:
    """Return what the generated driver reads of each register: its value, or the error that says why there is none."""
    kind = module_of(find_map(MAP)).InteropOne
    with kind.tcp(running.host, port=running.port, unit=UNIT) as device:
        return {path: _read(device, path) for path in kind.registers}


def module_of(register_map: RegisterMap) -> ModuleType:
    """Compile the driver of a map and import it."""
    ((name, code),) = python.render(register_map).items()
    spec = importlib.util.spec_from_loader("interop_driver", loader=None)
    assert spec is not None
    module = importlib.util.module_from_spec(spec)
    exec(compile(code, name, "exec"), vars(module))  # noqa: S102 (a driver that was generated just now)
    return module


def _read(device: Any, path: str) -> Any:
    for part in path.split("."):
        name, _, index = part.rstrip("]").partition("[")
        device = getattr(device, name)
        device = device[int(index)] if index else device
    try:
        return device.read()
    except SensorFault as fault:
        return fault
