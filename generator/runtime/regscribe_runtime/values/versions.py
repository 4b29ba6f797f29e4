"""Versions that a device sends as text: compared part by part, as whole numbers."""

import re

MOST_PARTS, BASE = 4, 10**6
"""Parts that count, and what each is less than."""
_VERSION = re.compile(r"[A-Za-z ]*([0-9]{1,6}(?:\.[0-9]{1,6}){0,3})")


def version_key(text: str) -> int | None:
    """A number that is in order as versions are: 2.10 is above 2.9; None where the text has no version.

    Letters and blanks before the first digit, and what follows the last part, do not count; a part that lacks is 0.
    """
    found = _VERSION.match(text)
    if found is None:
        return None
    parts = [int(part) for part in found[1].split(".")]
    key = 0
    for part in parts + [0] * (MOST_PARTS - len(parts)):
        key = key * BASE + part
    return key


def version_of_key(key: int) -> str:
    """The version of a key, of at least two parts."""
    parts = [key // BASE**place % BASE for place in reversed(range(MOST_PARTS))]
    while len(parts) > 2 and not parts[-1]:  # noqa: PLR2004 (1.0 reads as a version, 1 as a number)
        parts.pop()
    return ".".join(map(str, parts))
