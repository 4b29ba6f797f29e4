"""Where the pictures of a map lie: what draws them and what links to them agree on it here."""

import hashlib
import re
from pathlib import PurePosixPath

LONGEST = 80
"""Characters of a name before it is cut: a file system takes 255 bytes."""

PLAIN = re.compile(r"[a-z0-9_]+(?:\[\]\.[a-z0-9_]+)*")
"""Paths whose file names differ whenever they do."""


def addresses() -> str:
    """Return the name of the picture of a map's address spaces."""
    return "addresses.svg"


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
