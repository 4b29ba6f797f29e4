"""How a rule is written: a small pure function under a decorator that names the rule and what the function looks at."""

from collections.abc import Callable, Hashable, Iterable, Iterator
from dataclasses import dataclass, field
from fractions import Fraction
from functools import partial
from typing import TypeVar, cast

from regscribe.checks.held_values import default_values, with_fields
from regscribe.model import Model, Register, RegisterMap, Related, Rule, Severity, Span
from regscribe.reference import Surroundings

Made = TypeVar("Made")
Item = TypeVar("Item")

MAP = "map"
"""The subject of findings about the map as a whole."""


@dataclass(frozen=True, slots=True)
class RuleScope:
    """One model under examination: its map, its registers and the defaults that are numbers, both by path.

    `at_defaults` is the state in which all registers stand at their defaults; `memo` keeps costly answers.
    """

    register_map: RegisterMap
    model: Model
    registers: dict[str, Register]
    defaults: dict[str, Fraction]
    at_defaults: Surroundings
    memo: dict[object, object] = field(default_factory=dict)

    @classmethod
    def of(cls, register_map: RegisterMap, model: Model) -> "RuleScope":
        """The scope of one model of a map."""
        by_path = {register.path: register for register in model.registers}
        defaults = default_values(model)
        return cls(register_map, model, by_path, defaults, Surroundings(with_fields(model, defaults)))

    def once(self, key: object, make: Callable[[], Made]) -> Made:
        """The result of `make`, which is called once for the model."""
        if key not in self.memo:
            self.memo[key] = make()
        return cast("Made", self.memo[key])

    def named(self, paths: Iterable[str]) -> Iterator[Register]:
        """The registers of these paths, each once, as far as the model has them."""
        return (self.registers[path] for path in dict.fromkeys(paths) if path in self.registers)


@dataclass(frozen=True, slots=True)
class Finding:
    """Something wrong with `subject`: a register's path, the id of a group or command, or `map`.

    `related` is the place of another party.
    """

    subject: str
    span: Span
    message: str
    help: str
    related: Related | None = None

    @classmethod
    def at(cls, register: Register, message: str, help_text: str, related: Related | None = None) -> "Finding":
        """A finding about a register: the message starts with its path."""
        return cls(register.path, register.span, f"`{register.path}` {message}", help_text, related)


Scopes = tuple[RuleScope, ...]
"""The scopes of all models of a map."""

Problem = tuple[str, str, *tuple[Related, ...]]
"""What is wrong with the subject that a rule looks at: message, help, and perhaps the place of another party."""

Findings = Iterator[tuple[str, Finding]]
"""Findings, each with the name of its model; those of the map as a whole with an empty name."""

RegisterCheck = Callable[[Register, RuleScope], Iterable[Problem]]
ModelCheck = Callable[[RuleScope], Iterable[Finding]]
HeaderCheck = Callable[[RegisterMap], Iterable[Problem]]
MapCheck = Callable[[RegisterMap, Scopes], Iterable[Finding]]
Check = TypeVar("Check", bound=Callable[..., object])


DECLARED: dict[Rule, Callable[[Scopes], Findings]] = {}
"""All declared rules, each with the function that finds its violations in the scopes of all models."""


def register_rule(rule_id: str, title: str, *, warns: bool = False) -> Callable[[RegisterCheck], RegisterCheck]:
    """Declare a rule whose function looks at one register of one model at a time; findings stand at the register."""

    def walk(check: RegisterCheck, scope: RuleScope) -> Iterator[Finding]:
        for register in scope.model.registers:
            for problem in check(register, scope):
                yield Finding.at(register, *problem)

    return rule_of_models(rule_id, title, walk, warns=warns)


def model_rule(rule_id: str, title: str, *, warns: bool = False) -> Callable[[ModelCheck], ModelCheck]:
    """Declare a rule whose function looks at one model at a time."""
    return rule_of_models(rule_id, title, lambda check, scope: check(scope), warns=warns)


def header_rule(rule_id: str, title: str, *, warns: bool = False) -> Callable[[HeaderCheck], HeaderCheck]:
    """Declare a rule whose function looks at what all models share; findings stand at the map."""

    def walk(check: HeaderCheck, scopes: Scopes) -> Iterator[Finding]:
        register_map = scopes[0].register_map
        return (Finding(MAP, register_map.span, *problem) for problem in check(register_map))

    return rule_of_map(rule_id, title, walk, warns=warns)


def map_rule(rule_id: str, title: str, *, warns: bool = False) -> Callable[[MapCheck], MapCheck]:
    """Declare a rule whose function looks at the whole map, and at the scopes of all its models."""
    return rule_of_map(rule_id, title, lambda check, scopes: check(scopes[0].register_map, scopes), warns=warns)


def rule_of_map(
    rule_id: str, title: str, walk: Callable[[Check, Scopes], Iterable[Finding]], *, warns: bool = False
) -> Callable[[Check], Check]:
    """Declare a rule whose function `walk` calls for each subject in the map."""
    return _declare(rule_id, title, lambda check, scopes: (("", one) for one in walk(check, scopes)), warns=warns)


def rule_of_models(
    rule_id: str, title: str, walk: Callable[[Check, RuleScope], Iterable[Finding]], *, warns: bool = False
) -> Callable[[Check], Check]:
    """Declare a rule whose function `walk` calls for each subject in one model."""

    def walk_all(check: Check, scopes: Scopes) -> Findings:
        return ((scope.model.name, finding) for scope in scopes for finding in walk(check, scope))

    return _declare(rule_id, title, walk_all, warns=warns)


def _declare(
    rule_id: str, title: str, walk: Callable[[Check, Scopes], Findings], *, warns: bool
) -> Callable[[Check], Check]:
    """Declare a rule; the docstring of its function is the reason for it, which `regscribe explain` shows."""

    def declare(check: Check) -> Check:
        severity = Severity.WARNING if warns else Severity.ERROR
        DECLARED[Rule(rule_id, title, check.__doc__ or "", severity)] = partial(walk, check)
        return check

    return declare


def doubled(items: Iterable[Item], keys: Callable[[Item], Iterable[Hashable]]) -> Iterator[tuple[Item, Item]]:
    """Pairs of an item and the first earlier item that shares a key with it, the earlier one first."""
    owners: dict[Hashable, Item] = {}
    for item in items:
        for key in keys(item):
            owner = owners.setdefault(key, item)
            if owner is not item:
                yield owner, item
                break
