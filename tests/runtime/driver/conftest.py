"""Small YAML -> generate -> import -> talk to the simulator: what every test here does."""

import asyncio
import importlib.util
import itertools
import re
import struct
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

import pytest

from regscribe import checks, lower, schema, source
from regscribe.emit import python
from regscribe.model import RegisterMap, Severity
from regscribe_runtime import LinkLost, NoAnswer, WrongAnswer
from regscribe_runtime.link.links import Retry
from regscribe_runtime.link.locks import AsyncTurns, Turns
from regscribe_runtime.values.serial_line import SerialLine
from regscribe_runtime.wire import pdu
from regscribe_runtime.wire.requests import Request

OVEN = (Path(__file__).parent / "oven.yaml").read_text(encoding="utf-8")
"""A made-up controller with every hard fact of the real manuals in a few registers."""


class Built(NamedTuple):
    """A compiled map and its generated driver module."""

    map: RegisterMap
    module: Any

    def driver(self, model: str) -> Any:
        """The synchronous driver class of a model."""
        return getattr(self.module, self.map.model(model).class_name)


def compile_text(text: str) -> RegisterMap:
    """All phases; fails the test with the diagnostics if there is an error."""
    document, found = source.parse(text, name="maps/test/oven.yaml")
    assert document is not None, found
    found = [*found, *schema.validate(document)]
    assert not found, found
    register_map, lowered = lower.lower(document)
    assert register_map is not None, lowered
    errors = [one for one in checks.check(register_map) if one.severity is Severity.ERROR]
    assert not errors, errors
    return register_map


