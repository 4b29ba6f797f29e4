"""Model to diagnostics: what a well-formed map says that cannot be right. One small rule each, with a stable id.

A rule is a pure function under a decorator of `registry`, in the module of its subject. `check` runs them all.
"""

from regscribe.checks import (
    addresses,
    behaviour,
    bits,
    commands,
    conditions,
    enums,
    frames,
    governing,
    identifiers,
    programs,
    protocol,
    provenance,
    ranges,
    references,
    scales,
    types,
    views,
    waivers,
    worked,
    writes,
)
from regscribe.checks.registry import entries
from regscribe.checks.run import run
from regscribe.model import Diagnostic, RegisterMap, Rule

SUBJECTS = (
    addresses,
    identifiers,
    types,
    scales,
    ranges,
    enums,
    worked,
    frames,
    bits,
    views,
    references,
    waivers,
    conditions,
    writes,
    governing,
    commands,
    behaviour,
    programs,
    protocol,
    provenance,
)
"""The modules that declare rules, in the order of their numbers."""

RULES: tuple[Rule, ...] = tuple(
    sorted((*(entry.rule for entry in entries()), *waivers.RULES), key=lambda rule: rule.id)
)
"""All rules of this room."""

__all__ = ["RULES", "check"]


def check(register_map: RegisterMap) -> list[Diagnostic]:
    """All that is wrong with a map, less what it waives, sorted by place."""
    return run(register_map, entries())
