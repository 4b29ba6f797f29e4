"""Sections of manuals: where a manual describes something, and how a sibling's manual numbers the same."""

import re
from collections.abc import Iterable, Mapping

CHAPTER = re.compile(r"(^|[,;] ?| and )((?:[Tt]able|[Ff]igure|[Ss]ection|[Cc]hapter) )?([0-9]+)")
"""The first number of a section: behind its line's start, a separator or a word such as `table`."""


def renumbered(section: str, chapters: Mapping[str, str]) -> str:
    """The section with each of its first numbers as another manual counts them (`4.2, 4.3` by {4: 5}: `5.2, 5.3`)."""
    return CHAPTER.sub(lambda found: f"{found[1]}{found[2] or ''}{chapters.get(found[3], found[3])}", section)


def chapters_of(section: str) -> Iterable[str]:
    """The first numbers in a section."""
    return [found[3] for found in CHAPTER.finditer(section)]
