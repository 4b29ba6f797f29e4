"""Bytes to text: UTF-8 with visible characters only, one kind of line end, blanks for indentation."""

import codecs
import re

from regscribe.source.document import START, SourcePlace
from regscribe.source.findings import Findings
from regscribe.source.rules import CONTROL_CHARACTER, DIRECTIVE, NOT_UTF8, TAB

# Line separators other than \n count too: YAML 1.1 and 1.2 disagree whether they end a line.
_INVISIBLE = re.compile(
    "[\\x00-\\x08\\x0b-\\x1f\\x7f-\\x9f\\u2028\\u2029\\u202a-\\u202e\\u2066-\\u2069\\ud800-\\udfff\\ufeff\\ufffe\\uffff]"
)
_TAB_INDENT = re.compile(r"^ *(\t)", re.MULTILINE)
_DIRECTIVE = re.compile(r"\A(?: *(?:#.*)?\n)*+(%)")
# The longer marks first: that of UTF-32 starts like that of UTF-16.
_MARKS = (
    (codecs.BOM_UTF32_LE, "UTF-32"),
    (codecs.BOM_UTF32_BE, "UTF-32"),
    (codecs.BOM_UTF16_LE, "UTF-16"),
    (codecs.BOM_UTF16_BE, "UTF-16"),
)


def decode(data: bytes, findings: Findings) -> str:
    """Return the text of a file; raises StopReadingError, with the reason among the findings, if it is not UTF-8."""
    encoding = next((name for mark, name in _MARKS if data.startswith(mark)), "")
    if not encoding and b"\0" in data[:4]:
        encoding = "UTF-16 or UTF-32"
    if encoding:
        message = f"the file is {encoding}; maps are UTF-8"
        raise findings.stop(NOT_UTF8, message, START, advice="save it as UTF-8 (in most editors: save with encoding)")
    try:
        return normalise(data.decode("utf-8-sig"))
    except UnicodeDecodeError as error:
        before = normalise(data[: error.start].decode("utf-8-sig"))
        message = f"byte 0x{data[error.start]:02X} at offset {error.start} is not UTF-8"
        advice = "save the file as UTF-8; old editors write °C or µ in Latin-1 or Windows-1252"
        raise findings.stop(NOT_UTF8, message, place_at(before, len(before)), advice=advice) from None


def normalise(text: str) -> str:
    """Make the line feed the only line end and drop a byte order mark."""
    return text.removeprefix("\ufeff").replace("\r\n", "\n").replace("\r", "\n")


def check_characters(text: str, findings: Findings) -> None:
    """Refuse invisible characters, tabs and directives; raises StopReadingError where the structure depends on them."""
    for match in _INVISIBLE.finditer(text):
        message = f"{describe(match[0])} in the text"
        findings.add(CONTROL_CHARACTER, message, place_at(text, match.start()), advice="delete it; it cannot be seen")
    tabs = [match.start(1) for match in _TAB_INDENT.finditer(text)]
    if tabs:
        message = f"a tab in the indentation ({len(tabs)} line{'s' if len(tabs) > 1 else ''} of the file)"
        raise findings.stop(TAB, message, place_at(text, tabs[0]), advice="indent with blanks, two for each level")
    directive = _DIRECTIVE.match(text)
    if directive:
        advice = "delete the line; a map is always read as YAML 1.2"
        raise findings.stop(DIRECTIVE, "a YAML directive", place_at(text, directive.start(1)), advice=advice)


def find_invisible(text: str) -> str | None:
    """Name the first invisible character of a value (an escape can hide one); None if it has none."""
    match = _INVISIBLE.search(text)
    return describe(match[0]) if match else None


def describe(character: str) -> str:
    """Name an invisible character."""
    direction = "\u202a" <= character <= "\u202e" or "\u2066" <= character <= "\u2069"
    return f"{'direction mark' if direction else 'control character'} U+{ord(character):04X}"


def place_at(text: str, index: int) -> SourcePlace:
    """Return the place of one character."""
    line = text.count("\n", 0, index)
    column = index - (text.rfind("\n", 0, index) + 1)
    return SourcePlace(line, column, line, column + 1)
