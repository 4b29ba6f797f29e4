"""Words on the wire <-> the number that a view transmits; exact, and free of any device's state.

A device must send *something*, also where the map leaves a question open. The choices made here: a number that a view
cannot carry is clipped to the view's limits (with or without `saturates`: only a driver can tell the difference), and a
fraction in a view whose rounding the map does not state is rounded half up.
"""

import math
import struct
from collections.abc import Sequence
from fractions import Fraction

from regscribe.model import NotANumber, Order, Rounding, View, WireType
from regscribe.reference import NotFiniteError, ieee_bits, ieee_number, not_a_number, shortest

_FLOAT_LARGEST = {WireType.FLOAT32: 0x7F7FFFFF, WireType.FLOAT64: 0x7FEFFFFFFFFFFFFF}
_PAD = b"\0"


def round_to_whole(number: Fraction, rounding: Rounding) -> int:
    """Return the whole number that a device makes of `number`."""
    match rounding:
        case Rounding.DOWN:
            return math.trunc(number)
        case Rounding.HALF_EVEN:
            return round(number)
        case Rounding.HALF_AWAY:
            size = math.floor(abs(number) + Fraction(1, 2))
            return size if number >= 0 else -size
        case _:
            return math.floor(number + Fraction(1, 2))


def encode(view: View, stored: Fraction | str | NotANumber, order: Order) -> tuple[int, ...]:
    """Return the words (or the one bit, or the one status byte) that `view` shows while the device holds `stored`."""
    if view.type is WireType.STRING:
        return _text_to_words(view, str(stored), order)
    if isinstance(stored, NotANumber):
        return _to_words(view, not_a_number(view.type).to_bytes(view.type.bits // 8, "big"), order)
    number = Fraction(stored) * view.factor
    if view.type.is_float:
        return _to_words(view, _float_bits(view.type, number).to_bytes(view.type.bits // 8, "big"), order)
    whole = round_to_whole(number, view.rounding)
    whole = min(max(whole, view.type.minimum), view.type.maximum) & ((1 << view.type.bits) - 1)
    if view.type.bits <= 16:  # noqa: PLR2004 -- a Modbus register has 16 bits
        return (_swap(whole) if view.byte_order is Order.LITTLE else whole,)
    return _to_words(view, whole.to_bytes(view.type.bits // 8, "big"), order)


def decode(view: View, words: Sequence[int], order: Order) -> Fraction | str | None:
    """Return the stored value that `words`, written through `view`, set; None if they spell no number (NaN, infinity).

    A float stands for the shortest decimal that has its bits: 120.1 written is 120.1 stored, and 120.1 shown again.
    """
    if view.type is WireType.STRING:
        return _words_to_text(view, words, order)
    data = _to_bytes(view, words, order)
    if view.type.is_float:
        try:
            return shortest(ieee_number(int.from_bytes(data, "big"), view.type), view.type) / view.factor
        except NotFiniteError:
            return None
    whole = int.from_bytes(data, "big") & ((1 << view.type.bits) - 1)
    whole -= (whole > view.type.maximum) << view.type.bits
    return Fraction(whole) / view.factor


def _float_bits(kind: WireType, number: Fraction) -> int:
    bits = ieee_bits(number, kind)
    return _FLOAT_LARGEST[kind] | (number < 0) << (kind.bits - 1) if bits is None else bits


def _swap(word: int) -> int:
    return (word & 0xFF) << 8 | word >> 8


def _to_words(view: View, data: bytes, order: Order) -> tuple[int, ...]:
    words = struct.unpack(f">{len(data) // 2}H", data)
    words = tuple(map(_swap, words)) if view.byte_order is Order.LITTLE else words
    return words[::-1] if order is Order.LITTLE else words


def _to_bytes(view: View, words: Sequence[int], order: Order) -> bytes:
    ordered = words[::-1] if order is Order.LITTLE else words
    ordered = tuple(map(_swap, ordered)) if view.byte_order is Order.LITTLE else ordered
    return struct.pack(f">{len(ordered)}H", *ordered)


def _text_to_words(view: View, text: str, order: Order) -> tuple[int, ...]:
    data = text.encode("latin-1", "replace")[: 2 * view.words].ljust(2 * view.words, _PAD)
    return _to_words(view, data, order)


def _words_to_text(view: View, words: Sequence[int], order: Order) -> str:
    return _to_bytes(view, words, order).decode("latin-1")
