"""Errors in names of links, devices, models and registers, with the name that was probably meant."""

import re
from collections.abc import Iterable

from regscribe.model.nearest import near

MOST_NAMED = 12
"""Names that a message lists before it says how many more there are."""

MOST_MEANT = 5
"""Names that a message asks about, of those that are nearly alike."""

MOST_SHOWN = 100
"""Characters of the given text that a message repeats."""


class TargetError(Exception):
    """A device that cannot be reached because its name, or something in it, is not understood; nothing was sent."""


def unknown(what: str, name: str, known: Iterable[str], *, where: str = "") -> str:
    """A message: `what` of that name does not exist, which one was probably meant, or which there are."""
    names = list(dict.fromkeys(known))
    shown = f"{name[:MOST_SHOWN]}…" if len(name) > MOST_SHOWN else name
    return f"there is no {what} `{shown}`{f' {where}' if where else ''}{meant(name, names)}"


def meant(name: str, known: Iterable[str]) -> str:
    """The end of a message: `; did you mean `x` or `y`?`, else the names there are, else nothing."""
    names = list(known)
    folded = {one.casefold(): one for one in reversed(names)}
    alike: dict[str, str] = {}
    for one in near(name.casefold(), folded, most=MOST_MEANT):
        alike.setdefault(re.sub(r"\[\d+\]", "[]", one), f"`{folded[one]}`")  # of elements of an array the nearest
    if found := list(alike.values()):
        return f"; did you mean {' or '.join(filter(None, (', '.join(found[:-1]), found[-1])))}?"
    if not names:
        return ""
    more = f" and {len(names) - MOST_NAMED} more" if len(names) > MOST_NAMED else ""
    return f"; there are {', '.join(names[:MOST_NAMED])}{more}"
