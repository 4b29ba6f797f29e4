"""A position that moves through a text line by line, and the forms of keys, marks and comments."""

import re

from regscribe.source import SourcePlace

_PLAIN = r"(?:[^\s\-?:,\[\]{}#&*!|>'\"%@`]|[-?:](?=[^\s]))(?:[^:#\n]|:(?=\S)|(?<=\S)#)*?"
_QUOTED = r"\"(?:[^\"\\]|\\.)*\"|'(?:[^']|'')*'"
KEY = re.compile(rf"({_QUOTED}|{_PLAIN})[ \t]*:(?=\s|$)")
"""A key of a mapping in block style, with its colon."""

DASH = re.compile(r"-(?=\s|$)[ \t]*")
PROPERTY = re.compile(r"[&!]([^\s,\[\]{}]*)[ \t]*")
BLOCK_TEXT = re.compile(r"[|>][-+0-9]*[ \t]*(?:#.*)?$")
_BLANKS = re.compile(r"[ \t]*(?:(?<![^\s])#.*)?")


class Characters:
    """The lines of a text, and a position in them: `line` and `column` count from 0."""

    def __init__(self, text: str) -> None:
        self.lines = text.split("\n")
        self.line = self.column = 0

    @property
    def ended(self) -> bool:
        """Whether the text is read to its end."""
        return self.line >= len(self.lines)

    @property
    def rest(self) -> str:
        """What is left of the line."""
        return "" if self.ended else self.lines[self.line][self.column :]

    def match(self, pattern: re.Pattern[str]) -> re.Match[str] | None:
        """What stands here, if it is of this form."""
        return None if self.ended else pattern.match(self.lines[self.line], self.column)

    def take(self, pattern: re.Pattern[str]) -> re.Match[str] | None:
        """What stands here, if it is of this form; the position moves behind it."""
        found = self.match(pattern)
        if found:
            self.column = found.end()
        return found

    def next_line(self) -> None:
        """Go to the start of the next line."""
        self.line, self.column = self.line + 1, 0

    def skip(self) -> None:
        """Go to the next character that is neither blank nor in a comment, perhaps on another line."""
        while not self.ended:
            self.take(_BLANKS)
            if self.rest:
                return
            self.next_line()

    def skip_blanks(self) -> None:
        """Go to the next character of the line that is neither blank nor in a comment, or to its end."""
        self.take(_BLANKS)

    def place(self, line: int, column: int) -> SourcePlace:
        """From a position up to this one."""
        return SourcePlace(line, column, self.line, self.column)
