"""Whether a register can be read and written, in the words of several languages."""

import re
from dataclasses import dataclass

from regscribe.importers.table.cells import Unclear, quoted
from regscribe.importers.table.cells.numbers import clean
from regscribe.model import Access, Space


@dataclass(frozen=True, slots=True)
class AccessCell:
    """The access, and what else the cell says of it (`with code`), which an access alone does not say."""

    access: Access
    remark: str = ""


_SAYS_NOTHING = frozenset({"", "-", "--", "n/a", "?"})
_READ = (
    r"r|l|ro|r o|rd|rof|read|reading|readable|read only|get|lesen|lesend|nur lesen|lese|lesbar|lecture|lecture seule"
    r"|lettura|sola lettura|lectura|solo lectura|lezen|alleen lezen|l\u00e4s|l\u00e4sning|odczyt|leitura"
    r"|\u53ea\u8bfb|\u8bfb"
)
_WRITE = (
    r"w|s|wo|w o|wd|wr|write|writing|writable|write only|set|schreiben|nur schreiben|schreibbar|schreibend"
    r"|\u00e9criture|ecriture|scrittura|escritura|schrijven|skriv|skrivning|zapis|escrita|\u53ea\u5199|\u5199"
)
_BOTH = r"rw|wr|rwd|r w|l s|l e|ls|le|read write|lesen schreiben|\u8bfb\u5199|read and write|read or write"
_YES = frozenset({"yes", "y", "ja", "oui", "si", "sí", "sì", "true", "1", "x", "tak", "✓", "✔", "是"})
_NO = frozenset({"no", "n", "nein", "non", "false", "0", "nie", "nee", "nej", "\u5426"})

_ONE_READS = re.compile(rf"(?:{_READ})")
_ONE_WRITES = re.compile(rf"(?:{_WRITE})")
_ONE_BOTH = re.compile(rf"(?:{_BOTH})")
_BY_COMMAND = re.compile(r"r\s*/?\s*wc|wc")
_JOINED = re.compile(r" (?:and|or|und|et|e|y|en|och|i) ")
_WRITABLE = re.compile(r"writ|schreib|\u00e9crit|ecrit|scriv|scritt|escri|schrijf|skriv|zapis", re.IGNORECASE)
_READ_ONLY = re.compile(r"read.?only|nur.?lese|lecture seule|sola lettura|solo lectura", re.IGNORECASE)

READ_SPACES = frozenset({Space.INPUT, Space.DISCRETE, Space.STATUS, Space.IDENTIFICATION})
"""Spaces that are never written."""


def parse_access(text: str, header: str = "", space: Space | None = None) -> AccessCell | Unclear | None:
    """Read `R`, `RO`, `R/W`, `Lesen/Schreiben`, `lecture`; `yes` and `no` under a heading such as `writable`.

    An empty cell means `r` in a space that is only read; None where it says nothing. Unclear: that a register of such a
    space is written.
    """
    plain = clean(text).casefold()
    if plain in _SAYS_NOTHING:
        return AccessCell(Access.READ) if space in READ_SPACES else None
    found = _answer(plain, header, text) if plain in _YES | _NO else _words(plain, text)
    if isinstance(found, AccessCell) and found.access.writable and space in READ_SPACES:
        return Unclear(f"{quoted(text)} says that it is written, and {space} registers are only read")
    return found


def _answer(plain: str, header: str, text: str) -> AccessCell | Unclear:
    """Yes or no, as the heading asks."""
    yes = plain in _YES
    if _READ_ONLY.search(header):
        return AccessCell(Access.READ if yes else Access.READ_WRITE)
    if _WRITABLE.search(header):
        return AccessCell(Access.READ_WRITE if yes else Access.READ)
    return Unclear(f"{quoted(text)} under `{header.strip()}` does not say whether it can be read and written")


def _words(plain: str, text: str) -> AccessCell | Unclear:
    """Words for reading and for writing, with a remark behind them in brackets."""
    if _BY_COMMAND.fullmatch(plain):
        return Unclear(f"{quoted(text)} may say that it is written by a command of the device, and not itself")
    bare, _, remark = plain.partition("(")
    marks = bare[len(bare.rstrip("*\u2020\u2021\u00b9\u00b2\u00b3 ")) :].strip()
    bare = bare.rstrip("*\u2020\u2021\u00b9\u00b2\u00b3 ")
    folded = " ".join(re.split(r"[\s/,;+&.|_-]+", bare)).strip()
    said = f"{remark.removesuffix(')').strip()} {marks}".strip()
    if found := _access_of(folded):
        with_write = found is Access.READ and _ONE_WRITES.fullmatch(said.partition(" ")[0])
        return AccessCell(Access.READ_WRITE if with_write else found, said)
    words = folded.split()
    for end in range(len(words) - 1, 0, -1):
        if (found := _access_of(" ".join(words[:end]))) and not _access_of(words[end]):
            return AccessCell(found, " ".join(words[end:]))
    return Unclear(f"{quoted(text)} does not say whether it can be read and written")


def _access_of(folded: str) -> Access | None:
    """The access that words mean, if all of them do."""
    if _ONE_BOTH.fullmatch(folded):
        return Access.READ_WRITE
    if _ONE_READS.fullmatch(folded):
        return Access.READ
    if _ONE_WRITES.fullmatch(folded):
        return Access.WRITE
    first, _, last = _JOINED.sub(" ", folded).partition(" ")
    sides = {bool(_ONE_READS.fullmatch(first)), bool(_ONE_READS.fullmatch(last))}
    writes = {bool(_ONE_WRITES.fullmatch(first)), bool(_ONE_WRITES.fullmatch(last))}
    return Access.READ_WRITE if sides == {True, False} and writes == {True, False} else None
