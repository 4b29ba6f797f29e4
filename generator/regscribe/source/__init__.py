"""Text to plain values with positions, by the rules of YAML 1.2; every mistake is a diagnostic with its place.

`load` reads a file, `parse` a text. Time and memory are bounded for any input: see the limits in `load`,
`scalars` and `node_builder`.
"""

from pathlib import Path as FilePath

from regscribe.model import Diagnostic
from regscribe.source.document import Document, Path, Plain, SourceNode, SourcePlace
from regscribe.source.load import display_name, parse, read
from regscribe.source.rules import RULES
from regscribe.source.scalars import NumberFormError, resolve, shorten

__all__ = [
    "RULES",
    "Document",
    "NumberFormError",
    "Path",
    "Plain",
    "SourceNode",
    "SourcePlace",
    "display_name",
    "load",
    "parse",
    "resolve",
    "shorten",
]


def load(path: FilePath, *, name: str | None = None, escapes: bool = False) -> tuple[Document | None, list[Diagnostic]]:
    """Read a map; `name` is what diagnostics call it (default: the path as given, relative where possible).

    The document is None if and only if there are diagnostics. `escapes`: see `parse`.
    """
    shown = name or display_name(path)
    data, diagnostics = read(path, name=shown)
    return (None, diagnostics) if data is None else parse(data, name=shown, escapes=escapes)
