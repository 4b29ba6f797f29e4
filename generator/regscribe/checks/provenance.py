"""Where facts come from: sections, manual, errata; how models are told apart."""

from collections import Counter
from collections.abc import Iterator

from regscribe.checks.rule import MAP, Finding, Problem, RuleScope, Scopes, header_rule, map_rule, register_rule
from regscribe.model import Identity, Register, RegisterMap


@header_rule("RS0494", "Models not told apart")
def identification(register_map: RegisterMap) -> Iterator[Problem]:
    """`identify` says for every model, once, how it answers."""
    known: set[Identity] = set()
    for rule in register_map.identity:
        twice = [name for name, count in Counter(rule.models).items() if count > 1]
        if twice:
            yield f"`identify` lists {', '.join(twice)} twice at once", "remove one"
        if rule.identity in known:
            message = f"`identify` has two entries of one condition (the second for {', '.join(rule.models)})"
            yield message, "list the models in one entry"
        known.add(rule.identity)
    listed = {name for rule in register_map.identity for name in rule.models}
    missing = [model.name for model in register_map.models if listed and model.name not in listed]
    if missing:
        yield f"`identify` does not say how to tell {', '.join(missing)}", "add them"


@register_rule("RS0495", "Register without section", warns=True)
def no_section(register: Register, _: RuleScope) -> Iterator[Problem]:
    """A reader must be able to look every value up in the manual."""
    if not register.section:
        yield "does not say where the manual describes it", "add `source` here or at its group"


@header_rule("RS0496", "Manual not identified", warns=True)
def manual_not_identified(register_map: RegisterMap) -> Iterator[Problem]:
    """Makers reissue manuals: number or date tells which one was transcribed."""
    if not (register_map.manual.number.strip() or register_map.manual.date.strip()):
        message = f'the manual "{register_map.manual.title}" has neither number nor date'
        yield message, "add `manual.number` or `manual.date`"


@map_rule("RS0498", "Erratum or given that does not say enough")
def blank_reasons(register_map: RegisterMap, _: Scopes) -> Iterator[Finding]:
    """A blank reason cannot be judged by a reviewer."""
    for erratum in register_map.errata:
        texts = {"where": erratum.where, "printed": erratum.printed, "read": erratum.read, "why": erratum.why}
        blank = [key for key, text in texts.items() if not text.strip()]
        if blank:
            message = f'the erratum at "{erratum.where}" leaves {", ".join(blank)} blank'
            yield Finding(MAP, register_map.span, message, "say it in your own words")
    for given in register_map.givens:
        if not (given.description.strip() and given.reason.strip()):
            message = f"given `{given.id}` has a blank description or reason"
            yield Finding(given.id, given.span, message, "say what it is and why the manual does not hold it")
