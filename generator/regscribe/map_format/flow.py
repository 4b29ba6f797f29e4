"""Collections in brackets: blanks as in prose, the author's line ends, rows aligned behind the outermost bracket."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from regscribe.map_format.lines import INDENT, WIDTH, with_comment
from regscribe.map_format.scalars import scalar_lines
from regscribe.map_format.tokens import Comment, Token

OPENS = {"FlowMappingStart", "FlowSequenceStart"}
CLOSES = {"FlowMappingEnd", "FlowSequenceEnd"}


@dataclass(slots=True)
class Chunk:
    """A stretch within which no line ends: an entry, as far as the next bracket or comma, or a comment of its own.

    `depth` counts the brackets that are open where it begins; a chunk that does not start a line may be made to.
    """

    text: str
    depth: int
    starts_line: bool = False
    space: bool = True
    continues: bool = False
    comment: str = ""


def flow_lines(tokens: Sequence[Token], before: str) -> list[str]:
    """Return the lines of a collection; `before` stands on the first one already."""
    cut = _Cutter()
    for token, following in zip(tokens, [*tokens[1:], tokens[-1]], strict=True):
        cut.take(token, following)
    base = len(before)
    lines: list[str] = []
    for row in _rows(cut.chunks):
        for part in _fitting(row, base, first=not lines):
            margin = " " * _column(part[0], base) if lines else before
            text, comment = _text(part), part[-1].comment
            lines.append(with_comment(f"{margin}{text}", comment) if text else f"{margin}{comment}".rstrip(" "))
    return lines


def _column(chunk: Chunk, base: int) -> int:
    return base + 1 + INDENT * (max(chunk.depth, 1) - 1 + chunk.continues)


def _text(chunks: Sequence[Chunk]) -> str:
    return "".join(f" {chunk.text}" if chunk.space and place else chunk.text for place, chunk in enumerate(chunks))


def _rows(chunks: Sequence[Chunk]) -> Iterator[list[Chunk]]:
    """Part the chunks at the line ends that stay."""
    row: list[Chunk] = []
    for chunk in chunks:
        if chunk.starts_line and row:
            yield row
            row = []
        row.append(chunk)
    yield row


def _fitting(row: list[Chunk], base: int, *, first: bool) -> Iterator[list[Chunk]]:
    """Part a row that is too wide, where as few brackets as possible are open, and there as late as possible."""
    start, end = 0, base if first else _column(row[0], base)
    places: list[int] = []
    for place, chunk in enumerate(row):
        end += len(chunk.text) + (chunk.space and place > start)
        while end > WIDTH and places:
            cut = min(places, key=lambda one: (row[one].depth, -one))
            yield row[start:cut]
            start, places = cut, [one for one in places if one > cut]
            end = _column(row[start], base) + len(_text(row[start : place + 1]))
        places.append(place + 1)
    yield row[start:]


class _Cutter:
    """Cuts the tokens of one collection into chunks."""

    def __init__(self) -> None:
        self.chunks = [Chunk("", 0)]
        self._depth = 0
        self._next: Chunk | None = None
        self._after_comment = False
        self._breaks = False
        self._previous = ""

    def take(self, token: Token, following: Token) -> None:
        """Add a token; what follows it tells whether a bracket is empty and a comma needless."""
        for comment in token.comments:
            self._comment(comment)
        self._breaks = self._breaks or token.breaks > 0
        if token.kind in OPENS:
            self._put(token.text)
            self._depth += 1
            if self._depth > 1 and following.kind not in CLOSES:
                self._next = Chunk("", self._depth, space=False)
        elif token.kind in CLOSES:
            self._glue(f" {token.text}" if self._previous == "Value" else token.text)
            self._depth -= 1
        elif token.kind == "FlowEntry":
            self._comma(following)
        elif token.kind == "Value":
            self._glue(" :" if self._previous == "Alias" else ":")
        elif token.kind == "Scalar":
            self._scalar(token)
        elif token.text:
            self._put(token.text)
        if token.text and not (token.kind == "FlowEntry" and following.kind in CLOSES):
            self._previous = token.kind

    @property
    def _written(self) -> Chunk:
        """The last chunk that is no comment."""
        return next(chunk for chunk in reversed(self.chunks) if chunk.text)

    def _comment(self, comment: Comment) -> None:
        if comment.breaks == 0 and not self.chunks[-1].comment:
            self.chunks[-1].comment = comment.text
        else:
            self.chunks.append(Chunk("", self._depth, starts_line=True, comment=comment.text))
        self._after_comment = True

    def _comma(self, following: Token) -> None:
        """Put a comma behind what stands before it, and before a comment; none before a closing bracket."""
        if following.kind not in CLOSES:
            self._written.text += " ," if self._previous == "Value" else ","
            self._next = Chunk("", self._depth, starts_line=self._breaks)

    def _glue(self, text: str) -> None:
        if self._after_comment:
            self._put(text)
        else:
            self._written.text += text

    def _scalar(self, token: Token) -> None:
        first, *others = scalar_lines(token, flow=True)
        self._put(first)
        self.chunks += [Chunk(line, self._depth, starts_line=True, continues=True) for line in others]

    def _put(self, text: str) -> None:
        """Add a text: as a chunk if one was announced or a comment came before it, else to the last one."""
        if self._next is None and not self._after_comment:
            last = self.chunks[-1]
            last.text += text if last.text[-1:] in {"", "{", "["} else f" {text}"
            self._breaks = False
            return
        new = self._next or Chunk("", self._depth)
        new.text = text
        new.starts_line = new.starts_line or self._breaks or self._after_comment
        self.chunks.append(new)
        self._next, self._after_comment, self._breaks = None, False, False
