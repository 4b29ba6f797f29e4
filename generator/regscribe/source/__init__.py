"""Text to plain values with positions, by the rules of YAML 1.2; every mistake is a diagnostic with its place.

`load` reads a file, `parse` a text. Time and memory are bounded for any input: see the limits in `load`,
`scalars` and `node_builder`.
"""

from regscribe.source.document import Document, Path, Plain, SourceNode, SourcePlace
from regscribe.source.load import Texts, display_name, load, parse
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
    "Texts",
    "display_name",
    "load",
    "parse",
    "resolve",
    "shorten",
]
