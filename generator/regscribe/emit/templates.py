"""Users' own templates: their files, and path, header and text of what is made of them (docs/templates.md)."""

import os
from collections.abc import Callable, Container, Iterator, Mapping
from pathlib import Path, PurePosixPath

from regscribe.emit.header import HEAD, header
from regscribe.emit.write import WriteError
from regscribe.model import RegisterMap
from regscribe.visible import safe

_HASH = ("# ", "", "\n# ")
_SLASHES = ("// ", "", "\n// ")
_BLOCK = ("/* ", " */", "\n   ")
_MARKUP = ("<!-- ", " -->", " ")
_DASHES = ("-- ", "", "\n-- ")
_PASCAL = ("(* ", " *)", "\n   ")
_SEMICOLON = ("; ", "", "\n; ")
_PERCENT = ("% ", "", "\n% ")

COMMENTS = {
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

BY_SUFFIX = {f".{ending}": style for style, endings in COMMENTS.items() for ending in endings.split()}

ENDING = ".j2"
NO_COMMENT = "how a comment is written in such a file is not known: put {{ header }} into one of its first lines"


class Templates:
    """The templates below a folder: every *.j2 is rendered, and may include or import any other file there."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.files = sorted(path.relative_to(folder).as_posix() for path in _files(folder))
        self.names = [name for name in self.files if name.endswith(ENDING)]
        self._text: Callable[[str, Mapping[str, object]], str] | None = None

    def contents(self) -> Iterator[tuple[str, bytes]]:
        """Yield name and content of every file below the folder: all that decides what is rendered."""
        yield from ((name, (self.folder / name).read_bytes()) for name in self.files)

    def render(self, register_map: RegisterMap, taken: Container[str]) -> dict[str, str]:
        """Return the text of each template by path, which must not be among those `taken`. Raises WriteError."""
        texts: dict[str, str] = {}
        for name in self.names:
            path = _path(name, register_map)
            if path in taken or path in texts:
                raise WriteError(safe(f"{self.folder / name}: another file is written to {path}: rename the template"))
            text = _with_header(self.text(name, register_map), path, register_map)
            if text is None:
                raise WriteError(safe(f"{self.folder / name}: {NO_COMMENT}"))
            texts[path] = text
        return texts

    def text(self, name: str, register_map: RegisterMap) -> str:
        """Return the text of one template. Raises WriteError with file, line and what is wrong."""
        from regscribe.emit.sandbox import Sandbox  # noqa: PLC0415 - 40 ms that a build without change does not need
        from regscribe.emit.template_words import WORDS  # noqa: PLC0415 - as above

        self._text = self._text or Sandbox(self.folder).text
        known = {"map": register_map, "models": register_map.models, "words": WORDS, "header": header(register_map)}
        return self._text(name, known)


def _path(name: str, register_map: RegisterMap) -> str:
    """Return the path of a template's text: its name without `.j2`, with `{maker}` and `{family}` filled in."""
    maker, _, family = register_map.id.partition("/")
    return name.removesuffix(ENDING).replace("{maker}", maker).replace("{family}", family)


def _files(folder: Path) -> Iterator[Path]:
    """All files below a folder but for hidden ones and those in hidden folders."""
    for root, folders, names in os.walk(folder):
        folders[:] = [name for name in folders if not name.startswith(".")]
        paths = (Path(root, name) for name in names if not name.startswith("."))
        yield from (path for path in paths if path.is_file() or not path.exists())  # devices and pipes may have no end


def _with_header(text: str, path: str, register_map: RegisterMap) -> str | None:
    """Put the header before a text as a comment, unless it stands in the first `HEAD` bytes; None without a comment."""
    if header(register_map).encode() in text.encode()[:HEAD]:
        return text
    style = BY_SUFFIX.get(PurePosixPath(path).suffix.lower())
    return None if style is None else f"{header(register_map, *style)}\n{text}"
