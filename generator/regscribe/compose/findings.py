"""What the files of one map must keep to among each other, and the mistakes that are found while they are composed."""

from collections.abc import Iterable
from dataclasses import dataclass, field

from regscribe.model import Diagnostic, Related, Rule
from regscribe.model.nearest import nearest
from regscribe.source import SourceNode, SourcePlace, shorten

_LISTED = 12

NO_FILE = "RS0501"
CYCLE = "RS0502"
WRONG_FILE = "RS0503"
OTHER_ID = "RS0504"
NO_MODEL = "RS0505"
CHANGES_NOTHING = "RS0506"
NO_TARGET = "RS0507"
DROPS_NOTHING = "RS0508"
NO_REASON = "RS0509"
NAME_CLASH = "RS0510"
RENUMBERS_NOTHING = "RS0511"
LEAVES_NOTHING_OUT = "RS0512"
CHANGED_IN_PASSING = "RS0513"
UNKNOWN_NOTATION = "RS0514"
NO_NUMBER = "RS0515"

_SURPLUS = "What does nothing here is meant for something else, or its reason is gone."

RULES: tuple[Rule, ...] = (
    Rule(
        NO_FILE,
        "Base or library not found",
        "What a map builds on lies under its id in the same `maps` folder, or comes with regscribe.",
    ),
    Rule(CYCLE, "Map that extends itself", "A map that is built on itself, however indirectly, has no beginning."),
    Rule(
        WRONG_FILE, "Map in place of a library, or the reverse", "A map is extended; of a library the names are used."
    ),
    Rule(OTHER_ID, "File under another id", "What is found under one id and calls itself by another is a mix-up."),
    Rule(NO_MODEL, "Renamed model that does not exist", "A mistyped model would silently lose all its registers."),
    Rule(CHANGES_NOTHING, "Override that changes nothing", _SURPLUS),
    Rule(NO_TARGET, "Override of what the base does not have", "An override speaks of something that is inherited."),
    Rule(DROPS_NOTHING, "Drop of what the base does not have", _SURPLUS),
    Rule(NO_REASON, "Override or drop without a reason", "Readers of the docs must see why siblings differ."),
    Rule(NAME_CLASH, "Name declared twice among files", "Which of two things of one name counts must not be guessed."),
    Rule(RENUMBERS_NOTHING, "Chapter that nothing stands in", _SURPLUS),
    Rule(LEAVES_NOTHING_OUT, "Command left out that no library has", _SURPLUS),
    Rule(
        CHANGED_IN_PASSING,
        "Inherited group changed in passing",
        "What differs from the base stands under `override`, with its reason.",
    ),
    Rule(
        UNKNOWN_NOTATION,
        "Rows written in an unknown notation",
        "Without the notation nobody knows which wire address a number of the manual means.",
    ),
    Rule(
        NO_NUMBER,
        "Number that the notation does not have",
        "A number outside the notation was misread, or stands in a space that the row contradicts.",
    ),
)


@dataclass(slots=True)
class ComposeFindings:
    """Collects diagnostics; every place knows its file."""

    diagnostics: list[Diagnostic] = field(default_factory=list)

    def add(
        self,
        rule: str,
        message: str,
        place: SourcePlace,
        advice: str,
        *related: tuple[str, SourcePlace],
        replacement: str = "",
    ) -> None:
        """Add a diagnostic with what it is related to: descriptions and places."""
        others = tuple(Related(what, where.span("")) for what, where in related)
        said = Diagnostic(rule, message, place.span(""), advice, related=others, replacement=replacement)
        self.diagnostics.append(said)

    def unknown(
        self, rule: str, message: str, node: SourceNode, known: Iterable[str], *related: tuple[str, SourcePlace]
    ) -> None:
        """Report a name that nothing has, with the one that was probably meant."""
        name, names = str(node.value), list(dict.fromkeys(known))
        meant = nearest(name, names)
        self.add(rule, message, node.place, suggestion(name, names), *related, replacement=meant)

    def reason(self, rule: str, node: SourceNode | None, subject: str) -> None:
        """Report a reason that is blank."""
        if node is not None and not str(node.value).strip():
            self.add(rule, f"{subject} gives no reason", node.place, "say in your own words why the siblings differ")


def suggestion(name: str, known: Iterable[str]) -> str:
    """A guess which of the known names was meant, and some of them."""
    names = list(dict.fromkeys(known))
    near = nearest(name, names)
    guess = f"did you mean `{near}`? " if near else ""
    more = f" and {len(names) - _LISTED} more" if len(names) > _LISTED else ""
    return f"{guess}there are: {', '.join(map(shorten, names[:_LISTED]))}{more}" if names else "there are none"
