"""Where something is in a map and what is wrong with it: frozen values, printed by the CLI alone."""

from dataclasses import dataclass
from enum import StrEnum


class Severity(StrEnum):
    """How much a diagnostic matters: an error stops the pipeline after its phase, a warning does not."""

    ERROR = "error"
    WARNING = "warning"


@dataclass(frozen=True, slots=True, order=True)
class Span:
    """A stretch of a source file: lines and columns count from 1, the end column is exclusive."""

    file: str
    line: int = 1
    column: int = 1
    end_line: int = 1
    end_column: int = 1

    def __str__(self) -> str:
        return f"{self.file}:{self.line}:{self.column}"


NOWHERE = Span("")
"""The place of what was made by hand, in tests for instance."""


@dataclass(frozen=True, slots=True)
class Related:
    """The other party of a diagnostic: what it is and where it stands."""

    message: str
    span: Span


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """One finding: a stable rule id, what is wrong with the numbers in it, where, and what to do.

    `replacement` is what was probably meant by the name that stands at `span`; empty where nothing is like it.
    """

    rule: str
    message: str
    span: Span
    help: str = ""
    severity: Severity = Severity.ERROR
    related: tuple[Related, ...] = ()
    replacement: str = ""


@dataclass(frozen=True, slots=True)
class Rule:
    """A stable rule of the compiler, as `regscribe explain` shows it; its examples stand beside it as data."""

    id: str
    title: str
    why: str
    severity: Severity = Severity.ERROR
