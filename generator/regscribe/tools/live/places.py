"""The registers of one unit by address; where its blocks stand is learned from the headers that it was seen to send."""

from collections import defaultdict
from collections.abc import Mapping, Sequence
from typing import Any

from regscribe_runtime import AsyncBareDevice, BareDevice, Register
from regscribe_runtime.planning.address_ranges import places
from regscribe_runtime.values.blocks import Chain, Header, RegisterBlock, find, headers_in
from regscribe_runtime.values.facts import CommandStep
from regscribe_runtime.values.views import View
from regscribe_runtime.values.wire_types import PAGE_BITS

Here = list[tuple[Register[Any], View]]


class RegisterPlaces:
    """Registers and their views by space and address; `bases` are known bases of blocks."""

    def __init__(self, driver: type[BareDevice | AsyncBareDevice], bases: Mapping[str, int]) -> None:
        self._registers = driver.registers.values()
        self._blocks: dict[str, RegisterBlock] = {one.id: one for one in driver._blocks}  # noqa: SLF001 (its facts)
        self._headers = {name: Header(0, base) for name, base in bases.items()}
        self._pages, self._page = driver._pages, 0  # noqa: SLF001 (as above)
        self._written: dict[tuple[str, int], int] = {}
        self._counters = {path for one in self._registers for path in one.counters}
        self._counts: dict[str, Any] = {}
        self._seen: dict[tuple[str, int], int] = {}
        self._index = self._indexed({})

    def at(self, space: str, address: int, unit: int) -> Here:
        """The registers that begin at an address, of the device or of a unit behind it."""
        for number, page in enumerate(self._pages, start=1):
            if page.unit and page.unit == unit:
                return self._index.get((space, number << PAGE_BITS | address), [])
        behind = self._index.get((space, self._page << PAGE_BITS | address), []) if self._page else []
        return behind or self._index.get((space, address), [])

    def wrote(self, space: str, address: int, words: Sequence[int]) -> None:
        """Learn which page is selected: the first whose steps were all written, and nothing else there since."""
        if not self._pages:
            return
        self._written |= {(space, address + place): word for place, word in enumerate(words)}
        shown = [number for number, page in enumerate(self._pages, start=1) if page.steps and self._shows(page.steps)]
        self._page = next(iter(shown), 0)

    def _shows(self, steps: Sequence[CommandStep]) -> bool:
        cells = ((one.space, one.address + place, word) for one in steps for place, word in enumerate(one.words))
        return all(self._written.get((space, at)) == word for space, at, word in cells)

    def placed(self, step: CommandStep) -> CommandStep:
        """A step of a command with the address that it has on this unit."""
        header = self._headers.get(step.block)
        return step._replace(address=step.address + header.base, block="") if header else step

    def saw(self, space: str, address: int, words: Sequence[int]) -> None:
        """Learn from words that were read where blocks stand."""
        chains = dict.fromkeys(one.chain for one in self._blocks.values() if one.chain and one.chain.space == space)
        if not chains:
            return
        self._seen |= {(space, address + place): word for place, word in enumerate(words)}
        before = len(self._headers)
        for chain in chains:
            self._learn(chain)
        if len(self._headers) > before:
            self._index = self._indexed(self._counts)

    def counted(self, state: Mapping[str, Any]) -> None:
        """Learn from values of registers where those behind packed arrays stand."""
        counts = {path: state[path] for path in self._counters if path in state}
        if counts != self._counts:
            self._counts, self._index = counts, self._indexed(counts)

    def _learn(self, chain: Chain) -> None:
        found = headers_in(chain, {address: word for (space, address), word in self._seen.items()})
        for block in self._blocks.values():
            if block.chain == chain and block.id not in self._headers and (header := find(block, found)):
                self._headers[block.id] = header

    def _indexed(self, counts: Mapping[str, Any]) -> dict[tuple[str, int], Here]:
        found: dict[tuple[str, int], Here] = defaultdict(list)
        for declared in self._registers:
            header = self._headers.get(declared.block)
            register = declared.placed(header.base, counts) if header else declared
            counted = [one for one in declared.when.leaves if one.register in counts]
            reaches = not header or register.end <= header.end
            here = reaches and register.origin is not None and all(one.holds(counts, {}) for one in counted)
            for view, address in places(register) if here else ():
                found[view.space, address].append((register, view))
        return dict(found)
