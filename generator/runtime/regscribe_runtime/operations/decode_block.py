"""Decoding of all registers of one request by one struct.unpack."""

import struct
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from types import MappingProxyType
from typing import Any

from regscribe_runtime.errors import RegscribeError, ValueNotDecodable
from regscribe_runtime.operations.bisect import Words
from regscribe_runtime.operations.session import Session
from regscribe_runtime.planning.plan import Block
from regscribe_runtime.registers import codec
from regscribe_runtime.registers.codec import Converter
from regscribe_runtime.registers.register import Register
from regscribe_runtime.values.kinds import OCTETS
from regscribe_runtime.values.orders import gathered
from regscribe_runtime.values.views import View
from regscribe_runtime.values.wire_types import Order
from regscribe_runtime.wire.requests import Request

Placed = tuple["Register[Any]", View, int]
"""A register, its view, and the index of its first word in the block."""


class PreparedBlock:
    """A request and the decoders of its words, for the state of the device at the time of preparation.

    Numbers are unpacked together; texts, bits and registers that share words are decoded alone. `unknown` are registers
    without a known value, with the error by path: what depends on them is not decoded.
    """

    __slots__ = ("alone", "block", "converters", "order", "packer", "paths", "placed", "request", "unpacker")

    def __init__(
        self,
        block: Block,
        placed: Sequence[Placed],
        session: Session,
        unknown: Mapping[str, RegscribeError] = MappingProxyType({}),
    ) -> None:
        self.block, self.placed = block, placed
        self.request = Request(block.function, block.address, block.quantity)
        together, others = _split(placed)
        self.packer = struct.Struct(f">{block.quantity}H")
        layout, self.order = _layout(together, block.quantity, session)
        self.unpacker = struct.Struct(layout)
        self.paths = [register.path for register, _, _ in together]
        converters = [_converter(codec.reader, register, view, session, unknown) for register, view, _ in together]
        self.converters = [(place, convert) for place, convert in enumerate(converters) if convert is not codec.same]
        self.alone = [(*one, _converter(codec.decoder, *one[:2], session, unknown)) for one in others]

    def decode(self, words: Sequence[int]) -> dict[str, Any]:
        """Values by path, or the ValueNotDecodable of a register without a value."""
        values: list[Any] = []
        if self.paths:
            ordered = [words[place] for place in self.order] if self.order else words
            values += self.unpacker.unpack(self.packer.pack(*ordered))
        for place, convert in self.converters:
            try:
                values[place] = convert(values[place])
            except ValueNotDecodable as error:
                values[place] = error
        found = dict(zip(self.paths, values, strict=True))
        for register, view, start, decode in self.alone:
            found[register.path] = _caught(decode, words[start : start + view.words])
        return found

    def decode_partly(self, words: Words, session: Session, unknown: Mapping[str, RegscribeError]) -> dict[str, Any]:
        """As `decode`, for the registers none of whose words is None."""
        found = {}
        for register, view, start in self.placed:
            there = words[start : start + view.words]
            if None not in there:
                decode = _converter(codec.decoder, register, view, session, unknown)
                found[register.path] = _caught(decode, there)
        return found


def _split(placed: Sequence[Placed]) -> tuple[list[Placed], list[Placed]]:
    together: list[Placed] = []
    alone: list[Placed] = []
    end = 0
    for one in placed:
        register, view, start = one
        packed = register.kind not in OCTETS and not view.type.spelling and not view.is_apart
        plain = packed and view.space.is_words and view.byte_order is Order.BIG
        (together if plain and start >= end else alone).append(one)
        end = max(end, start + view.words)
    return together, alone


def _layout(together: Sequence[Placed], quantity: int, session: Session) -> tuple[str, list[int] | None]:
    """The format of `struct` for all registers, and the order of words in which it applies (None: that of the wire)."""
    codes, places, end = ">", list(range(quantity)), 0
    for register, view, start in together:
        codes += "xx" * (start - end) + view.type.code
        end = start + view.words
        with suppress(ValueNotDecodable, KeyError):  # its converter raises it, for this register alone
            order = codec.present_order(view.order, register.path, session.memory, session.givens)
            places[start:end] = gathered(order, places[start:end]) if view.words > 1 else places[start:end]
    return codes + "xx" * (quantity - end), None if places == sorted(places) else places


def _converter(
    make: Callable[..., Converter],
    register: Register[Any],
    view: View,
    session: Session,
    unknown: Mapping[str, RegscribeError],
) -> Converter:
    """The converter of `codec.reader` or `codec.decoder`; one that raises the error where the word order is unknown."""
    state = codec.known_state(register, session.memory, unknown)
    try:
        codec.arranger(view, register.path, state, session.givens)
        return make(register, view, state, session.givens)
    except ValueNotDecodable as error:
        return codec.failing(error)


def _caught(convert: Converter, given: Any) -> Any:
    try:
        return convert(given)
    except ValueNotDecodable as error:
        return error
