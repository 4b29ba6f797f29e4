"""The state of a driver between requests: protocol, givens, remembered registers. No I/O."""

import time
from collections.abc import Callable, Generator, Iterable, Iterator, Mapping
from types import MappingProxyType
from typing import Any, NamedTuple, TypeVar

from regscribe_runtime.errors import (
    ExceptionAnswer,
    LinkLost,
    NoAnswer,
    PartialWrite,
    RegscribeError,
    WrongAnswer,
    is_lost,
)
from regscribe_runtime.link.links import LinkState, Retry
from regscribe_runtime.link.timing import response_seconds, slowest
from regscribe_runtime.operations.missing_registers import MissingRegisters
from regscribe_runtime.operations.portions import portions_of
from regscribe_runtime.planning.address_ranges import AddressRanges, ground_of, places
from regscribe_runtime.planning.cost import Cost
from regscribe_runtime.planning.plan import RequestLimits, Terms
from regscribe_runtime.registers.register import Register
from regscribe_runtime.report import Wear, WriteReport
from regscribe_runtime.values.blocks import Chain, Header, RegisterBlock, find, stated_bases
from regscribe_runtime.values.facts import Page
from regscribe_runtime.values.protocol import Protocol
from regscribe_runtime.values.serial_line import MODBUS, LineChange, SerialLine
from regscribe_runtime.values.views import needs, read_view
from regscribe_runtime.values.wire_types import WIRE, WRITE_AND_READ, Space
from regscribe_runtime.wire.requests import READ_HOLDING, Reply, Request, verify

T = TypeVar("T")

Operation = Generator["Request | Pause | LineChange", Reply | None, T]
"""Protocol logic without I/O: yields requests, pauses or line changes, receives replies, returns a value."""

GATEWAY_GOT_NO_ANSWER = 0x0B
"""The exception of a gateway whose serial side stayed silent, unless the device's manual gives it another meaning."""


class Pause(NamedTuple):
    """Time that the device needs, in seconds."""

    seconds: float


MOST_TIMED = 2000
"""Most reads whose timeout is cached: more than a device has registers, fewer than a scan of all addresses makes."""

TERMS = object()
"""The key of the terms in `Session.prepared`."""


