"""Errors of the YAML parser as messages for people who write maps."""

import yaml

from regscribe.source.document import START, SourcePlace
from regscribe.source.findings import Findings, StopReadingError
from regscribe.source.rules import SYNTAX
from regscribe.source.unclosed import find_unclosed
from regscribe.source.utf8 import place_at

# (a part of the parser's message, our message, our advice)
_KNOWN = (
    (
        "mapping values are not allowed",
        "a `: ` where no key can stand",
        "put a text that contains `: ` in quotes, or mend the indentation",
    ),
    ("could not find expected ':'", "a key without `:`", "write `key: value`, or indent a text that continues"),
    (
        "did not find expected key",
        "no key where one must stand",
        "indent all keys of a mapping alike; quote a text that starts with a quote, `[` or `{`",
    ),
    ("did not find expected ',' or ']'", "a list is not closed", "write `,` between the elements and `]` at the end"),
    ("did not find expected ',' or '}'", "a mapping is not closed", "write `,` between the keys and `}` at the end"),
    (
        "did not find expected '-' indicator",
        "no `- ` where the next element of the list must stand",
        "indent all elements of a list alike",
    ),
    ("found unexpected end of stream", "a quote is not closed", "write the closing quote"),
    (
        "found character that cannot start any token",
        "a text cannot start with this character",
        "put the text in quotes",
    ),
    ("found unknown escape character", "an unknown escape after `\\`", "use single quotes; in them `\\` is itself"),
    (
        "block sequence entries are not allowed",
        "a `- ` where no list can stand",
        "start the list on a line of its own",
    ),
    ("did not find expected alphabetic", "an anchor (`&`) or alias (`*`) without a name", "put the text in quotes"),
    ("did not find expected node content", "a value is missing", "write the value, or delete the `,`"),
)
# Noticed at the end of the file or of the line: the place to mend is where the thing starts.
_BLAMED_ON_START = ("end of stream", "could not find expected ':'")
_SEPARATOR = "did not find expected ','"
_NO_COMMA = "a `,` is missing before this"
_COMMA = "write `,` in front of it; a text that contains a quote, `: ` or a bracket needs quotes around it"
_ELSEWHERE = "check indentation, quotes and brackets around here"


def explain(error: yaml.YAMLError, text: str, findings: Findings) -> StopReadingError:
    """Add the parser's `error` in `text` to the findings; the caller raises what this returns."""
    if not isinstance(error, yaml.MarkedYAMLError):
        return findings.stop(SYNTAX, "the file is not YAML", START, advice=_ELSEWHERE)
    if unclosed := find_unclosed(text):
        return findings.stop(SYNTAX, unclosed.message, unclosed.place, advice=unclosed.advice)
    problem = error.problem or "not well-formed"
    _, message, advice = next(filter(lambda row: row[0] in problem, _KNOWN), ("", problem, _ELSEWHERE))
    place, start = _place(error.problem_mark), _place(error.context_mark)
    rest = text.rstrip()
    last = place_at(rest, max(0, len(rest) - 1))  # libyaml counts a line more than a text has that ends without one
    beyond = place.line > last.line
    if beyond:
        place, start = last, min(start, last)
    if _SEPARATOR in problem and not beyond:
        message, place, advice = _without_comma(text, place)
        start = place
    if not error.context_mark or start == place:
        return findings.stop(SYNTAX, message, place, advice=advice)
    if beyond or any(map(problem.__contains__, _BLAMED_ON_START)):
        return findings.stop(SYNTAX, message, start, advice=advice)
    related = ((error.context or "in what starts here", start),)
    return findings.stop(SYNTAX, message, place, advice=advice, related=related)


def _without_comma(text: str, place: SourcePlace) -> tuple[str, SourcePlace, str]:
    """Say what is wrong where a comma must stand: of a `:` it is missing before its key, if that starts no value."""
    line = text.split("\n")[place.line]
    before = line[: place.column].rstrip()
    if line[place.column : place.column + 1] != ":" or not before:
        return _NO_COMMA, place, _COMMA
    column = len(before) - len(before.split()[-1])
    if before[:column].rstrip().endswith((":", "{", "[", ",")):
        _, message, advice = _KNOWN[0]
        return message, place, advice
    return _NO_COMMA, SourcePlace(place.line, column, place.line, len(before)), _COMMA


def _place(mark: "yaml.Mark | None") -> SourcePlace:
    return SourcePlace(mark.line, mark.column, mark.line, mark.column + 1) if mark else START
