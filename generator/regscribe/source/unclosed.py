"""Brackets and quotes that are not closed where their block goes on: the YAML parser blames what stands behind them."""

from typing import NamedTuple

import yaml
from yaml import tokens

from regscribe.source.document import SourcePlace

_LOADER = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
_ENDS = {"{": "}", "[": "]"}
_OPENED = (tokens.FlowMappingStartToken, tokens.FlowSequenceStartToken)
_CLOSED = (tokens.FlowMappingEndToken, tokens.FlowSequenceEndToken)
_BLOCKS = (tokens.BlockMappingStartToken, tokens.BlockSequenceStartToken)


class Unclosed(NamedTuple):
    """What is wrong, where, and what to do."""

    message: str
    place: SourcePlace
    advice: str


def find_unclosed(text: str) -> Unclosed | None:
    """The first bracket or quote of a text that is no YAML that ends wrongly, if there is one."""
    reader = _Reader(text)
    try:
        for token in yaml.scan(text, Loader=_LOADER):
            if found := reader.take(token):
                return found
    except yaml.YAMLError:  # of which the parser tells as well as can be
        pass
    return None


class _Reader:
    """Follows the tokens: the columns of the blocks and the brackets that are open, and where the last token ended."""

    def __init__(self, text: str) -> None:
        self.lines = text.split("\n")
        self.blocks: list[int] = []
        self.open: list[SourcePlace] = []
        self.line = 0

    def take(self, token: tokens.Token) -> Unclosed | None:
        """What is wrong in front of a token, or with it."""
        start, end = token.start_mark, token.end_mark
        place = SourcePlace(start.line, start.column, end.line, end.column)
        quoted = isinstance(token, tokens.ScalarToken) and token.style in {'"', "'"}
        if quoted and (gone_on := self._gone_on(start.line + 1, end.line)):
            return self._unclosed([place], gone_on)
        if self.open and (gone_on := self._gone_on(self.line + 1, end.line)):
            return self._unclosed(self.open, gone_on)
        if self.open and isinstance(token, tokens.StreamEndToken):
            return self._unclosed(self.open, len(self.lines))
        self.line = end.line
        if isinstance(token, _OPENED):
            self.open.append(place)
        elif isinstance(token, _CLOSED):
            return self._closed(place)
        elif isinstance(token, _BLOCKS):
            self.blocks.append(start.column)
        elif isinstance(token, tokens.BlockEndToken):
            self.blocks.pop()
        return None

    def _gone_on(self, first: int, last: int) -> int | None:
        """The first of these lines in which the block around goes on: it starts no deeper, and with no bracket."""
        floor = self.blocks[-1] if self.blocks else -1
        for number in range(first, min(last + 1, len(self.lines))):
            line = self.lines[number]
            inner = line.lstrip(" ")
            if inner and inner[0] not in "#]}" and len(line) - len(inner) <= floor:
                return number
        return None

    def _unclosed(self, opened: list[SourcePlace], before: int) -> Unclosed:
        """Say that the last of what was opened is not closed in front of a line, or of the end."""
        signs = [self.lines[place.line][place.column] for place in opened]
        closing = "".join(_ENDS.get(sign, sign) for sign in reversed(signs))
        last = next(number for number in range(before - 1, -1, -1) if self.lines[number].strip())
        behind = f"line {before + 1}" if before < len(self.lines) else "the end"
        said = f"the `{signs[-1]}` of {_named(opened[-1])} is not closed before {behind}"
        return Unclosed(said, _mark(opened[-1]), f"write `{closing}` at the end of line {last + 1}")

    def _closed(self, place: SourcePlace) -> Unclosed | None:
        sign = self.lines[place.line][place.column]
        if not self.open:
            return Unclosed(f"a `{sign}` that closes nothing", _mark(place), "delete it")
        opened = self.open.pop()
        wanted = _ENDS[self.lines[opened.line][opened.column]]
        if wanted == sign:
            return None
        said = f"the `{self.lines[opened.line][opened.column]}` of {_named(opened)} is not closed before the `{sign}`"
        said = f"{said} of {_named(place)}"
        return Unclosed(said, _mark(opened), f"write `{wanted}` before the `{sign}`, or in its place")


def _named(place: SourcePlace) -> str:
    return f"line {place.line + 1}, column {place.column + 1}"


def _mark(place: SourcePlace) -> SourcePlace:
    return SourcePlace(place.line, place.column, place.line, place.column + 1)
