"""Model to diagnostics: what a well-formed map says that cannot be right. One small rule each, with a stable id.

A rule is a pure function under a decorator of `rule`, in the module of its subject. `check` runs them all.
"""

from regscribe.checks import (  # noqa: F401 (each declares its rules)
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
    worked_frames,
    worked_values,
    write_order,
)
from regscribe.checks.rule import entries
from regscribe.checks.run import WAIVER_RULES, run
from regscribe.model import Diagnostic, RegisterMap, Rule

RULES: tuple[Rule, ...] = tuple(sorted((*(entry.rule for entry in entries()), *WAIVER_RULES), key=lambda rule: rule.id))
"""All rules of this room."""

__all__ = ["RULES", "check"]


def check(register_map: RegisterMap) -> list[Diagnostic]:
    """All that is wrong with a map, less what it waives, sorted by place."""
    return run(register_map, entries())
