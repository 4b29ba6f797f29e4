"""Wire types, as people write them; words that mean different widths to different people are read in a dialect."""

import re
from dataclasses import replace
from difflib import get_close_matches

from regscribe.importers.table.cells import Unclear, quoted
from regscribe.importers.table.cells.dialect_choice import DialectChoice, choose_dialect
from regscribe.importers.table.cells.dialects import Dialect, read_dialect
from regscribe.importers.table.cells.numbers import clean
from regscribe.importers.table.cells.orders import Orders, parse_order, split_order
from regscribe.importers.table.cells.sizes import Size, parse_size
from regscribe.importers.table.cells.text_types import text_type
from regscribe.importers.table.cells.type_phrases import phrase
from regscribe.importers.table.cells.type_values import WORD_BITS, TypeCell, Words
from regscribe.importers.table.cells.type_words import (
    BITS_WORDS,
    FIXED,
    KINDS,
    NUMBERED,
    PROPOSED,
    UNIX,
    dialect_type,
    fold,
)
from regscribe.model import WireType

__all__ = [
    "Dialect",
    "DialectChoice",
    "TypeCell",
    "choose_dialect",
    "parse_order",
    "parse_type",
    "read_dialect",
]


def parse_type(text: str, dialect: Dialect, *, size: str = "", gap: int = 0) -> TypeCell | Unclear | None:
    """Read the cells of type and size of one row (`U16`, `UDINT swapped`, `STRING(16)`; `2 words`, `32 bit`).

    A size that is not understood matters only where the type hangs on it. `gap` is the distance to the next register of
    the space, 0 if not known: a text that ends just before it shows what its length counts.
    """
    plain = clean(text).casefold()
    sized = parse_size(size, dialect.size_bits)
    if plain in {"", "-", "--", "?"}:
        return _of_size(sized, size) if isinstance(sized, Size) else sized
    ordered = split_order(plain, little_bytes=dialect.little_bytes)
    if isinstance(ordered, Unclear):
        return ordered
    rest, orders = ordered
    known = sized if isinstance(sized, Size) else None
    found = _type(Words(rest, fold(rest), dialect, known, text, gap)) if rest else TypeCell()
    return found if isinstance(found, Unclear) else _checked(_with_orders(found, orders), known, text, size)


def _of_size(sized: Size, size: str) -> TypeCell | Unclear:
    """A size without a type."""
    return Unclear(f"the size {quoted(size)} does not say whether the number of {sized.bits} bits has a sign")


def _with_orders(found: TypeCell, orders: Orders) -> TypeCell:
    if found.type and found.words == 1 and not found.type.is_octets:
        orders = orders._replace(word=None)  # one word has no order of words
    return replace(found, word_order=orders.word, byte_order=orders.byte)


def _checked(found: TypeCell, sized: Size | None, text: str, size: str) -> TypeCell | Unclear:
    """The type, unless the size beside it contradicts it."""
    if sized is None or found.type is None or found.type.is_octets or found.type is WireType.BIT:
        return found
    if found.words == sized.words or sized.bits == found.type.bits:
        return found
    return Unclear(f"the type {quoted(text)} has {found.type.bits} bits, and the size {quoted(size)} says {sized.bits}")


def _type(words: Words) -> TypeCell | Unclear:
    """The type that words without an order say."""
    for reading in (_fixed, _of_dialect, text_type, _kind, _numbered, _signed, _unix, _phrase, _bracketed, _part):
        if found := reading(words):
            return found
    return _unknown(words.folded, words.text)


def _cell(name: str, **more: str) -> TypeCell | None:
    """The type of a name, if there is one."""
    if name not in list(WireType):
        return None
    wire = WireType(name)
    return TypeCell(type=wire, words=wire.words, kind=more.get("kind", ""), stated=more.get("stated", ""))


def _fixed(words: Words) -> TypeCell | None:
    return _cell(FIXED.get(words.folded, ""))


def _of_dialect(words: Words) -> TypeCell | None:
    return _cell(dialect_type(words.folded, words.dialect, words.size.bits if words.size else 0))


