"""One register as one declaration of a generated class."""

import re
from dataclasses import dataclass

from regscribe.emit.python.enum_classes import NamedClasses, enum_content, special_content, specials, word_content
from regscribe.emit.python.expressions import Specs, expression
from regscribe.emit.python.formatting import Call, Expression, call, group, lay, mapping
from regscribe.emit.python.literals import docstring, exact, literal, plain
from regscribe.emit.words import listed, one_line, range_words
from regscribe.model import PLAIN_READING, Access, Cases, Command, Kind, Range, Register, WireType, show
from regscribe_runtime.values.kinds import OCTETS
from regscribe_runtime.values.octets import PLAIN_TEXT

DESCRIPTORS = {Access.READ: "ReadOnly", Access.READ_WRITE: "ReadWrite", Access.WRITE: "WriteOnly"}


NAMED = {Kind.ENUM: "choice", Kind.FLAGS: "flags", Kind.FIELDS: "word_of"}
"""The kinds whose values are of a class of their own, and the function of the runtime that takes it."""


OCTET_TYPES = {WireType.STRING: "text", WireType.BYTES: "octets"}
"""The names of types of bytes in Python, where they are not those of the map."""


@dataclass(frozen=True, slots=True)
class Declarations:
    """Writes declarations of registers with the shared constants and classes of a module."""

    specs: Specs
    named: NamedClasses

    def call(self, register: Register) -> Call:
        """The declaration itself."""
        specs = self.specs
        return call(
            DESCRIPTORS[register.access],
            str(register.at),
            specs.views(register),
            self._kind(register),
            scale=specs.scale(register, "scale", "value of the stored x"),
            special_scale=specs.scale(register, "special_scale", "value of the special code x"),
            range=specs.range(register, "range"),
            valid=specs.range(register, "valid"),
            default=_default(register),
            default_cases=specs.shared(register, "default", register.default_cases),
            unit=specs.unit(register),
            section=_text(register.section),
            sentinels=specs.shared(register, "sentinels", register.sentinels),
            partial=specs.shared(register, "partial", register.partial),
            aliases=group([str(alias) for alias in register.aliases]) if register.aliases else None,
            writable=specs.shared(register, "writable", register.writable),
            when=None if register.when.always else specs.shared(register, "when", register.when),
            persistence=_text(register.persistence),
            unlock=_text(register.unlock),
            apply=_text(register.apply),
            danger=specs.maybe(register, "danger", literal(one_line(register.danger))) if register.danger else None,
            stays=_text(register.stays),
            governs=specs.governs(register),
            settle=str(register.settle) if register.settle else None,
            reading=specs.of(register.reading) if register.reading != PLAIN_READING else None,
            static="True" if register.static else None,
            mandatory=None if register.mandatory is None else str(register.mandatory),
            rescales=_text(register.rescales),
            block=_text(register.block),
        )

    def _kind(self, register: Register) -> Expression:
        helper = self.specs.pool.helper
        if named := self._named(register):
            return f"{helper(NAMED[register.kind])}({', '.join(named)})"
        match register.kind:
            case kind if kind in OCTETS:
                return self._octets(register)
            case Kind.VERSION:
                return f"{helper('version')}({register.version_digits}, {register.version_group})"
        if register.specials:
            return self._numeric(register)
        return helper("raw_float" if register.kind is Kind.RAW and register.fractional else register.kind)

    def _octets(self, register: Register) -> Expression:
        """The type of a text, an address, or a date, with its form."""
        helper = self.specs.pool.helper
        if register.layout:
            return f"{helper(f'{register.kind}_as')}({literal(register.layout)})"
        if register.text != PLAIN_TEXT:
            return call(helper("text_as"), expression(register.text))
        return helper(OCTET_TYPES.get(register.base.type, register.base.type))

    def _named(self, register: Register) -> list[str]:
        """The classes of the values, if they have some of their own: several of an enum by case."""
        if register.kind is Kind.ENUM and register.enum:
            return [self.named.name(enum.id, enum_content(enum)) for enum in register.enum.each]
        if register.kind in {Kind.FLAGS, Kind.FIELDS}:
            return [self.named.name(register.id, word_content(register))]
        return []

    def class_of(self, register: Register) -> str:
        """The type of a register's values, if they have one of their own; with special values, that or a number."""
        if specials(register) and register.kind in {Kind.NUMBER, Kind.INTEGER}:
            return f"{TYPES[register.kind]} | {self.named.name(f'{register.id}_special', special_content(register))}"
        return " | ".join(self._named(register))

    def _numeric(self, register: Register) -> Expression:
        helper = self.specs.pool.helper
        means = [(exact(one.code), exact(one.means)) for one in register.specials if one.means is not None]
        kind = "number" if register.fractional else "integer"
        if not specials(register):
            return call(helper(f"{kind}_with"), mapping(means))
        special = self.named.name(f"{register.id}_special", special_content(register))
        return call(helper(f"{kind}_or"), special, mapping(means)) if means else f"{helper(f'{kind}_or')}({special})"


