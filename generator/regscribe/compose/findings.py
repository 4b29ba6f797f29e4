"""The mistakes that are found while files are put together."""

from collections.abc import Iterable
from dataclasses import dataclass, field
from difflib import get_close_matches

from regscribe.model import Diagnostic, Related
from regscribe.source import SourceNode, SourcePlace, shorten

_LISTED = 12


@dataclass(slots=True)
class ComposeFindings:
    """The diagnostics so far; every place knows its file."""

    diagnostics: list[Diagnostic] = field(default_factory=list)

    def add(self, rule: str, message: str, place: SourcePlace, advice: str, *related: tuple[str, SourcePlace]) -> None:
        """Keep one, with the other parties."""
        others = tuple(Related(said, where.span("")) for said, where in related)
        self.diagnostics.append(Diagnostic(rule, message, place.span(""), advice, related=others))

    def reason(self, rule: str, node: SourceNode | None, subject: str) -> None:
        """Refuse a reason of blanks."""
        if node is not None and not str(node.value).strip():
            self.add(rule, f"{subject} gives no reason", node.place, "say in your own words why the siblings differ")


def meant(name: str, known: Iterable[str]) -> str:
    """A guess which of the known names was meant, and some of them."""
    names = list(dict.fromkeys(known))
    near = get_close_matches(name[:100], names, n=1)
    guess = f"did you mean `{near[0]}`? " if near else ""
    more = f" and {len(names) - _LISTED} more" if len(names) > _LISTED else ""
    return f"{guess}there are: {', '.join(map(shorten, names[:_LISTED]))}{more}" if names else "there are none"
