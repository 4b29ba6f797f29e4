"""Classes for values with names: enums, flags, words of bit fields and special values; equal ones are shared."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import NamedTuple

from regscribe.emit.python.class_sharing import suffix
from regscribe.emit.python.expressions import expression
from regscribe.emit.python.formatting import INDENT, WIDTH, Call, call, group, lay, width
from regscribe.emit.python.literals import camel, docstring, exact, literal, plain
from regscribe.emit.python.reserved_names import free, taken
from regscribe.emit.words import member_words, one_line
from regscribe.model import Array, BitField, Enum, Kind, Register, RegisterMap

Content = tuple[object, ...]


class Origin(NamedTuple):
    """A class and the module of a library that defines it."""

    module: str
    name: str


@dataclass(slots=True)
class NamedClasses:
    """Class names by content.

    If models define a name differently, the definition that most models share keeps the plain name, and the names of
    the others end with those of their models. A class that a library offers under the same key is imported.
    """

    register_map: RegisterMap
    offered: Mapping[str, Origin] = field(default_factory=dict)
    wanted: dict[str, dict[Content, list[str]]] = field(default_factory=dict)
    bodies: dict[Content, list[str]] = field(default_factory=dict)
    keys: dict[Content, str] = field(default_factory=dict)
    imports: dict[Content, Origin] = field(default_factory=dict)
    taken: frozenset[str] = field(init=False)

    def __post_init__(self) -> None:
        self.taken = taken(self.register_map)

    def collect_all(self) -> None:
        """Note all classes that the map needs."""
        models = self.register_map.models
        found = [(one, model.name) for model in models for one in _registers(model.members)]
        found += [(one, model.name) for model in models for command in model.commands for _, one in command.arguments]
        for register, model in found:
            self._collect(register, model)
        for register, model in found:  # their enums were collected for all models before
            if register.kind is Kind.FIELDS:
                body = self._word_body(register)
                self._note(register.id, word_content(register), word_key(register), model, body)

    def declare(self, enum: Enum, owner: str) -> None:
        """Note an enum of a library, which no register needs to have; without members it is no class."""
        if enum.members:
            self._enum(enum, owner, f"{enum.id.replace('_', ' ').capitalize()}.")

    def _enum(self, enum: Enum, model: str, about: str) -> None:
        self._note(enum.id, enum_content(enum), enum_key(enum), model, _enum_body(enum, about))

    def _collect(self, register: Register, model: str) -> None:
        """Note the classes that a register of a model needs, but for that of a word of bit fields."""
        for enum in (*(register.enum.each if register.enum else ()), *(part.enum for part in register.fields)):
            if enum:
                self._enum(enum, model, _about(register))
        if register.kind is Kind.FLAGS:
            self._note(register.id, word_content(register), word_key(register), model, _flags_body(register))
        if specials(register):
            content = special_content(register)
            self._note(f"{register.id}_special", content, str(content), model, _special_body(register))

    def _note(self, name: str, content: Content, key: str, model: str, body: list[str]) -> None:
        """Note a class that a model needs: the id that names it, and the key under which a library may offer it."""
        if content not in self.keys:
            self.keys[content] = key
            origin = self.offered.get(key)
            if origin and origin.name not in self.taken | self.imported:
                self.imports[content] = origin
        models = self.wanted.setdefault(camel(name), {}).setdefault(content, [])
        if model not in models:
            models.append(model)
        self.bodies.setdefault(content, body)

    def offered_by(self, module: str) -> dict[str, Origin]:
        """What a module with these classes offers to others, by key."""
        return {
            self.keys[content]: Origin(module, self.name(wanted, content))
            for wanted, variants in self.wanted.items()
            for content in variants
        }

    @property
    def imported(self) -> frozenset[str]:
        """The names of the classes that come from elsewhere."""
        return frozenset(origin.name for origin in self.imports.values())

    def name(self, wanted: str, content: Content) -> str:
        """The class name for `wanted` with this content."""
        if content in self.imports:
            return self.imports[content].name
        variants = {one: models for one, models in self.wanted[camel(wanted)].items() if one not in self.imports}
        plain = free(camel(wanted), self.taken, "Value")
        usual = max(variants, key=lambda one: len(variants[one]))
        if content == usual and plain not in self.imported:
            return plain
        own = suffix(variants[content])
        alike = [one for one in variants if one != usual and suffix(variants[one]) == own]
        name = f"{plain}{own}{alike.index(content) + 1 if content in alike[1:] else ''}"
        return free(name, self.imported, "Own")

    def lines(self) -> list[str]:
        """The definitions of all own classes, enums before the words that use them."""
        found: list[str] = []
        for name, variants in self.wanted.items():
            for content in (one for one in variants if one not in self.imports):
                opening, *body = self.bodies[content]
                found += ["", "", f"class {self.name(name, content)}({opening}):", *body]
        return found

    def _word_body(self, register: Register) -> list[str]:
        lines = ["Word", *docstring(_about(register), 1), ""]
        for part in register.fields:
            lines += lay(self._part(part), head=f"{part.id} = ", depth=1)
        return lines

    def _part(self, part: BitField) -> Call:
        if part.is_flag:
            return call("Bit", str(part.low), literal(part.label))
        if part.is_number:
            return _number_part(part)
        kind = self.name(part.enum.id, enum_content(part.enum)) if part.enum else "int"
        return call("Field", str(part.low), str(part.high), kind, literal(part.label))


def _number_part(part: BitField) -> Call:
    """A part that is a number with a sign, a scale, limits or faults."""
    faults = tuple((*(one.ends or ()), one.id, one.label) for one in part.sentinels)
    whole = part.multiply.denominator == part.add.denominator == 1
    return call(
        "NumberField",
        str(part.low),
        str(part.high),
        "int" if whole else "float",
        literal(part.label),
        signed="True" if part.signed else None,
        multiply=exact(part.multiply) if part.multiply != 1 else None,
        add=exact(part.add) if part.add else None,
        limits=expression(part.range) if part.range else None,
        faults=expression(faults) if faults else None,
        valid=expression(part.valid) if part.valid else None,
    )


def _registers(members: Sequence[Register | Array]) -> list[Register]:
    return [
        register
        for member in members
        for register in (_registers(member.members) if isinstance(member, Array) else [member])
    ]


def enum_content(enum: Enum) -> Content:
    """Identity of an enum's class in a module: ids, codes, labels and cells."""
    other = (enum.other,) if enum.other else ()
    members = tuple((member.code, member.id, member.label, member.cells) for member in enum.members)
    return ("enum", enum.id, members, *other)


