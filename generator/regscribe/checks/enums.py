"""Enums, bit fields and flags: codes, labels, ids and bits."""

import keyword
from collections import defaultdict
from collections.abc import Callable, Iterator
from fractions import Fraction
from itertools import combinations

from regscribe.checks.held_values import no_member
from regscribe.checks.identifiers import ENUM_NAMES, enums_of, normalised
from regscribe.checks.representable import ends_of, same_bits
from regscribe.checks.rule import Finding, Problem, RuleScope, register_rule, rule_of_models
from regscribe.model import BitField, Enum, Kind, Member, Register, WireType, show
from regscribe.reference.ieee import ieee_bits, ieee_number, shortest

EnumCheck = Callable[[Enum], Iterator[Problem]]


def enum_rule(rule_id: str, title: str) -> Callable[[EnumCheck], EnumCheck]:
    """Declare a rule whose function looks at one enum, of a register or of a bit field; findings stand at the enum."""

    def walk(check: EnumCheck, scope: RuleScope) -> Iterator[Finding]:
        for register, field, enum in enums_of(scope):
            path = f"{register.path}.{field}" if field else register.path
            span = enum.span if enum.span.file else register.span
            for message, help_text, *related in check(enum):
                yield Finding(register.path, span, f"the enum of `{path}` {message}", help_text, *related)

    return rule_of_models(rule_id, title, walk)


@register_rule("RS0440", "Enum code outside the type")
def code_outside_type(register: Register, _: RuleScope) -> Iterator[Problem]:
    """A code that the word cannot spell can never be read or written."""
    if register.enum is None or register.base.type.is_octets:
        return
    outside = sorted({one.code for one in register.enum.members if not _carries(register.base.type, one.code)})
    if outside:
        message = f"has enum codes {', '.join(map(str, outside))}, outside {ends_of(register)}"
        yield message, same_bits(register, outside) or "correct the codes or the type"


def _carries(wire: WireType, code: int) -> bool:
    """Whether a type has the number that a code is; floats skip whole numbers far from 0."""
    if wire.is_float:
        bits = ieee_bits(Fraction(code), wire)
        return bits is not None and ieee_number(bits, wire) == shortest(Fraction(code), wire) == code
    low, high = wire.ends
    return low <= code <= high


def _label(member: Member) -> str:
    return " ".join(member.label.casefold().split())


def _sharing(enum: Enum, key: Callable[[Member], str]) -> Iterator[tuple[str, list[Member]]]:
    """Members of an enum that share a key, in the order of the first."""
    groups: defaultdict[str, list[Member]] = defaultdict(list)
    for member in enum.members:
        groups[key(member)].append(member)
    yield from ((name, members) for name, members in groups.items() if len(members) > 1)


def _codes(members: list[Member]) -> str:
    return ", ".join(str(member.code) for member in members)


@enum_rule("RS0441", "Label used twice in an enum")
def label_twice(enum: Enum) -> Iterator[Problem]:
    """Two codes of one meaning: one of them was misread, unless they have names of their own."""
    for label, members in _sharing(enum, _label):
        if len({member.id for member in members}) < len(members):
            message = f'has the label "{label}" for codes {_codes(members)}'
            yield message, "correct a label, or give each an `id` of its own: {label: ..., id: ...}"


@enum_rule("RS0442", "Enum members of one id")
def member_id_twice(enum: Enum) -> Iterator[Problem]:
    """Labels that differ in signs only become one Python name."""
    for name, members in _sharing(enum, lambda member: normalised(member.id)):
        if len({_label(member) for member in members}) == len(members):  # equal labels are RS0441's
            message = f"gives codes {_codes(members)} one id, {name.upper()}"
            yield message, "give one of them an `id`: {label: ..., id: ...}"


@register_rule("RS0443", "Default is no member of the enum")
def default_no_member(register: Register, _: RuleScope) -> Iterator[Problem]:
    """The device leaves the factory with a code that has a meaning."""
    for what, value in register.beginnings:
        problem = no_member(register, value)
        if problem:
            yield f"has {what} {problem}", f"correct the {what}, or add the member"


