"""Model to diagnostics: what a well-formed map says that cannot be right. One small rule each, with a stable id.

A rule is a pure function under a decorator of `registry`, in the module of its subject. `check` runs them all.
"""

from regscribe.checks import (
    addresses,
    commands,
    conditions,
    enums,
    identifiers,
    line_settings,
    process,
    programs,
    protocol,
    provenance,
    ranges,
    references,
    scales,
    stated_numbers,
    views,
    waivers,
    worked_frames,
    worked_values,
    write_order,
)
from regscribe.checks.rule import entries
from regscribe.checks.run import run
from regscribe.model import Diagnostic, RegisterMap, Rule

SUBJECTS = (
    addresses,
    identifiers,
    stated_numbers,
    scales,
    ranges,
    enums,
    worked_values,
    worked_frames,
    views,
    references,
    waivers,
    conditions,
    write_order,
    line_settings,
    commands,
    process,
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