def enum_key(enum: Enum) -> str:
    """Identity of an enum's class in all modules: its content and the descriptions of its members."""
    return f"enum {enum_content(enum)} {[member_words(member, enum) for member in enum.members]}"


def word_content(register: Register) -> Content:
    """Identity of a word's class in a module: ids, labels and bits of its parts, and their enums."""
    parts = tuple(
        (part.id, part.label, part.low, part.high, part.enum and enum_content(part.enum), *_numeric(part))
        for part in register.fields
    )
    return ("word", register.id, parts, *([register.none] if register.none else ()))


def _numeric(part: BitField) -> Content:
    """What tells the number of a part from another's."""
    return (part.signed, part.multiply, part.add, part.range, part.valid, part.sentinels) if part.is_number else ()


def word_key(register: Register) -> str:
    """Identity of a word's class in all modules: its content and the descriptions of its parts."""
    parts = [
        (
            part.id,
            part.label,
            part.low,
            part.high,
            one_line(part.description),
            part.enum and enum_key(part.enum),
            *_numeric(part),
        )
        for part in register.fields
    ]
    return f"{register.kind} {register.id} {parts}{register.none}"


def specials(register: Register) -> list[tuple[Fraction, str, str]]:
    """Special values that stand for no number: (code, id, label)."""
    return [(one.code, one.id, one.label) for one in register.specials if one.means is None]


def special_content(register: Register) -> Content:
    """Identity of a class of special values."""
    return ("special", register.id, tuple(specials(register)))


def _members(members: Sequence[tuple[str, str, str, str]]) -> list[str]:
    lines: list[str] = []
    for code, name, label, description in members:
        items = [code, literal(label), *([literal(description)] if description else [])]
        written = f"{INDENT}{name.upper()} = {', '.join(items)}"
        lines += [written] if width(written) <= WIDTH else lay(group(items), head=f"{name.upper()} = ", depth=1)
    return lines


def _about(register: Register) -> str:
    section = one_line(register.section)
    return f"{one_line(register.name)} ({section})." if section else f"{one_line(register.name)}."


def _enum_body(enum: Enum, about: str) -> list[str]:
    """The base class of an enum, its docstring (`about` unless it has a description of its own) and members."""
    about = one_line(enum.description) or about
    members = [(str(member.code), member.id, member.label, member_words(member, enum)) for member in enum.members]
    base = f"Choice, other={literal(enum.other)}" if enum.other else "Choice"
    return [base, *docstring(about, 1), "", *_members(members)]


def _special_body(register: Register) -> list[str]:
    about = f"Special values of {_about(register)}"
    members = [(plain(code), name, label, "") for code, name, label in specials(register)]
    whole = all(code.denominator == 1 for code, _, _ in specials(register))
    return ["Choice" if whole else "SpecialNumber", *docstring(about, 1), "", *_members(members)]


def _flags_body(register: Register) -> list[str]:
    base = f"Flags, none={literal(one_line(register.none))}" if register.none else "Flags"
    lines = [base, *docstring(_about(register), 1), ""]
    for part in register.fields:
        lines.append(f"{INDENT}{part.id.upper()} = 1 << {part.low}")
        lines += docstring(". ".join(filter(None, [one_line(part.label), one_line(part.description)])), 1)
    return lines