@enum_rule("RS0444", "Enum without members")
def no_members(enum: Enum) -> Iterator[Problem]:
    """A model on which no code is valid cannot have the register."""
    if not enum.members:
        yield "has no members", "give it members for this model, or the register an `except`"


@enum_rule("RS0454", "Cells and columns of an enum differ")
def cells_of_columns(enum: Enum) -> Iterator[Problem]:
    """A cell without a column, or the reverse, says nothing certain."""
    for member in enum.members:
        if member.cells and len(member.cells) != len(enum.columns):
            message = f"has {len(member.cells)} cells for code {member.code}, but {len(enum.columns)} columns"
            yield message, "give one cell for each of `columns`"


@enum_rule("RS0445", "Member id is no Python name")
def member_no_name(enum: Enum) -> Iterator[Problem]:
    """A member becomes an attribute of an IntEnum class."""
    for member in enum.members:
        name = member.id
        valid = name.isidentifier() and not name.startswith("_") and not keyword.iskeyword(name)
        if not valid or name.upper() in ENUM_NAMES:
            message = f"has member id {name} for code {member.code}, which Python cannot use"
            yield message, "give the member another `id`"


def _bits(bits: BitField) -> str:
    return f"`{bits.id}` (bit {bits.low})" if bits.width == 1 else f"`{bits.id}` (bits {bits.low}..{bits.high})"


@register_rule("RS0450", "Bit fields overlap")
def bits_overlap(register: Register, _: RuleScope) -> Iterator[Problem]:
    """One bit has one meaning: a row of the bit table was misread."""
    for one, other in combinations(register.fields, 2):
        if one.low <= other.high and other.low <= one.high:
            yield f"has bit fields {_bits(one)} and {_bits(other)} that overlap", "correct the bits of one of them"


@register_rule("RS0451", "Bit outside the word")
def bit_outside_word(register: Register, _: RuleScope) -> Iterator[Problem]:
    """A bit beyond the word's width can never be read."""
    for bits in register.fields:
        if bits.low < 0 or bits.high >= register.bits:
            message = f"has bit field {_bits(bits)} in a word of bits 0..{register.bits - 1}"
            yield message, "correct the bits or the type"


@register_rule("RS0452", "Enum wider than its bit field")
def enum_wider_than_field(register: Register, _: RuleScope) -> Iterator[Problem]:
    """A code that the bits cannot spell never occurs."""
    for bits in register.fields:
        outside = [m.code for m in bits.enum.members if not 0 <= m.code < 1 << bits.width] if bits.enum else []
        if outside:
            codes = ", ".join(map(str, outside))
            message = f"has bit field {_bits(bits)} with codes {codes}, outside 0..{(1 << bits.width) - 1}"
            yield message, "correct the codes or the bits"


@register_rule("RS0453", "Bit fields of one name")
def bits_of_one_name(register: Register, _: RuleScope) -> Iterator[Problem]:
    """Two bits of one id cannot be told apart; of one label they can, if each has an `id`."""
    for one, other in combinations(register.fields, 2):
        if normalised(one.id) == normalised(other.id):
            yield f'has bit fields {_bits(one)} and {_bits(other)} both called "{other.label}"', "correct one of them"


@register_rule("RS0655", "Default with bits that mean nothing")
def default_of_no_name(register: Register, _: RuleScope) -> Iterator[Problem]:
    """A driver writes no bit that has no name, so it could never write this default."""
    for what, value in register.beginnings if register.kind is Kind.FLAGS else ():
        if what != "default" or not isinstance(value, Fraction):
            continue
        unnamed = int(value) & ~register.named_bits
        if 0 <= value < 1 << register.bits and unnamed:
            bits = ", ".join(str(bit) for bit in range(register.bits) if unnamed >> bit & 1)
            message = f"has default {show(value)}, but no flag at bit {bits}"
            yield message, "name the bits, or give the value as `delivered`"
