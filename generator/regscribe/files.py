"""Files that people write besides maps: backups, programs, configurations, states of simulated devices.

`read` checks one against its JSON Schema, `dump` makes YAML that people compare line by line and that a YAML 1.2 reader
takes for what it was, `save` writes whole or not at all. Every mistake is a FileError with its place.
"""

import os
import sys
import tempfile
from collections.abc import Mapping, Sequence
from contextlib import suppress
from decimal import Decimal
from pathlib import Path
from typing import Any, Self

import yaml

from regscribe import schema, source
from regscribe.model import Diagnostic
from regscribe.source import Document
from regscribe.visible import INVISIBLE, safe

MOST_BYTES = 8_000_000
"""The largest of these files have 200 kB; one beyond this is none."""
MOST_ERRORS = 20


class FileError(Exception):
    """A file that cannot be read or written, or is not what it should be: each mistake with line and column."""


def read(path: Path, *, language: str, what: str) -> Document:
    """The document in a file (`-`: standard input).

    `language` names its schema, `what` is how a message calls such a file (a backup).
    """
    if str(path) == "-":
        content = sys.stdin.buffer.read(MOST_BYTES + 1)
        named = "standard input"
        return _checked(
            *source.parse(content, name=named, escapes=True), language=language, what=f"{named} is no {what}"
        )
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


class UnwrittenError(FileError):
    """A file that cannot be written: a full disk, a folder that is missing or closed to the user."""


class OneLine(dict[str, Any]):
    """A mapping that stands on one line."""


class Plain(str):
    """The decimal text of a number, which stands as that number, exactly so."""

    __slots__ = ()


class Tagged(str):
    """A text under a tag of another program: `!lambda` and lines of code."""

    __slots__ = ("tag",)
    tag: str

    def __new__(cls, text: str, tag: str) -> Self:
        """The text under this tag."""
        found = super().__new__(cls, text)
        found.tag = tag
        return found


class _Dumper(yaml.SafeDumper):
    """No anchors: equal values stay readable."""

    def ignore_aliases(self, data: object) -> bool:  # noqa: ARG002 (pyyaml's signature)
        """Whether a value is written out although it was written before."""
        return True

    def increase_indent(self, flow: bool = False, indentless: bool = False) -> None:  # noqa: ARG002, FBT001, FBT002 (as above)
        """Put the items of a list to the right of their key."""
        super().increase_indent(flow, indentless=False)


def _one_line(dumper: yaml.SafeDumper, data: OneLine) -> yaml.Node:
    return dumper.represent_mapping("tag:yaml.org,2002:map", data.items(), flow_style=True)


def _text(dumper: yaml.SafeDumper, data: str) -> yaml.Node:
    """Quote what is invisible, or no text by YAML 1.2 (pyyaml itself quotes what is none by 1.1)."""
    try:
        plain = INVISIBLE.search(data) is None and isinstance(source.resolve(data), str)
    except source.NumberFormError:
        plain = False
    return dumper.represent_scalar("tag:yaml.org,2002:str", data, style=None if plain else '"')


def _number(dumper: yaml.SafeDumper, data: Decimal) -> yaml.Node:
    """Write an exact number digit by digit, without an exponent."""
    text = format(data, "f")
    return dumper.represent_scalar("tag:yaml.org,2002:float" if "." in text else "tag:yaml.org,2002:int", text)


def _plain(dumper: yaml.SafeDumper, data: Plain) -> yaml.Node:
    return dumper.represent_scalar(f"tag:yaml.org,2002:{'float' if '.' in data else 'int'}", str(data))


def _tagged(dumper: yaml.SafeDumper, data: Tagged) -> yaml.Node:
    return dumper.represent_scalar(data.tag, str(data), style="|" if "\n" in data else '"')


_Dumper.add_representer(OneLine, _one_line)
_Dumper.add_representer(Plain, _plain)
_Dumper.add_representer(Tagged, _tagged)
_Dumper.add_representer(Decimal, _number)
_Dumper.add_representer(str, _text)


def dump(data: Mapping[str, Any], *, remarks: Sequence[str] = ()) -> str:
    """A mapping as YAML in the order of its keys; `remarks` become comments above it."""
    body: str = yaml.dump(dict(data), Dumper=_Dumper, sort_keys=False, allow_unicode=True, width=1 << 20)
    return "".join(f"# {safe(remark)}\n" for remark in remarks) + body


def save(path: Path, content: str | bytes, *, new: bool = False) -> None:
    """Write a file (a text as UTF-8) beside its place, flush it to the disk and move it into its place.

    What a link leads to is written, and the link stays; a device or a pipe is written to and never replaced. Raises
    UnwrittenError where that fails (a full disk); a file that was there before is then as it was. With `new` it also
    fails where there is a file, whoever else writes one at the same time.
    """
    octets = content.encode() if isinstance(content, str) else content
    try:
        if path.exists() and not path.is_file():
            path.write_bytes(octets)
        else:
            _replace(path.resolve(), octets, new=new)
    except (OSError, RuntimeError) as error:  # a loop of links is a RuntimeError before Python 3.13
        message = f"{path} cannot be written ({getattr(error, 'strerror', None) or error}); nothing of it was changed"
        raise UnwrittenError(message) from None


def _replace(path: Path, octets: bytes, *, new: bool) -> None:
    """Write a file beside its place and move it there. Raises OSError, and leaves nothing behind."""
    descriptor, temporary = tempfile.mkstemp(prefix=f".{path.name[:100]}.", dir=path.parent)
    try:
        with os.fdopen(descriptor, "wb") as file:
            file.write(octets)
            file.flush()
            os.fsync(file.fileno())
        Path(temporary).chmod(_mode(path))
        if new:
            path.hardlink_to(temporary)  # which fails where there is a file, as no move does
            Path(temporary).unlink()
        else:
            Path(temporary).replace(path)
    except OSError:
        with suppress(OSError):
            Path(temporary).unlink()
        raise


def _mode(path: Path) -> int:
    """Mode of the file that is replaced, else what the user's mask leaves of 666."""
    with suppress(OSError):
        return path.stat().st_mode & 0o777
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask
