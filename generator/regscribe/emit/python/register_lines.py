"""One register as one declaration of a generated class."""

from dataclasses import dataclass
from typing import Protocol

from regscribe.emit.python.enum_classes import Content, enum_content, special_content, specials, word_content
from regscribe.emit.python.expressions import Specs
from regscribe.emit.python.formatting import Call, Expression, call, group, lay, mapping
from regscribe.emit.python.literals import docstring, exact, literal, plain
from regscribe.emit.words import ACCESS, cases_words, listed, one_line, range_words
from regscribe.model import Access, Case, Command, Kind, NotANumber, Register, Sentinel, Step, show

SHOWN_CASES = 2
"""Ranges of more cases are left to the reference: a docstring is for a glance."""
DESCRIPTORS = {Access.READ: "ReadOnly", Access.READ_WRITE: "ReadWrite", Access.WRITE: "WriteOnly"}


NAMED = {Kind.ENUM: "choice", Kind.FLAGS: "flags", Kind.FIELDS: "word_of"}
"""The kinds whose values are of a class of their own, and the function of the runtime that takes it."""
TYPES = {Kind.STRING: "str", Kind.VERSION: "str", Kind.BOOLEAN: "bool"}
"""What the values of a kind are to a type checker, if neither `int` nor, where they may have a fraction, `float`."""


class Names(Protocol):
    """What gives named classes their names."""

    def name(self, wanted: str, content: Content) -> str:
        """The class name for `wanted` with this content."""
        ...


@dataclass(frozen=True, slots=True)
class Declarations:
    """Writes declarations of registers with the shared constants and classes of a module."""

    specs: Specs
    named: Names

    def lines(self, register: Register) -> list[str]:
        """The declaration and its docstring, indented for a class body."""
        return [*lay(self.call(register), head=f"{register.id} = ", depth=1), *docstring(about(register), 1)]

    def type(self, register: Register) -> str:
        """The type of the declaration: that of the register and of its values."""
        special = self._special(register) if specials(register) and not self._named(register) else ""
        value = self._named(register) or ("float" if register.fractional else TYPES.get(register.kind, "int"))
        return f"{DESCRIPTORS[register.access]}[{value}{special}]"

    def call(self, register: Register) -> Call:
        """The declaration itself."""
        specs = self.specs
        return call(
            DESCRIPTORS[register.access],
            str(register.base.address),
            specs.views(register),
            self._kind(register),
            scale=specs.scale(register),
            special_scale=specs.special_scale(register),
            range=specs.range(register),
            default=_default(register),
            unit=specs.unit(register.unit),
            section=literal(register.section) if register.section else None,
            sentinels=self._sentinels(register),
            aliases=group([str(alias) for alias in register.aliases]) if register.aliases else None,
            writable=self._writable(register),
            persistence=literal(register.persistence) if register.persistence else None,
            unlock=literal(register.unlock) if register.unlock else None,
            apply=literal(register.apply) if register.apply else None,
            danger=specs.pool.maybe("danger", literal(one_line(register.danger))) if register.danger else None,
            stays=literal(register.stays) if register.stays else None,
            governs=specs.governs(register),
            settle=str(register.settle) if register.settle else None,
            rescales=literal(register.rescales) if register.rescales else None,
        )

    def _sentinels(self, register: Register) -> str | None:
        rows = [group([_stored(one), literal(one.id), literal(one.label)]) for one in register.sentinels]
        return self.specs.pool.share("sentinels", group(rows)) if rows else None

    def _writable(self, register: Register) -> str | None:
        if register.writable is None:
            return None
        told = [self.specs.when(register.writable.when), literal(one_line(register.writable.reason))]
        return self.specs.pool.share("writable", group(told))

    def _kind(self, register: Register) -> Expression:
        helper = self.specs.pool.helper
        if named := self._named(register):
            return f"{helper(NAMED[register.kind])}({named})"
        match register.kind:
            case Kind.STRING:
                return helper("text")
            case Kind.VERSION:
                return f"{helper('version')}({register.version_digits}, {register.version_group})"
        if register.specials:
            return self._numeric(register)
        return helper("raw_float" if register.kind is Kind.RAW and register.fractional else register.kind)

    def _named(self, register: Register) -> str:
        """The class of the values, if they have one of their own."""
        if register.kind is Kind.ENUM and register.enum:
            return self.named.name(register.enum.id, enum_content(register.enum))
        if register.kind in {Kind.FLAGS, Kind.FIELDS}:
            return self.named.name(register.id, word_content(register))
        return ""

    def _special(self, register: Register) -> str:
        return self.named.name(f"{register.id}_special", special_content(register))

    def _numeric(self, register: Register) -> Expression:
        helper = self.specs.pool.helper
        means = [(exact(one.code), exact(one.means)) for one in register.specials if one.means is not None]
        kind = "number" if register.fractional else "integer"
        if not specials(register):
            return call(helper(f"{kind}_with"), mapping(means))
        special = self._special(register)
        return call(helper(f"{kind}_or"), special, mapping(means)) if means else f"{helper(f'{kind}_or')}({special})"


def _stored(sentinel: Sentinel) -> str:
    return literal(sentinel.stored.value) if isinstance(sentinel.stored, NotANumber) else exact(sentinel.stored)


def _default(register: Register) -> str | None:
    if register.default is None:
        return None
    return literal(register.default) if isinstance(register.default, str) else plain(register.default)


def about(register: Register) -> str:
    """The docstring of a register: range, special values, unit, access, section."""
    symbol = f" ({one_line(register.symbol)})" if register.symbol else ""
    facts = [
        range_text(register) if len(register.range) <= SHOWN_CASES else "range by condition",
        f"special: {listed([f'{show(one.code)} = {one_line(one.label)}' for one in register.specials])}"
        if register.specials
        else "",
        f"unit {units}" if (units := listed([case.then for case in register.unit if case.then])) else "",
        ACCESS[register.access],
        register.section,
    ]
    return f"{one_line(register.name)}{symbol}: {'; '.join(one_line(fact) for fact in facts if fact)}."


def range_text(register: Register) -> str:
    """The range in words, with the conditions of its cases."""
    return (
        cases_words(tuple(Case(case.when, range_words(case.then)) for case in register.range)) if register.range else ""
    )


def command_call(command: Command) -> Call:
    """The declaration of a command."""
    steps = (_step(step) for step in command.steps)
    return call("Command", *steps, danger=literal(one_line(command.danger)) if command.danger else None)


def _step(step: Step) -> Call:
    if not step.words:
        return group(["0", str(step.wait), "()"])
    return group([str(step.function), str(step.address), group([str(word) for word in step.words])])


def command_text(command: Command) -> str:
    """The docstring of a command."""
    parts = [one_line(part) for part in (command.name, command.description, command.section) if part]
    danger = f"; dangerous: {one_line(command.danger)}" if command.danger else ""
    return f"{'; '.join(parts)}{danger}."
