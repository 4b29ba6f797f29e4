"""Mappings and lists in lines: two columns a level, a list below its key, comments above what they stand before."""

from collections.abc import Sequence
from dataclasses import dataclass

from regscribe.map_format.flow import CLOSES, OPENS, flow_lines
from regscribe.map_format.lines import INDENT, WIDTH, with_comment
from regscribe.map_format.scalars import block_lines, scalar_lines
from regscribe.map_format.tokens import BLOCK_STYLES, Comment, Token

_MAPPING, _LIST = "BlockMappingStart", "BlockSequenceStart"


@dataclass(frozen=True, slots=True)
class Level:
    """An open collection: where its entries began and where they begin now; a `loose` list stands below its key."""

    kind: str
    source: int
    column: int
    loose: bool = False


class Printer:
    """Prints the tokens of one map, line by line."""

    def __init__(self, tokens: Sequence[Token]) -> None:
        self._tokens = tokens
        self._levels: list[Level] = []
        self._lines: list[str] = []
        self._line = ""
        self._begun = False
        self._after_dash = False
        self._first_stays = False
        self._explicit_key = False
        self._at = 0

    def text(self) -> str:
        """Return the whole text."""
        while self._at < len(self._tokens):
            token = self._tokens[self._at]
            self._before(token)
            self._print(token)
            self._at += 1
        self._end_line()
        return "\n".join([*self._lines, ""])

    def _print(self, token: Token) -> None:
        match token.kind:
            case "BlockMappingStart" | "BlockSequenceStart":
                self._open(token.kind, token.column)
            case "BlockEnd":
                self._close_loose()
                self._levels.pop()
            case "BlockEntry":
                self._dash(token)
            case "Key":
                self._key(token)
            case "Value":
                self._colon()
            case "DocumentStart" | "DocumentEnd":
                self._new_line(0)
                self._line = token.text
                self._end_line()
            case _ if token.text:
                self._value(token)

    @property
    def _column(self) -> int:
        """Where the entries of the innermost collection begin."""
        return self._levels[-1].column if self._levels else -INDENT

    def _open(self, kind: str, source: int, *, loose: bool = False) -> None:
        column = len(self._line) + 1 if self._after_dash else self._column + INDENT
        self._levels.append(Level(kind, source, column, loose))
        self._first_stays = self._after_dash

    def _opens_loose(self, kind: str) -> bool:
        return kind == "BlockEntry" and self._levels[-1].kind == _MAPPING

    def _close_loose(self) -> None:
        if self._levels[-1].loose:
            self._levels.pop()

    def _dash(self, token: Token) -> None:
        if self._opens_loose(token.kind):
            self._open(_LIST, token.column, loose=True)
        self._entry()
        self._put("-")
        self._after_dash = True

    def _key(self, token: Token) -> None:
        self._close_loose()
        self._entry()
        self._explicit_key = bool(token.text) and not self._is_simple_key()
        if self._explicit_key:
            self._put("?")

    def _is_simple_key(self) -> bool:
        """Whether `? key` can be written `key:`."""
        key, colon = self._tokens[self._at + 1 : self._at + 3]
        plain = key.kind == "Scalar" and key.style not in BLOCK_STYLES and "\n" not in key.text
        return plain and colon.kind == "Value" and not key.comments and not colon.comments

    def _entry(self) -> None:
        """Begin an entry: on a line of its own, unless it is the first one behind a dash."""
        if not self._first_stays:
            self._new_line(self._column)
        self._first_stays = self._after_dash = False

    def _colon(self) -> None:
        if self._explicit_key:
            self._new_line(self._column)
            self._put(":")
        else:
            self._line += " :" if self._tokens[self._at - 1].kind == "Alias" else ":"
        self._explicit_key = False

    def _value(self, token: Token) -> None:
        """Print a key or a value."""
        if token.kind in OPENS:
            self._flow(token)
        elif token.style in BLOCK_STYLES:
            source = self._levels[-1].source if self._levels else 0
            first, *others = block_lines(token, self._column, source)
            self._put(first)
            self._end_line()
            self._lines += others  # its last line may be of blanks alone
        elif token.kind == "Scalar":
            first, *others = scalar_lines(token, flow=False)
            if token.breaks and len(self._line) + 1 + len(first) > WIDTH:
                self._new_line(self._column + INDENT)
            self._put(first)
            self._more([f"{' ' * (self._column + INDENT)}{line}" if line else "" for line in others])
        else:
            self._put(token.text)

    def _flow(self, token: Token) -> None:
        depth, end = 0, self._at
        for end in range(self._at, len(self._tokens)):
            depth += (self._tokens[end].kind in OPENS) - (self._tokens[end].kind in CLOSES)
            if depth == 0:
                break
        inside = [Token(token.kind, token.text, "", "", 0), *self._tokens[self._at + 1 : end + 1]]
        if token.breaks and self._line.endswith(":"):
            self._new_line(self._column + INDENT)
        before = self._begin()
        first, *others = flow_lines(inside, before)
        self._line = first
        self._more(others)
        self._at = end

    def _put(self, text: str) -> None:
        self._line = f"{self._begin()}{text}"
        self._after_dash = False

    def _begin(self) -> str:
        """Return the line up to where a text can stand: behind what is there, or below it after a comment."""
        if not self._begun:
            self._new_line(self._column + INDENT)
        return f"{self._line} " if self._line.strip() else self._line

    def _more(self, lines: Sequence[str]) -> None:
        self._after_dash = False
        if lines:
            self._lines += [self._line, *lines[:-1]]
            self._line = lines[-1]

    def _new_line(self, column: int) -> None:
        self._end_line()
        self._line, self._begun = " " * column, True

    def _end_line(self) -> None:
        if self._line.strip():
            self._lines.append(self._line)
        self._line, self._begun = "", False
        self._after_dash = False

    def _before(self, token: Token) -> None:
        """Print the comments before a token and the empty line, at most one, where the text had some."""
        for comment in token.comments:
            if comment.breaks == 0 and self._line:
                self._line = with_comment(self._line, comment.text)
                self._end_line()
            else:
                self._end_line()
                self._space(comment.breaks)
                self._lines.append(f"{' ' * self._comment_column(comment)}{comment.text}")
        if token.breaks > 1 and self._starts_entry() and not self._after_dash:
            self._end_line()
            self._space(token.breaks)

    def _space(self, breaks: int) -> None:
        if breaks > 1 and self._lines and self._lines[-1]:
            self._lines.append("")

    def _coming(self) -> list[str]:
        """Kinds of the marks at this place and of the token behind them."""
        kinds = []
        for token in self._tokens[self._at :]:
            kinds.append(token.kind)
            if token.text:
                break
        return kinds

    def _starts_entry(self) -> bool:
        return bool({"Key", "BlockEntry"} & set(self._coming()))

    def _comment_column(self, comment: Comment) -> int:
        """Return the column of what comes next, or of an open collection that the comment stood in."""
        coming = self._coming()
        opens = {_MAPPING, _LIST} & set(coming) or self._opens_loose(coming[0])
        if opens or (not self._starts_entry() and "StreamEnd" not in coming):
            return self._column + INDENT
        kept = len(self._levels)
        for _ in range(coming.count("BlockEnd")):
            kept -= 1 + self._levels[kept - 1].loose
        kept -= coming[-1] != "BlockEntry" and "Key" in coming and self._levels[kept - 1].loose
        found = self._levels[kept - 1].column if kept else 0
        for level in self._levels[kept:]:
            if level.source + level.loose <= comment.column:
                found = level.column
        return found
