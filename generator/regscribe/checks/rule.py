"""How a rule is written: a small pure function under a decorator that names the rule and what the function looks at."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from fractions import Fraction
from functools import partial
from typing import TypeVar, cast

from regscribe.checks.assumed_values import Beginning, all_defaults
from regscribe.model import Model, Register, RegisterMap, Related, Rule, Severity, Span
from regscribe.reference import RefusedError, Surroundings, UnknownValueError, choose, limits

Made = TypeVar("Made")

MAP = "map"
"""The subject of findings about the map as a whole."""


@dataclass(frozen=True, slots=True)
class RuleScope:
    """One model under examination: its map, its registers by path, and the state in which all stand at their defaults.

    `memo` keeps costly answers about this model.
    """

    register_map: RegisterMap
    model: Model
    registers: dict[str, Register]
    beginning: Beginning
    defaults: Surroundings
    memo: dict[object, object] = field(default_factory=dict)

    @classmethod
    def of(cls, register_map: RegisterMap, model: Model) -> "RuleScope":
        """The scope of one model of a map."""
        by_path = {register.path: register for register in model.registers}
        beginning = Beginning.of(model)
        return cls(register_map, model, by_path, beginning, all_defaults(model, beginning))

    def once(self, key: object, make: Callable[[], Made]) -> Made:
        """What `make` gives; worked out once for the model."""
        if key not in self.memo:
            self.memo[key] = make()
        return cast("Made", self.memo[key])

    def ends_at_defaults(self, register: Register) -> tuple[tuple[Fraction | None, Fraction | None], ...]:
        """The ends of a register's range with all other registers at their defaults; none where they are not known."""
        try:
            now = choose(register.range, self.defaults)
            return limits(now, self.defaults) if now else ()
        except (UnknownValueError, RefusedError):
            return ()


@dataclass(frozen=True, slots=True)
class Finding:
    """Something wrong with `subject`: a register's path, the id of a group or command, or `map`."""

    subject: str
    span: Span
    message: str
    help: str = ""
    related: tuple[Related, ...] = ()

    @classmethod
    def at(cls, register: Register, message: str, help: str = "", *related: Related) -> "Finding":  # noqa: A002 (named as in Diagnostic)
        """A finding about a register: the message starts with its path."""
        return cls(register.path, register.span, f"`{register.path}` {message}", help, related)


Scopes = tuple[RuleScope, ...]
"""The scopes of all models of a map."""

RegisterCheck = Callable[[Register, RuleScope], Iterable[Finding]]
ModelCheck = Callable[[RuleScope], Iterable[Finding]]
MapCheck = Callable[[RegisterMap, Scopes], Iterable[Finding]]
Check = TypeVar("Check")
Findings = Iterator[tuple[str, Finding]]
"""What a rule finds: the findings of each model by its name, those of the map under an empty name."""


@dataclass(frozen=True, slots=True)
class RuleEntry:
    """A rule and what finds all that is against it, in the scopes of all models."""

    rule: Rule
    run: Callable[[Scopes], Findings]


_ENTRIES: list[RuleEntry] = []


def entries() -> tuple[RuleEntry, ...]:
    """All rules that were declared, in the order of their ids."""
    return tuple(sorted(_ENTRIES, key=lambda entry: entry.rule.id))


def register_rule(
    rule_id: str, title: str, why: str, *, warns: bool = False
) -> Callable[[RegisterCheck], RegisterCheck]:
    """Declare a rule whose function looks at one register of one model at a time; one that `warns` stops nothing."""
    return _declare(warning(rule_id, title, why) if warns else Rule(rule_id, title, why), _of_registers)


def model_rule(rule_id: str, title: str, why: str, *, warns: bool = False) -> Callable[[ModelCheck], ModelCheck]:
    """Declare a rule whose function looks at one model at a time."""
    return _declare(warning(rule_id, title, why) if warns else Rule(rule_id, title, why), _of_models)


def map_rule(rule_id: str, title: str, why: str, *, warns: bool = False) -> Callable[[MapCheck], MapCheck]:
    """Declare a rule whose function looks at the whole map, and at the scopes of all its models."""
    return _declare(warning(rule_id, title, why) if warns else Rule(rule_id, title, why), _of_map)


def warning(rule_id: str, title: str, why: str) -> Rule:
    """A rule whose findings do not stop the pipeline."""
    return Rule(rule_id, title, why, Severity.WARNING)


def _declare(rule: Rule, findings: Callable[[Check, Scopes], Findings]) -> Callable[[Check], Check]:
    def declare(check: Check) -> Check:
        _ENTRIES.append(RuleEntry(rule, partial(findings, check)))
        return check

    return declare


def _of_registers(check: RegisterCheck, scopes: Scopes) -> Findings:
    for scope in scopes:
        for register in scope.model.registers:
            for finding in check(register, scope):
                yield scope.model.name, finding


def _of_models(check: ModelCheck, scopes: Scopes) -> Findings:
    for scope in scopes:
        for finding in check(scope):
            yield scope.model.name, finding


def _of_map(check: MapCheck, scopes: Scopes) -> Findings:
    yield from (("", finding) for finding in check(scopes[0].register_map, scopes))
