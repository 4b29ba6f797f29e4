"""Words and wire numbers: type, word order, rounding and text."""

from fractions import Fraction
from math import floor, trunc

from regscribe.model.number import show
from regscribe.model.reference.ieee import NotFiniteError, ieee_bits, ieee_number, shortest
from regscribe.model.reference.known import NOTHING_KNOWN, Surroundings
from regscribe.model.reference.outcome import Reason, RefusedError
from regscribe.model.wire import Order, Rounding, View

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


def word_order(view: View, known: Surroundings) -> Order | None:
    """Return the order of the words as things stand; None if the register's code sets no order."""
    if isinstance(view.word_order, Order):
        return view.word_order
    code = known.look_up(view.word_order.register)
    return next((order for listed, order in view.word_order.codes if listed == code), None)


def _bits_of(view: View, words: tuple[int, ...], order: Order) -> int:
    in_order = words if order is Order.BIG else tuple(reversed(words))
    bits = 0
    for word in in_order:
        bits = bits * 65536 + word
    return bits % (1 << view.type.bits)


def _words_of(view: View, bits: int, order: Order) -> tuple[int, ...]:
    most_first = tuple((bits >> (16 * place)) % 65536 for place in reversed(range(view.type.words)))
    return most_first if order is Order.BIG else tuple(reversed(most_first))


def wire_number(view: View, words: tuple[int, ...], order: Order) -> Fraction | None:
    """Return the number that the words spell; None for an IEEE pattern that is none (infinity, not a number)."""
    bits = _bits_of(view, words, order)
    if view.type.is_float:
        try:
            return shortest(ieee_number(bits, view.type), view.type)
        except NotFiniteError:
            return None
    return Fraction(bits if bits <= view.type.maximum else bits - (1 << view.type.bits))


def text_of(view: View, words: tuple[int, ...]) -> str | None:
    """Return the ASCII text in `words` without what fills it up; None if it is no ASCII."""
    pairs = (divmod(word, 256) for word in words)
    raw = bytes(byte for high, low in pairs for byte in ((high, low) if view.byte_order is Order.BIG else (low, high)))
    raw = raw.rstrip(b"\x00 ")
    return raw.decode("ascii") if raw.isascii() else None


def words_of_text(view: View, text: str) -> tuple[int, ...]:
    """Return the words of an ASCII text, filled up with blanks; RefusedError if it does not fit."""
    if not text.isascii() or len(text) > 2 * view.words:
        raise RefusedError(Reason.TYPE, f"{text!r} does not fit {2 * view.words} ASCII characters")
    raw = text.encode("ascii").ljust(2 * view.words)
    first, second = (0, 1) if view.byte_order is Order.BIG else (1, 0)
    return tuple(256 * raw[2 * word + first] + raw[2 * word + second] for word in range(view.words))


def spelled(view: View, number: Fraction, order: Order, *, rounded: bool) -> tuple[int, ...]:
    """Return the words of a wire number; RefusedError if the view cannot carry it."""
    if view.type.is_float:
        bits = ieee_bits(number, view.type)
        if bits is None:
            raise RefusedError(Reason.TYPE, f"{show(number)} is beyond {view.type}")
        if not rounded and shortest(ieee_number(bits, view.type), view.type) != number:
            raise RefusedError(Reason.RESOLUTION, f"{show(number)} is finer than {view.type}")
        return _words_of(view, bits, order)
    if number.denominator != 1 and not rounded:
        raise RefusedError(Reason.RESOLUTION, f"{show(number)} is no whole number on the wire")
    whole = round_by(view.rounding, number)
    lowest, highest = view.type.minimum + view.saturates, view.type.maximum - view.saturates
    if not lowest <= whole <= highest:
        raise RefusedError(Reason.TYPE, f"{whole} lies outside {lowest} to {highest} of {view.type}")
    return _words_of(view, whole % (1 << view.type.bits), order)


def transmit(view: View, stored: Fraction, known: Surroundings = NOTHING_KNOWN) -> tuple[int, ...]:
    """Return the words that a device which holds `stored` sends: rounded by the view, clipped if the view saturates.

    Raises RefusedError for a number that the view cannot carry.
    """
    order = word_order(view, known)
    if order is None:
        raise RefusedError(Reason.CONDITION, "the order of the words is not known")
    number = stored * view.factor
    if view.type.is_integer:
        whole = round_by(view.rounding, number)
        clipped = min(max(whole, view.type.minimum), view.type.maximum)
        if clipped != whole and not view.saturates:
            raise RefusedError(Reason.TYPE, f"{whole} lies outside {view.type}")
        return _words_of(view, clipped % (1 << view.type.bits), order)
    bits = ieee_bits(number, view.type)
    if bits is None:
        raise RefusedError(Reason.TYPE, f"{show(number)} is beyond {view.type}")
    return _words_of(view, bits, order)
