"""What a driver knows between requests: the device's protocol, the givens and the remembered registers. No I/O."""

from collections.abc import Callable, Generator, Iterable, Mapping
from types import MappingProxyType
from typing import Any, NamedTuple, TypeVar

from regscribe.runtime.plan import Limits
from regscribe.runtime.request import Meanings, Reply, Request, verify

T = TypeVar("T")

Operation = Generator["Request | Pause", "Reply | None", T]
"""Protocol logic without I/O: yields requests (or pauses), receives replies, returns a value."""


class Pause(NamedTuple):
    """Time that the device needs, in seconds."""

    seconds: float


class Latency(NamedTuple):
    """Milliseconds from the end of a request to the start of its answer: a part that is fixed, and one for each word.

    `characters` character times at the speed of the line come on top.
    """

    minimum: float = 0
    maximum: float = 0
    minimum_per_word: float = 0
    maximum_per_word: float = 0
    characters: float = 0


class Protocol(NamedTuple):
    """What the device accepts: function codes, limits, unit ids, its meanings of exception codes, and its times.

    `timeout` is the longest time in seconds that a good answer may take at any speed, from the manual's latencies,
    which `latencies` has by function code; `gap` is the silence between frames in characters. `broadcast` are the
    functions that may be sent to all units at once, `bauds` and `formats` (8N1) what the serial line can be set to.
    """

    functions: tuple[int, ...] = (3, 6, 16)
    read_words: int = 125
    write_words: int = 123
    read_bits: int = 2000
    write_bits: int = 1968
    read_holes: bool = False
    unit_ids: tuple[int, int] = (1, 247)
    exceptions: Meanings = MappingProxyType({})
    timeout: float = 1.0
    baud: int = 9600
    format: str = "8N1"
    modes: tuple[str, ...] = ("rtu",)
    bauds: tuple[int, ...] = ()
    formats: tuple[str, ...] = ()
    gap: float = 3.5
    latencies: Mapping[int, Latency] = MappingProxyType({})
    broadcast: tuple[int, ...] = ()

    @property
    def read_limits(self) -> Limits:
        """What a read plan must keep to."""
        return Limits(words=self.read_words, bits=self.read_bits, holes=self.read_holes)


class Session:
    """One device behind one link: `memory` holds the registers that the meaning of others depends on.

    It is forgotten when one of them is written, when a command ran, and when the link was opened anew (`epoch`).
    `prepared` caches requests and decoders made under that memory, so it goes whenever the memory changes.
    """

    __slots__ = ("commands", "epoch", "givens", "memory", "prepared", "protocol", "registers", "unit")

    def __init__(
        self,
        *,
        unit: int,
        protocol: Protocol,
        registers: Mapping[str, Any],
        commands: Mapping[str, Any],
        givens: Mapping[str, Any],
    ) -> None:
        low, high = protocol.unit_ids
        if not low <= unit <= high:
            message = f"unit {unit} is outside {low} to {high}, the unit ids of this device"
            raise ValueError(message)
        self.unit, self.protocol, self.givens = unit, protocol, givens
        self.registers, self.commands = registers, commands
        self.memory: dict[str, Any] = {}
        self.prepared: dict[Any, Any] = {}
        self.epoch = 0

    def remember(self, path: str, value: object) -> None:
        """Keep the value of a register that others depend on."""
        self.memory[path] = value
        self.prepared.clear()

    def forget(self, paths: Iterable[str] | None = None) -> None:
        """Drop some registers from memory; all of them without `paths`."""
        gone = list(self.memory) if paths is None else [path for path in paths if path in self.memory]
        for path in gone:
            del self.memory[path]
        if gone:
            self.prepared.clear()

    def at_epoch(self, epoch: int) -> None:
        """Forget everything if the link was opened anew since the last operation."""
        if epoch != self.epoch:
            self.epoch = epoch
            self.forget()

    def exchange(self, request: Request) -> Operation[tuple[int, ...]]:
        """Send one request and verify its answer."""
        reply = yield request
        assert reply is not None, "an executor answers a request with a reply"  # noqa: S101 (the executors' contract)
        return verify(request, reply, unit=self.unit, meanings=self.protocol.exceptions)


Task = Callable[[Session], Operation[T]]
"""An operation before it knows its device."""
