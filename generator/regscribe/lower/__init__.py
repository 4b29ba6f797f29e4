"""Plain values -> model: what the keys of a map mean, for each model of the family.

`lower` takes a document whose shape `regscribe.schema.validate` found right. It reads through `Value`, which knows the
place of each value, so a step that merges the raw data of several maps can stand in front of it.
"""

from regscribe.lower.library import library_of
from regscribe.lower.map import map_of
from regscribe.lower.node import Collector, Value
from regscribe.lower.rules import RULES
from regscribe.lower.units import KNOWN as KNOWN_UNITS
from regscribe.model import Diagnostic, RegisterMap, Severity
from regscribe.source import Document

__all__ = ["KNOWN_UNITS", "RULES", "library_of", "lower"]


def lower(document: Document) -> tuple[RegisterMap | None, list[Diagnostic]]:
    """The model of a document, and all mistakes of meaning in it; no model where one of them is an error."""
    context = Collector(document)
    found = map_of(Value(context, (), document.data))
    errors = any(diagnostic.severity is Severity.ERROR for diagnostic in context.diagnostics)
    return (None if errors else found), context.diagnostics
