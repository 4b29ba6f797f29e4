"""Names and paths of the pictures of a map, for the pages that link to them and the emitter that draws them."""

import hashlib
import re
from pathlib import PurePosixPath

ADDRESSES = "addresses.svg"
"""Name of the picture of a map's address spaces."""

LONGEST = 80
"""Characters of a name before it is cut: a file system takes 255 bytes."""

PLAIN = re.compile(r"[a-z0-9_]+(?:\[\]\.[a-z0-9_]+)*")
"""Paths that have a file name of their own without a hash."""


def bits(pattern: str) -> str:
    """Return the name of the picture of a register's bits, by its path without indices."""
    return f"bits-{_stem(pattern)}.svg"


def array(pattern: str) -> str:
    """Return the name of the picture of an array, by its id."""
    return f"array-{_stem(pattern)}.svg"


def path(map_id: str, name: str) -> str:
    """Return the path of a picture in the output directory."""
    return f"docs/{map_id}/{name}"


def link(map_id: str, name: str) -> str:
    """Return the path of a picture as the map's page names it."""
    return f"{PurePosixPath(map_id).name}/{name}"


def _stem(pattern: str) -> str:
    plain = re.sub(r"[^a-z0-9_]+", "-", pattern.lower()).strip("-")
    if len(plain) <= LONGEST and PLAIN.fullmatch(pattern):
        return plain
    return f"{plain[:LONGEST]}-{hashlib.sha256(pattern.encode()).hexdigest()[:8]}"
