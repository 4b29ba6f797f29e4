"""The canonical form of a map's text: the same values and comments, laid out as the maps that come with regscribe.

The author keeps what has a meaning to readers: the order of keys, what stands in brackets and where lines end. Only
blanks, indentation, needless quotes, the place of comments and rows that are too wide are settled here.
"""

from regscribe.map_format.block import Printer
from regscribe.map_format.tokens import comments_of, tokens_of
from regscribe.source import Document, parse

__all__ = ["FormatError", "formatted"]


class FormatError(Exception):
    """A text for which the canonical form would say something else; it stays as it is."""


def formatted(document: Document) -> str:
    """Return the text of a map in its canonical form.

    Raises FormatError rather than return one with other values, or without one of the comments.
    """
    text = Printer(tokens_of(document.text)).text()
    if text != document.text:
        again, _ = parse(text, name=document.name)
        if again is None or repr(again.data) != repr(document.data) or comments_of(text) != comments_of(document.text):
            message = "its canonical form would not hold the same values and comments"
            raise FormatError(message)
    return text
