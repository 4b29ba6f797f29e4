"""Positions of the protocol, which count in UTF-16 (or as the client asks for), and places, which count characters."""

from collections.abc import Sequence

from lsprotocol.types import Position, PositionEncodingKind, Range

from regscribe.model import Span
from regscribe.source import SourcePlace

_ENCODINGS = {PositionEncodingKind.Utf8: ("utf-8", 1), PositionEncodingKind.Utf32: ("utf-32-le", 4)}


class Positions:
    """Translates between the two for one client."""

    def __init__(self, encoding: PositionEncodingKind | str | None = PositionEncodingKind.Utf16) -> None:
        self._encoding, self._size = _ENCODINGS.get(PositionEncodingKind(encoding or "utf-16"), ("utf-16-le", 2))

    def units(self, text: str) -> int:
        """How many units of the client a text has."""
        return len(text.encode(self._encoding, "surrogatepass")) // self._size

    def column(self, line: str, units: int) -> int:
        """The character at which so many units end; the end of the line if it has fewer."""
        for column, character in enumerate(line):
            if units <= 0:
                return column
            units -= self.units(character)
        return len(line)

    def cursor(self, lines: Sequence[str], position: Position) -> tuple[int, int]:
        """Line and character of a position."""
        line = lines[position.line] if position.line < len(lines) else ""
        return position.line, self.column(line, position.character)

    def position(self, lines: Sequence[str], line: int, column: int) -> Position:
        """The position of a character; one behind the text is its end."""
        if line >= len(lines):
            line, column = len(lines) - 1, len(lines[-1])
        return Position(line, self.units(lines[line][:column]))

    def range(self, lines: Sequence[str], place: SourcePlace) -> Range:
        """The range of a place."""
        return Range(
            self.position(lines, place.line, place.column), self.position(lines, place.end_line, place.end_column)
        )


def place_of(span: Span) -> SourcePlace:
    """A span of a diagnostic, which counts from 1, as a place."""
    return SourcePlace(span.line - 1, span.column - 1, span.end_line - 1, span.end_column - 1)
