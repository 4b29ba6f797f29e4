"""Words for the order of words and of bytes: `CDAB`, `swapped`, `Lo-Hi`, `little endian`."""

import re
from typing import NamedTuple

from regscribe.importers.table.cells import Unclear, quoted
from regscribe.importers.table.cells.numbers import clean
from regscribe.model import Order


class Orders(NamedTuple):
    """The order of the words and of the bytes in each; None: not said."""

    word: Order | None = None
    byte: Order | None = None


_BIG, _LITTLE = Order.BIG, Order.LITTLE
_LETTERS = (
    (Orders(_BIG, _BIG), r"a-?b-?c-?d|abcdefgh|1-?2-?3-?4(?=\W|$)|ab"),
    (Orders(_LITTLE, _BIG), r"c-?d-?a-?b|ghefcdab|3-?4-?1-?2(?=\W|$)"),
    (Orders(_BIG, _LITTLE), r"b-?a-?d-?c|badcfehg|2-?1-?4-?3(?=\W|$)|ba"),
    (Orders(_LITTLE, _LITTLE), r"d-?c-?b-?a|hgfedcba|4-?3-?2-?1(?=\W|$)"),
)
_WORDS = (
    (Orders(_LITTLE, _LITTLE), r"(?:byte and word|word and byte) swap(?:ped)?"),
    (Orders(None, _LITTLE), r"byte[\s-]?swap(?:ped)?|bytes swapped|swapped bytes?|little[\s-]endian bytes?|lsb first"),
    (Orders(None, _LITTLE), r"low byte first"),
    (
        Orders(_LITTLE),
        r"word[\s-]?swap(?:ped)?|words swapped|swapped words?|little[\s-]endian words?|lsw first|low word first",
    ),
    (
        Orders(_LITTLE),
        r"lo(?:w)?\s*[-/,]\s*hi(?:gh)?|lsw\s*[-/,]?\s*msw|least significant word first|lowest word first",
    ),
    (Orders(_LITTLE), r"little[\s-]endian word order|word order:? little(?:[\s-]endian)?|inverted word order"),
    (Orders(_LITTLE), r"poids faible (?:en premier|d'abord)|niederwertige[rs]? wort zuerst|low word zuerst"),
    (Orders(_BIG), r"poids fort (?:en premier|d'abord)|höherwertige[rs]? wort zuerst|high word zuerst"),
    (Orders(_BIG), r"big[\s-]endian word order|word order:? big(?:[\s-]endian)?"),
    (Orders(_LITTLE), r"swapped|swap|sw|reversed|inverse|inverted"),
    (
        Orders(_BIG),
        r"msw first|high word first|hi(?:gh)?\s*[-/,]\s*lo(?:w)?|msw\s*[-/,]?\s*lsw|most significant word first",
    ),
    (Orders(_BIG), r"big[\s-]endian words?"),
    (Orders(_BIG, _BIG), r"big[\s-]?endian|not swapped|be|msb first|normal|motorola"),
)
"""Words for orders, the first that fits counts."""

_LITTLE_ENDIAN = re.compile(r"little[\s-]?endian|le|intel|little", re.IGNORECASE)
_SUFFIXES = {"_r": Orders(_LITTLE), "sw": Orders(_LITTLE), "sb": Orders(None, _LITTLE), "le": Orders(_LITTLE, _LITTLE)}
_SUFFIXES |= {"be": Orders(_BIG, _BIG)}
_GLUED = re.compile(
    r"(?P<rest>(?:[usif]|u?int|s?int|float|fp|double|[us]_?[dq]?word)_?(?:[0-9]{1,2})?)(?P<order>_r|sw|sb|le|be)"
)
_ANY = "|".join(f"(?:{words})" for _, words in (*_LETTERS, *_WORDS))
_BEHIND = re.compile(rf"(?P<rest>.*?)[\s_,;:/(\[-]+(?P<order>{_ANY}|{_LITTLE_ENDIAN.pattern})[)\]]?", re.IGNORECASE)
_BEFORE = re.compile(rf"[(\[]?(?P<order>{_ANY}|{_LITTLE_ENDIAN.pattern})[)\]]?[\s_,;:/-]+(?P<rest>.*)", re.IGNORECASE)


def parse_order(text: str, *, little_bytes: bool | None = None) -> Orders | Unclear | None:
    """Read a cell of an order; None if it is empty.

    `little endian` alone is said of words (CDAB) and of all bytes (DCBA): `little_bytes` says which; None: unclear.
    """
    plain = clean(text).casefold()
    if plain in {"", "-", "--"}:
        return None
    return _orders(plain.strip("()[]"), text, little_bytes=little_bytes)


_SAID = re.compile(
    r"\b(?:abcd|cdab|badc|dcba|(?:low|high) word first|[lm]sw first|words? swapped|swapped words|lo-hi|hi-lo"
    r"|poids (?:faible|fort) en premier|(?:niederwertige|höherwertige)[rs]? wort zuerst"
    r"|(?:little|big)[\s-]endian(?: word order| words)?)\b",
    re.IGNORECASE,
)


def order_in(text: str, *, little_bytes: bool | None = None) -> Orders | Unclear | None:
    """The order that a text says beside other things, in words that mean nothing else; None where it says none."""
    found = {match[0].casefold() for match in _SAID.finditer(clean(text))}
    if len(found) > 1:
        return Unclear(f"{quoted(text)} names several orders of words")
    return _orders(found.pop(), text, little_bytes=little_bytes) if found else None


def split_order(plain: str, *, little_bytes: bool | None) -> tuple[str, Orders] | Unclear:
    """Take an order out of the words of a type: what is left of them, and the order (of nothing, if none stands)."""
    if found := _GLUED.fullmatch(plain):
        return found["rest"], _SUFFIXES[found["order"]]
    for pattern in (_BEHIND, _BEFORE):
        if (found := pattern.fullmatch(plain)) and not found["rest"].strip().isdecimal():
            orders = _orders(found["order"], plain, little_bytes=little_bytes)
            return orders if isinstance(orders, Unclear) else (found["rest"].strip(), orders)
    return plain, Orders()


def _orders(plain: str, text: str, *, little_bytes: bool | None) -> Orders | Unclear:
    for orders, words in (*_LETTERS, *_WORDS):
        if re.fullmatch(words, plain, re.IGNORECASE):
            return orders
    if _LITTLE_ENDIAN.fullmatch(plain) and little_bytes is not None:
        return Orders(_LITTLE, _LITTLE if little_bytes else None)
    if _LITTLE_ENDIAN.fullmatch(plain):
        return Unclear(f"{quoted(text)} does not say whether words alone are swapped (CDAB) or bytes as well (DCBA)")
    return Unclear(f"{quoted(text)} is no order of words")