def load(path: Path, name: str) -> ModuleType:
    """Import a generated file under a name of its own."""
    spec = importlib.util.spec_from_file_location(name, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


_numbers = itertools.count()
WRITE_ONE, WRITE_SEVERAL, READ_STATUS, READ_BITS = 6, 16, 7, {1, 2}


@pytest.fixture(scope="session")
def build(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Built]:
    """Compile, generate and import a map."""

    def make(text: str) -> Built:
        register_map = compile_text(text)
        ((_, code),) = python.render(register_map).items()
        folder = tmp_path_factory.mktemp("generated")
        (folder / "driver.py").write_text(code, encoding="utf-8")
        return Built(register_map, load(folder / "driver.py", f"generated_driver_{next(_numbers)}"))

    return make


@pytest.fixture(scope="session")
def oven(build: Callable[[str], Built]) -> Built:
    """The made-up controller."""
    return build(OVEN)


KILN = (Path(__file__).parent / "kiln.yaml").read_text(encoding="utf-8")
"""A made-up controller whose writes have every contract that the real manuals have."""


@pytest.fixture(scope="session")
def kiln(build: Callable[[str], Built]) -> Built:
    """The made-up controller for writes."""
    return build(KILN)


class DirectLink:
    """Carries requests to a simulated device without a line; `fate` says what happens to the one of a number.

    `lost` was carried out and is not answered, `missed` never arrived, `gone` took the link away before it was sent,
    `garbled` was carried out and answered with nonsense; all of them count from 1. `writes_only` counts writes alone.
    """

    def __init__(self, device: Any, *, fate: dict[int, str] | None = None, writes_only: bool = False) -> None:
        self.device, self.fate, self.writes_only = device, fate or {}, writes_only
        self.epoch, self.timeout, self.retry = 1, 1.0, Retry(reads=0)
        self.lock: Any = Turns()
        self.line: Any = SerialLine("", 9600)
        self.addressing = "modbus"
        self.count, self.log = 0, list[Request]()
        self.answered = True

    def open(self) -> None:
        """Nothing to open."""

    def close(self) -> None:
        """Nothing to close."""

    def retune(self, change: Any) -> None:
        """Talk otherwise."""
        self.addressing = change.addressing or self.addressing
        self.line = self.line._replace(**change.line)

    def call(self, unit: int, request: Request) -> Any:
        """Hand the request to the device, with the fate of its number."""
        self.log.append(request)
        self.count += not (self.writes_only and request.reads)
        fate = self.fate.get(self.count, "") if not (self.writes_only and request.reads) else self.fate.get(-1, "")
        if fate == "gone":
            message = "the cable is out"
            raise LinkLost(message)
        answer = None if fate == "missed" or not self._is_here(unit) else self._answer(request, unit)
        if answer is None or fate == "lost":
            raise NoAnswer(unit=unit, function=request.function, address=request.address, seconds=1.0)
        if fate == "garbled":
            message = "noise on the line"
            raise WrongAnswer(message)
        return answer

    def _is_here(self, unit: int) -> bool:
        return unit in getattr(self.device, "units", [self.device.unit])

    def _answer(self, request: Request, unit: int) -> Any:
        first = {"modbus": 0, "jbus": 1}[self.addressing]
        asked = request._replace(address=request.address + first)
        more = {} if unit == self.device.unit else {"unit": unit}
        answer = self.device.handle(pdu.encode_request(asked), **more)
        reply = None if answer is None else pdu.decode_reply(asked, answer)
        return reply and reply._replace(address=reply.address - first if reply.address else 0)


@pytest.fixture(scope="session")
def words() -> type["Words"]:
    """The device of nothing but numbers."""
    return Words


@pytest.fixture(scope="session")
def direct() -> type[DirectLink]:
    """The link without a line."""
    return DirectLink


class Words:
    """A device of nothing but numbers: `holds` by address, as an independent reader of the standard would serve them.

    It answers functions 01 to 04, 06, 07 and 16 from the bytes of a request, whatever its space, and keeps what was
    written.
    """

    def __init__(self, holds: dict[int, int], *, unit: int = 1) -> None:
        self.unit, self.holds = unit, dict(holds)

    def handle(self, pdu: bytes) -> bytes:
        """The answer to a request, both without address and checksum."""
        if pdu[0] == READ_STATUS:
            return bytes([READ_STATUS, 0])
        function, first, count = struct.unpack(">BHH", pdu[:5])
        if function == WRITE_ONE:
            self.holds[first] = count
            return pdu
        addresses = range(first, first + count)
        if function == WRITE_SEVERAL:
            self.holds.update(zip(addresses, struct.unpack(f">{count}H", pdu[6:]), strict=True))
            return pdu[:5]
        held = [self.holds.get(address, 0) for address in addresses]
        if function in READ_BITS:
            bits = sum((one & 1) << place for place, one in enumerate(held))
            return struct.pack(">BB", function, -(-count // 8)) + bits.to_bytes(-(-count // 8), "little")
        return struct.pack(f">BB{count}H", function, 2 * count, *held)


class AsyncDirectLink(DirectLink):
    """The link without a line for asyncio."""

    def __init__(self, device: Any) -> None:
        super().__init__(device)
        self.lock = AsyncTurns()

    async def open(self) -> None:  # type: ignore[override] # what asyncio drivers await
        """Nothing to open."""

    async def close(self) -> None:  # type: ignore[override] # as above
        """Nothing to close."""

    async def call(self, unit: int, request: Request) -> Any:
        """As `DirectLink.call`."""
        return super().call(unit, request)


class Talk:
    """A driver of the only model of a map in front of words, and the same for asyncio.

    `sent` are the requests of the synchronous driver as (function, address, count or words).
    """

    def __init__(self, built: Built, holds: dict[int, int]) -> None:
        self.built, self.words = built, Words(holds)
        name = built.map.models[0].class_name
        self.link = DirectLink(self.words)
        self.driver = getattr(built.module, name)(self.link, unit=1)
        self.other = getattr(built.module, f"Async{name}")(AsyncDirectLink(self.words), unit=1)

    @property
    def sent(self) -> list[tuple[int, ...]]:
        """What was asked for and written so far, in the order of sending."""
        return [(one.function, one.address, *(one.words or (one.quantity,))) for one in self.link.log]

    def read(self, path: str) -> Any:
        """The value of a register by its path: as the two drivers read it alone, in its element, and in a snapshot."""
        whole = self.driver.read()[path]
        found = [attribute(self.driver, path).read(), asyncio.run(_awaited(attribute(self.other, path).read()))]
        element, dot, name = path.rpartition(".")
        if dot:
            found += [attribute(self.driver, element).read()[name]]
            found += [asyncio.run(_awaited(attribute(self.other, element).read()))[name]]
        assert found == [whole] * len(found), "the ways to read a register disagree"
        return whole

    def unit(self, path: str) -> str:
        """The unit of a register as the device is configured, as both drivers tell it."""
        told = str(attribute(self.driver, path).read_unit())
        assert told == asyncio.run(_awaited(attribute(self.other, path).read_unit()))
        return told


async def _awaited(awaitable: Any) -> Any:
    return await awaitable


def attribute(driver: Any, path: str) -> Any:
    """The attribute `a[3].b` of a driver."""
    for name, index in re.findall(r"(\w+)(?:\[(\d+)\])?", path):
        driver = getattr(driver, name)[int(index)] if index else getattr(driver, name)
    return driver


@pytest.fixture(scope="session")
def talk(build: Callable[[str], Built]) -> Callable[..., Talk]:
    """Compile a map of one model and talk to a device that holds words, by address."""
    known: dict[str, Built] = {}

    def make(text: str, holds: dict[int, int]) -> Talk:
        known[text] = known.get(text) or build(text)
        return Talk(known[text], holds)

    return make