def _text(text: str) -> str | None:
    return literal(text) if text else None


def _default(register: Register) -> str | None:
    if register.default is None:
        return None
    return literal(register.default) if isinstance(register.default, str) else plain(register.default)


def declaration_lines(register: Register, declaration: Call) -> list[str]:
    """A declaration and the register's docstring, indented for a class body."""
    text = _about(register)
    return [*lay(declaration, head=f"{register.id} = ", depth=1), *(docstring(text, 1) if text else [])]


def _about(register: Register) -> str:
    """The docstring of a register; empty if it says no more than the declaration."""
    name = one_line(register.name)
    symbol = f" ({one_line(register.symbol)})" if register.symbol else ""
    facts = [
        _range_text(register.range),
        f"valid {valid}" if (valid := _range_text(register.valid)) else "",
        f"special: {listed([f'{show(one.code)} = {one_line(one.label)}' for one in register.specials])}"
        if register.specials
        else "",
        f"unit {units}" if (units := listed([case.then for case in register.unit if case.then])) else "",
    ]
    if not any(facts) and re.sub(r"\W+", "_", (name + symbol).lower()).strip("_") == register.id:
        return ""
    return f"{name}{symbol}: {'; '.join(map(one_line, filter(None, (*facts, register.section))))}."


def _range_text(cases: Cases[Range]) -> str:
    """A range in words; empty where it depends on other registers: its cases are a constant with a comment."""
    if len(cases) > 1 or any(not case.when.always for case in cases):
        return ""
    return listed([range_words(case.then) for case in cases])


def command_call(command: Command, declarations: Declarations, takes: str) -> Call:
    """The declaration of a command; `takes` is the function that has its arguments, if it has any."""
    pool = declarations.specs.pool
    steps = (declarations.specs.of(step) for step in command.steps)
    when = None if command.when.always else declarations.specs.of(command.when)
    danger = pool.maybe(literal(one_line(command.danger)), f"{command.id}_danger") if command.danger else None
    if not takes:
        return call("Command", *steps, danger=danger, when=when)
    arguments = mapping([(literal(name), declarations.call(register)) for name, register in command.arguments])
    return call("CommandWith", takes, *steps, arguments=arguments, danger=danger, when=when)


TYPES = {
    Kind.NUMBER: "float",
    Kind.INTEGER: "int",
    Kind.RAW: "int",
    Kind.STRING: "str",
    Kind.VERSION: "str",
    Kind.BOOLEAN: "bool",
    Kind.BYTES: "bytes",
    Kind.MAC: "str",
}


def takes_lines(command: Command, name: str, declarations: Declarations) -> list[str]:
    """The function `name` that has the arguments of a command and their types."""
    types = [(each, _type_of(register, declarations)) for each, register in command.arguments]
    parameters = ", ".join(f"{each}: {kind}" for each, kind in types)
    return [
        f"def {name}(*, {parameters}, confirm: bool = False) -> None:",
        *docstring(f"Arguments of {command.id}.", 1),
    ]


def _type_of(register: Register, declarations: Declarations) -> str:
    if register.kind is Kind.RAW and register.fractional:
        return "float"
    return declarations.class_of(register) or TYPES.get(register.kind, "Any")


def command_text(command: Command) -> str:
    """The docstring of a command."""
    parts = [one_line(part) for part in (command.name, command.description, command.section) if part]
    danger = f"; dangerous: {one_line(command.danger)}" if command.danger else ""
    return f"{'; '.join(parts)}{danger}."
