"""Files to bytes and bytes to documents."""

import errno
import hashlib
import os
import stat
from collections.abc import Mapping
from pathlib import Path as FilePath

from regscribe.model import Diagnostic
from regscribe.source.document import START, Document
from regscribe.source.findings import Findings, StopReadingError
from regscribe.source.node_builder import NodeBuilder
from regscribe.source.rules import TOO_LARGE, UNREADABLE
from regscribe.source.scalars import shorten
from regscribe.source.utf8 import check_characters, decode, normalise

MAX_BYTES = 8 * 1024 * 1024

Texts = Mapping[FilePath, str]
"""Texts that count instead of the files at these paths: what an editor holds and has not saved."""

_ADVICE = {
    errno.ENOENT: "check the path; `regscribe new MAKER/FAMILY` starts a map",
    errno.EACCES: "ask for the right to read it (`ls -l` shows who has it)",
    errno.ENAMETOOLONG: "check the path",
}


def display_name(path: FilePath) -> str:
    """Show a path as diagnostics do: relative to the working directory where it lies below, printable always."""
    here = FilePath.cwd()
    shown = path.relative_to(here) if path.is_absolute() and path.is_relative_to(here) else path
    text = os.fsencode(shown).decode("utf-8", "backslashreplace")
    return "".join(character if character.isprintable() else "?" for character in text)


def load(
    path: FilePath, *, escapes: bool = False, unsaved: Texts | None = None
) -> tuple[Document | None, list[Diagnostic]]:
    """Read and parse a file, or its text in `unsaved`; the rest as in `parse`."""
    name = display_name(path)
    if unsaved and path in unsaved:
        return parse(unsaved[path], name=name, escapes=escapes)
    findings = Findings(name)
    try:
        data = _read(path, findings)
    except StopReadingError:
        pass
    except OSError as error:
        reason = (error.strerror or "cannot be read").lower()
        advice = _ADVICE.get(error.errno or 0, "check the path and the disk")
        findings.add(UNREADABLE, f"the map cannot be read: {reason}", START, advice=advice)
    except ValueError:
        findings.add(UNREADABLE, "no file can have this name", START, advice="check the path")
    else:
        return parse(data, name=name, escapes=escapes)
    return None, findings.diagnostics


def _read(path: FilePath, findings: Findings) -> bytes:
    status = path.stat()
    if stat.S_ISDIR(status.st_mode):
        advice = "name a file in it: MAKER/FAMILY.yaml"
        raise findings.stop(UNREADABLE, "this is a directory, not a map", START, advice=advice)
    if not stat.S_ISREG(status.st_mode):
        raise findings.stop(UNREADABLE, "this is no regular file", START, advice="copy the map into a file")
    _check_size(status.st_size, findings)
    with path.open("rb") as file:
        data = file.read(MAX_BYTES + 1)
    _check_size(len(data), findings)
    return data


def _check_size(size: int, findings: Findings) -> None:
    if size > MAX_BYTES:
        message = f"the file has {size:,} bytes; at most {MAX_BYTES:,} are read"
        raise findings.stop(TOO_LARGE, message, START, advice="is this a map? split a family that is really so large")


def parse(content: str | bytes, *, name: str, escapes: bool = False) -> tuple[Document | None, list[Diagnostic]]:
    """Parse a map's text; the document is None if and only if there are diagnostics, which are sorted by place.

    `escapes`: in other files than maps, an escape may spell any character that a device sent.
    """
    findings = Findings(shorten(name, limit=500))
    data = content.encode("utf-8", "surrogatepass") if isinstance(content, str) else content
    try:
        _check_size(len(data), findings)
        text = normalise(content) if isinstance(content, str) else decode(data, findings)
        check_characters(text, findings)
        if not findings.diagnostics:
            root = NodeBuilder(text, findings, escapes=escapes).build()
            if not findings.diagnostics:
                return Document(findings.name, text, root.value, hashlib.sha256(data).hexdigest(), root), []
    except StopReadingError:
        pass
    return None, sorted(findings.diagnostics, key=lambda found: found.span)
