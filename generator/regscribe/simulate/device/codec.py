"""Codec of a device, which must send *something*: words on the wire <-> the number that a view transmits.

A number that a view cannot carry is clipped to the view's limits (with or without `saturates`: only a driver can tell
the difference), and what is no ASCII in a text is sent and kept as it is.
"""

from collections.abc import Sequence
from fractions import Fraction

from regscribe.model import NotANumber, View
from regscribe.reference import Arrangement, bytes_in_order, sent_words, wire_number, words_in_order


def encode(view: View, stored: Fraction | str | NotANumber, order: Arrangement) -> tuple[int, ...]:
    """Return the words (or the one bit, or the one status byte) of `view` for a stored value."""
    if isinstance(stored, str) or view.type.is_octets:
        size = 2 * view.words
        return words_in_order(list(str(stored).encode("latin-1", "replace")[:size].ljust(size, b"\0")), order)
    return sent_words(view, stored, order, clip=True)


def decode(view: View, words: Sequence[int], order: Arrangement) -> Fraction | str | None:
    """Return the stored value of `words` written through `view`; None if they are no number (NaN, infinity).

    A float stands for the shortest decimal that has its bits: 120.1 written is 120.1 stored, and 120.1 shown again.
    """
    if view.type.is_octets:
        return bytes(bytes_in_order(tuple(words), order)).decode("latin-1")
    number = wire_number(view, tuple(words), order)
    return number / view.factor if isinstance(number, Fraction) else None
