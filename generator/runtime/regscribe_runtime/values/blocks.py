"""Blocks: registers that stand together, and whose base address a device or its user tells."""

import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

from regscribe_runtime.values.wire_types import Space

HEADER = 2
"""Words of a header: the id of a block, and how many words follow."""
END_OF_SPACE = 1 << 16
ADDRESS = re.compile(r"0[xX][0-9A-Fa-f]{1,4}|0|[1-9][0-9]{0,4}")
"""How an address is written on a command line."""


class Chain(NamedTuple):
    """Blocks one behind the other, each with a header: its id and its length, the number of words behind the header.

    They begin behind `marker`, which stands at one of the addresses `at`, and end with the id `end`.
    """

    id: str
    at: tuple[int, ...] = (0,)
    marker: tuple[int, ...] = ()
    end: int = 0xFFFF
    space: Space = Space.HOLDING


class RegisterBlock(NamedTuple):
    """A block of a map: at the address that the given `given` states, or number `number` of one of `ids` in `chain`.

    Addresses of its registers count from its base; in a chain that is the first word of the header.
    """

    id: str
    given: str = ""
    chain: Chain | None = None
    ids: tuple[int, ...] = ()
    number: int = 1


class Slip(NamedTuple):
    """A packed array in front: what follows moves up by `words` for each element that a device lacks of `most`."""

    counter: str
    words: int
    most: int

    def steps(self, count: int) -> int:
        """The steps to an address on a device with so many elements."""
        return -self.words * (self.most - count)


class Header(NamedTuple):
    """A block as a device has it: its id, the address of its first word, and how many words follow its header.

    `length` is None where nothing tells it.
    """

    id: int
    base: int
    length: int | None = None

    @property
    def end(self) -> int:
        """The first address behind it."""
        return END_OF_SPACE if self.length is None else self.base + HEADER + self.length


class Layout(NamedTuple):
    """Where blocks stand, by their ids, and the words of chains by space and address (0 inside the blocks)."""

    headers: Mapping[str, Header]
    words: Mapping[tuple[Space, int], int]

    @property
    def stretches(self) -> tuple[tuple[Space, int, int], ...]:
        """Addresses (space, first, last) of chains, which a device that has the blocks answers for."""
        return tuple((space, address, address) for space, address in self.words)


def stated_bases(blocks: Iterable[RegisterBlock], givens: Mapping[str, Any]) -> dict[str, int]:
    """The bases that givens state, by block; ValueError for one that is no address."""
    bases = {}
    for block in blocks:
        if block.given in givens:
            base = givens[block.given]
            if base != int(base) or not 0 <= base < END_OF_SPACE:
                message = f"{block.given}={base}: the base of block {block.id} is a whole number from 0 to 65535"
                raise ValueError(message)
            bases[block.id] = int(base)
    return bases


def find(block: RegisterBlock, headers: Iterable[Header]) -> Header | None:
    """The block among the headers of its chain; None if the chain lacks it."""
    fitting = [header for header in headers if header.id in block.ids]
    return fitting[block.number - 1] if len(fitting) >= block.number else None


def bases_in(owner: str, blocks: Sequence[RegisterBlock], texts: Iterable[str]) -> dict[str, int]:
    """The addresses that texts NAME=ADDRESS give to blocks and chains of a map `owner`; ValueError for another text."""
    known = [*dict.fromkeys(block.chain.id for block in blocks if block.chain), *(block.id for block in blocks)]
    bases = {}
    for text in texts:
        name, _, address = text.partition("=")
        if name not in known or not ADDRESS.fullmatch(address) or int(address, 0) >= END_OF_SPACE:
            has = f"blocks and chains of {owner} are {', '.join(known) or '(none)'}"
            message = f"{text}: write NAME=ADDRESS, for example sunspec=40000; {has}"
            raise ValueError(message)
        bases[name] = int(address, 0)
    return bases


def headers_in(chain: Chain, words: Mapping[int, int]) -> tuple[Header, ...]:
    """The headers of a chain as far as the known words, by address, lead to them."""
    for start in chain.at:
        address = start + len(chain.marker)
        if [words.get(at) for at in range(start, address)] != list(chain.marker):
            continue
        found: list[Header] = []
        while {address, address + 1} <= words.keys() and words[address] != chain.end:
            found.append(Header(words[address], address, words[address + 1]))
            address = found[-1].end
        return tuple(found)
    return ()


def lay_out(blocks: Sequence[RegisterBlock], ends: Mapping[str, int], bases: Mapping[str, int]) -> Layout:
    """A device that has the blocks in `ends`, which are the first addresses behind their registers ("": behind others).

    `bases` are addresses by the ids of blocks, and of chains for their markers; where none is stated, a marker stands
    where the device may have it, and a block without a chain behind everything else.
    """
    headers: dict[str, Header] = {}
    words: dict[tuple[Space, int], int] = {}
    here = [block for block in blocks if block.id in ends]
    for chain in dict.fromkeys(block.chain for block in here if block.chain):
        address = bases.get(chain.id, chain.at[0])
        address = _put(words, chain.space, address, chain.marker)
        for block in sorted((one for one in here if one.chain == chain), key=lambda one: one.number):
            for _ in range(block.number - 1 - sum(one.id in block.ids for one in headers.values())):
                address = _put(words, chain.space, address, (block.ids[0], 0))
            header = Header(block.ids[0], address, max(0, ends[block.id] - HEADER))
            _put(words, chain.space, address, (header.id, header.length or 0, *[0] * (header.length or 0)))
            headers[block.id], address = header._replace(base=bases.get(block.id, header.base)), header.end
        _put(words, chain.space, address, (chain.end, 0))
    free = max([ends.get("", 0), *(header.end for header in headers.values())])
    for block in here:
        if block.chain is None:
            headers[block.id] = Header(0, bases.get(block.id, free))
            free = max(free, headers[block.id].base + ends[block.id])
    return Layout(headers, words)


def _put(words: dict[tuple[Space, int], int], space: Space, address: int, values: Sequence[int]) -> int:
    words |= {(space, address + place): value for place, value in enumerate(values)}
    return address + len(values)
