"""The measures of a map's lines."""

WIDTH = 160
"""A row in brackets that is wider gets a line end behind a comma."""

INDENT = 2
"""Columns from a key to what stands below it."""

COMMENT_COLUMN = 55
"""Where a comment behind a line begins, counted from 0, if the line is not longer."""


def with_comment(line: str, comment: str) -> str:
    """Return the line with a comment at its end, if there is one."""
    return f"{line:<{COMMENT_COLUMN - 2}}  {comment}" if comment else line
