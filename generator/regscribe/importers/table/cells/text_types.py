"""Texts with their length, which counts characters or registers."""

from dataclasses import replace

from regscribe.importers.table.cells import Unclear, quoted
from regscribe.importers.table.cells.dialects import Dialect
from regscribe.importers.table.cells.type_values import TypeCell, Words
from regscribe.importers.table.cells.type_words import TEXTS
from regscribe.model import WireType


def text_type(words: Words) -> TypeCell | Unclear | None:
    """A text with its length, which counts characters or registers; None if it is no text."""
    found = TEXTS.fullmatch(words.plain) or TEXTS.fullmatch(words.folded)
    if not found:
        return None
    word, unit = found["word"] or found["word2"], found["unit"] or found["unit2"] or ""
    if word == "char" and not (found["n"] or found["m"]) and not words.size:
        return None
    plain = TypeCell(type=WireType.STRING, words=words.size.words if words.size else 0, encoding=_encoding(word))
    length = int(found["n"] or found["m"] or 0)
    if not length:
        return plain
    counts = _counts_characters(unit, word, words.dialect)
    if counts is None and length > 1 and (plain.words or words.gap) in {length, (length + 1) // 2}:
        counts = (plain.words or words.gap) != length
    if counts is None:
        return _unclear_length(words.text)
    stated = f"{quoted(words.text)} has {length} {'characters' if counts else 'registers'}"
    return replace(plain, words=(length + 1) // 2 if counts else length, stated=stated)


def _encoding(word: str) -> str:
    return "utf-8" if word.startswith("utf") else ""


def _counts_characters(unit: str, word: str, dialect: Dialect) -> bool | None:
    """Whether the length of a text counts characters, by the word behind it, else by the dialect."""
    if unit:
        return unit[0] in "cbz"
    return True if word.startswith("char") else dialect.characters


def _unclear_length(text: str) -> Unclear:
    return Unclear(f"{quoted(text)} does not say whether its length counts characters or registers")
