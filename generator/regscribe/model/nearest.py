"""Which of the known names was probably meant."""

from collections.abc import Iterable
from difflib import SequenceMatcher, get_close_matches

_LONGEST = 100
"""Characters of a name that are compared: the time grows with their square."""
_ALIKE = 0.6
"""How like a known name must be."""
_BAND = 0.15
"""How much less like than the best one a name may be to be meant as well."""


def nearest(name: str, known: Iterable[str]) -> str:
    """The known name that is most like this one; empty if none is like it."""
    return next(iter(near(name, known, most=1)), "")


def near(name: str, known: Iterable[str], *, most: int) -> list[str]:
    """The known names that this one may mean, the most like first, then those that are nearly as like.

    Where none is like it, those of the same letters: `emun` has but half of `enum` in its order.
    """
    wanted, names = name[:_LONGEST], list(known)
    best = get_close_matches(wanted, names, n=1, cutoff=_ALIKE)
    if not best:
        letters = sorted(wanted)
        return [one for one in names if sorted(one) == letters][:most]
    likeness = SequenceMatcher(None, best[0], wanted).ratio()
    return get_close_matches(wanted, names, n=most, cutoff=max(_ALIKE, likeness - _BAND))
