"""Markdown as GitHub reads it, rewritten so that Python-Markdown, which builds the site, shows the same.

Escapes become character references, and so do braces, which would set attributes, and `:::`, which would ask for the
reference of a Python object. Headings carry their ids, and blocks that follow a paragraph at once get the empty line
that Python-Markdown needs.
"""

import re
from collections.abc import Callable, Iterator

FENCE = re.compile(r" *(`{3,}|~{3,})")

TOKEN = re.compile(
    r"\\(?P<escaped>[!-/:-@\[-`{-~])"
    r"|(?P<code>(?P<ticks>`+)(?:(?!\n\s*\n).)+?(?<!`)(?P=ticks)(?!`))"
    r"|(?P<image>!?)\[(?P<text>(?:\\.|`[^`\n]*`|\[[^\[\]]*\]|[^\[\]\\])*)\]\((?P<target>[^()\s]*(?:\([^()\s]*\))?[^()\s]*)\)"
    r"|(?P<mark>[{}]|:(?=::))",
    re.DOTALL,
)
"""What is read differently, and code, which is left alone, in which nothing of it counts."""

HEADING = re.compile(r'(#{1,6}) +(?:<a id="([^"]+)"></a>)?(.*?)(?: +#+)?$')
BLOCK = re.compile(r"(?:[-*+]|\d{1,9}[.)]) |\||>|`{3}|~{3}")
"""The start of a list, a table, a quotation or a block of code."""

NESTED = re.compile(r"( {2,})(?=(?:[-*+]|\d{1,9}[.)]) )")
"""Spaces before a list item in another one: Python-Markdown wants four for each level."""

Linker = Callable[[str], str]
"""From the target of a link to that on the site; empty: there is none, and the link becomes its text."""


def convert(text: str, link: Linker, silent: frozenset[str] = frozenset()) -> str:
    """Return a page for Python-Markdown; sections whose headings have an id in `silent` are kept out of the search."""
    taken = set(re.findall(r'<a id="([^"]+)"></a>', text))
    lines: list[str] = []
    for is_code, block in _blocks(text):
        if is_code:
            lines += ["", *block] if lines and lines[-1].strip() else block
            continue
        for line in inline("\n".join(block), link).split("\n"):
            lines += _line(line, lines[-1] if lines else "", taken, silent)
    return "\n".join(lines)


def _blocks(text: str) -> Iterator[tuple[bool, list[str]]]:
    """Yield the lines of fenced code and those between, in turn."""
    block: list[str] = []
    fence = ""
    for line in text.split("\n"):
        found = FENCE.match(line)
        if not fence and found:
            yield False, block
            block, fence = [line], found[1]
        elif fence and line.strip().startswith(fence) and not line.strip().strip(fence[0]):
            yield True, [*block, line]
            block, fence = [], ""
        else:
            block.append(line)
    yield bool(fence), block


def inline(text: str, link: Linker) -> str:
    """Rewrite what stands in lines; code is left alone."""

    def token(found: re.Match[str]) -> str:
        if found["escaped"] or found["mark"]:
            return f"&#{ord(found['escaped'] or found['mark'])};"
        if found["code"]:
            return found["code"]
        words, target = TOKEN.sub(token, found["text"]), link(found["target"])
        return f"{found['image']}[{words}]({target})" if target else words

    return TOKEN.sub(token, text)


def _line(line: str, before: str, taken: set[str], silent: frozenset[str]) -> list[str]:
    if found := HEADING.match(line):
        marks, anchor, words = found.groups()
        anchor = anchor or _free(github_slug(words), taken)
        quiet = " data-search-exclude" if anchor in silent else ""
        return [f"{marks} {words.strip()} {{ #{anchor}{quiet} }}"]
    line = line.replace("<details>", '<details markdown="1">')
    starts, goes_on = BLOCK.match(line), BLOCK.match(before) or before.startswith(" ")
    apart = [""] if starts and before.strip() and not goes_on else []
    return [*apart, NESTED.sub(r"\1\1", line)]


def _free(slug: str, taken: set[str]) -> str:
    number, name = 0, slug
    while name in taken:
        number += 1
        name = f"{slug}-{number}"
    taken.add(name)
    return name


def github_slug(heading: str) -> str:
    """Return the anchor that GitHub gives a heading: links to it are written for that."""
    words = re.sub(r"!?\[([^\]]*)\]\([^)]*\)|<[^>]*>|&#?\w+;", r"\1", heading)
    return re.sub(r"[^\w\- ]", "", words.strip().lower()).replace(" ", "-") or "section"
