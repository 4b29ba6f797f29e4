r"""What the reference in Markdown says of registers and commands, as runs of text that need no renderer.

A run is a text, or `{"text": ..}` with `code` or `strong` where it is such, and `to`, the anchor that it links to; a
line break is `"\n"`.
"""

import html
import re
from collections.abc import Iterable
from typing import Any

from regscribe.emit.markdown.context import PageContext
from regscribe.emit.markdown.entries import commands, sections
from regscribe.emit.markdown.page_values import RegisterEntry, Titled

Json = Any
_RUNS = re.compile(
    r"\[(?P<text>(?:\\.|`[^`]*`|[^\]\\`])*)\]\(#(?P<to>[^)]*)\)|`(?P<code>[^`]*)`|\*\*(?P<strong>.*?)\*\*|(?P<br><br>)"
    r"|(?P<plain>(?:\\.|[^\\`*\[<])+)|(?P<other>.)",
    re.DOTALL,
)
_ESCAPED = re.compile(r"\\([!-/:-@\[-`{-~])")
DRAWN = ("Address of every element", "Values", "Bits", "Views")
"""Tables that the page draws from the data itself."""


def said(context: PageContext) -> dict[str, Json]:
    """Return by anchor what is said: paragraphs, danger, facts (pairs), tables and remarks."""
    entries = [entry for section in sections(context) for entry in section.entries] + [*commands(context)]
    return {entry.anchor: _entry(entry) for entry in entries if entry.anchor}


def _entry(entry: RegisterEntry) -> Json:
    found = {
        "summary": runs(entry.summary),
        "paragraphs": [*map(runs, entry.paragraphs)],
        "danger": [*map(runs, entry.danger)],
        "facts": [[*map(runs, row)] for row in entry.facts.rows],
        "tables": [_table(one) for one in entry.tables if not one.title.startswith(DRAWN)],
        "remarks": [*map(runs, entry.remarks)],
    }
    return {key: value for key, value in found.items() if value}


def _table(one: Titled) -> Json:
    return {
        "title": runs(one.title),
        "headers": [*map(runs, one.table.headers)],
        "rows": [[*map(runs, row)] for row in one.table.rows],
    }


def runs(markdown: str) -> list[Json]:
    """Return Markdown of our own as runs."""
    found: list[Json] = []
    for part in _RUNS.finditer(markdown):
        run = _run(part)
        if isinstance(run, str) and found and isinstance(found[-1], str):
            found[-1] += run
        else:
            found.append(run)
    return found


def _run(part: re.Match[str]) -> Json:
    if part["to"] is not None:
        inner = runs(part["text"])
        code = len(inner) == 1 and isinstance(inner[0], dict) and "code" in inner[0]
        return {"text": _flat(inner), "to": part["to"]} | ({"code": True} if code else {})
    if part["code"] is not None:
        return {"text": part["code"], "code": True}
    if part["strong"] is not None:
        return {"text": _flat(runs(part["strong"])), "strong": True}
    return "\n" if part["br"] else _unescaped(part["plain"] or part["other"])


def _flat(found: Iterable[Json]) -> str:
    return "".join(run if isinstance(run, str) else run["text"] for run in found)


def _unescaped(text: str) -> str:
    return html.unescape(_ESCAPED.sub(r"\1", text))
