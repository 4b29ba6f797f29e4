"""Conditions and cases: what can never hold, never be reached, or is not covered; givens that nothing needs."""

from collections.abc import Iterator
from dataclasses import dataclass

from regscribe.checks.registry import MAP, Finding, Scope, map_rule, warning
from regscribe.checks.worlds import Verdict, verdict
from regscribe.model import Condition, Register, Rule, Span

Ask = tuple[Condition, ...]


@dataclass(slots=True)
class Asked:
    """The conditions of one set of cases: who has them first, what they decide, and the verdict over all models.

    `faulty`: whatever has them can report a fault, which needs no scale.
    """

    subject: str
    span: Span
    what: str
    found: Verdict
    faulty: bool = True


def _cases_of(register: Register) -> Iterator[tuple[str, Ask]]:
    for what, cases in (("scale", register.scale), ("range", register.range), ("unit", register.unit)):
        if len(cases) > 1 or (cases and not cases[0].when.always):
            yield what, tuple(case.when for case in cases)
    if register.writable:
        yield "condition for a write", (register.writable.when,)


def _asked(scopes: tuple[Scope, ...]) -> list[tuple[Ask, Asked]]:
    """All sets of conditions of the map, each once: what can hold on one model can hold. Kept for all rules."""
    found = scopes[0].memo.setdefault("asked", [])
    if not isinstance(found, list):  # pragma: no cover (the key names what is kept)
        raise TypeError
    if not found:
        found.extend(_collected(scopes))
    return found


def _collected(scopes: tuple[Scope, ...]) -> list[tuple[Ask, Asked]]:
    every: dict[tuple[str, Ask], Asked] = {}
    for scope in scopes:
        for register in scope.model.registers:
            for what, ask in _cases_of(register):
                now = verdict(ask, scope)
                asked = every.setdefault((what, ask), Asked(register.path, register.span, what, now))
                asked.found = _either(asked.found, now)
                asked.faulty &= bool(register.sentinels)
    return [(ask, asked) for (_, ask), asked in every.items()]


def _either(one: Verdict, other: Verdict) -> Verdict:
    return Verdict(
        one.possible | other.possible,
        one.reached | other.reached,
        one.uncovered or other.uncovered,
        known=one.known and other.known,
    )


def _shown(condition: Condition, place: int) -> str:
    return f"`{condition.name}`" if condition.name else f"case {place + 1}"


@map_rule(
    Rule(
        "RS0470",
        "Condition that can never hold",
        "It asks for a code, or for codes at once, that the tested registers cannot have on any model.",
    )
)
def never_holds(scopes: tuple[Scope, ...]) -> Iterator[Finding]:
    """Try every condition in every state that it tells apart; each condition is reported once."""
    seen: set[Condition] = set()
    for ask, asked in _asked(scopes):
        for place, condition in enumerate(ask):
            if place not in asked.found.possible and condition not in seen:
                seen.add(condition)
                tested = ", ".join(dict.fromkeys(f"`{test.subject}`" for test in condition.tests if test.subject))
                message = f"`{asked.subject}`: the {asked.what} has {_shown(condition, place)}, which can never hold"
                help_text = f"compare the codes with what {tested or 'the givens'} can be, and with one another"
                yield Finding(asked.subject, asked.span, message, help_text)
    yield from _identities(scopes)


def _identities(scopes: tuple[Scope, ...]) -> Iterator[Finding]:
    for identity in scopes[0].register_map.identity:
        mine = [scope for scope in scopes if scope.model.name in identity.models]
        if mine and not any(verdict((identity.when,), scope).possible for scope in mine):
            message = f"`identify` for {', '.join(identity.models)} has a condition that can never hold on them"
            yield Finding(MAP, mine[0].model.span, message, "compare the codes with what the register can be")


@map_rule(
    Rule("RS0471", "Case that is never reached", "The first case that holds counts, and an earlier one always does.")
)
def never_reached(scopes: tuple[Scope, ...]) -> Iterator[Finding]:
    """Find cases that can hold, but never first."""
    for ask, asked in _asked(scopes):
        for place in sorted(asked.found.possible - asked.found.reached):
            message = (
                f"`{asked.subject}`: the {asked.what} has {_shown(ask[place], place)}, which no state ever reaches"
            )
            yield Finding(asked.subject, asked.span, message, "put it before the case that hides it, or remove it")


@map_rule(warning("RS0472", "States that no case covers", "In such a state a value can be neither read nor written."))
def not_covered(scopes: tuple[Scope, ...]) -> Iterator[Finding]:
    """Look for a state in which none of the cases of a scale or a range holds; units may be absent."""
    seen: set[Ask] = set()
    for ask, asked in _asked(scopes):
        excused = asked.what == "scale" and asked.faulty  # in such a state there may be nothing but the fault
        if asked.what in {"scale", "range"} and asked.found.uncovered and ask not in seen and not excused:
            seen.add(ask)
            message = f"`{asked.subject}`: no case of the {asked.what} holds when {asked.found.uncovered}"
            help_text = "end with a case without `when`, or give the tested registers the range or enum they have"
            yield Finding(asked.subject, asked.span, message, help_text)


@map_rule(
    Rule("RS0473", "Given that nothing needs", "Users must find out every given; one that decides nothing is in vain.")
)
def given_unused(scopes: tuple[Scope, ...]) -> Iterator[Finding]:
    """Collect the givens of all conditions of all models."""
    used = {test.given for ask, _ in _asked(scopes) for condition in ask for test in condition.tests}
    for given in scopes[0].register_map.givens:
        if given.id not in used:
            message = f"given `{given.id}` decides nothing"
            yield Finding(given.id, given.span, message, "use it in a condition, or remove it")
