"""Run all rules over a map: findings, less what is waived, each place once, in the order of the file."""

from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from regscribe.checks import waivers
from regscribe.checks.rule import Finding, RuleEntry, RuleScope
from regscribe.model import Diagnostic, RegisterMap, Rule, Severity, Span, Waiver


@dataclass(frozen=True, slots=True)
class LocatedFinding:
    """A finding with its rule and the model it was made on (empty: the map)."""

    rule: Rule
    model: str
    finding: Finding


def run(register_map: RegisterMap, entries: Iterable[RuleEntry]) -> list[Diagnostic]:
    """All diagnostics of a map, sorted by place and rule."""
    rules = tuple(entries)
    scopes = tuple(RuleScope.of(register_map, model) for model in register_map.models)
    found = (
        [LocatedFinding(entry.rule, model, one) for entry in rules for model, one in entry.run(scopes)]
        if scopes
        else []
    )
    used: set[Waiver] = set()
    kept = [one for one in found if not _waived(one, register_map, used)]
    waivable = frozenset(entry.rule.id for entry in rules)
    kept += [LocatedFinding(rule, "", finding) for rule, finding in waivers.useless(register_map, used, waivable)]
    merged = _merge(kept, len(register_map.models))
    return sorted(merged, key=lambda diagnostic: (diagnostic.span, diagnostic.rule))


def _waived(found: LocatedFinding, register_map: RegisterMap, used: set[Waiver]) -> bool:
    matching = [w for w in register_map.waivers if waivers.covers(w, found.rule.id, found.finding.subject)]
    valid = [waiver for waiver in matching if waiver.reason.strip()]
    used.update(valid)
    return bool(valid)


def _merge(found: list[LocatedFinding], models: int) -> Iterator[Diagnostic]:
    """One diagnostic for all findings of one rule at one place: the first speaks, the others are counted."""
    places: defaultdict[tuple[str, Span], list[LocatedFinding]] = defaultdict(list)
    for one in found:
        places[one.rule.id, one.finding.span].append(one)
    for together in places.values():
        first = together[0]
        severity = Severity(first.rule.severity)
        message = first.finding.message + _others(together) + _models(together, models)
        finding = first.finding
        yield Diagnostic(first.rule.id, message, finding.span, finding.help, severity, finding.related)


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
