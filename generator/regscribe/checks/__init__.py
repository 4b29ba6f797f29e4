"""Model to diagnostics: what a well-formed map says that cannot be right. One small rule each, with a stable id.

A rule is a pure function under a decorator of `rule`, in the module of its subject. `check` runs them all.
"""

import re
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

from regscribe import breaking
from regscribe.checks import (  # noqa: F401 (each declares its rules)
    addresses,
    blocks,
    commands,
    conditions,
    enron,
    enums,
    header,
    identifiers,
    line_settings,
    pages,
    process,
    programs,
    ranges,
    references,
    rereads,
    scales,
    stated_numbers,
    views,
    worked_frames,
    worked_values,
    write_and_read,
    write_order,
)
from regscribe.checks.rule import DECLARED, Finding, RuleScope
from regscribe.model import Diagnostic, RegisterMap, Rule, Severity, Span, Waiver

__all__ = ["RULES", "check"]

NOTHING_WAIVED = Rule(
    "RS0467", "Waiver that waives nothing", "What it excused is gone; it would hide the next one.", Severity.WARNING
)
UNKNOWN_RULE = Rule(
    "RS0468", "Waiver of a rule that cannot be waived", "Only findings of a map's meaning can be excused."
)
NO_REASON = Rule("RS0469", "Waiver without a reason", "Whoever reads the map must be able to judge the exception.")

RULES: tuple[Rule, ...] = tuple(sorted((*DECLARED, NOTHING_WAIVED, UNKNOWN_RULE, NO_REASON), key=lambda rule: rule.id))
"""All rules of this room."""

INDEX = re.compile(r"\[\d+\]")


class LocatedFinding(NamedTuple):
    """A finding with its rule and the model it was made on (empty: the map)."""

    rule: Rule
    model: str
    finding: Finding


def check(register_map: RegisterMap) -> list[Diagnostic]:
    """All that is wrong with a map, less what it waives, each place once, sorted by place and rule."""
    scopes = tuple(RuleScope.of(register_map, model) for model in register_map.models)
    rules = [rule for rule in RULES if rule in DECLARED] if scopes else []
    found = [LocatedFinding(rule, *each) for rule in rules for each in DECLARED[rule](scopes)]
    numbers = _printed_numbers(register_map) if found else {}
    found = [one._replace(finding=_numbered(one, numbers)) for one in found]
    used: set[Waiver] = set()
    kept = [one for one in found if not _waived(one, register_map, used)]
    kept += [LocatedFinding(rule, "", finding) for rule, finding in _useless(register_map, used)]
    return sorted(_merge(kept, len(register_map.models)), key=lambda diagnostic: (diagnostic.span, diagnostic.rule))


def _printed_numbers(register_map: RegisterMap) -> dict[tuple[str, str], str]:
    """The addresses of registers in the first notation of their space, by model and path."""
    notations = {notation.space: notation for notation in reversed(register_map.notations)}
    return {
        (model.name, register.path): f"{notation.name} {notation.printed(register.address)}"
        for model in register_map.models
        for register in (model.registers if notations else ())
        if (notation := notations.get(register.base.space)) and not register.block
    }


def _numbered(found: LocatedFinding, numbers: dict[tuple[str, str], str]) -> Finding:
    """A finding; one about a register with the number that the manual has for it."""
    finding, subject = found.finding, f"`{found.finding.subject}` "
    number = numbers.get((found.model, finding.subject))
    if number is None or not finding.message.startswith(subject):
        return finding
    return replace(finding, message=f"{subject}({number}) {finding.message.removeprefix(subject)}")


def _waived(found: LocatedFinding, register_map: RegisterMap, used: set[Waiver]) -> bool:
    """Whether a waiver with a reason names the subject of a finding; a path may lack its indexes."""
    subject = found.finding.subject
    subjects = {subject, INDEX.sub("", subject)}
    matching = [one for one in register_map.waivers if one.rule == found.rule.id and one.at in subjects]
    valid = [waiver for waiver in matching if waiver.reason.strip()]
    used.update(valid)
    return bool(valid)


def _useless(register_map: RegisterMap, used: set[Waiver]) -> Iterator[tuple[Rule, Finding]]:
    """What is wrong with the waivers themselves; `used` are those that removed a finding."""
    of_changes = {rule.id for rule in breaking.RULES}  # whether they excuse something, only two versions tell
    waivable = {rule.id for rule in DECLARED} | of_changes
    for waiver in register_map.waivers:
        if waiver.rule not in waivable:
            message = f"the waiver at `{waiver.at}` names {waiver.rule}, which is no rule that can be waived"
            help_text = "correct the id; `regscribe explain` knows all"
            yield UNKNOWN_RULE, Finding(waiver.at, waiver.span, message, help_text)
        elif not waiver.reason.strip():
            message = f"the waiver of {waiver.rule} at `{waiver.at}` gives no reason"
            yield NO_REASON, Finding(waiver.at, waiver.span, message, "say why the map is right nevertheless")
        elif waiver not in used and waiver.rule not in of_changes:
            message = f"nothing at `{waiver.at}` is against {waiver.rule}"
            yield NOTHING_WAIVED, Finding(waiver.at, waiver.span, message, "remove the waiver, or correct `at`")


def _merge(found: list[LocatedFinding], models: int) -> Iterator[Diagnostic]:
    """One diagnostic for all findings of one rule at one place: the first speaks, the others are counted."""
    places: defaultdict[tuple[str, Span], list[LocatedFinding]] = defaultdict(list)
    for one in found:
        places[one.rule.id, one.finding.span].append(one)
    for together in places.values():
        rule, _, first = together[0]
        message = first.message + _others(together) + _models(together, models)
        related = (first.related,) if first.related else ()
        yield Diagnostic(rule.id, message, first.span, first.help, rule.severity, related)


def _others(together: list[LocatedFinding]) -> str:
    """The further findings of the first one's model: their messages, or how many if they are many."""
    mine = dict.fromkeys(one.finding.message for one in together if one.model == together[0].model)
    more = list(mine)[1:]
    if len(more) > 2:  # noqa: PLR2004 (two more still make a readable line)
        return f" (and {len(more)} more like it)"
    return "".join(f"; {message}" for message in more)


def _models(together: list[LocatedFinding], models: int) -> str:
    names = list(dict.fromkeys(one.model for one in together if one.model))
    if not names or models == 1:
        return ""
    return " (on every model)" if len(names) == models else f" (on {', '.join(names)})"
