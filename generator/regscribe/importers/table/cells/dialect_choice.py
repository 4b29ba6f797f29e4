"""How a table shows what the words of its types mean, by the sizes and the gaps beside them."""

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from regscribe.importers.table.cells import Unclear
from regscribe.importers.table.cells.dialects import SIZES, WIDTHS, Dialect, read_dialect
from regscribe.importers.table.cells.numbers import clean


@dataclass(frozen=True, slots=True)
class DialectChoice:
    """The dialect of a table, with a sentence for each word that it decides, and the evidence."""

    dialect: Dialect
    stated: tuple[str, ...]


_KNOWN_BITS = re.compile(r"(?:u|s|i|f|uint|int|sint|float|unsigned|signed)[\s_-]?(16|32|64)\b", re.IGNORECASE)
_SIZED_TEXT = re.compile(r"(?:string|str|ascii|text|utf-?8)\s*[\[( .:_-]?\s*([0-9]{1,4})\s*[\])]?", re.IGNORECASE)
_STEMS = {
    **dict.fromkeys(("uint", "unsigned int", "unsigned integer"), "uint"),
    **dict.fromkeys(("int", "integer", "signed int", "signed integer"), "int"),
    **dict.fromkeys(("long", "ulong", "unsigned long", "signed long", "long int"), "long"),
    "byte": "byte",
    "word": "word",
    "float": "float",
}
"""The words of types that a dialect decides, with the row of `WIDTHS`."""


def choose_dialect(
    texts: Sequence[str], sizes: Sequence[str] = (), gaps: Sequence[int] = (), *, said: str = ""
) -> DialectChoice:
    """Decide what UINT, INT, LONG, lengths of texts and bare sizes mean in a table.

    `texts` are the cells of types, `sizes` those of a column of sizes, `gaps` the distances to the next register of the
    space (0: not known), row by row or not at all. `said` is what the user says (see `read_dialect`), and wins.
    """
    given = read_dialect(said)
    found = Dialect() if isinstance(given, Unclear) else given
    fixed = {part.partition("=")[0].casefold() for part in re.split(r"[\s,;]+", said)}
    rows = [
        (
            clean(text).casefold().replace("_", " "),
            clean(sizes[at]) if at < len(sizes) else "",
            gaps[at] if at < len(gaps) else 0,
        )
        for at, text in enumerate(texts)
    ]
    stated = []
    if "size" not in fixed and (size := _size_bits(rows)):
        found = replace(found, size_bits=size[0])
        stated.append(size[1])
    for word in dict.fromkeys(_STEMS[text] for text, _, _ in rows if text in _STEMS):
        if word not in fixed:
            bits, why = _width(
                word, [(size, gap) for text, size, gap in rows if _STEMS.get(text) == word], found.size_bits
            )
            width: dict[str, Any] = {WIDTHS[word][0]: bits}
            found = replace(found, **width)
            stated.append(why)
    if "text" not in fixed and (text := _text_counts(rows)):
        found = replace(found, characters=text[0])
        stated.append(text[1])
    return DialectChoice(found, tuple(stated))


ENOUGH = 3
"""Rows whose distances to the next show a width; fewer may have a gap by chance."""

MOSTLY = 3
"""How many times more sizes must say one width than say another, to count where none stands."""

Row = tuple[str, str, int]
"""The words of a type, the cell of its size, the distance to the next register."""


def _size_bits(rows: Sequence[Row]) -> tuple[int, str] | None:
    """What a bare number in the column of sizes counts, by the types whose width is plain; else by the gaps."""
    votes: Counter[int] = Counter()
    for text, size, gap in rows:
        if size.isdecimal() and 0 < int(size) < 1 << 16:
            known = _KNOWN_BITS.match(text)
            bits = int(known[1]) if known else 16 * gap if gap and 16 * gap % int(size) == 0 else 0
            votes.update({bits // int(size)} & set(SIZES.values()) if bits else ())
    if not votes:
        return None
    (best, count), *others = votes.most_common()
    if sum(number for _, number in others) * 4 > count:
        return None
    name = next(name for name, bits in SIZES.items() if bits == best)
    return best, f"sizes count {name}, by the types of {count} rows or the distance to the next row"


def _width(word: str, rows: Sequence[tuple[str, int]], size_bits: int | None) -> tuple[int, str]:
    """How wide a word is, by the sizes beside it, else by the gaps behind it, else as it is usual."""
    _, widths, usual = WIDTHS[word]
    sized = Counter(bits for size, _ in rows if (bits := _bits_of(size, size_bits)) in widths)
    if sized:
        bits, count = sized.most_common(1)[0]
        if count == sized.total():
            return bits, f"{word.upper()} has {bits} bits, as the sizes beside it say"
        if count >= MOSTLY * (sized.total() - count):
            return bits, f"{word.upper()} has {bits} bits, as {count} of {sized.total()} sizes beside it say"
    gaps = [gap for _, gap in rows if gap]
    if gaps and word != "byte" and (min(gaps) == 1 or len(gaps) >= ENOUGH):
        least = min(gaps)
        fitting = [bits for bits in widths if bits <= 16 * least]
        if fitting and (max(fitting) < max(widths) or all(gap % (max(fitting) // 16) == 0 for gap in gaps)):
            bits = max(fitting)
            return bits, f"{word.upper()} has {bits} bits, as the next register comes {least} or more after each"
    return usual, f"{word.upper()} is taken for {usual} bits, as is usual: nothing in the table shows it, so check one"


def _bits_of(size: str, size_bits: int | None) -> int:
    """The bits that a size says; 0 if it says none for sure."""
    found = re.fullmatch(r"([0-9]{1,4})\s*(w\w*|reg\w*|byte\w*|b|bit\w*)?\.?", size, re.IGNORECASE)
    if not found:
        return 0
    unit = (found[2] or "").casefold()
    each = 16 if unit[:1] in {"w", "r"} else 1 if unit.startswith("bit") else 8 if unit else size_bits or 0
    return int(found[1]) * each


def _text_counts(rows: Sequence[Row]) -> tuple[bool, str] | None:
    """Whether the numbers of texts count characters, by the gaps behind them."""
    pairs = [(int(found[1]), gap) for text, _, gap in rows if gap and (found := _SIZED_TEXT.fullmatch(text))]
    registers = sum(length == gap for length, gap in pairs)
    characters = sum((length + 1) // 2 == gap for length, gap in pairs if length > 1)
    if bool(registers) == bool(characters):
        return None
    name, count = ("characters", characters) if characters else ("registers", registers)
    return bool(characters), f"lengths of texts count {name}, as {count} of them show, which reach up to the next row"
