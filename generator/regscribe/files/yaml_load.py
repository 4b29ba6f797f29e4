"""Reading a file: YAML 1.2 by the rules of maps, in the shape that its JSON Schema describes."""

from pathlib import Path

from regscribe import schema, source
from regscribe.model import Diagnostic
from regscribe.source import Document

MOST_BYTES = 8_000_000
"""The largest of these files have 200 kB; one beyond this is none."""
MOST_ERRORS = 20


class FileError(Exception):
    """A file that cannot be read or written, or is not what it should be: each mistake with line and column."""


def read(path: Path, *, language: str, what: str) -> Document:
    """The document in a file; `language` names its schema, `what` is how a message calls such a file (a backup)."""
    _check_size(path, what)
    return _checked(*source.load(path, escapes=True), language=language, what=f"{path} is no {what}")


def parse(text: str, *, language: str, what: str) -> Document:
    """As `read`, of a text that is to become such a file."""
    return _checked(*source.parse(text, name=what, escapes=True), language=language, what=f"this is no {what}")


def _checked(document: Document | None, found: list[Diagnostic], *, language: str, what: str) -> Document:
    if document is not None:
        found = schema.validate(document, language=language)
        if not found:
            return document
    lines = [f"{one.span}: {one.message}{f' ({one.help})' if one.help else ''}" for one in found[:MOST_ERRORS]]
    more = [f"and {len(found) - MOST_ERRORS} more"] if len(found) > MOST_ERRORS else []
    raise FileError("\n".join([f"{what}:", *lines, *more]))


def _check_size(path: Path, what: str) -> None:
    try:
        size = path.stat().st_size
    except FileNotFoundError:
        message = f"there is no file {path}"
        raise FileError(message) from None
    except OSError as error:
        message = f"{path} cannot be read: {error.strerror or error}"
        raise FileError(message) from None
    if size > MOST_BYTES:
        message = f"{path} has {size} bytes: a {what} has at most {MOST_BYTES}"
        raise FileError(message)
