"""The map that a map extends, and what it overrides there."""

from regscribe.emit.markdown.context import PageContext
from regscribe.emit.markdown.escape import Md, code, escape, join, lines, link, md, prose
from regscribe.emit.markdown.page_values import PageTable, table
from regscribe.emit.words import one_line
from regscribe.model import Override

PLURALS = frozenset({"errata", "examples", "notes", "waivers"})
INTERNAL = frozenset({"waivers"})
"""Parts of a map that are no facts of the device."""

WORDS = "description"
"""A key whose text stands at the thing itself."""

ALL = "all"


def base(context: PageContext) -> Md:
    """Return the map that this one extends, with a link to its reference; empty if it stands alone."""
    other = context.map.extends
    up = "../" * context.map.id.count("/")
    return md(Md("["), one_line(other), Md(f"]({up}{other}.md)")) if other else Md()


def overrides(context: PageContext) -> PageTable:
    """Return the differences from the map that this one extends, with their reasons."""
    shown = (item for item in context.map.overrides if item.what not in INTERNAL)
    rows = ((_subject(context, item), _change(item), prose(item.reason)) for item in shown)
    return table(("What", "How it differs", "Why"), rows)


def _subject(context: PageContext, item: Override) -> Md:
    if item.what in PLURALS:
        return md(item.what, "" if item.id == ALL else f" of {one_line(item.id)}")
    anchor = context.anchor(item.what, item.id)
    return join(" ", (escape(item.what), link(code(item.id), anchor) if anchor else code(item.id)))


def _change(item: Override) -> Md:
    if not item.changed:
        return md("not taken over" if item.what in PLURALS else "is not there")
    changes = (one_line(change).partition(": ") for change in item.changed)
    return lines(
        *(md(f"other {key}" if key.rpartition(".")[2] == WORDS else f"{key}: {values}") for key, _, values in changes)
    )
