"""Conditions and cases: what can never hold, never be reached, or is not covered; givens that nothing needs."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

from regscribe.checks.probe_states import verdict
from regscribe.checks.rule import MAP, Finding, RuleScope, Scopes, map_rule
from regscribe.model import (
    ByCase,
    Cases,
    Condition,
    GivenRef,
    Identity,
    Is,
    Kind,
    Model,
    OrderCases,
    Register,
    RegisterMap,
    Span,
)
from regscribe_runtime.values.terms import parts_of
from regscribe_runtime.values.views import scale_needs


@dataclass(slots=True)
class CaseSet:
    """The conditions of one set of cases, what they decide, the first register that has them, and their verdict.

    `possible`, `reached` and `uncovered` (see `Verdict`) are those of all models together.
    `faulty`: whatever has the cases can report a fault, which needs no scale.
    """

    conditions: tuple[Condition, ...]
    what: str
    subject: str
    span: Span
    possible: set[int] = field(default_factory=set)
    reached: set[int] = field(default_factory=set)
    uncovered: str = ""
    faulty: bool = True


def _case_sets(scopes: Scopes) -> list[CaseSet]:
    """All sets of cases of the map, each once; kept for all rules."""
    return scopes[0].once("case sets", lambda: _collect_case_sets(scopes))


def _collect_case_sets(scopes: Scopes) -> list[CaseSet]:
    every: dict[tuple[str, tuple[Condition, ...]], CaseSet] = {}
    for scope in scopes:
        for register in scope.model.registers:
            for what, conditions in _conditions(register):
                found = verdict(conditions, scope)
                cases = every.setdefault((what, conditions), CaseSet(conditions, what, register.path, register.span))
                cases.possible |= found.possible
                cases.reached |= found.reached
                cases.uncovered = cases.uncovered or found.uncovered
                cases.faulty &= bool(register.sentinels)
    return list(every.values())


def _conditions(register: Register) -> Iterator[tuple[str, tuple[Condition, ...]]]:
    """The conditions of each set of cases of a register, with what they decide."""
    ranges = (("range", register.range), ("valid range", register.valid))
    beginnings = (("default", register.default_cases), ("delivered value", register.delivered_cases))
    every: tuple[tuple[str, Cases[Any]], ...] = (
        ("scale", register.scale),
        *ranges,
        ("unit", register.unit),
        *beginnings,
    )
    for what, cases in every:
        if len(cases) > 1 or (cases and not cases[0].when.always):
            yield what, tuple(case.when for case in cases)
    for part in parts_of((register.scale, register.range, register.valid)):
        if isinstance(part, ByCase):
            yield "term", tuple(case.when for case in part.cases)
    if any(not sentinel.when.always for sentinel in register.sentinels):
        yield "table of sentinels", tuple(dict.fromkeys(sentinel.when for sentinel in register.sentinels))
    for order in dict.fromkeys(order for view in register.views for order in (view.order, view.byte_order)):
        if isinstance(order, OrderCases) and not order.by_code():
            yield "word order", tuple(case.when for case in order.cases)
    yield from _single_conditions(register)


def _single_conditions(register: Register) -> Iterator[tuple[str, tuple[Condition, ...]]]:
    """The conditions that stand alone, each with what it decides."""
    for case in register.partial:
        yield f"condition of {_partial_name(register, case.then)}", (case.when,)
    if register.writable:
        yield "condition for a write", (register.writable.when,)
    if not register.when.always:
        yield "condition of its existence", (register.when,)


def _partial_name(register: Register, name: str) -> str:
    """What exists only in a case: an enum by its place, a member, a flag or a part."""
    place, _, member = name.partition(".")
    if register.enum is None:
        return f"`{name.lower()}`"
    return f"member `{member}`" if member else f"enum {int(place) + 1}"


def _shown(condition: Condition, place: int) -> str:
    return f"`{condition.name}`" if condition.name else f"case {place + 1}"


@map_rule("RS0470", "Condition that can never hold")
def never_holds(register_map: RegisterMap, scopes: Scopes) -> Iterator[Finding]:
    """It asks for a code, or for codes at once, that the tested registers cannot have on any model."""
    seen: set[Condition] = set()
    for cases in _case_sets(scopes):
        for place, condition in enumerate(cases.conditions):
            if place not in cases.possible and condition not in seen:
                seen.add(condition)
                tested = ", ".join(dict.fromkeys(f"`{test.subject}`" for test in condition.leaves if test.register))
                message = f"`{cases.subject}`: the {cases.what} has {_shown(condition, place)}, which can never hold"
                help_text = f"compare the codes with what {tested or 'the givens'} can be, and with one another"
                yield Finding(cases.subject, cases.span, message, help_text)
    yield from _identities(register_map, scopes)
    yield from _others(scopes)


def _others(scopes: Scopes) -> Iterator[Finding]:
    for scope in scopes:
        for what, thing, span, when in conditional(scope.model):
            if not verdict((when,), scope).possible:
                message = f"{what} has a condition that can never hold"
                yield Finding(thing, span, message, "compare the codes with what the registers can be")


def conditional(model: Model) -> Iterator[tuple[str, str, Span, Condition]]:
    """What has a condition and is no register: in words, its id, where it stands, and the condition."""
    for one in model.computed:
        cases = (
            case.when for part in parts_of((one.term, one.valid)) if isinstance(part, ByCase) for case in part.cases
        )
        whens = (one.when, *cases, *(case.when for case in one.valid))
        yield from ((f"computed value `{one.id}`", one.id, one.span, when) for when in whens)
    for command in model.commands:
        own = f"command `{command.id}`"
        yield f"{own}: it", command.id, command.span, command.when
        yield from ((f"{own}: a step of it", command.id, command.span, step.when) for step in command.steps)
    for program, notes in zip(model.programs, model.program_notes, strict=True):
        yield from ((f"program `{program.id}`", program.id, notes.span, when) for when in program.conditions)


def _identities(register_map: RegisterMap, scopes: Scopes) -> Iterator[Finding]:
    for identity in register_map.identity:
        mine = [scope for scope in scopes if scope.model.name in identity.models]
        unmet = [_why_never_met(identity.identity, scope) for scope in mine]
        if mine and all(unmet):
            message = f"`identify` for {', '.join(identity.models)} {unmet[0]}"
            yield Finding(MAP, mine[0].model.span, message, "compare the codes and texts with what the register can be")


def _why_never_met(identity: Identity, scope: RuleScope) -> str:
    """Why a model never shows an identity; empty if it may."""
    tested_paths = (*identity.when.registers, *(path for path, _ in identity.texts))
    unknown = next(filter(None, map(_why_unknown, scope.named(tested_paths))), "")
    if unknown:
        return unknown
    if not verdict((identity.when,), scope).possible:
        return "has a condition that can never hold on them"
    for path, text in identity.texts:
        if path in scope.registers and (why := _why_never_begins(scope.registers[path], text)):
            return f"asks `{path}` for the text {text!r}, {why}"
    return ""


def _why_unknown(register: Register) -> str:
    """Why the value of a register is not known while a device is identified; empty if it is."""
    if not register.access.readable:
        return f"asks for `{register.path}`, which can only be written"
    scales = (*register.scale, *(register.special_scale if register.specials else ()))
    others = [one.when for one in register.sentinels] + [one.when for one in register.valid]
    if not all(when.always for when in others):
        return f"asks for `{register.path}`, whose faults are not known before the model is"
    fixed = any(not view.needs() for view in register.views if view.readable)
    if not fixed or any(case.then.decimals or not case.when.always for case in scales) or scale_needs(register):
        return f"asks for `{register.path}`, whose value is not known before the model is"
    return ""


def _why_never_begins(register: Register, text: str) -> str:
    """Why what is read of a register never begins with a text; empty if it may."""
    room = 2 * max(view.words for view in register.views)
    whys = {
        f"and it is of kind {register.kind}": register.kind is not Kind.STRING,
        "which is no ASCII text": not text.isascii() or "\0" in text,
        "whose blanks at the end are dropped when it is read": text.endswith(" "),
        f"and it has room for {room} characters": len(text) > room,
    }
    return next((why for why, holds in whys.items() if holds), "")


@map_rule("RS0471", "Case that is never reached")
def never_reached(_: RegisterMap, scopes: Scopes) -> Iterator[Finding]:
    """The first case that holds counts, and an earlier one always does."""
    for cases in _case_sets(scopes):
        for place in sorted(cases.possible - cases.reached):
            case = _shown(cases.conditions[place], place)
            message = f"`{cases.subject}`: the {cases.what} has {case}, which no state ever reaches"
            yield Finding(cases.subject, cases.span, message, "put it before the case that hides it, or remove it")


@map_rule("RS0472", "States that no case covers", warns=True)
def not_covered(_: RegisterMap, scopes: Scopes) -> Iterator[Finding]:
    """In such a state a value can be neither read nor written."""
    seen: set[tuple[Condition, ...]] = set()
    for cases in _case_sets(scopes):
        excused = cases.what == "scale" and cases.faulty  # in such a state there may be nothing but the fault
        if (
            cases.what in {"scale", "range", "word order"}
            and cases.uncovered
            and cases.conditions not in seen
            and not excused
        ):
            seen.add(cases.conditions)
            message = f"`{cases.subject}`: no case of the {cases.what} holds when {cases.uncovered}"
            help_text = "end with a case without `when`, or give the tested registers the range or enum they have"
            yield Finding(cases.subject, cases.span, message, help_text)


@map_rule("RS0473", "Given that nothing needs")
def given_unused(register_map: RegisterMap, scopes: Scopes) -> Iterator[Finding]:
    """Users must find out every given; one that decides nothing is in vain."""
    if not register_map.givens:
        return
    used = {test.given for one in _case_sets(scopes) for condition in one.conditions for test in condition.leaves}
    used |= {block.given for block in register_map.blocks}
    registers = (register for scope in scopes for register in scope.model.registers)
    parts = (part for register in registers for part in parts_of((register.scale, register.range, register.views)))
    used |= {part.given for part in parts if isinstance(part, GivenRef)}
    for scope in scopes:
        computed = parts_of(tuple((one.term, one.valid) for one in scope.model.computed))
        used |= {part.given for part in computed if isinstance(part, GivenRef | Is)}
        used |= {test.given for *_, when in conditional(scope.model) for test in when.leaves}
    for given in register_map.givens:
        if given.id not in used:
            message = f"given `{given.id}` decides nothing"
            yield Finding(given.id, given.span, message, "use it in a condition or for a block, or remove it")
