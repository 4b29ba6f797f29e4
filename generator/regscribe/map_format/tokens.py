"""The tokens of a map's text, each with the comments and line ends that stand before it."""

import re
from dataclasses import dataclass, replace

import yaml

_LOADER = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
BLOCK_STYLES = {"|", ">"}
_COMMENT_OR_BREAK = re.compile(r"#[^\n]*|\n")
_KEEPS_ALL = re.compile(r"[|>][1-9]?\+")


@dataclass(frozen=True, slots=True)
class Comment:
    """A comment from its `#` on; `breaks` line ends stand before it, so that with none it ends a line of the map."""

    text: str
    column: int
    breaks: int


@dataclass(frozen=True, slots=True)
class Token:
    """One token in PyYAML's words, without `Token` at the end (`FlowEntry`); `text` as in the file, empty for marks.

    `comments` and `breaks`, the line ends behind the last of them, stand before it and the marks before it.
    """

    kind: str
    text: str
    value: str
    style: str
    column: int
    comments: tuple[Comment, ...] = ()
    breaks: int = 0


def tokens_of(text: str) -> list[Token]:
    """Return the tokens of a text that the reader accepts; of marks and the token behind them the first has the gap."""
    found: list[Token] = []
    end, first = 0, 0
    for token in yaml.scan(text, Loader=_LOADER):
        start = token.start_mark.index
        own = text[start : token.end_mark.index]
        style = getattr(token, "style", None) or ""
        if style in BLOCK_STYLES:
            own = _without_empty_end(own)
        kind = type(token).__name__.removesuffix("Token")
        found.append(Token(kind, own, str(getattr(token, "value", "")), style, token.start_mark.column))
        if own or kind == "StreamEnd":
            comments, breaks = _gap(text, end, start)
            found[first] = replace(found[first], comments=comments, breaks=breaks)
            end, first = start + len(own), len(found)
    return found


def _without_empty_end(block: str) -> str:
    """Drop the line ends behind a block that are none of its text; lines of more blanks than its margin are text."""
    lines = block.split("\n")
    margin = next((len(line) - len(line.lstrip(" ")) for line in lines[1:] if line.strip(" ")), 0)
    while len(lines) > 1 and not lines[-1].strip(" ") and len(lines[-1]) <= margin:
        lines.pop()
        if _KEEPS_ALL.match(block):
            break  # its empty lines count; that was the end of its last one
    return "\n".join(lines)


def comments_of(text: str) -> list[str]:
    """Return the comments of a text, sorted: what formatting must not lose."""
    tokens = tokens_of(text)
    found = [comment.text for token in tokens for comment in token.comments]
    heads = [token.text.partition("\n")[0] for token in tokens if token.style in BLOCK_STYLES]
    return sorted(found + [head[head.index("#") :].rstrip() for head in heads if "#" in head])


def _gap(text: str, start: int, end: int) -> tuple[tuple[Comment, ...], int]:
    comments: list[Comment] = []
    breaks = 0
    for match in _COMMENT_OR_BREAK.finditer(text, start, end):
        if match[0] == "\n":
            breaks += 1
            continue
        column = match.start() - (text.rfind("\n", 0, match.start()) + 1)
        comments.append(Comment(match[0].rstrip(" \t"), column, breaks))
        breaks = 0
    return tuple(comments), breaks
