r"""Inline Markdown of the reference as runs of text: a page shows them by text nodes, so no text of a map is mark-up.

A run is a text, or `{"text": ..}` with `code` or `strong` where it is such, and `to`, the anchor that it links to; a
line break is `"\n"`. `{"id": ..}` is an empty place that links lead to.
"""

import re
from functools import lru_cache
from typing import Any

from markdown_it import MarkdownIt

Runs = list[Any]

_PARSER = MarkdownIt("commonmark")
_TARGET = re.compile(r'<a id="([a-z0-9_-]+)">')


@lru_cache(maxsize=8192)  # a page says the same few words of every register
def runs(markdown: str) -> Runs:
    """Return the runs of one line of Markdown that the emitter of the reference wrote."""
    found: Runs = []
    style: dict[str, Any] = {}
    for token in _PARSER.parseInline(markdown)[0].children or []:
        target = _TARGET.fullmatch(token.content)
        if token.type == "link_open":
            style |= {"to": str(token.attrGet("href")).removeprefix("#")}
        elif token.type == "strong_open":
            style |= {"strong": True}
        elif token.type in {"link_close", "strong_close"}:
            style.pop("to" if token.type == "link_close" else "strong", None)
        elif token.type == "html_inline" and target:
            found.append({"id": target[1]})
        elif token.type == "code_inline":
            found.append({"text": token.content, "code": True} | style)
        elif text := "\n" if token.content == "<br>" else "" if token.type == "html_inline" else token.content:
            _add(found, {"text": text} | style if style else text)
    return found


def _add(found: Runs, run: Any) -> None:  # noqa: ANN401 (a text or an object of one)
    """Add a run; a text that follows another is joined to it."""
    if found and isinstance(run, str) and isinstance(found[-1], str):
        found[-1] += run
    else:
        found.append(run)