class Session:
    """One device behind one link.

    `memory` holds the values of registers that the meaning of others depends on; it is cleared by writes to them, by
    commands, and when the link was reopened (`epoch`). `prepared` caches requests and decoders made under that memory,
    so it is cleared whenever the memory changes. `proven` are remembered registers that were read since the link was
    opened, `absences` addresses that this unit refused; those in `unused` (space, first, last) are read as 0.

    `pages` are how each page is reached, `page` is the one that the present operation has selected (0: none).

    `line` is the link's serial line (None over TCP), `retry` the retries (None: those of the link), `wrote` whether the
    present operation has sent anything but reads. `broken_off` is the report of the last `configure` that was cancelled
    or interrupted and could not be undone. `home` is the line setting before a write that governs the line, which is
    restored if that operation fails.

    `declared` are the registers as the driver's class has them, `registers` the same where they stand on this device.
    `most` are the most addresses of a request by space and function.
    `counters` are registers that tell where others stand, `chains` the chains of `blocks` that were walked since the
    link was opened, `places` the blocks that were found.
    """

    def __init__(  # noqa: PLR0913 (keywords, for what a driver's class has)
        self,
        *,
        unit: int,
        protocol: Protocol,
        registers: Mapping[str, Register[Any]],
        commands: Mapping[str, Any],
        givens: Mapping[str, Any],
        groups: Mapping[str, Any] = MappingProxyType({}),
        unused: tuple[tuple[Space, int, int], ...] = (),
        pages: tuple[Page, ...] = (),
        blocks: tuple[RegisterBlock, ...] = (),
    ) -> None:
        low, high = protocol.unit_ids
        if not low <= unit <= high:
            message = f"unit {unit} is outside {low} to {high}, the unit ids of this device"
            raise ValueError(message)
        self.unit, self.protocol, self.givens = unit, protocol, givens
        self.declared, self.commands, self.groups = registers, commands, groups
        self.blocks = {block.id: block for block in blocks}
        self.registers = registers
        self.counters = {path for register in registers.values() for path in register.counters}
        self.places: dict[str, Header] = {}
        self.chains: dict[str, tuple[Header, ...]] = {}
        self.memory: dict[str, Any] = {}
        self.pages, self.page = pages, 0
        self._rested, self._pause = 0.0, float(protocol.pause) / 1000
        self._ends: dict[str, float] = {}
        self.proven: set[str] = set()
        self.prepared: dict[Any, Any] = {}
        self.wear = Wear()
        self.epoch = 0
        self.line: SerialLine | None = None
        self.addressing = MODBUS
        self.retry: Retry | None = None
        self.wrote = False
        self.broken_off: WriteReport | None = None
        self.home: LineChange | None = None
        self._tries = Retry()
        self._timed: dict[Request, Request] = {}
        self._behind = slowest(protocol)
        self.most: dict[tuple[Space | None, int], int] = {
            (space, function): protocol.most(function, space)
            for space in Space
            for function in {space.read_function, *space.write_functions}
        }
        self.unused, self.absences = unused, MissingRegisters()
        self._ground: AddressRanges | None = None
        self._absent: frozenset[str] = frozenset()
        self._conditional: tuple[Register[Any], ...] | None = None
        self._lose_chains()

    def own(self, register: Register[Any]) -> Register[Any]:
        """The register of this device for a declaration; ValueError if it is of another device or of all elements."""
        found, here = self.declared.get(register.path), self.registers.get(register.path)
        if found and here and (register is here or (found.at, found.views) == (register.at, register.views)):
            return here
        message = (
            f"{register.path} at {register.at} is no register of this device; one of an array's element is taken "
            f"from the driver itself, as driver.elements[1].{register.id}"
        )
        raise ValueError(message)

    def remember(self, path: str, value: object) -> None:
        """Keep the value of a register that others depend on."""
        self.memory[path] = value
        for one in self.conditional:
            if one.path in self.memory and path in one.when.registers and not self.has(one):
                del self.memory[one.path]
        if good_for := self.registers[path].reading.good_for:
            self._ends[path] = time.monotonic() + float(good_for)
        self.proven.add(path)
        self.prepared.clear()
        if path in self.counters:
            self._place(self.blocks[self.registers[path].block].chain)

    def forget(self, paths: Iterable[str] | None = None) -> None:
        """Drop some registers from memory, with those whose values were decoded by them; all without `paths`."""
        gone = set(self.memory) if paths is None else self._decoded_by(paths)
        for path in gone:
            del self.memory[path]
        if gone:
            self.prepared.clear()

    def _decoded_by(self, paths: Iterable[str]) -> set[str]:
        """Those of some registers that are remembered, and what is remembered by their values."""
        gone = more = {path for path in paths if path in self.memory}
        while more:
            left = [self.registers[path] for path in self.memory if path not in gone]
            more = {one.path for one in left if not more.isdisjoint(needs(one, read_view(one)))}
            gone = gone | more
        return gone

    @property
    def conditional(self) -> tuple[Register[Any], ...]:
        """The registers that exist only under a condition."""
        if self._conditional is None:
            self._conditional = tuple([one for one in self.declared.values() if one.when.tests])
        return self._conditional

    def has(self, register: Register[Any]) -> bool:
        """Whether a register is known to exist, by what is remembered."""
        return register.when.always or self._meets(register)

    def _meets(self, register: Register[Any]) -> bool:
        tested = [self.declared[path] for path in register.when.registers if path in self.memory]
        known = {one.path: self.memory[one.path] for one in tested if self.has(one)}
        try:
            return register.when.holds(known, self.givens)
        except KeyError:
            return False

    def found(self, chain: Chain, headers: tuple[Header, ...]) -> None:
        """Adopt the headers of a chain: registers of its blocks stand at their addresses from now on."""
        self.chains[chain.id] = headers
        for block in self.blocks.values():
            if block.chain == chain and (header := find(block, headers)):
                self.places[block.id] = header
        self._place(chain)

    def _place(self, chain: Chain | None) -> None:
        """Locate the registers of blocks in a chain, or in none, as far as the blocks reach."""
        changed = {}
        for path, register in self.declared.items():
            header = self.places.get(register.block)
            if header and self.blocks[register.block].chain == chain:
                moved = register.placed(header.base, self.memory)
                changed[path] = moved if moved.end <= header.end else register.located(None)
        self.registers = {**self.registers, **changed}
        self._ground = None
        self.prepared.clear()

    def _lose_chains(self) -> None:
        """Forget where chains have their blocks; those with a given stay where it says."""
        if self.blocks:
            given = stated_bases(self.blocks.values(), self.givens)
            self.places = {name: Header(0, base) for name, base in given.items()}
            self.chains = {}
            self.registers = {path: one.located(None) if one.block else one for path, one in self.declared.items()}
            self._place(None)

    def at_epoch(self, epoch: int) -> None:
        """Forget everything if the link was reopened since the last operation."""
        if epoch != self.epoch:
            self.epoch = epoch
            self.forget()
            self.proven.clear()
            self._lose_chains()
            if self.absences.clear():
                self.prepared.clear()

    def terms(self) -> Terms:
        """The constraints and prices of read plans on this line."""
        if TERMS not in self.prepared:
            absent = frozenset(one.path for one in self.conditional if not self.has(one))
            if self._ground is None or absent != self._absent:
                holes = self.protocol.read_holes
                here = [one for one in self.registers.values() if one.origin is not None]
                unused = (*self.unused, *self._inside_blocks())
                self._ground, self._absent = ground_of(here, unused=unused, holes=holes, absent=absent), absent
            ground = self._ground
            if self.absences:
                ground = ground.refusing(self.absences.items(alone=True), apart=self.absences.items(alone=False))
            cost = Cost.of(self.protocol, self.line)
            self.prepared[TERMS] = Terms(RequestLimits.of(self.protocol), ground, cost, self.pages)
        found: Terms = self.prepared[TERMS]
        return found

    def _inside_blocks(self) -> Iterator[tuple[Space, int, int]]:
        """The addresses of blocks in chains, all of which a device answers for: space, first, last."""
        for name, header in self.places.items():
            if chain := self.blocks[name].chain:
                yield chain.space, header.base, header.end - 1

    def begin(self, link: LinkState) -> None:
        """Adopt the present state of the link before an operation."""
        self.at_epoch(link.epoch)
        self.addressing = link.addressing
        self._tries = self.retry or link.retry
        self.wrote, self.home, self.page = False, None, 0
        if self._ends:
            self._let_expire(time.monotonic())
        line = link.line
        if line is not None and not self.unit:
            message = "unit 0 is a broadcast on a serial line; the device has it over TCP only"
            raise ValueError(message)
        if line is not self.line and line != self.line:
            self.line = line
            self.prepared.clear()
            self._timed.clear()

    def _let_expire(self, now: float) -> None:
        """Forget what is remembered for longer than it is good for."""
        gone = [path for path, end in self._ends.items() if end <= now]
        self.forget(gone)
        for path in gone:
            del self._ends[path]

    def retuned(self, change: LineChange, *, line: SerialLine | None, addressing: str) -> None:
        """Adopt another unit id, line or addressing; everything remembered is dropped."""
        self.unit = self.unit if change.unit is None else change.unit
        self.line, self.addressing = line, addressing
        self._timed.clear()
        self.memory.clear()
        self.proven.clear()
        self.prepared.clear()

    def doubt(self) -> None:
        """Forget everything before the next operation: after a silence another device may answer."""
        self.epoch = -1

    def timed(self, request: Request) -> Request:
        """The request with its response timeout, by the manual's latencies and the line."""
        found = self._timed.get(request)
        if found is None:
            found = request._replace(seconds=response_seconds(self.protocol, request, self.line, behind=self._behind))
            if request.reads and len(self._timed) < MOST_TIMED:
                self._timed[request] = found
        return found

    def exchange(self, request: Request) -> Operation[tuple[int, ...]]:
        """Send one request and verify its answer; a read is sent again as `retry` says, a write never.

        A value that is more than the device takes at once (a long text) is sent in portions.
        """
        if len(portions := self.portions(request)) > 1:
            return (yield from self._in_portions(request, portions))
        asked = request
        if self.pages:
            request = yield from self._on_its_page(request)
        left = self._tries.reads if request.reads else 0
        while True:
            if self.protocol.pause and (left_to_rest := self._rested - time.monotonic()) > 0:
                yield Pause(left_to_rest)
            try:
                try:
                    reply = yield request
                finally:
                    self._rested = time.monotonic() + self._pause
                assert reply is not None, "an executor answers a request with a reply"  # noqa: S101 (their contract)
                words = verify(request, reply, unit=request.unit or self.unit, protocol=self.protocol)
            except (NoAnswer, WrongAnswer, LinkLost, ExceptionAnswer) as error:
                if not left or not _is_passing(error) or self._clears(asked):
                    raise
                left = 0 if isinstance(error, LinkLost) else left - 1  # a link that is lost once more is gone
            else:
                if self.absences.heard(asked):
                    self.prepared.clear()
                return words
            yield Pause(self._tries.pause)

    def portions(self, request: Request) -> list[Request]:
        """The requests that go out for one: several for a value that is longer than the device takes at once."""
        most = self.most.get((request.space, request.function), request.quantity)
        return portions_of(request, most, self.registers.values())

    def _in_portions(self, request: Request, portions: list[Request]) -> Operation[tuple[int, ...]]:
        """Send a request by several; PartialWrite if the device takes some of a write, and refuses the next."""
        words: tuple[int, ...] = ()
        for portion in portions:
            try:
                words += yield from self.exchange(portion)
            except (ExceptionAnswer, PartialWrite) as error:
                done = portion.address - request.address
                if request.reads or not done or is_lost(error):
                    raise
                done += error.written if isinstance(error, PartialWrite) else 0
                sent = request.quantity
                raise PartialWrite(unit=self.unit, address=request.address, sent=sent, written=done) from error
        if request.reads and self.absences.heard(request):
            self.prepared.clear()
        return words

    def _on_its_page(self, request: Request) -> Operation[Request]:
        """The request as it goes out once its page is selected."""
        page = request.space.page(request.address) if request.space else 0
        if page and self.pages[page - 1].at_once and request.function == READ_HOLDING:
            return self._selecting(request, page)
        if page:
            yield from self._turn_to(page)
            return request._replace(address=request.address & WIRE, page=page, unit=self.pages[page - 1].unit)
        if not request.reads and not request.selects:
            self.page = 0
        return request

    def _selecting(self, request: Request, page: int) -> Request:
        """The read of holding registers on a page as a request that selects the page as well, whatever was before."""
        self.page, how = 0, self.pages[page - 1]
        at, into = request.address & WIRE, how.steps[0].address
        return Request(
            WRITE_AND_READ, at, request.quantity, how.words, page=page, selects=True, unit=how.unit, into=into
        )

    def _turn_to(self, page: int) -> Operation[None]:
        """Write what selects a page, unless this operation has done so, and nothing else since."""
        if self.page == page:
            return
        if not self.pages[page - 1].steps:
            return
        self.page = 0
        for step in self.pages[page - 1].steps:
            request = Request(step.function, step.address, len(step.words), step.words, selects=True)
            yield from self.exchange(request)
        self.page = page

    def _clears(self, request: Request) -> bool:
        """Whether a read changed the device even if its answer was lost, so that a second one would tell nothing."""
        space, end = request.space, request.address + request.quantity
        return any(
            view.space is space and address < end and request.address < address + view.words
            for register in self.registers.values()
            if register.reading.clears
            for view, address in places(register)
        )


def _is_passing(error: RegscribeError) -> bool:
    """Whether an error may be gone at the next try; of exceptions, only that of a gateway without an answer."""
    return not isinstance(error, ExceptionAnswer) or (error.code == GATEWAY_GOT_NO_ANSWER and not error.name)


Task = Callable[[Session], Operation[T]]
"""An operation without its device."""
