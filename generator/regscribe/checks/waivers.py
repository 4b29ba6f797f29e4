"""Waivers: findings that a map puts up with, and waivers that are no use."""

import re
from collections.abc import Iterator

from regscribe.checks.rule import Finding, warning
from regscribe.model import RegisterMap, Rule, Waiver

NOTHING_WAIVED = warning("RS0467", "Waiver that waives nothing", "What it excused is gone; it would hide the next one.")
UNKNOWN_RULE = Rule(
    "RS0468", "Waiver of a rule that cannot be waived", "Only findings of a map's meaning can be excused."
)
NO_REASON = Rule("RS0469", "Waiver without a reason", "Whoever reads the map must be able to judge the exception.")
RULES = (NOTHING_WAIVED, UNKNOWN_RULE, NO_REASON)

INDEX = re.compile(r"\[\d+\]")


def covers(waiver: Waiver, rule: str, subject: str) -> bool:
    """Whether a waiver speaks of this finding: of a register by its path, with or without indexes, else of an id."""
    return waiver.rule == rule and waiver.at in {subject, INDEX.sub("", subject)}


def useless(register_map: RegisterMap, used: set[Waiver], waivable: frozenset[str]) -> Iterator[tuple[Rule, Finding]]:
    """What is wrong with the waivers themselves; `used` have removed a finding, `waivable` are the ids of all rules."""
    for waiver in register_map.waivers:
        if waiver.rule not in waivable:
            message = f"the waiver at `{waiver.at}` names {waiver.rule}, which is no rule that can be waived"
            yield (
                UNKNOWN_RULE,
                Finding(waiver.at, waiver.span, message, "correct the id; `regscribe explain` knows all"),
            )
        elif not waiver.reason.strip():
            message = f"the waiver of {waiver.rule} at `{waiver.at}` gives no reason"
            yield NO_REASON, Finding(waiver.at, waiver.span, message, "say why the map is right nevertheless")
        elif waiver not in used:
            message = f"nothing at `{waiver.at}` is against {waiver.rule}"
            yield NOTHING_WAIVED, Finding(waiver.at, waiver.span, message, "remove the waiver, or correct `at`")
