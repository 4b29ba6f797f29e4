"""Sections of a sibling's manual in the numbers of the own one, as the compiler renumbers them."""

import re
from collections.abc import Mapping

_CHAPTER = re.compile(r"(^|[,;] ?| and )((?:[Tt]able|[Ff]igure|[Ss]ection|[Cc]hapter) )?([0-9]+)")


def renumbered(section: str, chapters: Mapping[str, str]) -> str:
    """The section with each of its first numbers as another manual counts them (`4.2, 4.3` by {4: 5}: `5.2, 5.3`)."""
    return _CHAPTER.sub(lambda found: f"{found[1]}{found[2] or ''}{chapters.get(found[3], found[3])}", section)
