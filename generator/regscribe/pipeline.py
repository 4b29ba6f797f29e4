"""The phases in their order: source, schema, lower, checks.

A phase reports all its errors; the next one runs only if there are none. Warnings stop nothing.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from regscribe import checks, lower, schema, source
from regscribe.model import Diagnostic, RegisterMap, Severity


@dataclass(frozen=True, slots=True)
class Compiled:
    """What became of one file: the map, unless an error was found, and all that was found, in the file's order."""

    path: Path
    map: RegisterMap | None
    diagnostics: tuple[Diagnostic, ...] = ()


def compile_map(path: Path) -> Compiled:
    """Read, validate, lower and check the map at `path`; what is wrong with the file is in the diagnostics."""
    document, found = source.load(path)
    if document is None or has_errors(found):
        return Compiled(path, None, _ordered(found))
    found = [*found, *schema.validate(document)]
    if has_errors(found):
        return Compiled(path, None, _ordered(found))
    register_map, lowered = lower.lower(document)
    found = [*found, *lowered]
    if register_map is None or has_errors(found):
        return Compiled(path, None, _ordered(found))
    found = [*found, *checks.check(register_map)]
    return Compiled(path, None if has_errors(found) else register_map, _ordered(found))


def has_errors(found: Iterable[Diagnostic]) -> bool:
    """Whether one of them is an error."""
    return any(diagnostic.severity is Severity.ERROR for diagnostic in found)


def _ordered(found: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
    return tuple(sorted(found, key=lambda diagnostic: (diagnostic.span, diagnostic.rule)))
