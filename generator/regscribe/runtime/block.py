"""Decoding many registers of one request at once: one struct.unpack for all of them."""

import struct
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from regscribe.runtime import codec
from regscribe.runtime.errors import ValueNotDecodable
from regscribe.runtime.ground import Item
from regscribe.runtime.plan import Block, blocks
from regscribe.runtime.request import Request
from regscribe.runtime.spec import View
from regscribe.runtime.wire import LITTLE

if TYPE_CHECKING:
    from regscribe.runtime.register import Register
    from regscribe.runtime.session import Session

Placed = tuple["Register[Any]", View, int]
"""A register, its view, and the place of its first word in the block."""


class PreparedBlock:
    """A request and what to do with its words, under the state of the device at the time of preparation.

    Registers of numbers are unpacked together; texts, bits and registers that share words are decoded alone.
    """

    __slots__ = ("alone", "converters", "order", "packer", "paths", "request", "unpacker")

    def __init__(self, block: Block, placed: Sequence[Placed], session: "Session") -> None:
        self.request = Request(block.function, block.address, block.quantity)
        together, others = _split(placed)
        self.packer = struct.Struct(f">{block.quantity}H")
        self.unpacker = struct.Struct(_format(together, block.quantity))
        self.order = _order(together, block.quantity, session)
        self.paths = [register.path for register, _, _ in together]
        converters = [_converter(*one, session) for one in together]
        self.converters = [(place, convert) for place, convert in enumerate(converters) if convert is not codec.same]
        self.alone = [(*one, _decoder(*one, session)) for one in others]

    def decode(self, words: Sequence[int]) -> dict[str, Any]:
        """Values by path; a ValueNotDecodable in place of a value that is none."""
        if self.order:
            words = [words[place] for place in self.order]
        found = self._together(words) if self.paths else {}
        for register, view, start, decode in self.alone:
            found[register.path] = _caught(decode, words[start : start + view.words])
        return found

    def _together(self, words: Sequence[int]) -> dict[str, Any]:
        values: list[Any] = list(self.unpacker.unpack(self.packer.pack(*words)))
        for place, convert in self.converters:
            try:
                values[place] = convert(values[place])
            except ValueNotDecodable as error:
                values[place] = error
        return dict(zip(self.paths, values, strict=True))


def prepare(registers: Sequence["Register[Any]"], session: "Session") -> list[PreparedBlock]:
    """Plan the reading of registers in their preferred views."""
    wanted: dict[Item, list[tuple[Register[Any], View]]] = {}
    for register in registers:
        view = register.view()
        wanted.setdefault(Item(view.space, view.address(register.at), view.words), []).append((register, view))
    return [
        PreparedBlock(
            block,
            [(register, view, item.address - block.address) for item in block.items for register, view in wanted[item]],
            session,
        )
        for block in blocks([(item,) for item in wanted], session.terms())[0]
    ]


def _split(placed: Sequence[Placed]) -> tuple[list[Placed], list[Placed]]:
    together: list[Placed] = []
    alone: list[Placed] = []
    end = 0
    for one in placed:
        register, view, start = one
        plain = register.kind.name != "string" and view.space not in codec.BIT_SPACES
        (together if plain and start >= end else alone).append(one)
        end = max(end, start + view.words)
    return together, alone


def _format(together: Sequence[Placed], quantity: int) -> str:
    codes, end = [">"], 0
    for _, view, start in together:
        codes.append("xx" * (start - end) + view.type.code)
        end = start + view.words
    return "".join(codes) + "xx" * (quantity - end)


def _order(together: Sequence[Placed], quantity: int, session: "Session") -> list[int] | None:
    places = list(range(quantity))
    for register, view, start in together:
        if view.words > 1 and _backward(register, view, session):
            places[start : start + view.words] = places[start : start + view.words][::-1]
    return None if places == sorted(places) else places


def _backward(register: "Register[Any]", view: View, session: "Session") -> bool:
    try:
        return view.word_order(register.path, session.memory) == LITTLE
    except ValueNotDecodable:
        return False  # its converter says so, for this register alone


def _converter(register: "Register[Any]", view: View, _: int, session: "Session") -> Callable[[Any], Any]:
    try:
        if view.words > 1:
            view.word_order(register.path, session.memory)
        return codec.reader(register, view, session.memory, session.givens)
    except ValueNotDecodable as error:
        return _always(error)


def _decoder(register: "Register[Any]", view: View, _: int, session: "Session") -> Callable[[Any], Any]:
    try:
        return codec.decoder(register, view, session.memory, session.givens)
    except ValueNotDecodable as error:
        return _always(error)


def _always(error: ValueNotDecodable) -> Callable[[Any], Any]:
    def fail(_: object) -> Any:
        raise error

    return fail


def _caught(convert: Callable[[Any], Any], given: Any) -> Any:
    try:
        return convert(given)
    except ValueNotDecodable as error:
        return error