def _numbered(words: Words) -> TypeCell | Unclear | None:
    """`unsigned 16`, `32 bit float`: a word and a number of bits."""
    found = NUMBERED.fullmatch(words.folded)
    if not found:
        return None
    word = found["word"] or found["last"] or found["both"]
    stem = "float" if word[0] in "fr" else "uint" if word[0] == "u" else "int"
    bits = found["n"] or found["m"] or found["o"]
    return _cell(f"{stem}{bits}") or Unclear(f"{quoted(words.text)} is no type: there is no {stem} of {bits} bits")


def _signed(words: Words) -> TypeCell | Unclear | None:
    """`signed` or `float`, whose width another column says."""
    stem = BITS_WORDS.get(words.folded)
    if not stem:
        return None
    if words.size is None:
        return Unclear(f"{quoted(words.text)} does not say of how many bits")
    return _cell(f"{stem}{words.size.bits}") or Unclear(f"there is no {stem} of {words.size.bits} bits")


def _phrase(words: Words) -> TypeCell | None:
    return _cell(phrase(words.plain, words.dialect, words.size.bits if words.size else 0))


def _part(words: Words) -> TypeCell | None:
    """`2bit`: a part of a word, whose place the address says."""
    found = re.fullmatch(r"([0-9]{1,2})bits?", words.folded)
    return TypeCell(bits=int(found[1])) if found and 0 < int(found[1]) < WORD_BITS else None


def _unix(words: Words) -> TypeCell | None:
    """Seconds since 1970, whose width another column says."""
    layouts = {2: "unix", 4: "unix64"}
    if words.folded not in UNIX or not words.size or words.size.words not in layouts:
        return None
    return TypeCell(type=WireType.DATETIME, words=words.size.words, layout=layouts[words.size.words])


def _bracketed(words: Words) -> TypeCell | Unclear | None:
    """`UINT (16 bit)`, `U16 (bitfield)`: a type with its size, its kind or an order in brackets."""
    found = re.fullmatch(r"(.+?)\s*[(\[]([^()\[\]]+)[)\]]", words.plain)
    if not found:
        return None
    sized, kind = parse_size(found[2], None), KINDS.get(found[2].replace(" ", ""))
    if not isinstance(sized, Size) and not kind:
        return None
    inner = found[1]
    size = sized if isinstance(sized, Size) else words.size
    of_type = _type(words._replace(plain=inner, folded=fold(inner), size=size))
    if isinstance(of_type, Unclear):
        return of_type
    return _checked(replace(of_type, kind=kind or of_type.kind), size, words.text, found[2])


def _kind(words: Words) -> TypeCell | Unclear | None:
    """A word that says of what kind the value is: its number is unsigned, of 16 bits if nothing else is said."""
    folded = re.sub(r"([0-9]+)(?:digits?|bits?)(bcd|flags|bitmap|enum)", r"\2\1", words.folded)
    found = re.fullmatch(r"([a-z]+?)([0-9]*)(?:bits?|digits?)?", folded)
    kind = KINDS.get(found[1]) if found else None
    if not found or not kind:
        return None
    bits = int(found[2]) if found[2] else words.size.bits if words.size else 16
    if kind == "bcd":
        if not found[2] and not words.size:
            return Unclear(f"{quoted(words.text)} does not say of how many bits", "`bcd16`")
        of_digits = f"bcd{bits if bits >= 16 else 4 * bits}"  # noqa: PLR2004 - digits of four bits each
        return _cell(of_digits) or Unclear(f"{quoted(words.text)} is no type")
    return _cell(f"uint{bits}", kind=kind) or Unclear(f"{quoted(words.text)}: there is no number of {bits} bits")


def _unknown(folded: str, text: str) -> Unclear:
    if re.fullmatch(r"[0-9]+bits?", folded):
        return Unclear(f"{quoted(text)} does not say whether the number has a sign")
    if folded in PROPOSED:
        return Unclear(f"{quoted(text)} does not say how the words tell it", PROPOSED[folded])
    near = get_close_matches(folded, list(FIXED), n=1, cutoff=0.75)
    return Unclear(f"{quoted(text)} is no type", f"`{FIXED[near[0]]}`" if near else "")
