"""TOML as a tree; the reader of Python tells no lines, so these are found again by the texts."""

import re
import tomllib
from typing import Any

from regscribe.importers.shared.tree import Builder, Node, TreeError


class _Number(str):
    """A number as it is written."""

    __slots__ = ()


def read_toml(text: str) -> tuple[Node, list[tuple[int, str]]]:
    """Return the document. Raises TreeError."""
    try:
        data = tomllib.loads(text, parse_float=_Number)
    except tomllib.TOMLDecodeError as error:
        found = re.search(r"line (\d+)", str(error))
        raise TreeError(int(found[1]) if found else 1, f"no TOML: {error}") from None
    except RecursionError:
        raise TreeError(1, "values are nested too deep", "no such configuration is") from None
    return _Walker(text).tree(data), []


class _Walker:
    """Walks the data in the order of the text, and looks for each key behind the one before."""

    def __init__(self, text: str) -> None:
        self.text, self.at, self.line = text, 0, 1

    def tree(self, data: dict[str, Any]) -> Node:
        builder = Builder()
        self._put(data, builder)
        assert builder.root is not None  # noqa: S101 - a document of TOML is a table
        return builder.root

    def _put(self, value: Any, builder: Builder) -> None:  # noqa: ANN401 - plain values
        if isinstance(value, dict):
            for key, inner in list(value.items())[:1]:
                self._find(key, inner)  # a table begins where its first key stands
            builder.start(self.line, mapping=True)
            for key, inner in value.items():
                self._find(key, inner)
                builder.key(key, self.line)
                self._put(inner, builder)
            builder.end()
        elif isinstance(value, list):
            builder.start(self.line, mapping=False)
            for inner in value:
                self._put(inner, builder)
            builder.end()
        else:
            quoted = isinstance(value, str) and not isinstance(value, _Number)
            text = str(value).lower() if isinstance(value, bool) else str(value)
            builder.scalar(text, self.line, quoted=quoted)

    def _find(self, key: str, value: Any) -> None:  # noqa: ANN401 - as above
        """Go on to the next place of a key, with its value where that is a text."""
        told = re.escape(value) if isinstance(value, str) and not isinstance(value, _Number) else ""
        pattern = rf"""(?<![\w-])["']?{re.escape(key)}["']?\s*(?:=\s*["']{told}|=|\.|\])"""
        pattern = pattern if not told else rf"""(?<![\w-])["']?{re.escape(key)}["']?\s*=\s*["']+{told}"""
        found = re.compile(pattern).search(self.text, self.at)
        if found:
            self.line += self.text.count("\n", self.at, found.start())
            self.at = found.start()
