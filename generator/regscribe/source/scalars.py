"""YAML 1.2 core scalars, as strict as a map needs: exact numbers, `true`/`false`/`null` only, nothing ambiguous."""

import re
from decimal import Decimal

MAX_NUMBER_LENGTH = 100
MAX_EXPONENT = 400

_WORDS: dict[str, bool | None] = {"": None, "~": None, "null": None, "true": True, "false": False}
_NUMERIC_START = frozenset("0123456789+-.")
_NUMBER = re.compile(
    r"(?P<integer>[-+]?(?:0|[1-9][0-9]*)|0o[0-7]+|0x[0-9a-fA-F]+)\Z"
    r"|[-+]?(?:\.[0-9]+|(?:0|[1-9][0-9]*)(?:\.[0-9]*)?)(?:[eE](?P<exponent>[-+]?[0-9]+))?\Z"
)
_REFUSED = (
    (re.compile(r"[-+]?0[0-9]+(\.[0-9]*)?([eE][-+]?[0-9]+)?\Z"), "starts with 0 (octal to some readers)"),
    (re.compile(r"[-+]?[0-9][0-9_]*_[0-9_]*(\.[0-9_]*)?\Z"), "has a `_` between its digits"),
    (re.compile(r"[-+]?0[xXoObB][0-9a-fA-F_]+\Z"), "is in a notation that YAML 1.2 does not have"),
    (re.compile(r"[-+]?\.(inf|Inf|INF)\Z|\.(nan|NaN|NAN)\Z"), "is no finite number"),
)
NUMBER_HELP = "write a plain decimal number, 0x.. or 0o..; if a text is meant, put it in quotes"


class NumberFormError(ValueError):
    """A plain scalar that some readers take for a number and others do not; the message says why."""


def resolve(text: str) -> bool | int | Decimal | str | None:
    """Return the value of a plain scalar; raises NumberFormError for a number that readers take differently."""
    if text in _WORDS:
        return _WORDS[text]
    if text[0] not in _NUMERIC_START:
        return text
    number = _NUMBER.match(text)
    if number is None:
        for pattern, reason in _REFUSED:
            if pattern.match(text):
                message = f"the number `{shorten(text)}` {reason}"
                raise NumberFormError(message)
        return text
    if len(text) > MAX_NUMBER_LENGTH:
        message = f"a number of {len(text)} characters, at most {MAX_NUMBER_LENGTH} are read"
        raise NumberFormError(message)
    if abs(int(number["exponent"] or 0)) > MAX_EXPONENT:
        message = f"the exponent {int(number['exponent'])} is beyond ±{MAX_EXPONENT}"
        raise NumberFormError(message)
    return int(text, 0) if number["integer"] else Decimal(text)


def shorten(text: str, limit: int = 40) -> str:
    """`text` on one line, cut to `limit` characters, for use inside a message."""
    line = "".join(character if character.isprintable() else " " for character in text[: limit + 1])
    return line if len(line) <= limit else line[: limit - 1] + "…"
