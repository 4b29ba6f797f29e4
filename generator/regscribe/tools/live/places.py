"""The registers of one unit by address; where its blocks stand is learned from the headers that it was seen to send."""

from collections import defaultdict
from collections.abc import Mapping, Sequence
from typing import Any

from regscribe_runtime import AsyncBareDevice, BareDevice, Register
from regscribe_runtime.values.blocks import Chain, Header, RegisterBlock, find, headers_in
from regscribe_runtime.values.facts import CommandStep
from regscribe_runtime.values.views import View

Here = list[tuple[Register[Any], View]]


class RegisterPlaces:
    """Registers and their views by space and address; `bases` are known bases of blocks."""

    def __init__(self, driver: type[BareDevice | AsyncBareDevice], bases: Mapping[str, int]) -> None:
        self._registers = driver.registers.values()
        self._blocks: dict[str, RegisterBlock] = {one.id: one for one in driver._blocks}  # noqa: SLF001 (its facts)
        self._headers = {name: Header(0, base) for name, base in bases.items()}
        self._seen: dict[tuple[str, int], int] = {}
        self._index = self._indexed()

    def at(self, space: str, address: int) -> Here:
        """The registers that begin at an address."""
        return self._index.get((space, address), [])

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
            self._index = self._indexed()

    def _learn(self, chain: Chain) -> None:
        found = headers_in(chain, {address: word for (space, address), word in self._seen.items()})
        for block in self._blocks.values():
            if block.chain == chain and block.id not in self._headers and (header := find(block, found)):
                self._headers[block.id] = header

    def _indexed(self) -> dict[tuple[str, int], Here]:
        found: dict[tuple[str, int], Here] = defaultdict(list)
        for declared in self._registers:
            header = self._headers.get(declared.block)
            register = declared.located(header.base) if header else declared
            for view in register.views if header or not declared.block else ():
                for at in (register.at, *register.aliases):
                    found[view.space, view.address(at)].append((register, view))
        return dict(found)
