"""The difference between a file as it is and as it would be, as a unified diff."""

import re
from difflib import unified_diff

MOST_LINES = 20_000
"""Longer files are told apart but not compared line by line: that would take minutes."""


def unified(path: str, old: bytes | None, new: bytes | None) -> str:
    """Return the unified diff from `old` to `new`; None stands for a file that does not exist."""
    before, after = _lines(old), _lines(new)
    names = "/dev/null" if old is None else f"a/{path}", "/dev/null" if new is None else f"b/{path}"
    if max(len(before), len(after)) > MOST_LINES:
        return f"--- {names[0]}\n+++ {names[1]}\n@@ {len(before)} lines become {len(after)}; too long to compare @@\n"
    return "".join(_ended(line) for line in unified_diff(before, after, *names))


def _lines(content: bytes | None) -> list[str]:
    """Split at line feeds alone: `str.splitlines` would split at form feeds and U+2028, too."""
    return re.findall(r"[^\n]*\n|[^\n]+", (content or b"").decode(errors="backslashreplace"))


def _ended(line: str) -> str:
    return line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n"
