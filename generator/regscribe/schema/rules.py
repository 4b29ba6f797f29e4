"""Rules of the shape of a map: known keys, the right types, one form for each value."""

from regscribe.model import Rule

UNKNOWN_KEY = "RS0201"
MISSING_KEY = "RS0202"
WRONG_TYPE = "RS0203"
VALUE_NOT_ALLOWED = "RS0204"
WRONG_FORM = "RS0205"
WRONG_COUNT = "RS0206"
EXCLUSIVE_KEYS = "RS0207"
TOO_MANY_ERRORS = "RS0208"

RULES: tuple[Rule, ...] = (
    Rule(UNKNOWN_KEY, "Unknown key", "A misspelt key would be ignored silently, and what it says would be lost."),
    Rule(MISSING_KEY, "Missing key", "Without this key nothing can be generated; a default would be a guess."),
    Rule(
        WRONG_TYPE, "Wrong type of value", "A text where a number must stand (or the reverse) has no certain meaning."
    ),
    Rule(
        VALUE_NOT_ALLOWED, "Value not allowed", "Only the listed words, or numbers inside the limits, have a meaning."
    ),
    Rule(
        WRONG_FORM,
        "Wrong form",
        "Names, ranges, codes and frames have one form each, so that they are read in one way.",
    ),
    Rule(WRONG_COUNT, "Too few or too many", "An empty or an overlong list or text says nothing that could be used."),
    Rule(
        EXCLUSIVE_KEYS, "Keys that exclude each other", "Two keys that say the same in different ways may contradict."
    ),
    Rule(TOO_MANY_ERRORS, "Too many errors", "After some hundreds the same mistake repeats; the rest is not listed."),
)
