"""Conditions and cases: what can never hold, never be reached, or is not covered; givens that nothing needs."""

from collections.abc import Iterator
from dataclasses import dataclass

from regscribe.checks.probe_states import Verdict, verdict
from regscribe.checks.rule import MAP, Finding, RuleScope, Scopes, map_rule
from regscribe.model import Condition, Identity, Kind, OrderFrom, Register, RegisterMap, Span

Ask = tuple[Condition, ...]


@dataclass(slots=True)
class AskedSubject:
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


def _asked(scopes: Scopes) -> list[tuple[Ask, AskedSubject]]:
    """All sets of conditions of the map, each once: what can hold on one model can hold. Kept for all rules."""
    return scopes[0].once("asked", lambda: _collected(scopes))


def _collected(scopes: Scopes) -> list[tuple[Ask, AskedSubject]]:
    every: dict[tuple[str, Ask], AskedSubject] = {}
    for scope in scopes:
        for register in scope.model.registers:
            for what, ask in _cases_of(register):
                now = verdict(ask, scope)
                asked = every.setdefault((what, ask), AskedSubject(register.path, register.span, what, now))
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
    "RS0470",
    "Condition that can never hold",
    "It asks for a code, or for codes at once, that the tested registers cannot have on any model.",
)
def never_holds(register_map: RegisterMap, scopes: Scopes) -> Iterator[Finding]:
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
    yield from _identities(register_map, scopes)


def _identities(register_map: RegisterMap, scopes: Scopes) -> Iterator[Finding]:
    for identity in register_map.identity:
        mine = [scope for scope in scopes if scope.model.name in identity.models]
        unmet = [_unmet(identity.identity, scope) for scope in mine]
        if mine and all(unmet):
            message = f"`identify` for {', '.join(identity.models)} {unmet[0]}"
            yield Finding(MAP, mine[0].model.span, message, "compare the codes and texts with what the register can be")


def _unmet(identity: Identity, scope: RuleScope) -> str:
    """Why a model never shows an identity; empty if it may."""
    asked = (*identity.when.registers, *(path for path, _ in identity.texts))
    unknown = next(filter(None, (_unknown(scope.registers[path]) for path in asked if path in scope.registers)), "")
    if unknown:
        return unknown
    if not verdict((identity.when,), scope).possible:
        return "has a condition that can never hold on them"
    for path, text in identity.texts:
        if path in scope.registers and (why := _never_begins(scope.registers[path], text)):
            return f"asks `{path}` for the text {text!r}, {why}"
    return ""


def _unknown(register: Register) -> str:
    """Why the value of a register is not known while a device is identified; empty if it is."""
    if not register.access.readable:
        return f"asks for `{register.path}`, which can only be written"
    if not _tells_alone(register):
        return f"asks for `{register.path}`, whose value is not known before the model is"
    return ""


def _tells_alone(register: Register) -> bool:
    """Whether the words of a register have a value without any other register, and without a given."""
    scales = (*register.scale, *(register.special_scale if register.specials else ()))
    fixed = any(not isinstance(view.order, OrderFrom) for view in register.views if view.readable)
    return fixed and all(case.when.always and not case.then.decimals for case in scales)


def _never_begins(register: Register, text: str) -> str:
    """Why what is read of a register never begins with a text; empty if it may."""
    room = 2 * max(view.words for view in register.views)
    whys = {
        f"and it is of kind {register.kind}": register.kind is not Kind.STRING,
        "which is no ASCII text": not text.isascii() or "\0" in text,
        "whose blanks at the end are dropped when it is read": text.endswith(" "),
        f"and it has room for {room} characters": len(text) > room,
    }
    return next((why for why, holds in whys.items() if holds), "")


@map_rule("RS0471", "Case that is never reached", "The first case that holds counts, and an earlier one always does.")
def never_reached(_: RegisterMap, scopes: Scopes) -> Iterator[Finding]:
    """Find cases that can hold, but never first."""
    for ask, asked in _asked(scopes):
        for place in sorted(asked.found.possible - asked.found.reached):
            message = (
                f"`{asked.subject}`: the {asked.what} has {_shown(ask[place], place)}, which no state ever reaches"
            )
            yield Finding(asked.subject, asked.span, message, "put it before the case that hides it, or remove it")


@map_rule(
    "RS0472", "States that no case covers", "In such a state a value can be neither read nor written.", warns=True
)
def not_covered(_: RegisterMap, scopes: Scopes) -> Iterator[Finding]:
    """Look for a state in which none of the cases of a scale or a range holds; units may be absent."""
    seen: set[Ask] = set()
    for ask, asked in _asked(scopes):
        excused = asked.what == "scale" and asked.faulty  # in such a state there may be nothing but the fault
        if asked.what in {"scale", "range"} and asked.found.uncovered and ask not in seen and not excused:
            seen.add(ask)
            message = f"`{asked.subject}`: no case of the {asked.what} holds when {asked.found.uncovered}"
            help_text = "end with a case without `when`, or give the tested registers the range or enum they have"
            yield Finding(asked.subject, asked.span, message, help_text)


@map_rule("RS0473", "Given that nothing needs", "Users must find out every given; one that decides nothing is in vain.")
def given_unused(register_map: RegisterMap, scopes: Scopes) -> Iterator[Finding]:
    """Collect the givens of all conditions of all models."""
    used = {test.given for ask, _ in _asked(scopes) for condition in ask for test in condition.tests}
    for given in register_map.givens:
        if given.id not in used:
            message = f"given `{given.id}` decides nothing"
            yield Finding(given.id, given.span, message, "use it in a condition, or remove it")
