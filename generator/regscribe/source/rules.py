"""Rules of a file before its meaning is looked at: readable, UTF-8, YAML 1.2 in one sense only."""

from regscribe.model import Rule

UNREADABLE = "RS0101"
TOO_LARGE = "RS0102"
NOT_UTF8 = "RS0103"
CONTROL_CHARACTER = "RS0104"
SYNTAX = "RS0105"
TAB = "RS0106"
EMPTY = "RS0107"
SEVERAL_DOCUMENTS = "RS0108"
DUPLICATE_KEY = "RS0109"
KEY_NOT_TEXT = "RS0110"
TAG = "RS0111"
MERGE_KEY = "RS0112"
TOO_MANY_VALUES = "RS0113"
BAD_ALIAS = "RS0114"
TOO_DEEP = "RS0115"
NUMBER_FORM = "RS0116"
TEXT_TOO_LONG = "RS0117"
DIRECTIVE = "RS0118"
TOO_MANY_FINDINGS = "RS0119"

RULES: tuple[Rule, ...] = (
    Rule(UNREADABLE, "The map cannot be read", "Nothing can be said about a file that does not open."),
    Rule(
        TOO_LARGE, "The file is too large", "A map is text that people review; a file of many megabytes is a mistake."
    ),
    Rule(NOT_UTF8, "The file is not UTF-8", "In any other encoding a degree sign or a micro sign would be guessed."),
    Rule(
        CONTROL_CHARACTER,
        "Invisible control character",
        "Control characters and direction marks make a reviewer see another text than the compiler reads.",
    ),
    Rule(SYNTAX, "Not well-formed YAML", "The structure of the file is not certain, so nothing in it is used."),
    Rule(TAB, "Tab in the indentation", "YAML counts blanks; how wide a tab is differs between editors."),
    Rule(EMPTY, "The file is empty", "A map has at least its format, its name, its models and its groups."),
    Rule(
        SEVERAL_DOCUMENTS, "Several documents in one file", "One file is one map; a second document would be ignored."
    ),
    Rule(DUPLICATE_KEY, "Key given twice", "YAML readers keep the first or the last silently; one of the two is lost."),
    Rule(KEY_NOT_TEXT, "A key that is no text", "A key is a name or a code; an empty or a nested key names nothing."),
    Rule(TAG, "YAML tag", "Tags make readers construct other types; a map has texts, numbers, true/false, null only."),
    Rule(MERGE_KEY, "Merge key", "`<<` is no part of YAML 1.2, and hides what a register has from who reviews it."),
    Rule(
        TOO_MANY_VALUES, "Too many values", "Aliases that repeat aliases grow without bound; real maps stay far below."
    ),
    Rule(
        BAD_ALIAS, "Alias without value", "An alias must name an anchor that stands before it and does not contain it."
    ),
    Rule(TOO_DEEP, "Nested too deeply", "No map needs such a depth; it exhausts the readers of the file."),
    Rule(
        NUMBER_FORM,
        "Ambiguous number",
        "YAML 1.1 and 1.2 read `010`, `1_000` or `0b1` as different values, and infinity is no value of a register.",
    ),
    Rule(
        TEXT_TOO_LONG,
        "Text too long",
        "Every text of a map ends up in docs and source code, where it must be readable.",
    ),
    Rule(DIRECTIVE, "YAML directive", "A map is read by the rules of YAML 1.2 whatever a directive says."),
    Rule(
        TOO_MANY_FINDINGS, "Too many findings", "After some hundreds the same mistake repeats; the rest is not listed."
    ),
)
