"""The diagnostics of one file, at most some hundreds."""

from dataclasses import dataclass, field

from regscribe.model import Diagnostic, Related
from regscribe.source.document import SourcePlace
from regscribe.source.rules import TOO_MANY_FINDINGS

MAX_FINDINGS = 300

Others = tuple[tuple[str, SourcePlace], ...]
"""Texts and places of what else a finding is about."""


class StopReadingError(Exception):
    """Reading ends here; the reason is the last of the findings."""


@dataclass(slots=True)
class Findings:
    """The diagnostics of the file `name`, in the order in which they are found."""

    name: str
    diagnostics: list[Diagnostic] = field(default_factory=list)

    def add(self, rule: str, message: str, place: SourcePlace, *, advice: str, related: Others = ()) -> None:
        """Add one; raises StopReadingError when there are too many to be useful."""
        others = tuple(Related(text, where.span(self.name)) for text, where in related)
        self.diagnostics.append(Diagnostic(rule, message, place.span(self.name), advice, related=others))
        if len(self.diagnostics) >= MAX_FINDINGS:
            message = f"{MAX_FINDINGS} findings up to here; the rest of the file was not read"
            advice = "mend these first, then check again"
            self.diagnostics.append(Diagnostic(TOO_MANY_FINDINGS, message, place.span(self.name), advice))
            raise StopReadingError

    def stop(
        self, rule: str, message: str, place: SourcePlace, *, advice: str, related: Others = ()
    ) -> StopReadingError:
        """Add one after which nothing can be read; the caller raises what this returns."""
        self.add(rule, message, place, advice=advice, related=related)
        return StopReadingError()
