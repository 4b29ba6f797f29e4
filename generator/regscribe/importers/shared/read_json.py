"""JSON as a tree with lines; comments `//` and `/* */` and commas at the end of a list are taken, as others do."""

import json
import re

from regscribe.importers.shared.tree import Builder, Node, TreeError

TOKEN = re.compile(
    r"""(?P<skip>[\s\ufeff]+|//[^\n]*|/\*.*?\*/)|(?P<string>"(?:[^"\\\x00-\x1f]|\\.)*")"""
    r"""|(?P<mark>[{}\[\]:,])|(?P<word>[-+.\w]+)""",
    re.DOTALL,
)
WORD = re.compile(r"-?(?:0|[1-9]\d*)(?:\.\d+)?(?:[eE][-+]?\d+)?|true|false|null")
OPENING = {"{": "}", "[": "]"}


def read_json(text: str) -> tuple[Node, list[tuple[int, str]]]:
    """Return the document, and keys that stand twice with their lines. Raises TreeError."""
    return _Reader(text).read()


class _Reader:
    """Takes one token after the other; `before` is the last one, which says what may follow."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.builder = Builder()
        self.closing: list[str] = []
        self.before = ""
        self.line = 1

    def read(self) -> tuple[Node, list[tuple[int, str]]]:
        position = 0
        while position < len(self.text):
            token = TOKEN.match(self.text, position)
            if token is None:
                raise TreeError(self.line, f"no JSON: unexpected {self.text[position : position + 20]!r}")
            if token.lastgroup != "skip":
                self._take(token)
            self.line += token[0].count("\n")
            position = token.end()
        if self.builder.root is None or self.closing:
            raise TreeError(self.line, "no JSON: it ends before it is complete")
        return self.builder.root, self.builder.doubled

    def _take(self, token: re.Match[str]) -> None:
        if token.lastgroup == "mark":
            self._mark(token[0])
        else:
            self._value(token)
        self.before = token[0] if token.lastgroup == "mark" else "value"

    def _mark(self, mark: str) -> None:
        if mark in OPENING:
            self._expect_value()
            self.builder.start(self.line, mapping=mark == "{")
            self.closing.append(OPENING[mark])
        elif mark in OPENING.values():
            if not self.closing or self.closing.pop() != mark or self.before == ":":
                raise TreeError(self.line, f"no JSON: `{mark}` closes nothing")
            self.builder.end()
        elif self.before in {"", ",", ":", "{", "["}:
            raise TreeError(self.line, f"no JSON: `{mark}` stands where a value is expected")

    def _value(self, token: re.Match[str]) -> None:
        quoted = token.lastgroup == "string"
        text = self._unescaped(token[0]) if quoted else token[0]
        if self.builder.awaits_key and self.before in {"{", ","}:
            if not quoted:
                raise TreeError(self.line, f"no JSON: the key {text!r} has no quotes")
            self.builder.key(text, self.line)
            return
        self._expect_value()
        if not quoted and not WORD.fullmatch(text):
            raise TreeError(self.line, f"no JSON: {text[:40]!r} is no value")
        self.builder.scalar(text, self.line, quoted=quoted)

    def _expect_value(self) -> None:
        """Refuse a value that stands beside another, or a mapping's value without a colon."""
        of_mapping = bool(self.closing) and self.closing[-1] == "}"
        allowed = {":"} if of_mapping else {"", "[", ","}
        if self.before not in allowed or (not self.closing and self.builder.root is not None):
            raise TreeError(self.line, "no JSON: two values beside each other, or a comma or colon too few")

    def _unescaped(self, token: str) -> str:
        try:
            return str(json.loads(token, strict=False))
        except ValueError:
            raise TreeError(self.line, f"no JSON: the text {token[:40]} has an escape that is none") from None
