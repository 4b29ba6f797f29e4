"""Values of the templates, frozen, with nothing left to decide; a `str` is escaped on output, a `Md` is not."""

import html
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from regscribe.emit.markdown.escape import CONTROL, Md
from regscribe.emit.words import one_line


@dataclass(frozen=True, slots=True)
class PageTable:
    """Headers and rows of equal length; no rows: nothing to show."""

    headers: tuple[str, ...] = ()
    rows: tuple[tuple[str, ...], ...] = ()


def table(headers: Sequence[str], rows: Iterable[Sequence[str]]) -> PageTable:
    """Make a table without the columns that are empty in every row."""
    kept_rows = [tuple(row) for row in rows]
    kept = [index for index in range(len(headers)) if any(row[index] for row in kept_rows)]
    return PageTable(
        tuple(headers[index] for index in kept),
        tuple(tuple(row[index] for index in kept) for row in kept_rows),
    )


@dataclass(frozen=True, slots=True)
class Titled:
    """A table under a line of its own; `folded` hides it until it is opened."""

    title: str
    table: PageTable
    folded: bool = False

    @property
    def summary(self) -> Md:
        """Return the title for use inside an HTML element, where Markdown's escapes do not count."""
        return Md(html.escape(CONTROL.sub("", one_line(self.title))))


@dataclass(frozen=True, slots=True, kw_only=True)
class RegisterEntry:
    """One register, array or command with its details; `marks` opens its heading (`####`)."""

    marks: Md
    anchor: str
    name: str
    summary: Md
    paragraphs: tuple[Md, ...] = ()
    pictures: tuple[Md, ...] = ()
    danger: tuple[Md, ...] = ()
    facts: PageTable = PageTable()
    tables: tuple[Titled, ...] = ()
    remarks: tuple[Md, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class PageSection:
    """A group of registers, in the manual's order."""

    anchor: str
    name: str
    summary: Md
    entries: tuple[RegisterEntry, ...]
    paragraphs: tuple[Md, ...] = ()
