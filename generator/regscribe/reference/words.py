"""Words to wire numbers and back: type, order of words and bytes, rounding, text."""

from fractions import Fraction
from math import floor, trunc
from typing import NamedTuple

from regscribe.reference.ieee import (
    NotFiniteError,
    ieee_bits,
    ieee_number,
    is_infinity,
    largest,
    not_a_number,
    shortest,
)
from regscribe.reference.outcome import RefusalReason, RefusedError
from regscribe.reference.surroundings import NOTHING_KNOWN, Known, choose
from regscribe.reference.terms import present_view
from regscribe.reference.whole_numbers import whole_bits, whole_number
from regscribe_runtime.values.numbers import show
from regscribe_runtime.values.orders import OrderCases, WordOrder
from regscribe_runtime.values.scales import NAN, NotANumber
from regscribe_runtime.values.views import View
from regscribe_runtime.values.wire_types import Order, Rounding

HALF = Fraction(1, 2)


def round_by(rounding: Rounding, number: Fraction) -> int:
    """Return the whole number that a device of this rounding makes of `number`; half up where the map does not say."""
    if rounding is Rounding.DOWN:
        return trunc(number)
    if rounding is Rounding.HALF_EVEN:
        below = floor(number)
        if number - below == HALF:
            return below if below % 2 == 0 else below + 1
        return floor(number + HALF)
    if rounding is Rounding.HALF_AWAY and number < 0:
        return -floor(-number + HALF)
    return floor(number + HALF)


class Arrangement(NamedTuple):
    """How the words of a value stand on the wire, and the bytes in each of them."""

    words: WordOrder
    bytes: WordOrder


AS_IS = Arrangement(Order.BIG, Order.BIG)


def word_order(view: View, known: Known) -> Arrangement | None:
    """Return the present order of words and bytes; None if what sets one of them sets it to none."""
    words = _now(view.order, known) if view.words > 1 else Order.BIG
    turned = _now(view.byte_order, known)
    return None if words is None or turned is None else Arrangement(words, turned)


def _now(order: WordOrder | OrderCases, known: Known) -> WordOrder | None:
    return choose(order.cases, known) if isinstance(order, OrderCases) else order


def _places(order: Arrangement, count: int) -> list[int]:
    """Return where on the wire each word stands, the most significant (or the first letters) first."""
    if isinstance(order.words, Order):
        return list(range(count)) if order.words is Order.BIG else list(range(count - 1, -1, -1))
    return [place - 1 for place in order.words]


def bytes_in_order(words: tuple[int, ...], order: Arrangement) -> list[int]:
    """Return the bytes of words on the wire, the most significant (or the first letter) first."""
    pairs = [divmod(words[place], 256) for place in _places(order, len(words))]
    return [byte for high, low in pairs for byte in ((high, low) if order.bytes is Order.BIG else (low, high))]


def words_in_order(raw: list[int], order: Arrangement) -> tuple[int, ...]:
    """Return the words on the wire of bytes that stand the most significant (or the first letter) first."""
    places = _places(order, len(raw) // 2)
    words = [0] * (max(places) + 1)  # some that stand apart have others between them
    for place, first, second in zip(places, raw[::2], raw[1::2], strict=True):
        words[place] = 256 * first + second if order.bytes is Order.BIG else 256 * second + first
    return tuple(words)


def words_of_bits(view: View, bits: int, order: Arrangement) -> tuple[int, ...]:
    """Return the words on the wire of all their bits, as a number."""
    return words_in_order(list(bits.to_bytes(2 * view.type.words, "big")), order)


def wire_number(view: View, words: tuple[int, ...], order: Arrangement) -> Fraction | NotANumber | None:
    """Return the number in the words: NAN for IEEE patterns of no number, None for infinity and impossible digits."""
    bits = int.from_bytes(bytes_in_order(words, order), "big")
    if view.type.is_float:
        try:
            return shortest(ieee_number(bits, view.type), view.type)
        except NotFiniteError:
            return None if is_infinity(bits, view.type) else NAN
    return whole_number(bits, view.type)


def carried(view: View, number: Fraction) -> Fraction | None:
    """Return the number that reading `number` from the wire of a view gives; None if the view cannot carry it."""
    if view.type.is_float:
        bits = ieee_bits(number, view.type)
        return None if bits is None else shortest(ieee_number(bits, view.type), view.type)
    fits = number.denominator == 1 and view.type.minimum <= number <= view.type.maximum
    return number if fits else None


def spelled(view: View, number: Fraction, order: Arrangement, *, rounded: bool) -> tuple[int, ...]:
    """Return the words of a wire number; RefusedError if the view cannot carry it."""
    if view.type.is_float:
        bits = ieee_bits(number, view.type)
        if bits is None:
            raise RefusedError(RefusalReason.TYPE, f"{show(number)} is beyond {view.type}")
        carried = ieee_number(bits, view.type)
        if not rounded and number not in (carried, shortest(carried, view.type)):
            raise RefusedError(RefusalReason.RESOLUTION, f"{show(number)} is finer than {view.type}")
        return words_of_bits(view, bits, order)
    if number.denominator != 1 and not rounded:
        raise RefusedError(RefusalReason.RESOLUTION, f"{show(number)} is no whole number on the wire")
    whole = round_by(view.rounding, number)
    lowest, highest = view.type.minimum + view.saturates, view.type.maximum - view.saturates
    if not lowest <= whole <= highest:
        raise RefusedError(RefusalReason.TYPE, f"{whole} lies outside {lowest} to {highest} of {view.type}")
    return words_of_bits(view, whole_bits(whole, view.type), order)


def transmit(view: View, stored: Fraction | NotANumber, known: Known = NOTHING_KNOWN) -> tuple[int, ...]:
    """Return the words that a device which holds `stored` sends: rounded by the view, clipped if the view saturates.

    Raises RefusedError for a number that the view cannot carry.
    """
    order, seen = word_order(view, known), present_view(view, known)
    if order is None or seen is None:
        raise RefusedError(RefusalReason.CONDITION, "the order of the words, or the factor of the view, is not known")
    return sent_words(seen, stored, order)


def sent_words(view: View, stored: Fraction | NotANumber, order: Arrangement, *, clip: bool = False) -> tuple[int, ...]:
    """Return what `transmit` does, in this word order; with `clip`, a view clips even if it does not saturate."""
    if isinstance(stored, NotANumber):
        return words_of_bits(view, not_a_number(view.type), order)
    number = stored * view.factor
    return words_of_bits(view, (_whole if view.type.is_integer else _ieee)(view, number, clip=clip), order)


def _whole(view: View, number: Fraction, *, clip: bool) -> int:
    whole = round_by(view.rounding, number)
    clipped = min(max(whole, view.type.minimum), view.type.maximum)
    if clipped != whole and not (view.saturates or clip):
        raise RefusedError(RefusalReason.TYPE, f"{whole} lies outside {view.type}")
    return whole_bits(clipped, view.type)


def _ieee(view: View, number: Fraction, *, clip: bool) -> int:
    bits = ieee_bits(number, view.type)
    if bits is None and not clip:
        raise RefusedError(RefusalReason.TYPE, f"{show(number)} is beyond {view.type}")
    return largest(view.type, negative=number < 0) if bits is None else bits
