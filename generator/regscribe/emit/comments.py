"""How a comment is written in a file, told by the ending of its name: where the header of a user's template goes."""

from pathlib import PurePosixPath

from regscribe.emit.header import HEAD, header
from regscribe.model import RegisterMap

_HASH = ("# ", "", "\n# ")
_SLASHES = ("// ", "", "\n// ")
_BLOCK = ("/* ", " */", "\n   ")
_MARKUP = ("<!-- ", " -->", " ")
_DASHES = ("-- ", "", "\n-- ")
_PASCAL = ("(* ", " *)", "\n   ")
_SEMICOLON = ("; ", "", "\n; ")
_PERCENT = ("% ", "", "\n% ")

STYLES = {
    _HASH: "cfg cmake conf jl mk nix pl properties ps1 py pyi r rb robot sh tcl toml yaml yml",
    _SLASHES: "adoc cc cpp cs cxx dart fs go groovy h++ hh hpp hxx ino java js kt php proto rs scala swift ts zig",
    _BLOCK: "c css h ld",
    _MARKUP: "htm html md svg xhtml",
    _DASHES: "adb ads elm hs lua sql vhd vhdl",
    _PASCAL: "exp ml pas scl st",
    _SEMICOLON: "asm clj el ini lisp",
    _PERCENT: "erl m tex",
}
"""Prefix, suffix and separator of the two sentences of a header (see `header`), and endings of files that take them."""

BY_SUFFIX = {f".{ending}": style for style, endings in STYLES.items() for ending in endings.split()}


def with_header(text: str, path: str, register_map: RegisterMap) -> str | None:
    """Put the header before a text as a comment, unless one is there; None if no comment is known for the file.

    A header of its own must stand where generated files are told by it: within the first `HEAD` bytes.
    """
    if header(register_map).encode() in text.encode()[:HEAD]:
        return text
    style = BY_SUFFIX.get(PurePosixPath(path).suffix.lower())
    return None if style is None else f"{header(register_map, *style)}\n{text}"
