"""Which of the known names was probably meant."""

from collections.abc import Iterable
from difflib import get_close_matches

_LONGEST = 100
"""Characters of a name that are compared: the time grows with their square."""


def nearest(name: str, known: Iterable[str]) -> str:
    """The known name that is most like this one; empty if none is like it."""
    return next(iter(get_close_matches(name[:_LONGEST], list(known), n=1)), "")
